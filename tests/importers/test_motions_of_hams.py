"""A ``.4`` file of HAMS, whose motions are not those of WAMIT, is refused; any real motion is not."""

import math

import numpy as np
import pytest

from riserstudy.errors import InputError
from riserstudy.importers.wamit import from_wamit


def written(path, draw, unit, modes):
    """Motions of a spring in long and short waves, in a unit of amplitude."""
    lines = []
    own = float(draw.uniform(15.0, 25.0))
    for period in np.sort(draw.uniform(5.0, 30.0, 8)):
        for mode in modes:
            value = unit * complex(1.0, 0.1) / (1.0 - (own / period) ** 2 + 0.2j)
            angle = math.degrees(math.atan2(value.imag, value.real))
            numbers = (period, 0.0, mode, abs(value), angle, value.real, value.imag)
            lines.append(" ".join(f"{x:.6E}" if k != 2 else f"{x}" for k, x in enumerate(numbers)))
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize("first", [None, "period", "frequency"])
@pytest.mark.parametrize("seed", range(9))
def test_motions_per_density_times_gravity_are_refused_and_others_are_not(tmp_path, seed, first):
    draw = np.random.default_rng(seed)
    path = tmp_path / "Buoy.4"
    modes = sorted({int(draw.integers(1, 4)), int(draw.integers(1, 7))})
    assert from_wamit(written(path, draw, float(draw.uniform(0.05, 1.0)), modes), 1.0, "period").rows
    weight = float(draw.uniform(980.0, 1030.0)) * 9.81
    with pytest.raises(InputError, match=r"the moduli: .* m per m of wave.*HAMS"):
        from_wamit(written(path, draw, 1.0 / weight, modes), 1.0, first)


@pytest.mark.parametrize("seed", range(3))
def test_rotations_alone_may_be_of_any_size(tmp_path, seed):
    draw = np.random.default_rng(seed)
    path = tmp_path / "yaw.4"
    assert from_wamit(written(path, draw, 1e-5, [6]), 1.0, "period").rows
