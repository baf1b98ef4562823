"""Settings that a job tunes: the points are run with them, or by request where they do not serve."""

import json

import numpy as np
import pytest
import short_study
import xarray as xr

from riserstudy.database.parameters import parameters_of
from riserstudy.database.prune import unneeded
from riserstudy.database.read_dataset import read_dataset
from riserstudy.dataset.provenance import scene_file_of
from riserstudy.errors import InputError, SimulationError
from riserstudy.jobs.plan_checks import refuse_settings
from riserstudy.model.mesh import prescribed
from riserstudy.simulation.error_estimate import controlled, difference
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import single
from riserstudy.study import settings, store
from riserstudy.study.corners import others
from riserstudy.study.repeat_point import rerun
from riserstudy.study.setting import Setting
from riserstudy.study.settings import (
    Settings,
    fill_tuned,
    read_settings,
    tuned_for,
    with_setting,
    write_settings,
)
from riserstudy.study.simulate_points import attempt
from riserstudy.study.write_study import write_study

STUDIES = """\
paper: settings
studies:
  surge:
    scene: scenes/riser.yaml
    caption: surge of a short riser
    set:
      analysis: {duration: 20 s, output: {interval: 0.5 s, stations: [100 m]}, accuracy: 2 %}
    settings: {points: 3, seed: 2}
    axes:
      amplitude: {path: platform.surge.amplitude, unit: m, values: [0.5, 1, 1.5, 2]}
      period: {path: platform.surge.period, unit: s, values: {start: 8, stop: 14, step: 2}}
      end:
        free: {}
        on a joint: {bottom.rotation: {stiffness: 40 kN*m/deg}}
  quick:
    scene: scenes/riser.yaml
    caption: surge of a short riser, tuned at one point
    set: {analysis: {duration: 20 s, output: {interval: 0.5 s}, accuracy: 2 %}}
    settings: tuned
    axes:
      amplitude: {path: platform.surge.amplitude, unit: m, values: [0.5, 1, 1.5, 2]}
      period: {path: platform.surge.period, unit: s, values: {start: 8, stop: 14, step: 2}}
      end:
        free: {}
        on a joint: {bottom.rotation: {stiffness: 40 kN*m/deg}}
  own_mesh:
    scene: scenes/riser.yaml
    caption: with the mesh and step of its scene
    settings: tuned
    axes:
      mass: {path: "riser[0].mass", unit: kg/m, values: {start: 600, stop: 900, step: 10}}
  few:
    scene: scenes/riser.yaml
    caption: few points
    set: {analysis.duration: 10 s}
    settings: tuned
    axes:
      mass: {path: "riser[0].mass", unit: kg/m, values: [600, 700, 800, 900]}
  rest:
    scene: scenes/riser.yaml
    caption: at rest
    set: {analysis: {}, platform: null, top.x: held}
    settings: tuned
    axes:
      tension: {path: top.tension, unit: kN, values: {start: 1500, stop: 2500, step: 50}}
"""
GOOD = Setting(64, (), 0.05, "generalised-alpha")  # estimates 0.6 % at most, whichever points do
COARSE = Setting(4, (), 1.0, "generalised-alpha")  # estimates 40 % at least


def settings_of(setting):
    """Settings as a job leaves them."""
    return Settings(setting, "" if setting else "requests are cheaper", "2 %", 3, 4, 2, 0.9, 0.3)


