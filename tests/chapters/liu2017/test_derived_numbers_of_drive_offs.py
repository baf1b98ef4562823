"""Numbers derived from drive-offs, of runs whose answer is known."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017 import derived
from chapters.liu2017.limits import LIMITS
from riserstudy.dataset.label import labelled
from riserstudy.scene.load import read_scene
from riserstudy.simulation.refine import run as simulated

FILE = read_scene(Path(__file__).parents[3] / "config/scenes/liu2017/ref_0.yaml")
TREE = FILE.tree
SCENE = {"scene": json.dumps(TREE)}
TIME = np.arange(0.0, 101.0)
TENSION = 3.02e6  # N, printed
FOOT = 73.0  # m, the wellhead above the conductor's foot


def quantity(text):
    return float(str(text).split()[0])


def pipe(section):
    """Area and section modulus of a pipe (m2, m3), by radii."""
    outer, inner = (0.5 * quantity(section[f"{side}_diameter"]) for side in ("outer", "inner"))
    return np.pi * (outer - inner) * (outer + inner), np.pi * (outer**4 - inner**4) / (4.0 * outer)


def history(values):
    return ("time", np.asarray(values, float))


def driven(**changes):
    """A platform that moves 2 m/s along x; its riser's variables as given."""
    zero = 0.0 * TIME
    made = dict.fromkeys((*derived.OF_THE_PLATFORM, *derived.OF_THE_RISER, "largest_stress"), zero)
    made |= {"platform_surge": 2.0 * TIME} | changes
    s = np.array([0.0, FOOT, 80.0, 218.0, 1400.0])
    moment = np.outer(TIME, [1.0, 3e4, 1e6, 1.0, 1.0])
    x = 5.0 + np.outer(TIME, [0.0, 0.0, 0.1, 0.25, 2.0])
    data = {name: history(values) for name, values in made.items()}
    data |= {"bending_moment": (("time", "s"), moment), "x": (("time", "s"), x)}
    return xr.Dataset(data, {"time": TIME, "s": s}, SCENE)


def test_what_is_measured_stands_where_its_name_says():
    found = derived.measured(driven(platform_sway=1.5 * TIME, ufj_angle=0.01 * np.ones(101)))
    np.testing.assert_allclose(found["platform_offset"], 2.5 * TIME)  # 3, 4, 5
    np.testing.assert_allclose(found["wellhead_moment"], 3e4 * TIME)
    np.testing.assert_allclose(found["low_displacement"], 0.25 * TIME, atol=1e-12)
    np.testing.assert_allclose(found["riser_force_x"], -TENSION * np.sin(0.01))


def test_the_joint_pulls_by_its_tension_until_it_has_stroked_out():
    stroke = 0.2 * TIME
    found = derived.top_tension(driven(stroke=stroke))
    assert (found[stroke < 9.905] == TENSION).all()
    assert found[stroke > 9.905].isnull().all()
    assert int(found.notnull().sum()) == 50


def test_a_run_with_the_whole_riser_has_the_tension_of_its_uppermost_node():
    s = np.linspace(0.0, 1400.0, 30)
    run = driven().drop_dims("s").assign_coords(s=s)
    run["effective_tension"] = (("time", "s"), np.outer(1.0 + TIME, 1e6 + s))
    np.testing.assert_allclose(derived.top_tension(run), (1.0 + TIME) * (1e6 + 1400.0))


def test_the_stress_of_the_riser_is_of_its_own_nodes_alone():
    """Larger tension and moments below its foot and above its top do not count."""
    below = sum(quantity(section["length"]) for section in TREE["riser"][:2])
    top = below + quantity(TREE["riser"][2]["length"])
    s = np.array([0.0, below - 1.0, below, 0.5 * (below + top), top, top + 1.0])
    tension = np.array([9e9, 9e9, -3e6, 1e6, 2e6, 9e9])
    moment = np.array([9e9, 9e9, 1e5, -4e5, 2e5, 9e9])
    run = xr.Dataset({"effective_tension": ("s", tension), "bending_moment": ("s", moment)}, {"s": s}, SCENE)
    area, modulus = pipe(TREE["riser"][2])
    expected = max(3e6 / area + 1e5 / modulus, 1e6 / area + 4e5 / modulus, 2e6 / area + 2e5 / modulus)
    assert float(derived.riser_stress(run)) == pytest.approx(expected)


