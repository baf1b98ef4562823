"""Options of axes have an effect, or are refused: values of a preview, and assumptions that samples leave."""

import json
import random

import numpy as np
import pytest
from pydantic import ValidationError
from random_rigs import moving, rig, written

from riserstudy.dataset.result import Result
from riserstudy.errors import InputError
from riserstudy.scene.paths import leaves, value_at
from riserstudy.study.axes import TIERS, Numbers
from riserstudy.study.collect import dataset_of
from riserstudy.study.seas_model import SeasModel
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

COUNT = dict.fromkeys(TIERS, 4)


@pytest.mark.parametrize("seed", range(40))
def test_values_of_a_preview_are_some_of_the_values_each_once_or_refused(seed):
    draw = random.Random(seed)
    values = draw.sample(range(-20, 20), draw.randint(1, 6))
    preview = draw.choices(values, k=draw.randint(0, len(values)))
    given = {"path": "top.tension", "unit": "kN", "values": values, "preview": preview}
    if not preview or any(preview.count(one) > 1 for one in preview):
        with pytest.raises(ValidationError, match="preview"):
            Numbers(**given)
        return
    axis = Numbers(**given)
    assert axis.numbers("preview") == preview
    assert axis.numbers("standard") == values


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_samples_leave_the_named_assumptions_and_refuse_a_name_that_is_none(seed, spatial, tmp_path):
    tree, draw = written(moving(seed, spatial=spatial)), random.Random(seed)
    masses = [f"riser[{k}].mass" for k in range(len(tree["riser"]))]
    masses = [path for path in masses if value_at(tree, path)] + ["water.density"]
    assumed = {
        path: {"assumed": value, "options": [value, "1 t/m" if "mass" in path else "1 t/m^3"], "because": "t"}
        for path in masses
        if (value := value_at(tree, path))
    }
    (tmp_path / "rig.yaml").write_text(json.dumps(tree))
    others = [path for path, _ in leaves(tree) if path not in assumed]

    def samples(leave):
        axes = {"sample": {"count": COUNT, "seed": seed, "leave": leave}}
        model = {"scene": "rig.yaml", "caption": "c", "set": assumed, "axes": axes}
        study = Study("own", "any", StudyModel.model_validate(model), tmp_path, "standard")
        return [sets for _, sets in study.axes["sample"]]

    left = draw.choice(sorted(assumed))
    if len(assumed) > 1:
        assert {path for sets in samples([left]) for path in sets} == {*assumed} - {left}
    assert {path for sets in samples([]) for path in sets} == {*assumed}
    for wrong in (draw.choice(others), left[:-1], left.rpartition(".")[0]):
        with pytest.raises(InputError, match=r"axes\.sample\.leave: .* is not an assumption of the scene"):
            samples([left, wrong])


@pytest.mark.parametrize("seed", range(20))
def test_windows_and_return_periods_of_a_record_are_different_or_refused(seed):
    draw = random.Random(seed)
    hours = draw.choices([6, 12, 24, 48], k=draw.randint(1, 4))
    windows = [draw.choice([f"{h} h", f"{60 * h} min", f"{h / 24} d"]) for h in hours]
    years = draw.choices([2, 10, 50, 100], k=draw.randint(1, 4))
    about = {"scene": "rig.yaml", "caption": "c", "record": "sea.csv"}
    repeated = [name for name, of in (("windows", hours), ("return_periods", years)) if len({*of}) < len(of)]
    given = about | {"windows": windows, "return_periods": years}
    if not repeated:
        assert len(SeasModel(**given).windows) == len({*hours})
        return
    with pytest.raises(ValidationError, match=f"{repeated[0]}: .* occurs twice"):
        SeasModel(**given)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_what_a_dataset_says_that_a_sample_assumes_is_an_input_of_its_points(seed, spatial, tmp_path):
    """Other axes may replace an assumption at all points, at some, or none."""
    tree, draw = written(rig(seed, spatial=spatial)), random.Random(seed)
    (tmp_path / "rig.yaml").write_text(json.dumps(tree))
    paths = ["water.density", "riser[0].mass", "gravity"]
    values = {path: value_at(tree, path) for path in paths}
    values = {path: value for path, value in values.items() if value}
    assumed = {
        path: {"assumed": value, "options": [value, _more(value, 1.01)], "because": "t"}
        for path, value in values.items()
    }
    path, other = draw.sample(sorted(values), 2) if len(values) > 1 else [*values] * 2
    axes = {
        "sample": {"count": COUNT, "seed": seed},
        "all": {f"{k}": {path: _more(values[path], k)} for k in (1.02, 1.03)},
        "some": {"own": {}, "another": {other: _more(values[other], 1.04)}},
    }
    axes = {name: axes[name] for name in draw.sample(sorted(axes), 3)}
    model = {"scene": "rig.yaml", "caption": "c", "set": assumed, "axes": axes, "keep": []}
    study = Study("own", "any", StudyModel.model_validate(model), tmp_path, "standard")
    results = [Result({"s_node": np.array([0.0, 1.0])}, {"effects": {}, "warnings": []})] * len(study.plan)
    dataset = dataset_of(study, results)
    told = {of.attrs["long_name"]: of for name, of in dataset.items() if str(name).startswith("assumed_")}
    assert {*assumed} - {*told} <= {path}
    for point in study.plan:
        index = dict(zip(study.axes, point.index, strict=True))
        scene = study.grid.file(point.index).tree
        for name, of in told.items():
            some = dataset["some"].values[index["some"]]
            if name != other or some == "own":
                assert str(value_at(scene, name)) == of.isel(sample=index["sample"]).item()


@pytest.mark.parametrize("seed", range(4))
def test_an_interpretation_with_the_name_of_an_assumption_is_refused(seed, tmp_path):
    """Both would be one variable of the dataset."""
    tree, draw = written(rig(seed)), random.Random(seed)
    (tmp_path / "rig.yaml").write_text(json.dumps(tree))
    path = draw.choice([path for path in ("water.density", "riser[0].mass") if value_at(tree, path)])
    value = value_at(tree, path)
    assumed = {path: {"assumed": value, "options": [value, _more(value, 1.01)], "because": "t"}}
    name = path.replace("[0]", "_0").replace(".", "_")
    for reading in (name, f"{name}_too"):
        axes = {"sample": {"count": COUNT, "seed": seed, "readings": [reading]}}
        model = {"scene": "rig.yaml", "caption": "c", "set": assumed, "axes": axes}
        readings = {reading: {"one": {"note": "one"}, "two": {"note": "two"}}}
        study = Study("own", "any", StudyModel.model_validate(model), tmp_path, "standard", readings=readings)
        if reading == name:
            with pytest.raises(InputError, match=f"would both be named assumed_{name}"):
                study.plan  # noqa: B018
        else:
            assert len(study.axes["sample"]) == 4


def _more(value, factor):
    """A quantity in its unit, times a factor."""
    number, unit = str(value).split(" ", 1)
    return f"{float(number) * factor!r} {unit}"
