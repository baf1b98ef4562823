"""Options of axes have an effect, or are refused: values of a preview, and assumptions that samples leave."""

import json
import random

import pytest
from pydantic import ValidationError
from random_rigs import moving, written

from riserstudy.errors import InputError
from riserstudy.scene.paths import leaves, value_at
from riserstudy.study.axes import TIERS, Numbers
from riserstudy.study.models import StudyModel
from riserstudy.study.seas_model import SeasModel
from riserstudy.study.study import Study

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
        with pytest.raises(InputError, match=r"axes\.sample\.leave: no assumption"):
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
    with pytest.raises(ValidationError, match=f"{repeated[0]}: repeats"):
        SeasModel(**given)