@pytest.fixture
def study_of(tmp_path, monkeypatch):
    """A study by its name, in a store of its own."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "cache"))
    return short_study.studies_in(tmp_path, "settings", STUDIES)


@pytest.mark.parametrize("setting", [GOOD, COARSE, Setting(20, (("top", 7.0),), 0.1, "TR-BDF2"), None])
def test_settings_are_read_as_they_were_written(tmp_path, setting):
    write_settings(settings_of(setting), tmp_path / "one.json")
    assert read_settings(tmp_path / "one.json") == settings_of(setting)


@pytest.mark.parametrize("damage", ["", "{}", '{"setting": {"elements": 3}}', "[1, 2"])
def test_settings_that_are_not_whole_are_refused(tmp_path, damage):
    (tmp_path / "one.json").write_text(damage)
    with pytest.raises(InputError, match="tuned settings in this file are incomplete"):
        read_settings(tmp_path / "one.json")


@pytest.mark.long
@pytest.mark.parametrize("setting", [GOOD, COARSE, None], ids=["good", "too coarse", "none"])
def test_every_point_says_how_it_was_run_and_runs_so_again(study_of, tmp_path, setting):
    study = study_of("surge")
    write_study(study, tmp_path / "study.nc", 1, lambda _: None, settings=settings_of(setting))
    with xr.open_dataset(tmp_path / "study.nc", engine="netcdf4") as dataset:
        dataset.load()
    by_request = dataset["by_request"].values.astype(bool)
    estimated = dataset["error_estimated"].values.astype(bool)
    assert estimated.any()
    assert not (by_request & ~estimated).any()  # a request always has an estimate
    errors = [dataset[f"error_{name}"].values for name in ("displacement", "moment", "tension")]
    assert (np.isfinite(errors[0]) == estimated).all()
    assert all((error[estimated] <= 0.02).all() for error in errors)
    if setting == GOOD:
        assert not by_request.any()
    else:  # where all that are known do not serve, none is believed
        assert by_request.all()
        assert estimated.all()
    for place in zip(*np.nonzero(by_request), strict=True):
        analysis = at(dataset, place).tree["analysis"]
        assert analysis["accuracy"] == "2 %"
        assert not {"mesh", "step", "method"} & {k for k, v in analysis.items() if v is not None}
    for place in [*zip(*np.nonzero(~by_request), strict=True)][:3]:
        analysis = at(dataset, place).tree["analysis"]
        assert (analysis["mesh"], analysis["step"]) == ({"elements": setting.elements}, f"{setting.step:g} s")
    assert json.loads(dataset.attrs["settings"])["accuracy"] == "2 %"
    some = [[*zip(*np.nonzero(which), strict=True)][:1] for which in (by_request, ~by_request)]
    for place in (place for places in some for place in places):
        values = {axis: str(dataset[axis].values[k]) for axis, k in zip(study.axes, place, strict=True)}
        assert max(rerun(dataset, values).changes.values()) < 1e-9  # ten digits are stored


@pytest.mark.parametrize("setting", [GOOD, COARSE, None], ids=["good", "too coarse", "none"])
def test_no_point_of_a_tuned_study_is_superfluous(study_of, tmp_path, setting):
    """Without a database, too, after a run that was interrupted: what a tuned study stored stays."""
    study = study_of("few")
    tiers = {tier: {} for tier in ("preview", "standard", "reference")}
    config = {"papers": ["settings"], "tier": "standard", "tiers": tiers}
    (tmp_path / "config.yaml").write_text(json.dumps(config))
    results = tmp_path / "results"
    write_settings(settings_of(setting), results / "settings/few.settings.json")
    found = read_settings(results / "settings/few.settings.json")
    write_study(study, tmp_path / "study.nc", 1, lambda _: None, settings=found)
    stored = [held.key for held in store.everything()]
    assert len(stored) >= len(study.grid)
    superfluous = unneeded(results / "results.sqlite", tmp_path)
    assert (superfluous.strange, superfluous.old, superfluous.needed) == ([], [], len(stored))


def at(dataset, place):
    """The scene behind a point."""
    return scene_file_of(dataset, dict(zip(dataset["by_request"].dims, map(int, place), strict=True)))


@pytest.mark.long
def test_the_database_knows_the_parameters_of_points_by_request(study_of, tmp_path):
    study = study_of("surge")
    write_study(study, tmp_path / "study.nc", 1, lambda _: None, settings=settings_of(COARSE))
    contents = read_dataset(tmp_path / "study.nc")
    grid = contents.grids[0][0]
    flags = next(v.values for v in grid.variables if v.name == "by_request").reshape(grid.shape)
    _, varied = parameters_of(contents.attributes, grid)
    by_path = {next(iter(one.values)).path: one for one in varied}
    assert ((by_path["analysis.mesh.elements"].at < 0) == (flags == 1)).all()
    assert ((by_path["analysis.accuracy"].at >= 0) == (flags == 1)).all()


def test_points_that_cannot_be_completed_as_tuned_are_run_by_request(study_of, monkeypatch):
    """Every second one is made to fail; the others are run as tuned."""
    study = study_of("surge")
    hopeless = with_setting(study, GOOD)

    def failing(of, points, processes, notify):
        assert attempt(of, points[1::2], processes, notify) == {}
        return {point.key: SimulationError("a step fails") for point in points[::2]}

    monkeypatch.setattr(settings, "attempt", failing)
    monkeypatch.setattr(settings, "has_error_estimate", lambda *_: True)
    pairs = [*zip(study.plan, hopeless.plan, strict=True)][:6]
    points = fill_tuned(study, hopeless, pairs, 1)
    assert points.by_request == [True, False] * 3
    assert [store.has(requested.key) for requested in points.requested] == points.by_request
    assert [store.has(one.key) for one in points.tuned] == [not by for by in points.by_request]


@pytest.mark.parametrize(
    "estimate, serves", [({}, False), ({"moment": 0.01}, True), ({"moment": 0.03}, False)]
)
def test_a_point_whose_error_is_not_known_to_be_small_is_run_by_request(
    study_of, monkeypatch, estimate, serves
):
    """Its estimate is empty if a run for it failed."""
    study = study_of("surge")
    tuned = with_setting(study, GOOD)
    again = []
    monkeypatch.setattr(settings, "attempt", lambda *_: {})
    monkeypatch.setattr(settings, "fill", lambda _, points, __: again.extend(points))
    monkeypatch.setattr(settings, "has_error_estimate", lambda *_: True)
    monkeypatch.setattr(settings.store, "about", lambda key: {"facts": {"error_estimate": estimate}})
    points = fill_tuned(study, tuned, zip(study.plan, tuned.plan, strict=True), 1)
    assert points.by_request == [not serves] * len(study.plan)
    assert len(again) == sum(points.by_request)


@pytest.mark.long
def test_points_that_estimate_nothing_are_served_as_their_nearest_is(study_of, monkeypatch):
    """One point that does not serve takes those with it that are nearer to it than to the other."""
    study = study_of("surge")
    tuned = with_setting(study, GOOD)
    bad, good = (0, 0, 0), (3, 3, 0)
    known = {bad: False, good: True, (0, 0, 1): True}
    monkeypatch.setattr(settings, "_serves", lambda _, __, point: known.get(point.index))
    points = fill_tuned(study, tuned, zip(study.plan, tuned.plan, strict=True), 1)
    for point, by in zip(points.tuned, points.by_request, strict=True):
        i, k, label = point.index
        if label == 1 or i + k > 3:
            assert not by
        elif i + k < 3:
            assert by


@pytest.mark.parametrize(
    "name, said", [("own_mesh", "analysis.mesh"), ("rest", "only dynamic runs can be tuned")]
)
def test_what_cannot_be_tuned_is_refused_before_any_job(study_of, name, said):
    with pytest.raises(InputError, match=said):
        refuse_settings(study_of(name))


@pytest.mark.long
def test_a_small_study_is_tuned_at_one_point_to_the_same_every_time(study_of):
    first, again = (tuned_for(study_of("quick"), lambda _: None) for _ in range(2))
    assert first == again
    assert (first.points, first.held_out) == (1, 2)
    assert first.setting is not None
    assert first.error <= 1.0
    assert first.work < 1.0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["surge", "quick"])
def test_true_errors_of_held_out_points_stay_below_the_request(study_of, name):
    """A seeded twentieth of the points, four at least, against segments and steps a quarter as long."""
    study = study_of(name)
    found = tuned_for(study, lambda _: None)
    assert found.setting is not None
    tuned = with_setting(study, found.setting)
    for index in others(study, [], max(4, len(study.grid) // 20), 11):
        everywhere = {"analysis.output.stations": None}
        scene, requested = (
            of.grid.file(index).with_values(everywhere, "test").resolved() for of in (tuned, study)
        )
        refinement = Refinement(requested)
        refinement.result()
        mesh = refinement.finest_mesh.halved().halved()
        step = min(scene.analysis.step, refinement.step) / 4.0
        coarse = single(scene, prescribed(scene, found.setting.elements), scene.analysis.step)
        fine = single(requested, mesh, step)
        assert max(controlled(difference(coarse, fine)).values()) <= 0.02
