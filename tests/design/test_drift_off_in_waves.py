"""A vessel that drifts off in waves: first-order motions on top of what its equation of motion gives."""

import copy
import json

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.phase_of_drift import lost_phase

MASS = 4.5e7 + 9e6  # kg
OUTPUTS = (
    *("x", "z", "effective_tension", "bending_moment", "tensioner_force", "tensioner_stroke"),
    *("joint_stroke", "stroke", "ufj_angle", "lfj_angle"),
)
EXTREMES = ("x_max", "z_min", "effective_tension_max", "bending_moment_absmax")


def waves(seed, spatial, size=1.0):
    """First-order motions, in space all six but yaw."""
    draw = np.random.default_rng((seed, 7))
    period = float(draw.uniform(7.0, 14.0))
    most = {"surge": 2.0, "heave": 2.0, "pitch": 0.03}
    if spatial:
        most |= {"sway": 1.5, "roll": 0.03}
    return {
        name: {
            "amplitude": size * float(draw.uniform(0.2, 1.0)) * largest,
            "period": period,
            "phase": float(draw.uniform(0.0, 6.0)),
            "ramp": period,
        }
        for name, largest in most.items()
    }


def adrift(seed, spatial=False, size=1.0, push=0.8e6):
    """A rig on a vessel that lost its thrust, in waves; in space some are free to sway."""
    tree = rig(seed, spatial=spatial, conductor=False)
    tree["top"]["x"] = "vessel"
    tree["platform"] = {"centre_of_rotation": {"elevation": 3.0}, **waves(seed, spatial, size)}
    tree["vessel"] = {
        "mass": "4.5e7 kg",
        "added_mass": "9e6 kg",
        "hull_drag": "400000 N*s^2/m^2",
        "wave_drift": {"force": f"{push} N"},
    }
    if spatial and seed % 2:
        tree["vessel"]["sway"] = {"added_mass": "3e7 kg", "hull_drag": "9e5 N*s^2/m^2"}
        tree["vessel"]["wave_drift"]["heading"] = "35 deg"
    tree["analysis"] = timed(40.0, 0.25, 50, 0.6)
    return tree


def run(tree):
    return simulate(SceneFile("rig.yaml", written(tree)), progress=False)


def same(one, other, within, names=OUTPUTS + EXTREMES):
    for name in names:
        size = float(abs(other[name]).max())
        np.testing.assert_allclose(one[name], other[name], atol=within * size, err_msg=name)


KINDS = [(0, False), (1, False), (2, True), (3, True)]


@pytest.mark.parametrize("seed, spatial", KINDS)
def test_without_amplitude_it_is_the_vessel_alone(seed, spatial):
    still = adrift(seed, spatial, size=0.0)
    alone = copy.deepcopy(still)
    del alone["platform"]
    alone["top"]["z"] = "held"
    one, other = run(still), run(alone)
    same(one, other, 1e-9)
    names = ["surge", *(["sway"] if "platform_sway" in other else [])]
    for name in names:
        np.testing.assert_allclose(one[f"low_frequency_{name}"], other[f"platform_{name}"], atol=1e-9)
    assert float(other["platform_surge"][-1]) > 3.0  # metres: it does drift
    assert not any(name.startswith("low_frequency") for name in other)


@pytest.mark.parametrize("method", [None, "ESDIRK4"])
@pytest.mark.parametrize("seed, spatial", KINDS)
def test_a_vessel_too_heavy_to_drift_is_a_platform_that_is_led(seed, spatial, method):
    heavy = adrift(seed, spatial)
    heavy["vessel"] |= {"mass": "1e20 kg"}
    if method:
        heavy["analysis"]["method"] = method
    led = copy.deepcopy(heavy)
    del led["vessel"]
    led["top"]["x"] = "platform"
    same(run(heavy), run(led), 1e-9)


@pytest.mark.parametrize("seed, spatial", KINDS[:3])
def test_the_riser_moves_as_below_a_platform_that_is_led_along_the_drift_in_waves(seed, spatial):
    """Its surge is the path, through points, and what the operators make of the wave."""
    tree = adrift(seed, spatial)
    del tree["platform"]["surge"]
    answer = {"surge": "0.8 m/m", "surge_phase": "-90 deg"}
    tree["platform"]["response"] = {
        "operators": [{"period": period, **answer} for period in ("5 s", "20 s")],
        "phases": "lead",
        "wave": {"height": "3 m", "period": "9 s"},
        "ramp": "9 s",
    }
    free = run(tree)
    path = free["low_frequency_surge"].to_series().items()
    led = copy.deepcopy(tree)
    del led["vessel"]
    led["top"]["x"] = "platform"
    led["platform"]["surge"] = {"points": [{"time": f"{t!r} s", "value": f"{x!r} m"} for t, x in path]}
    other = run(led)
    # a spline through outputs of 0.6 s leads the platform, starts it without a jolt, and ends with the last
    same(free.isel(time=slice(-1)), other.isel(time=slice(-1)), 2e-3, OUTPUTS)
    first = free["platform_surge"] - free["low_frequency_surge"]
    assert float(abs(first).max()) == pytest.approx(1.5 * 0.8, rel=0.03)


@pytest.mark.parametrize("seed, spatial", KINDS)
def test_energy_and_momentum_of_the_vessel_close(seed, spatial):
    tree = adrift(seed, spatial)
    tree["analysis"]["method"] = "ESDIRK4"
    tree["analysis"]["output"]["interval"] = 0.25
    made = run(tree)
    audit = json.loads(made.attrs["audit"])
    assert audit["unexplained_share"] < 1e-5
    assert abs(audit["numerically_dissipated"]) < 1e-4 * audit["exchanged"]
    speed, time = made["low_frequency_speed_x"].values, made["time"].values
    force = (made["environment_force_x"] + made["riser_reaction_x"]).values
    impulse = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(time))])
    np.testing.assert_allclose(MASS * speed, impulse, atol=2e-3 * abs(MASS * speed).max())
    rate = np.gradient(made["low_frequency_surge"].values, time)
    np.testing.assert_allclose(speed[1:-1], rate[1:-1], atol=2e-3 * abs(speed).max())


