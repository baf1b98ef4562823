"""A dataset of what the store holds for it is the dataset of whole runs."""

from pathlib import Path

import pytest
import xarray as xr

from riserstudy.simulation.refine import run
from riserstudy.study import collect, store
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.needed import with_envelopes
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

CONFIG = Path(__file__).parents[2] / "config"
SHORT = {"analysis.duration": "2 s", "analysis.output": {"interval": "0.5 s"}}
KEPT = [
    ["x"],
    ["z"],
    ["x", "bending_moment"],
    ["bending_moment", "z_static"],
    ["effective_tension"],
    ["bending_moment_max", "bending_moment_static", "x_absmax"],
    ["ufj_angle", "y"],
    [],
]
MESHES = {"coarse": {}, "fine": {"analysis.mesh": {"elements": 16}}}


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Make a study of a scene on two meshes that keeps some quantities."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / ".cache"))
    monkeypatch.chdir(tmp_path)

    def make(keep, sets=None):
        fields = {"scene": "scenes/bench/s2.yaml", "caption": "kept", "keep": keep}
        fields["set"] = SHORT | {"analysis.mesh": {"elements": 8}, "analysis.step": "0.1 s"}
        fields["set"] |= sets or {}
        model = StudyModel(**fields, axes={"mesh": MESHES})
        return Study("bench", "kept", model, CONFIG, "standard")

    return make


def whole(study):
    """Its dataset of runs that went through no store."""
    files = [study.grid.file(point.index) for point in study.plan]
    return dataset_of(study, [run(file.resolved()) for file in files])


def same(one, other):
    """Refuse datasets that differ in more than time spent."""
    timed = ("wall_seconds", "solve_seconds")
    xr.testing.assert_identical(one.drop_vars(timed), other.drop_vars(timed))


@pytest.mark.parametrize("keep", KEPT, ids=str)
@pytest.mark.parametrize(
    "sets", [{}, {"analysis.output.stations": ["100 m", "300 m"]}], ids=["at nodes", "at stations"]
)
def test_a_dataset_of_stored_points_is_that_of_whole_runs(study, keep, sets):
    mine = study(keep, sets=sets)
    results, made = results_of(mine, 1, lambda _: None)
    assert made == 2
    same(dataset_of(mine, results), whole(mine))
    every = {name for held in store.everything() for name in store.about(held.key)["left_out"]}
    assert {"effective_tension_max", "z_max"}.difference(with_envelopes(keep)) <= every


def test_so_is_one_of_runs_at_rest(study):
    rest = {"analysis.duration": None, "analysis.output": None, "analysis.step": None}
    mine = study(["x", "bending_moment"], sets=rest | {"platform": None, "top.x": "held"})
    same(dataset_of(mine, results_of(mine, 1, lambda _: None)[0]), whole(mine))


def test_studies_that_keep_different_things_share_their_points(study):
    first, second = study(["x"]), study(["effective_tension"])
    counts = [results_of(one, 1, lambda _: None)[1] for one in (first, second, first, second)]
    assert counts == [2, 2, 0, 0]
    same(dataset_of(first, results_of(first, 1, lambda _: None)[0]), whole(first))
    assert results_of(study(None), 1, lambda _: None)[1] == 2
    assert results_of(study(["z"]), 1, lambda _: None)[1] == 0


def test_a_point_that_another_study_overwrote_meanwhile_is_simulated_again(study, monkeypatch):
    mine, put, lost = study(["x"]), store.put, []

    def put_without(key, result, file, keep):
        """The first time the other study, which began together with this one, has the last word."""
        put(key, result, file, ["effective_tension"] if key not in lost else keep)
        lost.append(key)

    monkeypatch.setattr(store, "put", put_without)
    results, _ = results_of(mine, 1, lambda _: None)
    same(dataset_of(mine, results), whole(mine))
    assert len(lost) == 4


def test_points_that_vanish_each_time_are_an_error(study, monkeypatch):
    monkeypatch.setattr(store, "put", lambda *_: None)
    with pytest.raises(collect.SimulationError, match="were deleted from the cache"):
        results_of(study(["x"]), 1, lambda _: None)
