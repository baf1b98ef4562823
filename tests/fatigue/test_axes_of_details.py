"""Studies with axes that are not sea states: damage and gamma have the selected values of these axes."""

import json

import numpy as np
import pytest
import xarray as xr
from test_years import study
from test_years_of_records import seas

from riserstudy.dataset.provenance import scene_of_point
from riserstudy.fatigue.occurrence import of_record
from riserstudy.fatigue.years import axes_of, gamma_of, over_years

FACTOR, GAMMA = "safety_factor", "gamma"


def varied(seed):
    """A study with axes of the second detail's safety factor and of the sea's peak enhancement."""
    draw = np.random.default_rng(seed)
    of, axes = study(), {FACTOR: "fatigue.details[1].safety_factor", GAMMA: "wave.peak_enhancement"}
    for axis, path in axes.items():
        values = np.sort(draw.uniform(1.0, 6.0, 3))
        parts = [of.assign(damage_rate=of["damage_rate"] * (1.0 + 0.1 * k)) for k in range(3)]
        of = xr.concat(parts, axis, data_vars=["damage_rate"])
        sets = {str(value): {path: value} for value in values.tolist()}
        of = of.assign_coords({axis: (axis, values, {"units": "1", "sets": json.dumps(sets)})})
    return of.assign_attrs(study().attrs), draw.integers(3, size=2)


@pytest.mark.parametrize("seed", range(6))
def test_damage_has_the_selected_safety_factor(seed):
    of, (k, j) = varied(seed)
    factor, gamma = (float(of[axis][n]) for axis, n in ((FACTOR, k), (GAMMA, j)))
    at = {FACTOR: repr(factor), GAMMA: repr(gamma)}
    record = seas(seed)
    found = over_years(of, of_record(record, of, axes_of(of)), at)
    alone = study()
    expected = over_years(alone, of_record(record, alone, axes_of(alone)), {})
    assert [one.safety_factor for one in found.worst] == [10.0, factor]
    for one, without in zip(found.worst, expected.worst, strict=True):
        assert one.rate == pytest.approx(without.rate * (1.0 + 0.1 * k) * (1.0 + 0.1 * j), rel=1e-9)
        assert one.life == pytest.approx(1.0 / (one.rate * one.safety_factor))
    assert gamma_of(of, at) == gamma


@pytest.mark.parametrize("seed", range(6))
def test_a_scene_does_not_depend_on_how_its_point_is_selected(seed):
    """By index, or in part by an earlier selection."""
    of, (k, j) = varied(seed)
    scene = scene_of_point(of, {FACTOR: k, GAMMA: j})
    assert scene.fatigue.details[1].safety_factor == float(of[FACTOR][k])
    for axis, n, rest in ((FACTOR, k, {GAMMA: j}), (GAMMA, j, {FACTOR: k})):
        assert scene_of_point(of.isel({axis: n}), rest) == scene
    assert scene_of_point(of.isel({FACTOR: k, GAMMA: j}), {}) == scene
