"""Every point of a study, run anew from its dataset as it is written, is what the dataset holds."""

import json
import random

import numpy as np
import pytest
import xarray as xr
from random_rigs import moving, written
from ruamel.yaml import YAML
from short_study import CURRENT, SCENE

from riserstudy.dataset.place import complete
from riserstudy.dataset.statistics_tables import of_a_run
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.errors import InputError
from riserstudy.study import store
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.models import StudyFile
from riserstudy.study.repeat_point import rerun
from riserstudy.study.study import Study

AT_REST = {"platform": None, "top.x": "held", "analysis": {"mesh": {"elements": 12}}}
LIMITS = [
    {"output": "lfj_angle", "largest": "2 deg", "mode": "drilling"},
    {"output": "effective_tension", "smallest": "0 N", "mode": "connected"},
    {"output": "tensioner_stroke", "largest": "7 m", "mode": "connected"},  # not evaluated
    {"output": "bending_moment", "largest": {"assumed": "1 MN*m", "because": "t"}, "mode": "drilling"},
]
TENSION = {"path": "top.tension", "unit": "kN", "values": [1500, 1600.5, 1700]}
#: what a study may have, each of which adds variables, axes or another way to store them
PARTS = {
    "axes": [
        {"tension": TENSION},
        {"allow": {"tight": {"limits[0].largest": "0.1 deg"}, "loose": {"limits[0].largest": "9 deg"}}},
        {"allowed": {"path": "limits[1].smallest", "unit": "kN", "factor": 2, "values": [1, 0.05]}},
        {"length": {"path": "riser[0].length", "unit": "m", "values": [290, 300]}},
        {"mesh": {"path": "analysis.mesh.elements", "unit": "1", "values": [8, 12]}},
        {"sample": {"count": dict.fromkeys(("preview", "standard", "reference"), 2), "seed": 1}},
    ],
    "keep": [None, ["x", "bending_moment"], ["effective_tension_max", "ufj_angle"]],
}


def drawn(seed):
    """A study with limits and several of these parts."""
    draw = random.Random(seed)
    axes = {k: v for part in draw.sample(PARTS["axes"], 2) for k, v in part.items()}
    top = {"riser[0].mass": {"assumed": "700 kg/m", "range": ["600 kg/m", "800 kg/m"], "because": "t"}}
    moving = {"analysis.duration": "3 s", "analysis.mesh.elements": 12}
    return {
        "scene": "riser.yaml",
        "caption": "drawn",
        "set": top | (moving if seed % 3 == 0 else AT_REST),
        "limits": LIMITS,
        "axes": axes,
        "keep": draw.choice(PARTS["keep"]),
    }


@pytest.mark.parametrize("seed", range(12))
def test_an_exact_point_has_changed_in_nothing(seed, own_store, tmp_path):
    (tmp_path / "riser.yaml").write_text(SCENE)
    (tmp_path / "current.csv").write_text(CURRENT)
    file = StudyFile.model_validate({"paper": "own", "studies": {"one": drawn(seed)}})
    study = Study("own", "one", file.studies["one"], tmp_path, "standard")
    write_dataset(dataset_of(study, results_of(study, 1, lambda _: None)[0]), tmp_path / "one.nc")
    dataset = xr.load_dataset(tmp_path / "one.nc", decode_times=False)
    names = {"use_of_limit", "demand_of_limit", "verdict_of_limit", "smallest_tension"}
    points = [*np.ndindex(dataset["point_key"].shape)]
    for index in random.Random(seed).sample(points, min(3, len(points))):
        axes = dataset["point_key"].dims
        at = {str(a): str(dataset[a].values[k]) for a, k in zip(axes, index, strict=True)}
        found = rerun(dataset, at)
        assert found.changes.keys() >= names
        assert {n: c for n, c in found.changes.items() if not c <= 1e-9} == {}, at


