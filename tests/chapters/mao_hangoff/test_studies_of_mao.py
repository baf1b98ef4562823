"""Studies of Mao's chapter: readings as axes and samples, and datasets of risers of several lengths."""

import json

import numpy as np
import pytest
import xarray as xr
from mao import CONFIG, FILE, PAPER, hung_off, planned, small, small_steady

from chapters.mao_hangoff.derived.towed import towed
from chapters.mao_hangoff.runs import CURRENTS, track_name
from chapters.mao_hangoff.towed import at_top, displacement
from riserstudy.chapters.derive import derive
from riserstudy.errors import InputError
from riserstudy.scene.load import read_scene
from riserstudy.study.axes import Numbers
from riserstudy.study.models import Derived
from riserstudy.study.read import read_studies
from riserstudy.study.study_model import StudyModel

# studies


def test_an_axis_of_readings_takes_all_of_them():
    study = planned("readings")
    assert list(dict(study.axes["flow"])) == list(FILE.readings["flow"])


def test_samples_draw_readings_by_name_and_set_what_they_mean():
    study = planned("open_lmrp_mass")
    axis = study.model.axes["sample"]
    for assumed, (_, sets) in zip(study.assumed(axis), study.axes["sample"], strict=True):
        reading = FILE.readings["riser_weight"][assumed["riser_weight"]]
        assert reading.items() <= sets.items()
        assert "riser_weight" not in sets


def test_tracks_in_one_profile_have_the_names_by_which_claims_and_figures_find_them():
    along = {track_name(angle, current) for angle in (0, 45, 135, 180) for current in CURRENTS}
    assert {*FILE.readings["track"]} == along | {track_name(90)}


def test_an_unknown_reading_is_refused(tmp_path):
    text = (CONFIG / "studies" / f"{PAPER}.yaml").read_text()
    (tmp_path / "studies").mkdir()
    (tmp_path / "studies" / f"{PAPER}.yaml").write_text(text.replace("  flow:\n", "  stream:\n", 1))
    with pytest.raises(InputError, match="no readings 'flow'"):
        read_studies(tmp_path, PAPER)


def test_numbers_are_turned_and_shifted_on_their_way():
    axis = Numbers(path="riser[0].length", unit="m", factor=-1.0, offset=150.0, values=[100.0])
    assert axis.overrides(100.0) == {"riser[0].length": "50.0 m"}


def test_all_grids_hold_the_papers_points_and_eleven_of_their_own():
    axes = {
        "lmrp_mass": (120, 130, 140),
        "current_speed": (1.0, 1.1, 1.2),
        "platform_speed": (2.4, 2.5, 2.6),
        "riser_length": (1200, 1500, 1800),
        "track_angle": (0, 45, 90),
    }
    for name, points in axes.items():
        axis = FILE.studies[f"{name}_runs"].axes[name]
        assert set(points) <= set(axis.numbers("preview"))
        assert set(points) <= set(axis.numbers("standard"))
        assert len(axis.numbers("standard")) >= 11


def test_studies_of_samples_have_the_same_samples_in_the_standard_tier():
    """Claims that read two of them would else be judged on fewer samples than either has."""
    counts = {
        model.axes["sample"].count["standard"]
        for name, model in FILE.studies.items()
        if isinstance(model, StudyModel) and name.startswith("open_")
    }
    assert len(counts) == 1
    assert min(counts) >= 128


def test_variants_of_the_case_without_open_inputs_are_the_scenes_of_those_names():
    study = planned("hangoff_ref")
    scenes = CONFIG / "scenes" / PAPER
    names = [name for name, _ in study.axes["variant"]]
    assert names == sorted((path.stem for path in scenes.glob("hangoff_ref*.yaml")), key=names.index)
    base = read_scene(scenes / "hangoff_ref.yaml")
    for name, sets in study.axes["variant"]:
        made, own = base.with_values(sets, "test").tree, read_scene(scenes / f"{name}.yaml").tree
        assert made | {"title": ""} == own | {"title": ""}


# datasets


def test_the_grids_are_as_promised():
    made = towed(small("lmrp_mass_runs"), "lmrp_mass")
    assert made["lmrp_displacement"].dims == ("lmrp_mass", "time")
    assert made["bending_moment_size"].dims == ("lmrp_mass", "s")
    assert float(made["s"][0]) == 0.0
    assert made["lmrp_mass"].attrs["units"] == "t"
    assert made["bending_moment_size"].attrs["long_name"].endswith("bending moment at 130 s")
    x = made["lmrp_displacement"].isel(time=-1)
    assert (x < 0).all()
    assert (np.diff(x) > 0).all()  # the heavier, the less far
    cross = made["lmrp_displacement_cross"]
    assert cross.dims == ("lmrp_mass", "time")
    assert (cross == 0.0).all()
    assert cross.attrs["units"] == "m"


