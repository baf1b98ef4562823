"""Readings as axes and samples, risers of several lengths, and what Mao's chapter takes from runs."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg

from riserstudy.chapters import checks_of
from riserstudy.chapters.derive import derive
from riserstudy.chapters.draw import draw
from riserstudy.chapters.mao_hangoff.claims.at_some_time import (
    FREE,
    STRICT,
    distance_of_fig10,
    moment_of_fig9,
    numbers_at_some_time,
)
from riserstudy.chapters.mao_hangoff.claims.errata import load_power, readings_near, variants
from riserstudy.chapters.mao_hangoff.claims.heave import (
    harmonic,
    largest_at_0_degrees,
    lows_deeper_at_first,
)
from riserstudy.chapters.mao_hangoff.claims.towed import (
    change_arises_near_the_lmrp,
    change_near_the_lmrp,
    loads_small_at_the_lmrp,
    small_below,
)
from riserstudy.chapters.mao_hangoff.derived.towed import end_loads, reference_masses, towed
from riserstudy.chapters.mao_hangoff.hanging import hanging, largest_rise
from riserstudy.chapters.mao_hangoff.towed import at_top, displacement
from riserstudy.errors import InputError
from riserstudy.grading.grade import errata, grade
from riserstudy.grading.printed import with_printed
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import ErratumRow, table
from riserstudy.grading.words_file import read_words
from riserstudy.scene.load import read_scene
from riserstudy.study.axes import Numbers
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import Derived, StudyModel
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[3] / "config"
PAPER = "mao_hangoff"
WORD = read_words(CONFIG).word
FILE = read_studies(CONFIG, PAPER)
WEIGHTS = FILE.readings["riser_weight"]


def planned(name, **changes):
    model = FILE.studies[name].model_copy(update=changes)
    return Study(PAPER, name, model, CONFIG, "preview", None, FILE.readings)


def small(name, **settings):
    """A dataset on a coarse mesh with few outputs."""
    coarse = {
        "analysis.accuracy": None,
        "analysis.mesh": {"elements": 20},
        "analysis.step": "0.5 s",
        "analysis.output": {"interval": "10 s"},
    }
    study = planned(name, set=FILE.studies[name].set | coarse | settings)
    return dataset_of(study, results_of(study, 1, lambda text: None)[0])


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
    assert names == sorted(
        (path.stem for path in scenes.glob("hangoff_ref*.yaml")), key=names.index
    )
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
    with pytest.raises(ValueError, match="an assumption without evidence"):
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


def hung_off(length, mass, more=None):
    sets = {"riser[0].length": f"{length} m", "bottom.body.mass": f"{mass} t"}
    scene = read_scene(CONFIG / "scenes" / PAPER / "hang_off.yaml")
    return scene.with_values(sets | (more or {}), "test").resolved()


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


def small_steady():
    axes = dict(FILE.studies["steady"].axes)
    axes["riser_length"] = axes["riser_length"].model_copy(update={"preview": [1200.0]})
    study = planned("steady", axes=axes, set={"analysis.mesh": {"elements": 40}})
    return dataset_of(study, results_of(study, 1, lambda text: None)[0])


# checks


def test_the_amplitude_is_freed_of_a_drift():
    t = np.arange(0.0, 130.5, 0.5)
    z = 0.02 * t + 1e-4 * t**2 + 1.5 * np.sin(2 * np.pi * t / 10.0 + 0.3)
    heave = xr.Dataset({"z": (("time", "s"), z[:, None])}, {"time": t, "s": [0.0]})
    heave.attrs["scene"] = json.dumps({"platform": {"heave": {"period": "10 s"}}})
    fit = harmonic(heave["z"].isel(s=0), heave)
    assert float(fit["amplitude"]) == pytest.approx(1.5, rel=1e-9)
    assert float(fit["drift"]) == pytest.approx(0.02 + 1e-4 * 200.0, rel=1e-9)
    assert float(fit["share"]) == pytest.approx(1.0)


def of_two_readings(heavy, light, moment):
    """Runs whose LMRP trails so far (m) with 140 and 120 t, and their moment (kN m), a column a reading."""
    x = np.zeros((2, 2, 2, 2))  # over reading, mass, time, s
    x[:, 0, 1, 0], x[:, 1, 1, 0] = -np.array(light), -np.array(heavy)
    dims = ("riser_weight", "lmrp_mass", "time", "s")
    bending = np.broadcast_to(1e3 * np.array(moment)[:, None, None, None], x.shape)
    coords = {"riser_weight": ["thin", "thick"], "lmrp_mass": [120.0, 140.0]}
    return xr.Dataset(
        {"x": (dims, x), "bending_moment": (dims, bending)},
        coords | {"time": [0.0, 130.0], "s": [0.0, 1.0]},
    )


def test_a_distance_that_grows_with_the_square_of_the_speed_has_the_power_of_two():
    speeds = {"90 deg": -1.0}
    for angle, speed in ((0, 1.5), (45, 0.75), (135, -2.75), (180, -3.5)):
        speeds |= {f"{angle} deg, 2.5 m/s": 10.0, f"{angle} deg, 3 m/s": speed}
    x = np.zeros((len(speeds), 2, 2))
    x[:, 1, 0] = [-(speed**2) for speed in speeds.values()]
    coords = {"track": list(speeds), "time": [0.0, 130.0], "s": [0.0, 1.0]}
    runs = xr.Dataset({"x": (("track", "time", "s"), x)}, coords)
    sets = {name: {"current.profile.surface_speed": f"{v} m/s"} for name, v in speeds.items()}
    runs["track"].attrs["sets"] = json.dumps(sets)
    found = load_power(runs)
    assert found["power"] == pytest.approx(2.0)
    assert (found["slow"], found["fast"]) == (1.5, 3.5)


def test_a_rise_counts_from_still_water_wherever_the_record_starts():
    """Risers that start in the current are lifted by it already; those whose current grows are not."""
    grown = small("riser_length_runs")
    sudden = small("riser_length_runs", **{"current.ramp": None})
    at_first = {name: runs["z"].isel(s=0, time=0, drop=True) for name, runs in
                (("grown", grown), ("sudden", sudden))}  # fmt: skip
    np.testing.assert_allclose(at_first["grown"], hanging(grown), atol=1e-5)
    np.testing.assert_array_equal(hanging(grown), hanging(sudden))
    assert (at_first["sudden"] > hanging(sudden) + 1e-3).all()
    risen = largest_rise(sudden)
    assert (risen >= at_first["sudden"] - hanging(sudden) - 1e-9).all()


def heaving(*curves, **of):
    """Elevations over time of nodes from the LMRP up."""
    t = np.arange(0.0, 130.5, 0.5)
    z = np.stack([curve(t) for curve in curves], axis=-1)
    return xr.Dataset({"z": (("time", "s"), z)}, {"time": t} | of)


def test_lows_at_depths_are_compared_with_that_of_the_top():
    def heave(amplitude):
        return lambda t: amplitude * np.sin(2 * np.pi * t / 10.0)

    depths = [1000.0, 1500.0]
    nodes = [0.0, 300.0, 800.0, 1800.0]
    deeper = heaving(heave(1.3), heave(1.2), heave(1.1), heave(1.0), s=nodes)
    found = lows_deeper_at_first(deeper, depths, WORD("larger"))
    assert float(found.value) == pytest.approx(1.1, rel=1e-6)
    assert bool(found.true)
    risen = heaving(lambda t: heave(1.3)(t) + 0.05 * t, *[heave(0.9)] * 2, heave(1.0), s=nodes)
    assert not bool(lows_deeper_at_first(risen, depths, WORD("larger")).true)


def test_0_degrees_is_told_from_both_other_angles():
    values = xr.DataArray([2.0, 1.0, 1.7], {"track_angle": [0.0, 45.0, 90.0]}, "track_angle")
    assert not bool(largest_at_0_degrees(values, WORD("considerable")).true)  # by 50 and 15 %
    assert bool(largest_at_0_degrees(values, WORD("evident")).true)
    assert float(largest_at_0_degrees(values, WORD("evident")).value) == pytest.approx(0.85)


def shapes_of(light, heavy):
    """Runs whose risers of 100 m have shapes, with 120 and 140 t, over height from the LMRP."""
    s = np.linspace(0.0, 100.0, 101)
    x = np.zeros((2, 2, s.size))
    x[0, 1], x[1, 1] = -light(s), -heavy(s)
    coords = {"lmrp_mass": [120.0, 140.0], "time": [0.0, 130.0], "s": s}
    return xr.Dataset({"x": (("lmrp_mass", "time", "s"), x)}, coords)


def test_a_change_that_grows_all_the_way_down_occurs_near_the_lmrp_and_arises_everywhere():
    straight = shapes_of(lambda s: 2.0 * (100.0 - s), lambda s: 100.0 - s)
    assert bool(change_near_the_lmrp(straight).true)
    assert float(change_near_the_lmrp(straight).value) == pytest.approx(3.0, rel=0.02)
    assert float(change_arises_near_the_lmrp(straight, 0.5).value) == pytest.approx(0.25)
    bulged = shapes_of(lambda s: s * (100.0 - s), lambda s: 0.0 * s)
    assert not bool(change_near_the_lmrp(bulged).true)


def test_moments_are_small_or_not_below_the_depth_that_is_asked_for():
    s = np.linspace(0.0, 1800.0, 181)
    moment = np.where(s > 1800.0 - 170.0, 1.0, 0.4)
    dims = {"lmrp_mass": [140.0], "time": [130.0], "s": s}
    runs = xr.Dataset({"bending_moment": (("lmrp_mass", "time", "s"), moment[None, None])}, dims)
    assert bool(small_below(runs, 200.0, 0.5).true)
    assert not bool(small_below(runs, 150.0, 0.5).true)


def test_loads_are_those_of_the_slip_at_both_ends(datasets):
    """Against 1 m/s at 1 m/s the joint meets 2 m/s; C_D 1.2 and 0.7, no current at the LMRP."""
    readings = datasets["readings"]
    base = {name: readings[name].values[0] for name in ("riser_weight", "flow", "current_profile")}
    loads = end_loads(readings).sel(base)
    assert loads["load_at_joint"].values == pytest.approx(
        -0.5 * 1025.0 * 1.2 * 0.5334 * 4.0, rel=1e-6
    )
    x = readings["x"].sel(base).isel(s=0)
    speed = (x.sel(time=130.0) - x.sel(time=120.0)) / 10.0
    there = -0.5 * 1025.0 * 0.7 * 0.5334 * speed**2
    np.testing.assert_allclose(loads["load_at_lmrp"], there, rtol=1e-9)
    found = loads_small_at_the_lmrp(loads, WORD("considerable"))
    assert bool(found.true) == (float(found.value) < 0.75)


def test_the_case_without_open_inputs_stands_beside_the_printed_numbers(datasets):
    runs = datasets["hangoff_ref"]
    both = reference_masses(runs)
    for mass, name in ((140.0, "hangoff_ref"), (120.0, "hangoff_ref_120t")):
        xr.testing.assert_equal(
            both["x"].sel(lmrp_mass=mass, drop=True), runs["x"].sel(variant=name, drop=True)
        )


def test_readings_that_come_near_print_are_named():
    print_of = {"heavy": 58.2, "light": 62.7, "moment": 52.0, "within": 0.02}
    runs = of_two_readings(heavy=(58.0, 40.0), light=(62.5, 43.1), moment=(70.0, 52.5))
    told = readings_near(runs, **print_of)
    assert told["count"] == 2
    assert told["x_heavy"] == told["x_light"] == "1 (thin)"
    assert told["moment"] == "1 (thick)"
    assert told["ratio"] == "2 (thick; thin)"  # the nearer one first
    assert told["all"] == "none"
    assert told["best"] == "thick"
    assert told["worst"] == pytest.approx(1.0 - 40.0 / 58.2)
    met = readings_near(of_two_readings((58, 58), (62.5, 10), (52, 52)), **print_of)
    assert met["all"] == "1 (thin)"


def test_all_numbers_claims_and_errata_of_the_dossier_are_there():
    known = {*FILE.studies, *FILE.derived}
    file = read_published(CONFIG, PAPER, known)
    ids = {item.id for item in file.items} | {erratum.id for erratum in file.errata}
    wanted = [("N", 4), ("C", 28), ("R", 4), ("T", 14), ("E", 15)]
    assert {f"{letter}{k}" for letter, most in wanted for k in range(1, most + 1)} <= ids
    for item in file.items:
        assert item.impossible or callable(checks_of(PAPER)(item.check))


def test_the_depth_of_a_moment_counts_from_the_end_of_its_own_riser():
    """A lever arm makes the riser of one variant longer, whose nodes all variants then have."""
    names = list(FILE.studies["variants"].axes["variant"])
    s = np.array([0.0, 50.0, 100.0, 108.0])
    moment = np.tile([0.0, 1.0, 2.0, np.nan], (2, len(names), 1)).transpose(1, 0, 2)
    moment[names.index("LMRP with lever arm and rotary inertia"), :, 3] = 3.0
    dims = ("variant", "time", "s")
    coords = {"variant": names, "time": [0.0, 130.0], "s": s}
    runs = xr.Dataset({"bending_moment": (dims, moment), "x": (dims, moment)}, coords)
    facts = variants(runs)
    assert facts["d_base"] == facts["d_lever"] == 0.0


# figures and grading, from few and coarse runs

FEW = {name: dict(list(labels.items())[:2]) for name, labels in FILE.readings.items()}
COARSE = {"analysis.accuracy": None, "analysis.mesh": {"elements": 20}, "analysis.step": "0.5 s"}
STATIC = ("steady", "pe_pipe")


def little(name, model):
    axes = dict(model.axes)
    if "sample" in axes:
        axes["sample"] = axes["sample"].model_copy(update={"count": {"preview": 2}})
    if name == "variants":
        return model
    settings = {"analysis.mesh": {"elements": 20}} if name in STATIC else COARSE
    return model.model_copy(update={"axes": axes, "set": model.set | settings})


@pytest.fixture(scope="module")
def datasets():
    made = {}
    for name, model in FILE.studies.items():
        readings = FEW | {"track": FILE.readings["track"]}
        if name == "readings":  # errata tell every flow
            readings |= {"flow": FILE.readings["flow"]}
        study = Study(PAPER, name, little(name, model), CONFIG, "preview", "5 %", readings)
        made[name] = dataset_of(study, results_of(study, 1, lambda text: None)[0])
    for name, how in FILE.derived.items():
        sources = {source: made[source] for source in how.reads}
        made[name] = derive(PAPER, name, sources, with_printed(how.settings, CONFIG, PAPER))
    return made


def drawn(datasets, name):
    model = FILE.figures[name]
    settings = with_printed(model.settings, CONFIG, PAPER)
    return draw(PAPER, name, {key: datasets[key] for key in model.reads}, settings)


def test_a_reading_of_the_weight_has_one_colour_in_both_figures(datasets):
    colours = []
    for name in ("readings", "open_choices"):
        figure = drawn(datasets, name)
        lines = figure.axes[0].get_lines()
        weights = {line: str(line.get_label()).partition(";")[0] for line in lines}
        colours.append({n: line.get_color() for line, n in weights.items() if n in WEIGHTS})
    both = colours[0].keys() & colours[1].keys()
    assert both
    assert {name: colours[0][name] for name in both} == {name: colours[1][name] for name in both}


def test_dashed_lines_of_tracks_are_in_the_key(datasets):
    figure = drawn(datasets, "fig13")
    dashed = [
        line.get_label() for line in figure.axes[0].get_lines() if line.get_linestyle() == "--"
    ]
    shown = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    assert any(label in shown for label in dashed)


@pytest.mark.parametrize("name", FILE.figures)
def test_every_figure_is_drawn_whole_with_units(datasets, name):
    figure = drawn(datasets, name)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    inside = figure.get_tightbbox(canvas.get_renderer())
    width, height = figure.get_size_inches()
    assert min(inside.x0, inside.y0) >= -0.01
    assert inside.x1 <= width + 0.01
    assert inside.y1 <= height + 0.01
    for ax in figure.axes:
        for label in (ax.get_xlabel(), ax.get_ylabel()):
            assert not label or label.endswith(")") or " / " in label, label


def test_everything_is_graded(datasets):
    file = read_published(CONFIG, PAPER, datasets)
    cases = {of.id: of.cases for of in grade(file, datasets, checks_of(PAPER))}
    assert list(cases) == [item.id for item in file.items]
    # What must come out whatever the numbers, in every sample: one heave has one frequency.
    assert all(case.met for case in cases["C7"])
    assert "{" not in table(errata(file, datasets, checks_of(PAPER)), ErratumRow)


def passing(start, rate, moment, heave):
    """Two LMRP masses over time: distances that grow at a rate, a moment that swings with the heave."""
    t = np.arange(100.0, 201.0)
    x = np.zeros((2, t.size, 2))
    x[:, :, 0] = -(start + rate * (t - 130.0))  # the LMRP, behind a top that stands
    size = moment + heave * np.sin(2.0 * np.pi * t / 10.0)
    bending = 1e3 * np.repeat(np.repeat(size[None, :, None], 2, 0), 2, 2)
    dims = ("lmrp_mass", "time", "s")
    coords = {"lmrp_mass": [120.0, 140.0], "time": t, "s": [0.0, 1.0]}
    return xr.Dataset({"x": (dims, x), "bending_moment": (dims, bending)}, coords)


def test_a_number_without_a_time_is_met_where_a_run_passes_it():
    later = passing(58.2, 0.2, 52.0, 0.0)  # 62.7 m at 152.5 s
    found = distance_of_fig10(later, 120.0, 62.7).value
    assert float(found.sel(when=STRICT)) == pytest.approx(58.2)
    assert float(found.sel(when=FREE)) == pytest.approx(62.7)
    slower = distance_of_fig10(passing(58.2, 0.01, 52.0, 0.0), 120.0, 62.7).value
    assert float(slower.sel(when=FREE)) == pytest.approx(58.9)  # the last, which is the nearest
    assert bool(numbers_at_some_time(later, 58.2, 62.7, 52.0, 0.02).true)
    assert not bool(
        numbers_at_some_time(passing(50.0, 0.2, 52.0, 0.0), 58.2, 62.7, 52.0, 0.02).true
    )


def test_a_moment_is_met_at_some_phase_where_the_cycle_passes_it():
    found = moment_of_fig9(passing(58.2, 0.2, 53.4, 2.4), 140.0, 52.0).value
    assert float(found.sel(when=STRICT)) == pytest.approx(53.4)
    assert float(found.sel(when=FREE)) == 52.0
    above = moment_of_fig9(passing(58.2, 0.2, 55.4, 1.4), 140.0, 52.0).value
    assert 54.0 <= float(above.sel(when=FREE)) < 54.1
    # a run that ends in nothing has no value
    gone = passing(58.2, 0.2, 55.4, 1.4)
    gone["bending_moment"][:] = np.nan
    assert moment_of_fig9(gone, 140.0, 52.0).value.isnull().all()
