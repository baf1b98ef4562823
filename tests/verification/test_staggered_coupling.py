"""Platform and riser solved one after the other, as the paper does, against both solved as one.

The riser is given the platform's whole history, the platform the force that the riser made of the last
one, until neither changes. With the force of one step ago this is the staggered scheme.
"""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from riserstudy import load_scene, simulate

REF = Path(__file__).parents[2] / "config" / "scenes" / "liu2017" / "ref_0.yaml"
UNTIL, MASS, TENSION = 60.0, 5.26e7, 3.02e6
GRID = {"analysis.duration": f"{UNTIL} s", "analysis.output": {"interval": "0.5 s"}}
GRID |= {"analysis.mesh": {"elements": 200}, "analysis.step": "0.05 s"}
TIMES = np.arange(0.0, UNTIL + 0.25, 0.5)


@cache
def as_one():
    return simulate(load_scene(REF, **GRID))


def force_of_the_riser(surge):
    """What the riser pulls with when its top is moved as told (N)."""
    points = [
        {"time": f"{t} s", "value": f"{float(x)!r} m"} for t, x in zip(TIMES, surge, strict=True)
    ]
    told = {"vessel": None, "top.x": "platform", "platform": {"surge": {"points": points}}}
    run = simulate(load_scene(REF, **GRID, **told))
    ends = run.isel(s=[-2, -1])
    across, up = ends["x"].diff("s").squeeze("s"), ends["z"].diff("s").squeeze("s")
    shear = -ends["bending_moment"].diff("s").squeeze("s")
    return (-(TENSION * across) / np.hypot(across, up) - shear * up / (across**2 + up**2)).values


def surge_of_the_platform(force, lag):
    """Its motion under a history of the riser's force, taken ``lag`` seconds late (m)."""

    def rates(t, state):
        x, v = state
        water, wind = 0.5 - v, 13.8 - v
        outside = 2.5e5 * abs(water) * water + 2e3 * abs(wind) * wind + 1e5
        riser = np.interp(t - lag, TIMES, force)
        return v, (outside + 65.1e3 * (100.0 - x) + riser) / MASS

    found = solve_ivp(rates, (0.0, UNTIL), (0.0, 0.0), t_eval=TIMES, rtol=1e-9, max_step=0.25)
    return found.y[0]


@cache
def one_after_the_other(lag):
    """Surge when neither platform nor riser changes any more, and how many rounds that took."""
    surge = surge_of_the_platform(0.0 * TIMES, 0.0)
    for rounds in range(1, 11):
        before, surge = surge, surge_of_the_platform(force_of_the_riser(surge), lag)
        if np.abs(surge - before).max() < 1e-4:
            return surge, rounds
    raise AssertionError("still changing")


def test_iterated_to_the_end_both_ways_agree():
    surge, rounds = one_after_the_other(0.0)
    assert rounds <= 6
    # the platform's history is given at every half second, with a spline between
    np.testing.assert_allclose(surge, as_one()["platform_surge"], atol=5e-3)


@pytest.mark.parametrize("lag", [0.5, 1.0, 2.0])
def test_a_force_of_one_step_ago_errs_in_proportion_to_the_step(lag):
    """0.2 m of 134 m after 60 s for each second of the step; solved as one there is no such error."""
    off = np.abs(one_after_the_other(lag)[0] - one_after_the_other(0.0)[0]).max()
    assert off == pytest.approx(0.207 * lag, rel=0.02)
