"""Two tensioners are similar at a low amplitude and differ at a high one only if both parts are true."""

import itertools
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.chang2020.claims import agree, similar_then_apart
from riserstudy.grading.grade import answers
from riserstudy.grading.words_of_size_file import read_words

WORD = read_words(Path(__file__).parents[3] / "config").word
LIMITS = {"similar": WORD("similar"), "significantly": WORD("significant"), "amplitudes": [3.0, 10.0]}
ZERO, AMPLITUDES = 2394.0, [0.0, 3.0, 10.0]
FEW, MUCH = (0.01, 0.045), (0.3, 1.2)  # differences, as shares of the range
BETWEEN = (0.055, 0.24)


def responses(seed, apart, unit=1.0, level=0.0):
    """Heave with the gas law, and with a line that around one time is off by a share of the range."""
    draw = np.random.default_rng(seed)
    late, sizes = draw.uniform(0.0, 6.0, 2), np.array([0.0, 2.0, 6.0])
    time = np.arange(50.0)

    def shape(t):
        return np.cos(2.0 * np.pi * t / 25.0 - late[0]) + 0.3 * np.cos(2.0 * np.pi * t / 12.5 - late[1])

    curves = sizes[:, None] * shape(time)
    ranges = sizes * np.ptp(shape(np.linspace(0.0, 49.0, 20001)))
    bump = draw.choice([-1.0, 1.0]) * np.exp(-(((time - draw.integers(5, 45)) / 4.0) ** 2))
    other = curves.copy()
    other[1:] += (np.array(apart) * ranges[1:])[:, None] * bump

    def made(values):
        return xr.Dataset(
            {
                "z": (("heave_amplitude", "time", "s"), ZERO + level + unit * values[..., None]),
                "z_static": (("heave_amplitude", "s_node"), np.full((3, 1), ZERO + level)),
            },
            {"heave_amplitude": AMPLITUDES, "time": np.arange(50.0), "s": [ZERO], "s_node": [ZERO]},
        )

    return made(curves), made(other)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("unit, level", [(1.0, 0.0), (-3.0, 5.0)])
def test_both_parts_are_required(seed, unit, level):
    for small, large in itertools.product(FEW + BETWEEN + MUCH, repeat=2):
        found = similar_then_apart(*responses(seed, (small, large), unit, level), **LIMITS)
        assert (answers(found).item() == 1.0) == (small in FEW and large in MUCH), (small, large)
        assert float(found.value) == pytest.approx(large / small)


@pytest.mark.parametrize("seed", range(5))
def test_models_that_are_not_even_similar_do_not_agree(seed):
    """What is false of similarity is false of better agreement, at the same amplitude."""
    draw = np.random.default_rng(seed)
    for small in draw.uniform(0.051, 2.0, 3):
        gas, line = responses(seed, (small, 1.5))
        assert answers(agree(gas, line, 3.0, WORD("agree extremely well"))).item() == -1.0
        assert answers(similar_then_apart(gas, line, **LIMITS)).item() == -1.0
