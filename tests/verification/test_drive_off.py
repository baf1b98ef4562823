"""A platform that floats, and a joint within the riser: closed forms and balances."""

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from riserstudy import load_scene, simulate
from riserstudy.errors import SimulationError

CONFIG = Path(__file__).parents[2] / "config"
REF = CONFIG / "scenes" / "liu2017" / "ref_0.yaml"
QUICK = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": "1 %"}
#: the drive-off in a calm sea, without the joint's stop: what closed forms and balances are about
CALM = {"wave": None, "top.telescopic_joint.stop": None, "vessel.thrusters.gain": "65.1 kN/m"}


#: between steps angles are those of positions, moments those of the parabola through steps
ON_STEPS = {"analysis.mesh": {"elements": 200}, "analysis.step": "0.1 s"}
ON_STEPS |= {"analysis.output.interval": "0.5 s"}


def calm(path, **overrides):
    return load_scene(path, **CALM).with_values(overrides, "test")


@cache
def drive_off(name="ref_0", **overrides):
    path = REF.with_name(f"{name}.yaml")
    return simulate(calm(path, **QUICK, **overrides))


def test_a_stack_that_stands_below_the_riser_is_no_slack_riser():
    run = drive_off()
    assert float(run["effective_tension_static"].min()) < 0.0
    assert float(run.attrs["smallest_tension"]) > 0.0
    assert float(run.attrs["smallest_tension_s"]) >= 73.0 + 14.0 - 1e-9
    assert "slack" not in run.attrs["warnings"]


STRING = """\
title: platform on a string
riser: [{name: string, length: 1000 m, axial_stiffness: 1e10 N, mass: 500 kg/m}]
bottom: {hold: wellhead, elevation: 0 m}
top: {x: vessel, z: free, tension: 3 MN}
vessel:
  mass: 1e6 kg
  thrusters: {gain: 1e9 N/m, command: 1e6 m, saturation: 10 kN}
analysis: {duration: 20 s, output: {interval: 0.1 s}, mesh: {elements: 800}, step: 0.01 s}
"""


def test_a_platform_on_a_string_feels_its_impedance_until_the_wave_is_back(tmp_path):
    """M v' + sqrt(T m) v = F, and the string follows at depth L - s by (L - s) / c later."""
    file = tmp_path / "string.yaml"
    file.write_text(STRING)
    run = simulate(file)
    force, mass, speed = 1e4, 1e6, np.sqrt(3e6 / 500.0)
    slowness = mass / np.sqrt(3e6 * 500.0)

    def top(t):
        t = np.maximum(t, 0.0)
        return force * slowness / mass * (t - slowness * -np.expm1(-t / slowness))

    largest = float(run["x"].max())
    for s in (1000.0, 750.0, 500.0, 0.0):
        found = run["x"].sel(s=s, method="nearest")
        until = run["time"] < 1000.0 / speed + s / speed  # before the wave is back there
        expected = top(run["time"] - (1000.0 - s) / speed)
        expected = expected.where(s > 0.0, 0.0)
        np.testing.assert_allclose(found.where(until, 0.0), expected.where(until, 0.0), atol=2e-4 * largest)


