"""A number that a value was fitted to is never reproduced, wherever the fitted value stands."""

import json

import pytest
import xarray as xr

from riserstudy.chapters import derive as chapter
from riserstudy.database.parameters import parameters_of
from riserstudy.database.read_dataset import read_dataset
from riserstudy.dataset.origins import origins_of
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.grading.grade import Found, graded
from riserstudy.grading.models import Item
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import StudyFile
from riserstudy.study.study import Study

WEIGHT, PLACE = 600.0, "riser[0].submerged_weight"  # N/m of 500 m
FITTED = {PLACE: {"calibrated": f"{WEIGHT} N/m", "to": "own/N1", "range": ["0 N/m", "1 kN/m"]}}
PLAIN = {PLACE: f"{WEIGHT} N/m"}
OPEN = {"assumed": "1 MN", "range": ["1 MN", "1.0001 MN"], "because": "not printed"}
SAMPLES = {"count": {"preview": 2, "standard": 2, "reference": 2}, "seed": 1, "readings": ["line"]}


def scene(weight):
    return {
        "title": "hung",
        "riser": [{"name": "a", "length": "500 m", "axial_stiffness": "5e9 N", "submerged_weight": weight}],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"z": "free", "tension": OPEN},
        "analysis": {},
    }


#: where a fitted value stands: the weight in the scene, and the study's set, axes and readings
PLACES = {
    "scene": (FITTED[PLACE], {}, {}, {}),
    "set": ("1 kN/m", FITTED, {}, {}),
    "a part of what is set": ("1 kN/m", {"riser[0]": scene(FITTED[PLACE])["riser"][0]}, {}, {}),
    "label": ("1 kN/m", {}, {"line": {"fitted": FITTED}}, {}),
    "one of two labels": ("1 kN/m", {}, {"line": {"fitted": FITTED, "as it is": PLAIN}}, {}),
    "reading": ("1 kN/m", {}, {"line": "readings"}, {"line": {"fitted": FITTED}}),
    "sample": ("1 kN/m", {}, {"sample": SAMPLES}, {"line": {"fitted": FITTED}}),
    "scene, and one label without it": (FITTED[PLACE], {}, {"line": {"a": {}, "b": PLAIN}}, {}),
}
#: where it is only said of a value that no point has
ELSEWHERE = {
    "nowhere": ("600 N/m", {}, {}, {}),
    "set over": (FITTED[PLACE], PLAIN, {}, {}),
    "every label over it": (FITTED[PLACE], {}, {"line": {"a": PLAIN, "b": PLAIN}}, {}),
    "numbers over it": (FITTED[PLACE], {}, {"weight": {"path": PLACE, "unit": "N/m", "values": [600]}}, {}),
    "a later axis over a label": (
        "1 kN/m",
        {},
        {"line": {"fitted": FITTED}, "weight": {"path": PLACE, "unit": "N/m", "values": [600]}},
        {},
    ),
}


@pytest.fixture
def simulated(own_store, tmp_path):
    def make(weight, on_top, axes, readings):
        (tmp_path / "hung.yaml").write_text(json.dumps(scene(weight)))
        model = {"scene": "hung.yaml", "caption": "c", "set": on_top, "axes": axes}
        file = StudyFile.model_validate({"paper": "own", "readings": readings, "studies": {"pull": model}})
        study = Study("own", "pull", file.studies["pull"], tmp_path, "standard", None, readings)
        write_dataset(dataset_of(study, results_of(study, 1, lambda _: None)[0]), tmp_path / "p.nc")
        return xr.load_dataset(tmp_path / "p.nc")

    return make


def foot(runs):
    """Tension at the foot, 1 MN less the weight (kN)."""
    tension = runs["smallest_tension"] / 1e3
    return Found(tension.isel({dim: 0 for dim in tension.dims if dim != "sample"}))


def verdict(datasets, over=None):
    about = {"id": "N1", "figure": "1", "kind": "number", "statement": "s", "check": "foot"}
    item = Item(**about, published=700.0, rounding=1.0, reads={"runs": "pull"}, over=over or {})
    return graded("own", item, lambda _: foot, datasets).verdict


def graded_in_every_way(runs, monkeypatch):
    """Verdicts of a number from a dataset itself, and from one that is derived from it."""
    monkeypatch.setattr(chapter, "function_of", lambda *_: lambda pull: pull.drop_attrs())
    derived = chapter.derive("own", "further", {"pull": runs})
    again = chapter.derive("own", "further", {"pull": derived})
    base = runs.isel(sample=0) if "sample" in runs.dims else runs
    return {
        verdict({"pull": base}),
        *(verdict({"pull": x.isel(sample=0, missing_dims="ignore")}) for x in (derived, again)),
    }


@pytest.mark.parametrize("place", PLACES)
def test_the_number_a_value_was_fitted_to_is_calibrated(place, simulated, monkeypatch):
    runs = simulated(*PLACES[place])
    assert graded_in_every_way(runs, monkeypatch) == {"calibrated"}
    assert origins_of(runs)[PLACE] == "calibrated"


@pytest.mark.parametrize("place", ELSEWHERE)
def test_a_number_without_a_fitted_value_is_reproduced(place, simulated, monkeypatch):
    runs = simulated(*ELSEWHERE[place])
    assert graded_in_every_way(runs, monkeypatch) == {"reproduced"}


@pytest.mark.parametrize("place", {**PLACES, **ELSEWHERE})
def test_the_database_tells_of_each_point_whether_its_value_is_fitted(place, simulated, tmp_path):
    weight, on_top, axes, readings = {**PLACES, **ELSEWHERE}[place]
    simulated(weight, on_top, axes, readings)
    contents = read_dataset(tmp_path / "p.nc")
    same, varied = parameters_of(contents.attributes, contents.grids[0][0])
    told = {row.origin for row in same if row.path == PLACE}
    for of in varied:
        told |= {row.origin for row, k in of.values.items() if row.path == PLACE and k in of.at}
    assert ("calibrated" in told) == (place in PLACES)
    evidence = [row.because for row in same if row.origin == "calibrated"]
    evidence += [row.because for of in varied for row in of.values if row.origin == "calibrated"]
    assert set(evidence) <= {"own/N1"}


def test_a_calibrated_setting_of_a_derived_dataset_is_told(simulated, monkeypatch):
    runs = simulated(*ELSEWHERE["nowhere"])
    monkeypatch.setattr(
        chapter, "function_of", lambda *_: lambda pull, share: pull[["smallest_tension"]] * share
    )
    fitted = {"share": {"calibrated": 1.0, "to": "own/N1"}}
    assert verdict({"pull": chapter.derive("own", "further", {"pull": runs}, fitted)}) == "calibrated"