def test_a_calibration_takes_the_angle_at_the_deadline_and_its_largest_until_then():
    """Up to 8 deg at 20 s, 2 deg at 50.5 s, and the limit of 12 deg at 80 s."""
    degrees = np.interp(TIME, [0.0, 20.0, 40.0, 60.0, 80.0, 100.0], [0.0, -8.0, -1.0, -3.0, -12.0, -20.0])
    fits = xr.Dataset({"ufj_angle": history(np.deg2rad(degrees))}, {"time": TIME}, SCENE)
    found = derived.calibration(fits, 50.5)
    assert float(np.rad2deg(found["ufj_angle"])) == pytest.approx(2.05)
    assert float(np.rad2deg(found["ufj_angle_absmax"])) == pytest.approx(8.0)
    assert float(found["ufj_limit_time"]) == pytest.approx(80.0)
    vessel = TREE["vessel"]
    assert found.attrs["gain"] == pytest.approx(quantity(vessel["thrusters"]["gain"]), rel=1e-9)


def test_limits_are_those_that_the_paper_prints():
    printed = {"upper flex joint": np.pi / 15.0, "lower flex joint": np.pi / 30.0, "telescopic joint": 9.905,
               "conductor": 386e6, "wellhead": 7.8e6}  # fmt: skip
    assert {name: limit.most for name, limit in LIMITS.items()} == pytest.approx(printed)


def test_offsets_of_limits_are_where_the_platform_is_at_their_times():
    """Limits at 50 and 80 s of 2 m/s, and three that are never reached, which have no offset."""
    angle = LIMITS["upper flex joint"].most * TIME / 50.0
    run = driven(ufj_angle=angle, lfj_angle=LIMITS["lower flex joint"].most * TIME / 80.0)
    run["bending_moment"] = 0.0 * run["bending_moment"]
    runs = run.expand_dims(environment_heading=[0, 90])
    found = derived.disconnect(runs, ["20 s", "30 s"], "15 s").isel(environment_heading=1)
    assert float(found["disconnect_time"]) == pytest.approx(50.0)
    assert found["first_limit"].item() == "upper flex joint"
    offsets = found["limit_offset"]
    assert float(offsets.sel(limit="upper flex joint")) == pytest.approx(100.0)
    assert float(offsets.sel(limit="lower flex joint")) == pytest.approx(160.0)
    assert np.isnan(offsets.sel(limit="telescopic joint"))
    assert found["red_circle_radius"].values == pytest.approx([60.0, 40.0])
    assert found["yellow_circle_radius"].values == pytest.approx([30.0, 10.0])


def test_the_lag_is_from_the_upper_joint_to_the_first_part_at_the_bottom():
    """Shares of limits grow from 10, 30 and 36 s on, by a hundredth a second."""

    def after(begin):
        return 0.01 * np.maximum(TIME - begin, 0.0)

    run = driven(
        ufj_angle=-LIMITS["upper flex joint"].most * after(10.0),
        lfj_angle=LIMITS["lower flex joint"].most * after(30.0),
        largest_stress=LIMITS["conductor"].most * (0.5 + after(36.0)),
    )
    run["bending_moment"] = 0.0 * run["bending_moment"]
    found = derived.lag(run)
    assert found["begun"].values.tolist() == [0.02, 0.03, 0.05, 0.07, 0.1]
    assert found["lag"].values == pytest.approx([20.0] * 5)


def leaning(angle, moments, offset):
    """A riser at rest: its joint leans by an angle (rad), with moments at its last two nodes (N m)."""
    joint = quantity(TREE["top"]["telescopic_joint"]["length"])
    foot = FOOT + quantity(TREE["riser"][1]["length"])
    s = np.array([0.0, 40.0, FOOT, foot, 1300.0, 1300.0 + joint])
    x = np.array([0.0, 0.0, 0.0, 0.0, 3.0, 3.0 + (joint + offset) * np.sin(angle)])
    z = np.array([0.0, 40.0, FOOT, foot, 1300.0, 1300.0 + (joint + offset) * np.cos(angle)])
    moment = np.array([2e5, -6e5, 4e5, 9e4, *moments])
    return s, x, z, moment


