"""Platform and riser solved in turns, against both solved as one, and against an ODE for the platform.

The ODE knows nothing of the engine but the riser's force over time: the riser is given the platform's
whole history, the platform the force that the riser made of the last one, until neither changes.
"""

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from riserstudy import load_scene, simulate
from riserstudy.errors import SimulationError

REF = Path(__file__).parents[2] / "config" / "scenes" / "liu2017" / "ref_0.yaml"
UNTIL, MASS, TENSION = 60.0, 5.26e7, 3.02e6
GRID = {"analysis.duration": f"{UNTIL} s", "analysis.output": {"interval": "0.5 s"}}
GRID |= {"analysis.mesh": {"elements": 200}, "analysis.step": "0.05 s"}
TIMES = np.arange(0.0, UNTIL + 0.25, 0.5)
NEWMARK = {"analysis.method": {"beta": 0.25, "gamma": 0.5}}


@cache
def drive_off(scheme=None, interval=1.0, **overrides):
    turns = {"vessel.coupling": {"scheme": scheme, "interval": f"{interval} s"}} if scheme else {}
    return simulate(load_scene(REF, **(GRID | turns | {k: dict(v) for k, v in overrides.items()})))


def by_newmark(scheme=None, interval=1.0):
    """Whose marches go on from each other without a trace."""
    return drive_off(
        scheme, interval, **{k: tuple(v.items()) for k, v in NEWMARK.items()}
    )


# the ODE


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


def surge_of_the_platform(force, hold):
    """Its motion under a history of the riser's force, held for ``hold`` seconds where not 0 (m)."""

    def rates(t, state):
        x, v = state
        water, wind = 0.5 - v, 13.8 - v
        outside = 2.5e5 * abs(water) * water + 2e3 * abs(wind) * wind + 1e5
        seen = hold * np.floor(t / hold + 1e-9) if hold else t
        riser = np.interp(seen, TIMES, force)
        return v, (outside + 65.1e3 * (100.0 - x) + riser) / MASS

    # from one jump of the force to the next
    step = hold or UNTIL
    surge, state = np.zeros_like(TIMES), (0.0, 0.0)
    for begin in np.arange(0.0, UNTIL, step):
        inside = (begin <= TIMES) & (begin + step >= TIMES)
        found = solve_ivp(
            rates, (begin, begin + step * (1.0 - 1e-12)), state, rtol=1e-9, max_step=0.25, dense_output=True
        )
        surge[inside] = found.sol(TIMES[inside])[0]
        state = found.y[:, -1]
    return surge


@cache
def one_after_the_other(hold):
    """Surge when neither platform nor riser changes any more, and how many rounds that took."""
    surge = surge_of_the_platform(0.0 * TIMES, 0.0)
    for rounds in range(1, 11):
        before, surge = surge, surge_of_the_platform(force_of_the_riser(surge), hold)
        if np.abs(surge - before).max() < 1e-4:
            return surge, rounds
    raise AssertionError("still changing")


def test_iterated_to_the_end_the_platforms_ode_agrees_with_both_solved_as_one():
    surge, rounds = one_after_the_other(0.0)
    assert rounds <= 6
    # the platform's history is given at every half second, with a spline between
    np.testing.assert_allclose(surge, drive_off()["platform_surge"], atol=5e-3)
    np.testing.assert_allclose(surge, drive_off("iterated", 2.0)["platform_surge"], atol=5e-3)


@pytest.mark.parametrize("interval", [0.5, 1.0, 2.0])
def test_staggered_turns_err_as_the_ode_does_whose_force_is_held(interval):
    """0.104 m of 134 m after 60 s for each second: a force that is held is half an interval old."""
    exact = one_after_the_other(0.0)[0]
    off = drive_off("staggered", interval)["platform_surge"] - drive_off()["platform_surge"]
    expected = one_after_the_other(interval)[0] - exact
    # force of the ODE known at every half second, 2 % of the difference
    np.testing.assert_allclose(off, expected, atol=0.02 * np.abs(expected).max())
    assert float(off[-1]) == pytest.approx(0.1036 * interval, rel=0.01)
