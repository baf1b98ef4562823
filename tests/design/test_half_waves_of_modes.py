"""The warning of a screening that modes have few segments, for shapes that are written down."""

import math
import re

import numpy as np
import pytest
import xarray as xr

from riserstudy.design.vortex_screening import HALF_WAVE, _unresolved


@pytest.mark.parametrize("seed", range(20))
def test_modes_with_few_segments_in_a_half_wave_are_named_from_the_first_on(seed):
    """Half waves of p sines on n segments have n / p segments, along x or across it."""
    draw = np.random.default_rng(seed)
    count, numbers = int(draw.integers(20, 120)), [*range(1, int(draw.integers(4, 16)))]
    place = np.linspace(0.0, 1.0, count + 1)
    shapes = np.zeros((2, len(numbers), count + 1))
    for k, number in enumerate(numbers):
        shapes[draw.integers(2), k] = np.sin(math.pi * (number * place + 1e-3))
    shapes += 1e-3 * draw.normal(size=shapes.shape) * (shapes == 0.0)  # of the other direction
    modes = xr.Dataset(
        {name: (("mode", "s_node"), of) for name, of in zip("xy", shapes, strict=True)}, {"mode": numbers}
    )
    few = [number for number in numbers if number > 2 and math.floor(count / number) < HALF_WAVE]
    said = _unresolved(modes)
    if not few:
        assert said == ""
        return
    first, enough = (int(re.search(words, said)[1]) for words in (r"mode (\d+) on", r"about (\d+) seg"))
    assert said.startswith(f"analysis.mesh: {count} segments are too few")
    assert abs(first - few[0]) <= 1
    # with so many segments, the shortest half wave has enough of them
    assert HALF_WAVE * numbers[-1] <= enough <= HALF_WAVE * count / math.floor(count / numbers[-1]) + 1.0