def test_a_riser_at_rest_has_the_angles_strokes_and_stresses_of_its_shape():
    """The upper flex joint's angle is the chord's, plus the end slope of a beam under its two moments."""
    rests = [leaning(0.0, (0.0, 0.0), 0.0), leaning(0.1, (3e3, 6e3), 2.0)]
    dims = ("surface_speed", "offset", "s_node")
    names = ("x_static", "z_static", "bending_moment_static")
    data = {name: (dims, np.stack([rest[k + 1] for rest in rests])[None]) for k, name in enumerate(names)}
    tension = np.array([-3e6, 2e6, 1e6, 9e9, 9e9, 9e9])
    data["effective_tension_static"] = (dims, np.stack([tension, tension])[None])
    runs = xr.Dataset(data, {"surface_speed": [0.0], "offset": [0.0, 10.0], "s_node": rests[0][0]}, SCENE)
    share = derived.envelope(runs)["limit_share"].sel(surface_speed=0.0, offset=10.0)
    used = {name: float(share.sel(limit=name)) * LIMITS[name].most for name in LIMITS}
    joint = TREE["top"]["telescopic_joint"]
    length, stiff = quantity(joint["length"]), quantity(joint["bending_stiffness"])
    # by virtual work: a unit moment at the upper end, over the moments along the joint
    along = np.linspace(0.0, 1.0, 20001)
    slope = np.trapezoid((3e3 + 3e3 * along) * along, along * length) / stiff
    assert used["upper flex joint"] == pytest.approx(0.1 + slope)
    assert used["telescopic joint"] == pytest.approx(2.0)
    assert used["wellhead"] == pytest.approx(4e5)
    stiffness = quantity(TREE["riser"][2]["flex_joint_below"]["stiffness"])
    unit = str(TREE["riser"][2]["flex_joint_below"]["stiffness"]).split()[1]
    in_si = {"N*m/rad": 1.0, "kN*m/deg": 1e3 * 180.0 / np.pi, "N*m/deg": 180.0 / np.pi}[unit]
    assert used["lower flex joint"] == pytest.approx(9e4 / (stiffness * in_si))
    area, modulus = pipe(TREE["riser"][0])
    stresses = [3e6 / area + 2e5 / modulus, 2e6 / area + 6e5 / modulus, 1e6 / area + 4e5 / modulus]
    assert used["conductor"] == pytest.approx(max(stresses))


@pytest.mark.parametrize("offset, speed", [(120.0, 0.6), (-90.0, 0.3), (60.0, -1.0)])
def test_angles_at_rest_are_those_that_the_engine_gives_at_the_start_of_a_run(offset, speed):
    """With their signs: of the chord and of the moments in the joint, and of the lower joint's moment."""
    held = FILE.with_values(
        {"vessel": None, "wave": None, "top.x": "held", "top.offset": f"{offset} m"}, "test"
    )
    held = held.with_values({"current.profile.surface_speed": f"{speed} m/s"}, "test")
    held = held.with_values({"analysis": {"mesh": {"elements": 80}}}, "test")
    moving = {"analysis": {"mesh": {"elements": 80}, "duration": "1 s", "step": "0.5 s",
                           "output": {"interval": "0.5 s"}}}  # fmt: skip
    rest = labelled(simulated(held.resolved(), estimated=False))
    start = labelled(simulated(held.with_values(moving, "test").resolved(), estimated=False)).isel(time=0)
    runs = rest.expand_dims(surface_speed=[0.0], offset=[0.0]).assign_attrs(SCENE)
    share = derived.envelope(runs)["limit_share"].squeeze()
    found = derived._at_rest(runs).squeeze()
    for name, joint in (("ufj_angle", "upper flex joint"), ("lfj_angle", "lower flex joint")):
        assert float(found[name]) == pytest.approx(float(start[name]), rel=1e-5)
        used = abs(float(start[name])) / LIMITS[joint].most
        assert float(share.sel(limit=joint)) == pytest.approx(used, rel=1e-5)
    assert float(found["ufj_angle"]) * offset > 0.0