def several(seed, tmp_path, monkeypatch):
    """Dataset of a rig at points that differ in duration, motion, cylinders, and plane or space."""
    monkeypatch.setattr(store, "_file", lambda key: tmp_path / f"{key}.point")
    spatial = seed % 2 == 1
    tree = moving(seed, spatial=spatial, conductor=seed % 3 == 2)
    interval = tree["analysis"]["output"]["interval"]
    tree["analysis"] |= {"duration": 8 * interval, "mesh": {"elements": 10}}
    YAML().dump(written(tree), tmp_path / "riser.yaml")
    words = {
        "short": {},
        "long": {"analysis.duration": f"{13 * interval!r} s"},
        "rest": {"analysis": {"mesh": {"elements": 10}}},
        "across": {"current.heading": "80 deg"},
    }
    if tensioners := tree["top"].get("tensioners"):
        words["one more"] = {"top.tensioners.count": tensioners["count"] + 1}
    keep = [None, ["ufj_angle", "x", "y", "z", "tensioner_force", "bending_moment_max"]][seed // 2 % 2]
    model = {"scene": "riser.yaml", "caption": "c", "axes": {"what": words}, "keep": keep}
    file = StudyFile.model_validate({"paper": "own", "studies": {"one": model}})
    study = Study("own", "one", file.studies["one"], tmp_path, "standard")
    write_dataset(dataset_of(study, results_of(study, 1, lambda _: None)[0]), tmp_path / "one.nc")
    return xr.load_dataset(tmp_path / "one.nc", decode_times=False)


@pytest.mark.parametrize("seed", range(4))
def test_points_of_several_kinds_have_changed_in_nothing(seed, tmp_path, monkeypatch):
    dataset = several(seed, tmp_path, monkeypatch)
    for what in dataset["what"].values:
        found = rerun(dataset, {"what": str(what)})
        changed = {n: c for n, c in found.changes.items() if not c <= 1e-9}
        assert changed.keys() <= {"error_tension", "unexplained_energy"}, what
    lost = dataset.copy(deep=True)
    lost["ufj_angle"].loc[{"what": "long"}] = np.nan
    assert rerun(lost, {"what": "long"}).changes["ufj_angle"] == np.inf


@pytest.mark.parametrize("seed", range(4))
def test_statistics_of_a_point_are_those_of_its_run(seed, tmp_path, monkeypatch):
    dataset = several(seed, tmp_path, monkeypatch)
    for k, what in enumerate(dataset["what"].values):
        if what == "rest":
            with pytest.raises(InputError, match="the run is static"):
                of_a_run(complete(dataset.isel(what=k)), 0.0, None)
            continue
        run = rerun(dataset, {"what": str(what)}).run
        rows = of_a_run(complete(dataset.isel(what=k)), 0.0, None).rows
        assert {str(row[0]).split()[0] for row in rows} >= {"ufj_angle", "x"}
        for name, s, _, mean, deviation, *_ in rows:
            history = run[str(name).split()[0]]
            if " " in str(name):
                history = history.isel(cylinder=int(str(name).split()[1]))
            if s is not None:
                history = history.isel(s=int(abs(run["s"].values - s).argmin()))
            assert mean == pytest.approx(float(history.mean()), rel=1e-6, abs=1e-6)
            assert deviation == pytest.approx(float(history.std()), rel=1e-5, abs=1e-4)


def test_another_limit_is_seen(own_store, tmp_path):
    (tmp_path / "riser.yaml").write_text(SCENE)
    (tmp_path / "current.csv").write_text(CURRENT)
    model = {"scene": "riser.yaml", "caption": "c", "set": AT_REST, "limits": LIMITS, "axes": {}}
    file = StudyFile.model_validate({"paper": "own", "studies": {"one": model}})
    study = Study("own", "one", file.studies["one"], tmp_path, "standard")
    dataset = dataset_of(study, results_of(study, 1, lambda _: None)[0])
    scene = json.loads(dataset.attrs["scene"])
    scene["limits"][0]["largest"] = "0.001 deg"
    found = rerun(dataset.assign_attrs(scene=json.dumps(scene)), {})
    changed = {name for name, change in found.changes.items() if change > 1e-9}
    assert changed == {"use_of_limit", "verdict_of_limit"}