def test_risers_of_several_lengths_keep_their_own_tops():
    runs = small("riser_length_runs")
    for length in (1200.0, 1500.0, 1800.0):
        x = runs["x"].sel(riser_length=length).isel(time=-1)
        assert float(x.dropna("s")["s"][-1]) == length
        top = float(at_top(runs["x"]).sel(riser_length=length).isel(time=-1))
        assert top == pytest.approx(120.0)  # 130 s at 1 m/s, less half the ramp of 20 s


def test_displacement_counts_along_the_track_whichever_way_it_goes():
    time, s = [0.0, 1.0], [0.0, 1.0]
    x = xr.DataArray([[0.0, 0.0], [-1.0, -5.0]], {"time": time, "s": s}, ("time", "s"))
    there = displacement(xr.Dataset({"x": x})).isel(time=-1, s=0)
    back = displacement(xr.Dataset({"x": -x})).isel(time=-1, s=0)
    assert float(there) == float(back) == -4.0


def test_speed_limits_lie_where_a_limit_is_used_up():
    how = FILE.derived["speed_limits"]
    made = derive(PAPER, "speed_limits", {"steady": small_steady()}, how.settings)
    assert json.loads(made.attrs["origins"])["with.joint_angle"] == "assumed"
    use, speed = made["use_of_limit"].max("limit"), made["speed_limit"]
    at = use.isel(riser_length=0, lmrp_mass=0, current_speed=0)
    found = float(speed.isel(riser_length=0, lmrp_mass=0, current_speed=0))
    assert np.interp(found, at["platform_speed"], at) == pytest.approx(1.0, rel=0.05)
    # against 1 m/s the water comes 1.944 kn faster
    faster = made["speed_through_water"] - speed
    assert float(abs(faster.sel(current_speed=0.0)).max()) == 0.0
    assert faster.sel(current_speed=1.0).values == pytest.approx(1.943844, rel=1e-6)


def test_half_the_limit_of_the_joint_doubles_its_use():
    steady, settings = small_steady(), FILE.derived["speed_limits"].settings
    whole = derive(PAPER, "speed_limits", {"steady": steady}, settings)["use_of_limit"]
    strict = settings | {"joint_angle": "4.5 deg", "yield_stress": "1110 MPa"}
    halved = derive(PAPER, "speed_limits", {"steady": steady}, strict)["use_of_limit"]
    ratio = (halved / whole).isel(platform_speed=-1)
    for limit, factor in (("joint angle", 2.0), ("clearance", 1.0), ("stress", 0.5)):
        assert ratio.sel(limit=limit).values == pytest.approx(factor, rel=1e-9)


def test_an_assumption_without_evidence_is_refused_in_settings_too():
    with pytest.raises(ValueError, match="the assumption has no reason"):
        Derived.model_validate({"reads": ["steady"], "with": {"keel": {"assumed": "25 m"}}})


@pytest.mark.parametrize(
    "length, mass, pull, stiffness, damping",
    [(1200, 60, 3768617, 37686, 25808), (1800, 140, 6079379, 60794, 41633)],
)
def test_tensioners_of_a_hang_off_are_set_to_its_weight(length, mass, pull, stiffness, damping):
    """By hand: 2714.06 N/m and 318.212 kg/m of pipe, and an LMRP of solid steel."""
    rig = hung_off(length, mass).top.tensioners
    found = rig.linear.tension, rig.linear.stiffness, rig.damping
    assert found == pytest.approx((pull, stiffness, damping), rel=2e-5)


def test_cylinders_that_work_share_the_weight():
    rig = hung_off(1800, 140, {"top.tensioners.count": 6, "top.tensioners.failed": [0, 3]})
    assert rig.top.tensioners.linear.tension == pytest.approx(6079379 / 4, rel=2e-5)


def test_heave_that_loses_tension_lies_where_the_straight_line_from_rest_does():
    """1 MN at rest: half of it left at 1 m of heave, less than nothing at 2 m."""
    lowest = xr.DataArray([0.5e6, -0.5e6], {"heave_amplitude": [1.0, 2.0]}, "heave_amplitude")
    tension = lowest.expand_dims(mode=["soft", "hard"], s_node=[0.0], axis=(0, 1))
    runs = xr.Dataset({"effective_tension_max": tension, "effective_tension_min": tension})
    runs["effective_tension_static"] = xr.full_like(tension, 1e6)
    # locked, on a closer grid: 2 MN at 1 m, more than at rest, and -2 MN at 1.5 m
    close = tension.sel(mode="hard", drop=True).assign_coords(heave_amplitude=[1.0, 1.5])
    locked = xr.Dataset({"effective_tension_min": 4.0 * close})
    locked["effective_tension_static"] = xr.full_like(close, 1e6)
    both = {"hang_off": runs, "hang_off_lost": locked}
    lost = derive(PAPER, "tension_limits", both)["heave_that_loses_tension"]
    assert lost.sel(mode=["soft", "hard"]).values == pytest.approx([1.5, 1.25])
    runs["effective_tension_min"] = tension - 1e6
    early = derive(PAPER, "tension_limits", both)["heave_that_loses_tension"]
    assert float(early.sel(mode="soft")) == pytest.approx(2.0 / 3.0)
