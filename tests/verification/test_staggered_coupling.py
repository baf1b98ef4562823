"""Platform and riser solved in turns, against both solved as one, and against an ODE for the platform.

The ODE knows nothing of the engine but the riser's force over time: the riser is given the platform's
whole history, the platform the force that the riser made of the last one, until neither changes.
"""

import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from riserstudy import load_scene, simulate
from riserstudy.errors import SimulationError
from riserstudy.simulation.error_estimate import controlled

REF = Path(__file__).parents[2] / "config" / "scenes" / "liu2017" / "ref_0.yaml"
UNTIL, MASS, TENSION = 60.0, 5.26e7, 3.02e6
GRID = {"analysis.duration": f"{UNTIL} s", "analysis.output": {"interval": "0.5 s"}}
GRID |= {"analysis.mesh": {"elements": 200}, "analysis.step": "0.05 s"}
TIMES = np.arange(0.0, UNTIL + 0.25, 0.5)

#: the drive-off in a calm sea, without the joint's stop: what closed forms and balances are about
CALM = {"wave": None, "top.telescopic_joint.stop": None, "vessel.thrusters.gain": "65.1 kN/m"}


def calm(path, **overrides):
    return load_scene(path, **CALM).with_values(overrides, "test")


@cache
def drive_off(scheme=None, interval=1.0, method="default", output="0.5 s"):
    """As one, or in turns; Newmark's method goes on from march to march without a trace."""
    values = GRID | {"analysis.output": {"interval": output}}
    if scheme:
        values["vessel.coupling"] = {"scheme": scheme, "interval": f"{interval} s"}
    if method == "Newmark":
        values["analysis.method"] = {"beta": 0.25, "gamma": 0.5}
    return simulate(calm(REF, **values))


def off(run, other, name):
    """Largest difference over the largest value."""
    return float(abs(run[name] - other[name]).max() / abs(other[name]).max())


# the ODE


def force_of_the_riser(surge):
    """What the riser pulls with when its top is moved as told (N)."""
    points = [{"time": f"{t} s", "value": f"{float(x)!r} m"} for t, x in zip(TIMES, surge, strict=True)]
    told = {"vessel": None, "top.x": "platform", "platform": {"surge": {"points": points}}}
    run = simulate(calm(REF, **GRID, **told))
    ends = run.isel(s=[-2, -1])
    across, up = ends["x"].diff("s").squeeze("s"), ends["z"].diff("s").squeeze("s")
    shear = -ends["bending_moment"].diff("s").squeeze("s")
    return (-(TENSION * across) / np.hypot(across, up) - shear * up / (across**2 + up**2)).values


