"""Schemas of study files for editors: what chapters measure is known by its fields."""

import copy
import json
import sys
from pathlib import Path

import jsonschema
import pytest
from ruamel.yaml import YAML

from riserstudy.study.measured import models_of
from riserstudy.study.schemas import study_schema

ROOT = Path(__file__).parents[2]
OWN = """\
from typing import Annotated

from pydantic import Field

from riserstudy.inputs.strict import Strict
from riserstudy.study.measured import MeasuredModel


class Case(Strict):
    scene: str


class Own(MeasuredModel):
    repeats: Annotated[int, Field(ge=1)]
    cases: dict[str, Case]


MODELS = {"own": Own}
"""


def complaints(schema, tree):
    return [error.message for error in jsonschema.Draft202012Validator(schema).iter_errors(tree)]


@pytest.fixture(scope="module")
def numerics():
    """The schema in the repository's folder, and the study file of the engine itself."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ROOT)
        tree = YAML(typ="safe", pure=True).load(ROOT / "config/studies/numerics.yaml")
        return study_schema(["numerics"]), tree, models_of("numerics")


def test_a_dataset_that_a_chapter_measures_has_the_fields_of_its_model(numerics):
    schema, tree, models = numerics
    assert complaints(schema, tree) == []
    (rule,) = schema["allOf"]
    fields = rule["then"]["properties"]["measured"]["properties"]
    assert fields.keys() == models.keys() == tree["measured"].keys()
    for name, model in models.items():
        made = schema["$defs"][fields[name]["$ref"].removeprefix("#/$defs/")]
        assert made["properties"].keys() == model.model_fields.keys()


def test_a_slip_below_measured_is_marked_in_every_dataset(numerics):
    schema, tree, _ = numerics
    for name, of in tree["measured"].items():
        for field in of:
            wrong = copy.deepcopy(tree)
            wrong["measured"][name][f"{field}s"] = wrong["measured"][name].pop(field)
            assert any(f"'{field}s' was unexpected" in one for one in complaints(schema, wrong))
    unknown = copy.deepcopy(tree)
    unknown["measured"]["stabilities"] = unknown["measured"].pop("stability")
    assert any("'stabilities' was unexpected" in one for one in complaints(schema, unknown))


@pytest.fixture
def own_chapter(tmp_path, monkeypatch):
    """Where one works, with a chapter that measures."""
    folder = tmp_path / "chapters/own_schema"
    folder.mkdir(parents=True)
    (folder / "models.py").write_text(OWN)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    yield "own_schema"
    for module in ("chapters.own_schema", "chapters.own_schema.models"):
        sys.modules.pop(module, None)


def test_a_chapter_of_ones_own_is_in_the_schema_that_is_printed_where_it_lies(
    commands, own_chapter, monkeypatch
):
    code, printed, _ = commands("schema", "study")
    assert code == 0
    schema = json.loads(printed)
    own = {"caption": "own", "repeats": 2, "cases": {"one": {"scene": "scenes/one.yaml"}}}
    tree = {"paper": own_chapter, "studies": {}, "measured": {"own": own}}
    assert complaints(schema, tree) == []
    assert complaints(schema, tree | {"measured": {"own": own | {"repeats": 0}}})
    assert complaints(schema, tree | {"measured": {"own": own | {"cases": {"one": {}}}}})
    assert complaints(schema, tree | {"measured": {"other": own}})
    # another paper's datasets are not of this chapter
    assert complaints(schema, tree | {"paper": "another", "measured": {"other": own}}) == []
    monkeypatch.chdir("chapters")  # where no chapter lies
    assert "allOf" not in json.loads(commands("schema", "study")[1])
