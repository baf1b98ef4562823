"""Checks of what Chang et al. 2020 claim, on invented runs."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.chapters.chang2020 import claims as checks


def runs(up, down, amplitudes=(0.5, 1.0, 3.0, 10.0)):
    rest = 2395.0
    return xr.Dataset(
        {
            "z_static": (("heave_amplitude", "s_node"), np.full((len(amplitudes), 1), rest)),
            "z_max": (("heave_amplitude", "s_node"), rest + np.array(up, float)[:, None]),
            "z_min": (("heave_amplitude", "s_node"), rest - np.array(down, float)[:, None]),
        },
        {"heave_amplitude": list(amplitudes), "s_node": [2394.0]},
    )


def test_asymmetry_must_grow_at_every_step():
    grows = checks.asymmetry_grows(runs([1.0, 2.2, 6.0, 30.0], [1.0, 2.0, 4.0, 10.0]))
    assert bool(grows.true)
    assert float(grows.value) == pytest.approx(3.0)
    dips = runs([1.1, 2.0, 6.0, 30.0], [1.0, 2.0, 4.0, 10.0])
    assert not bool(checks.asymmetry_grows(dips).true)
    assert bool(checks.asymmetry_grows(dips, amplitudes=[1.0, 3.0, 10.0]).true)


def test_the_upper_side_must_be_larger_and_both_must_grow():
    assert bool(checks.upper_side_larger(runs([2, 3, 4, 5], [1, 2, 3, 4])).true)
    assert not bool(checks.upper_side_larger(runs([2, 3, 4, 5], [1, 2, 1, 4])).true)
    assert not bool(checks.upper_side_larger(runs([1, 3, 4, 5], [1, 2, 3, 4])).true)


def law(force, stroke):
    place = ("tensioner_model", "heave_position", "cylinder")
    models = ["gas law", "linear"]
    return xr.Dataset(
        {
            "tensioner_force_static": (place, np.stack([force, force])[..., None]),
            "tensioner_stroke_static": (place, np.stack([stroke, stroke])[..., None]),
        },
        {"tensioner_model": models, "heave_position": stroke},
    )


def test_the_force_must_fall_and_be_convex():
    stroke = np.linspace(-10.0, 10.0, 41)  # the piston's X is -stroke
    assert bool(checks.falls_convex(law(np.exp(0.1 * stroke), stroke)).true)
    assert not bool(checks.falls_convex(law(np.exp(-0.1 * stroke), stroke)).true)
    assert not bool(checks.falls_convex(law(-np.exp(-0.1 * stroke), stroke)).true)


def test_a_secant_that_falls_is_told_from_one_that_rises():
    stroke = np.linspace(-10.0, 10.0, 41)
    assert bool(checks.secant_falls(law(np.exp(0.1 * stroke), stroke)).true)
    assert not bool(checks.secant_falls(law(-np.exp(-0.1 * stroke), stroke)).true)


def test_a_line_differs_from_a_curve_and_not_from_itself():
    stroke = np.linspace(-10.0, 10.0, 41)
    same = law(np.exp(0.1 * stroke), stroke)
    assert not bool(checks.line_differs(same, at_least=0.05).true)
    other = same.copy(deep=True)
    other["tensioner_force_static"].loc[{"tensioner_model": "linear"}] += 0.1
    found = checks.line_differs(other, at_least=0.05)
    assert float(found.value) == pytest.approx(0.1)
    assert bool(found.true)