def surge_of_the_platform(force, hold):
    """Its motion under a history of the riser's force, held for ``hold`` seconds where not 0 (m)."""

    def rates(t, state, held):
        x, v = state
        water, wind = 0.5 - v, 13.8 - v
        outside = 2.5e5 * abs(water) * water + 2e3 * abs(wind) * wind + 1e5
        riser = np.interp(t if held is None else held, TIMES, force)
        return v, (outside + 65.1e3 * (100.0 - x) + riser) / MASS

    # from one jump of the force to the next
    step = hold or UNTIL
    surge, state = np.zeros_like(TIMES), (0.0, 0.0)
    for begin in np.arange(0.0, UNTIL, step):
        inside = (begin <= TIMES) & (begin + step >= TIMES)
        found = solve_ivp(
            rates,
            (begin, begin + step),
            state,
            args=(begin if hold else None,),
            rtol=1e-9,
            max_step=0.25,
            dense_output=True,
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


@pytest.mark.long
def test_iterated_to_the_end_the_platforms_ode_agrees_with_both_solved_as_one():
    surge, rounds = one_after_the_other(0.0)
    assert rounds <= 6
    # the platform's history is given at every half second, with a spline between
    np.testing.assert_allclose(surge, drive_off()["platform_surge"], atol=5e-3)
    np.testing.assert_allclose(surge, drive_off("iterated", 2.0)["platform_surge"], atol=5e-3)


@pytest.mark.long
@pytest.mark.parametrize("interval", [0.5, 1.0, 2.0])
def test_staggered_turns_err_as_the_ode_does_whose_force_is_held(interval):
    """0.104 m of 134 m after 60 s for each second: a force that is held is half an interval old."""
    found = drive_off("staggered", interval)["platform_surge"] - drive_off()["platform_surge"]
    expected = one_after_the_other(interval)[0] - one_after_the_other(0.0)[0]
    # the ODE settles to 1e-4 m, and knows the force at every half second
    np.testing.assert_allclose(found, expected, atol=5e-4)
    assert float(found[-1]) == pytest.approx(0.1036 * interval, rel=0.01)


# against both as one


@pytest.mark.long
@pytest.mark.parametrize("interval", [0.5, 2.0])
def test_iterated_turns_by_newmark_are_the_steps_of_both_as_one(interval):
    run, one = drive_off("iterated", interval, "Newmark"), drive_off(method="Newmark")
    # Newton's tolerance is 1e-9 of the length, 1.4e-6 m of 134 m; moments follow its second differences
    for name in ("platform_surge", "platform_speed_x", "riser_reaction_x", "ufj_angle", "x"):
        assert off(run, one, name) < 1e-8, name
    for name in ("bending_moment", "largest_stress", "bending_moment_max", "bending_moment_min"):
        if name in one:
            assert off(run, one, name) < 2e-6, name


@pytest.mark.long
def test_iterated_turns_by_generalised_alpha_differ_by_how_each_turn_begins():
    """By less than mesh and step make, the more the shorter the turns."""
    apart = [off(drive_off("iterated", i), drive_off(), "platform_surge") for i in (0.5, 1.0, 2.0)]
    estimated = json.loads(drive_off().attrs["error_estimate"])["displacement"]
    assert apart[0] < 0.1 * estimated
    assert apart[0] / apart[1] == pytest.approx(2.0, rel=0.05)
    assert apart[1] / apart[2] == pytest.approx(2.0, rel=0.05)


LATE = {"analysis.output": {"interval": "0.3 s", "start": "10.2 s", "stress_in": "conductor"}}
LATE |= {"analysis.method": {"beta": 0.25, "gamma": 0.5}, "analysis.duration": "20 s"}


def late(interval=None):
    """Outputs that begin late and fall beside the turns."""
    turns = {"vessel.coupling": {"scheme": "iterated", "interval": interval}} if interval else {}
    return simulate(calm(REF, **(GRID | LATE | turns)))


def test_what_is_written_down_does_not_see_the_turns():
    one, run = late(), late("1.25 s")
    assert set(run.variables) == set(one.variables)
    np.testing.assert_array_equal(run["time"], one["time"])
    for name in ("platform_surge", "largest_stress", "bending_moment_max", "x_min", "z_max"):
        # rounds end 1.4e-6 m apart at most, of 27 m
        assert off(run, one, name) < 1e-7, name


def test_the_last_turn_is_cut_short_by_the_end():
    one, run = late(), late("1.6 s")
    assert json.loads(run.attrs["coupling"])["turns"] == 13
    np.testing.assert_array_equal(run["time"], one["time"])
    # its steps are shorter: as far off as the step is
    estimated = json.loads(one.attrs["error_estimate"])
    assert 1e-9 < off(run, one, "platform_surge") < estimated["displacement"]
    assert off(run, one, "bending_moment") < estimated["moment"]


OBLIQUE = {
    "analysis.duration": "20 s",
    "analysis.mesh": {"elements": 60},
    "analysis.step": "0.1 s",
    "analysis.method": {"beta": 0.25, "gamma": 0.5},
    "analysis.newton_tolerance": 1e-13,
    "current.heading": "60 deg",
    "vessel.wind.heading": "100 deg",
    "vessel.thrusters.lag": "5 s",
    "vessel.thrusters.saturation": "6 MN",
    "vessel.thrusters.yaw": {"gain": "3.2e8 N*m/rad", "command": "5 deg"},
}
TIGHT = {"vessel.coupling": {"scheme": "iterated", "interval": "1 s", "tolerance": "1e-10 m"}}


def apart(values):
    """Largest differences of iterated turns from both as one, by name, and the estimated error (m)."""
    one = simulate(calm(REF, **(GRID | values)))
    run = simulate(calm(REF, **(GRID | values | TIGHT)))
    names = [name for name in ("platform_surge", "platform_sway", "platform_yaw") if name in one]
    estimated = json.loads(one.attrs["error_estimate"])["displacement"]
    scale = float(one["platform_surge"].max())
    return {name: float(abs(run[name] - one[name]).max()) for name in names}, estimated * scale


def test_a_platform_that_sways_with_lagging_thrust_does_the_same_in_iterated_turns():
    found, _ = apart(OBLIQUE | dict.fromkeys(("vessel.thrusters.yaw", "vessel.yaw")))
    # 20 turns, each within 1e-10 m by the exchange and within 1.4e-10 m by Newton's iteration
    assert max(found.values()) < 20 * 2.4e-10


@pytest.mark.long
def test_a_platform_that_turns_too_does_so_as_far_as_newtons_iteration_goes():
    """Its tangent leaves out how the mass of a turning hull changes, and so its last correction errs."""
    found, estimated = apart(OBLIQUE)
    assert found["platform_yaw"] < 1e-7
    assert max(found.values()) < 0.01 * estimated
    finer, _ = apart(OBLIQUE | {"analysis.step": "0.05 s"})
    order = math.log2(max(found.values()) / max(finer.values()))
    assert order > 1.7  # 2 in the limit


# what a run says of it


def test_the_energy_that_the_exchange_makes_is_that_of_the_force_that_was_lent():
    run = drive_off("staggered", 1.0, output="0.05 s")
    audit = json.loads(run.attrs["audit"])
    force, speed = run["riser_reaction_x"].values, run["platform_speed_x"].values
    steps = len(force) - 1
    lent = force[20 * (np.arange(steps) // 20)]  # that of the turn's begin, over each step
    made = ((lent - force[:-1]) * speed[:-1] + (lent - force[1:]) * speed[1:]).sum() * 0.05 / 2.0
    # riser's force at a begin: after the jump of the platform's acceleration here, before it there
    assert audit["made_by_exchange"] == pytest.approx(made, rel=2e-3)
    assert audit["made_by_exchange"] > 0.0
    assert audit["unexplained_share"] < 1e-6
    assert audit["work_of_supports"] == 0.0


def test_iterated_turns_make_no_energy():
    audit = json.loads(drive_off("iterated", 1.0).attrs["audit"])
    assert abs(audit["made_by_exchange"]) < 1e-8 * audit["exchanged"]
    assert audit["unexplained_share"] < 1e-6


def test_a_run_tells_its_scheme_and_that_the_interval_is_not_in_the_estimate():
    assert json.loads(drive_off().attrs["coupling"]) == {"scheme": "as one"}
    assert "made_by_exchange" not in drive_off().attrs["audit"]
    told = json.loads(drive_off("staggered", 2.0).attrs["coupling"])
    assert told == {
        "scheme": "staggered", "interval": 2.0, "turns": 30, "rounds": 30, "most_rounds": 1
    }  # fmt: skip
    estimates = [
        json.loads(run.attrs["error_estimate"])["displacement"]
        for run in (drive_off(), drive_off("staggered", 2.0))
    ]
    assert estimates[0] == pytest.approx(estimates[1], rel=0.01)
    assert "spurious energy" in drive_off("staggered", 2.0).attrs["warnings"]
    assert "spurious energy" not in drive_off("iterated", 2.0).attrs["warnings"]


@pytest.mark.long
def test_steps_refined_for_an_accuracy_stay_whole_parts_of_a_turn():
    asked = {"analysis.duration": "20 s", "analysis.accuracy": "1 %"}
    asked |= dict.fromkeys(("analysis.mesh", "analysis.step"))
    turns = {"vessel.coupling": {"scheme": "iterated", "interval": "0.12 s"}}
    run = simulate(calm(REF, **(GRID | asked | turns)))
    steps = [one["step"] for one in json.loads(run.attrs["refinements"])]
    # as one it would start with a 24th of 5 s, longer than a turn
    assert steps[0] == pytest.approx(0.12)
    assert steps[-1] < 0.07
    for step in steps:
        assert 0.12 / step == pytest.approx(round(0.12 / step))
    assert max(controlled(json.loads(run.attrs["error_estimate"])).values()) <= 0.01


LIGHT = {"analysis.duration": "20 s", "vessel.mass": "1 t", "vessel.added_mass": None}
LIGHT |= dict.fromkeys(("vessel.hull_drag", "vessel.wind", "vessel.thrusters"))


def in_turns(scheme):
    return {"vessel.coupling": {"scheme": scheme, "interval": "2 s"}}


def test_a_platform_too_light_for_turns_that_are_repeated_fails():
    """A ton on a riser that resists with sqrt(T m), 39 t/s: solved as one it moves."""
    moved = simulate(calm(REF, **(GRID | LIGHT)))
    assert float(abs(moved["platform_surge"]).max()) < 100.0
    with pytest.raises(SimulationError, match="the last of 50 iterations"):
        simulate(calm(REF, **(GRID | LIGHT | in_turns("iterated"))))


def test_a_platform_too_light_for_staggered_turns_owes_its_energy_to_the_exchange():
    light = LIGHT | {"vessel.mass": "10 t"}  # one of 1 t runs away so fast that steps may fail
    run = simulate(calm(REF, **(GRID | light | in_turns("staggered"))))
    audit = json.loads(run.attrs["audit"])
    assert audit["made_by_exchange"] > 0.5 * audit["exchanged"]
    made = float(run.attrs["warnings"].partition(" s added ")[2].partition(" kJ")[0])
    assert made == pytest.approx(audit["made_by_exchange"] / 1e3, rel=0.005)