def test_the_platform_alone_follows_its_own_equation():
    below = {
        "riser": [
            {
                "name": "thread",
                "length": "1328 m",
                "axial_stiffness": "100 N",
                "mass": "0.001 kg/m",
                "submerged_weight": "0 N/m",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "vessel", "z": "held", "elevation": "1341 m"},
        "soil": None,
        "vessel.thrusters.gain": "101 kN/m",
        "analysis.output": {"interval": "1 s"},
    }
    run = simulate(calm(REF.with_name("sat_0.yaml"), **below))

    def rates(t, state):
        x, v = state
        water, wind = 0.5 - v, 13.8 - v
        thrust = np.clip(1.01e5 * (100.0 - x), -4.5e6, 4.5e6)
        force = 2.5e5 * abs(water) * water + 2e3 * abs(wind) * wind + 1e5 + thrust
        return v, force / 5.26e7

    exact = solve_ivp(rates, (0.0, 150.0), (0.0, 0.0), t_eval=run["time"], rtol=1e-10, atol=1e-10)
    np.testing.assert_allclose(run["platform_surge"], exact.y[0], atol=2e-3 * exact.y[0].max())


def test_energy_balances_with_the_platform():
    audit = json.loads(drive_off().attrs["audit"])
    assert audit["unexplained_share"] < 1e-4
    assert audit["work_of_supports"] == 0.0


def test_the_other_way_round_is_the_mirror_image():
    turned = {f"vessel.{name}.heading": "180 deg" for name in ("wind", "wave_drift")}
    turned |= {"current.heading": "180 deg", "vessel.thrusters.command": "-100 m"}
    one, other = drive_off(), drive_off(**turned)
    for name in ("platform_surge", "ufj_angle", "lfj_angle", "riser_reaction_x", "x"):
        largest = float(abs(one[name]).max())
        np.testing.assert_allclose(one[name], -other[name], atol=1e-9 * largest)
    np.testing.assert_allclose(one["stroke"], other["stroke"], atol=1e-9)


def test_the_riser_pulls_with_tension_and_the_shear_of_the_joint():
    run = drive_off()
    ends = run.isel(s=[-2, -1])
    across, up = ends["x"].diff("s").squeeze("s"), ends["z"].diff("s").squeeze("s")
    length = np.hypot(across, up)
    shear = -ends["bending_moment"].diff("s").squeeze("s") / length
    expected = -3.02e6 * across / length - shear * up / length
    np.testing.assert_allclose(run["riser_reaction_x"], expected, atol=10.0)
    # what the paper's formula leaves out
    assert float(abs(run["riser_reaction_x"] + 3.02e6 * np.sin(run["ufj_angle"])).max()) < 3e4


def test_the_lower_joint_takes_the_moment_over_its_stiffness():
    run = simulate(calm(REF, **ON_STEPS))
    moment = run["bending_moment"].sel(s=87.0, method="nearest")
    np.testing.assert_allclose(run["lfj_angle"], moment / (90e3 * 180.0 / np.pi), rtol=1e-9)


def test_a_joint_drawn_out_to_its_stop_pulls_harder_and_loses_no_energy():
    stop = {"stroke": "9.905 m", "stiffness": "5.57 MN/m"}
    grid = {"analysis.mesh": {"elements": 200}, "analysis.step": "0.02 s"}
    run = simulate(calm(REF, **{"top.telescopic_joint.stop": stop}, **grid))
    beyond = float(run["stroke"].max()) - 9.905
    assert 0.0 < beyond < 1.0
    tension = float(run["effective_tension"].isel(s=-1).max())
    # at rest the joint differs from its own length by what the riser is stretched
    rest = float(np.hypot(*(np.diff(run[f"{c}_static"].values[-2:])[0] for c in "xz"))) - 15.0
    assert tension == pytest.approx(3.02e6 + 5.57e6 * (beyond + rest), rel=0.02)
    assert json.loads(run.attrs["audit"])["unexplained_share"] < 1e-4


def test_a_platform_lighter_than_the_riser_is_no_harder():
    light = {"vessel.mass": "50 t", "vessel.added_mass": "0 t", "vessel.thrusters.gain": "1 kN/m"}
    grid = {"analysis.mesh": {"elements": 200}, "analysis.step": "0.5 s"}
    run = simulate(calm(REF, **light, **grid))
    assert run.attrs["halved_steps"] == 0
    assert json.loads(run.attrs["audit"])["unexplained_share"] < 1e-3


def test_a_tension_that_does_not_carry_the_riser_is_refused():
    with pytest.raises(SimulationError, match="increase the top tension"):
        drive_off(**{"top.telescopic_joint.tension": "0.5 MN"})


def test_in_space_it_is_the_same_drive_off():
    grid = {"analysis.mesh": {"elements": 150}, "analysis.step": "0.2 s"}
    plane = simulate(calm(REF, **grid))
    space = simulate(calm(REF, **grid, **{"current.heading": "1e-6 deg"}))
    assert "y" in space
    assert "y" not in plane
    assert float(abs(space["y"]).max()) < 1e-6
    for name in ("platform_surge", "riser_reaction_x", "stroke", "largest_stress"):
        largest = float(abs(plane[name]).max())
        np.testing.assert_allclose(space[name], plane[name], atol=1e-5 * largest)
    for name in ("ufj_angle", "lfj_angle"):  # in space their sizes
        np.testing.assert_allclose(space[name], abs(plane[name]), atol=1e-5)


HELD = dict.fromkeys(("vessel.yaw", "vessel.sway", "vessel.thrusters.yaw", "vessel.thrusters.sway"))


def test_a_current_from_the_side_bends_the_riser_aside_and_not_a_platform_without_sway():
    grid = {"analysis.mesh": {"elements": 150}, "analysis.step": "0.2 s"}
    across = {f"{name}.heading": "90 deg" for name in ("current", "vessel.wind", "vessel.wave_drift")}
    one = simulate(calm(REF, **grid, **HELD, **across))
    other = simulate(calm(REF, **grid, **HELD, **dict.fromkeys(across, "-90 deg")))
    assert float(abs(one["y"].isel(s=-1)).max()) == 0.0
    assert float(one["y"].isel(time=0).max()) > 1.0
    np.testing.assert_allclose(one["y"], -other["y"], atol=1e-8)
    np.testing.assert_allclose(one["platform_surge"], other["platform_surge"], atol=1e-6)


ACROSS = {
    "vessel.sway": {"added_mass": "4.32e7 kg", "hull_drag": "4e5 N*s^2/m^2"},
    "vessel.yaw": {"inertia": "1.19e11 kg*m^2", "added_inertia": "1.38e11 kg*m^2"},
    "vessel.thrusters.sway": {"gain": "104 kN/m"},
    "vessel.thrusters.yaw": {"gain": "3.2e8 N*m/rad"},
    "riser[2].shear_modulus": "79 GPa",
}
COARSE = {"analysis.mesh": {"elements": 150}, "analysis.step": "0.2 s"}


def headed(degrees, **overrides):
    """The drive-off in space, all headings turned by as much."""
    turned = {f"vessel.{name}.heading" for name in ("wind", "wave_drift", "thrusters")}
    turned |= {"vessel.heading", "current.heading"}
    told = {"vessel.thrusters.command": "100 m"} | dict.fromkeys(turned, f"{degrees} deg")
    return simulate(calm(REF, **COARSE, **ACROSS, **(told | overrides)))


def test_a_platform_that_may_sway_surges_as_one_that_may_not():
    plane = simulate(calm(REF, **COARSE))
    same = simulate(calm(REF, **COARSE, **ACROSS))
    assert "y" not in same
    np.testing.assert_array_equal(plane["platform_surge"], same["platform_surge"])
    space = headed(1e-6)
    for name in ("platform_surge", "riser_reaction_x", "thrust_x", "stroke"):
        largest = float(abs(plane[name]).max())
        np.testing.assert_allclose(space[name], plane[name], atol=1e-5 * largest)


def test_a_headed_drive_off_is_the_one_along_x_turned():
    along, turned = simulate(calm(REF, **COARSE)), headed(37.0)
    c, s = np.cos(np.deg2rad(37.0)), np.sin(np.deg2rad(37.0))
    for name in ("platform_surge", "riser_reaction_x", "thrust_x", "environment_force_x", "x"):
        aside = turned[name.replace("_x", "_y") if "_x" in name else {"x": "y"}.get(name, "platform_sway")]
        largest = float(abs(along[name]).max())
        np.testing.assert_allclose(turned[name], c * along[name], atol=1e-5 * largest)
        np.testing.assert_allclose(aside, s * along[name], atol=1e-5 * largest)
    assert float(abs(turned["platform_yaw"]).max()) < 1e-9


def test_energy_balances_while_it_sways_and_turns_with_lagging_thrusters():
    oblique = {"current.heading": "60 deg", "vessel.wind.heading": "100 deg"}
    oblique |= {"vessel.thrusters.lag": "5 s", "vessel.thrusters.saturation": "6 MN"}
    oblique |= {"vessel.yaw.hull_drag": "1e12 N*m*s^2/rad^2"}
    run = headed(0.0, **oblique)
    assert float(abs(run["platform_sway"]).max()) > 1.0
    assert float(abs(run["platform_yaw"]).max()) > np.deg2rad(1.0)
    audit = json.loads(run.attrs["audit"])
    assert audit["unexplained_share"] < 1e-4
    assert abs(audit["numerically_dissipated"]) < 1e-3 * audit["exchanged"]