@pytest.mark.parametrize("seed, spatial", KINDS[:3])
def test_moving_sea_well_platform_and_vessel_together_up_changes_nothing(seed, spatial):
    tree, by = adrift(seed, spatial), 1234.5
    high = copy.deepcopy(tree)
    for path in (("water", "surface"), ("water", "seabed"), ("bottom", "elevation")):
        high[path[0]][path[1]] += by
    high["top"]["elevation"] += by
    high["top"]["tensioners"]["arrangement"]["deck_elevation"] += by
    high["platform"]["centre_of_rotation"]["elevation"] += by
    names = [name for name in (*OUTPUTS, "low_frequency_surge") if name != "z"]
    same(run(high), run(tree), 1e-7, names)


@pytest.mark.parametrize("seed", [0, 1])
def test_a_drift_off_in_waves_the_other_way_round_is_the_mirror_image(seed):
    tree = adrift(seed)
    tree["top"]["offset"] = 7.0
    turned = copy.deepcopy(tree)
    turned["top"]["offset"] = -7.0
    turned["top"]["tensioners"]["arrangement"]["first_bearing"] = np.pi
    turned["current"]["heading"] = "180 deg"
    turned["vessel"]["wave_drift"]["heading"] = "180 deg"
    for name in ("surge", "pitch"):
        turned["platform"][name]["phase"] += np.pi
    one, other = run(tree), run(turned)
    for name in ("x", "bending_moment", "ufj_angle", "lfj_angle", "riser_reaction_x"):
        size = float(abs(one[name]).max())
        np.testing.assert_allclose(other[name], -one[name], atol=1e-9 * size, err_msg=name)
    for name in ("low_frequency_surge", "platform_surge", "platform_speed_x"):
        np.testing.assert_allclose(other[name], -one[name], atol=1e-9)
    same(one, other, 1e-9, ("z", "effective_tension", "joint_stroke"))


ASKED = {
    "platform.cruise": {"platform.cruise": {"speed": "1 m/s"}},
    "platform.position.surge": {"platform.position": {"surge": "3 m"}},
    "platform.position.sway": {"platform.position": {"sway": "3 m"}},
    "vessel.yaw": {"vessel.sway": {}, "vessel.yaw": {"inertia": "1e10 kg*m^2"}},
    "vessel.coupling": {"vessel.coupling": {"scheme": "staggered", "interval": "1 s"}},
    "analysis.method": {"analysis.method": "explicit"},
}


@pytest.mark.parametrize("name", ASKED)
def test_what_does_not_go_with_a_vessel_in_waves_is_refused_by_name(name):
    file = SceneFile("rig.yaml", written(adrift(0)))
    with pytest.raises(InputError, match=name):
        file.with_values(ASKED[name], "test").resolved()


@pytest.mark.parametrize("push", [2e5, 5e6])
@pytest.mark.parametrize("seed, spatial", KINDS)
def test_a_drift_over_a_tenth_of_the_wavelength_is_told(seed, spatial, push):
    """Motions in waves keep the phase of the initial place, the wave loads on the riser do not."""
    tree = adrift(seed, spatial, push=push)
    heading = 0.6 if spatial else 0.0
    tree["wave"] = {"amplitude": 0.5, "period": 7.0, "ramp": 7.0, "heading": f"{heading} rad"}
    tree["wave"]["above_mean_level"] = "none"
    tree["analysis"]["output"]["interval"] = 0.25
    found = run(tree)
    sway = found.get("low_frequency_sway", np.zeros(1))
    away = np.cos(heading) * found["low_frequency_surge"] + np.sin(heading) * sway
    far = float(abs(away).max()) > 0.1 * 9.80665 * 7.0**2 / (2.0 * np.pi)  # in deep water
    assert far == (push > 1e6)
    said = [text for text in json.loads(found.attrs["warnings"]) if "phase of its initial" in text]
    assert bool(said) == far


@pytest.mark.parametrize("seed", range(6))
def test_a_platform_led_over_a_tenth_of_the_wavelength_is_told(seed):
    """Its surge is a time series, its heave follows the RAOs; a heave that is given has any phase."""
    draw = np.random.default_rng(seed)
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    period, heading = float(draw.uniform(6.0, 12.0)), float(draw.uniform(-0.5, 0.5))
    length = 9.80665 * period**2 / (2.0 * np.pi)  # in deep water
    tree["wave"] = {"amplitude": 1.0, "period": period, "heading": f"{heading!r} rad"}
    tree["wave"]["above_mean_level"] = "none"
    answer = {"heave": "0.5 m/m", "heave_phase": "0 deg"}
    operators = [{"period": f"{other} s", **answer} for other in (4, 20)]
    del tree["platform"]["position"]
    for share in (0.09, 0.11, 0.3):
        values = (0.5 * k * share * length for k in range(3))
        points = [{"time": f"{30 * k} s", "value": f"{x!r} m"} for k, x in enumerate((0.0, *values))]
        tree["platform"]["surge"] = {"points": points}
        for response in (None, {"operators": operators, "phases": "lead"}):
            tree["platform"].pop("response", None)
            tree["platform"] |= {"response": response} if response else {}
            scene = SceneFile("rig.yaml", written(tree)).resolved()
            far = share * np.cos(heading) > 0.1
            assert bool(lost_phase(scene, {})) == bool(response and far)
