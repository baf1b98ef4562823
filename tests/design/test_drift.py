"""A vessel adrift: printed cases, and its equation of motion integrated step by step."""

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp

from riserstudy.dataset.crossing import first_crossing
from riserstudy.design.drift import Hull, drift
from riserstudy.design.watch_circles import watch_circle

HULL = Hull(9e7, 599625.0)


def test_a_steady_force_in_still_water_drives_the_vessel_as_worked_by_hand():
    found = drift(HULL, 1e6, 0.0, 300.0)
    assert float(found.way) == pytest.approx(284.2396, abs=5e-5)
    assert float(found.speed) == pytest.approx(1.27669, abs=5e-6)


def test_a_current_alone_takes_the_vessel_along_as_worked_by_hand():
    assert float(drift(HULL, 0.0, 1.0, 300.0).way) == pytest.approx(135.168, abs=5e-4)


@pytest.mark.parametrize("force, current", [(1e6, 0.0), (0.0, 1.5), (2e5, 1.0), (3e6, 2.0)])
def test_drift_solves_its_equation_of_motion(force, current):
    def acceleration(_, state):
        slip = current - state[1]
        return [state[1], (force + HULL.drag * slip * abs(slip)) / HULL.mass]

    times = np.linspace(0.0, 900.0, 10)
    solved = solve_ivp(acceleration, (0.0, 900.0), [0.0, 0.0], t_eval=times, rtol=1e-10, atol=1e-10)
    found = drift(HULL, force, current, times)
    np.testing.assert_allclose(found.way, solved.y[0], rtol=1e-7, atol=1e-6)
    np.testing.assert_allclose(found.speed, solved.y[1], rtol=1e-7, atol=1e-8)


def test_a_force_against_the_current_is_refused():
    with pytest.raises(ValueError, match="same direction"):
        drift(HULL, 1e6, -1.0, 10.0)


def test_circles_of_a_drifting_vessel_leave_the_disconnect_its_time():
    """Adrift from the alarm on, the vessel reaches the limit when the disconnect is over, and not before."""
    times = np.arange(0.0, 1801.0)
    way = xr.DataArray(drift(HULL, 5e5, 1.0, times).way, dims="time", coords={"time": times})
    first = first_crossing(way - 120.0, 0.0)
    for before in (30.0, 60.0, 150.0):
        circle = watch_circle(first, way, before)
        alarm = float(first_crossing(way, float(circle["circle_radius"])))
        assert float(drift(HULL, 5e5, 1.0, alarm + before).way) == pytest.approx(120.0, abs=1e-3)
