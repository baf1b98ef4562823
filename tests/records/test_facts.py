"""A fact of runs is told once: what holds points has it by its field alone."""

import sqlite3
from pathlib import Path
from typing import Annotated

import numpy as np
import pytest

from riserstudy.database.build import schema
from riserstudy.dataset.result import Result
from riserstudy.dataset.variables import attributes, of_points
from riserstudy.errors import InputError
from riserstudy.inputs.validate import check
from riserstudy.records import facts
from riserstudy.records.facts import Column, RunFacts, point_columns
from riserstudy.study.axes import Numbers
from riserstudy.study.collect import dataset_of
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

CONFIG = Path(__file__).parents[2] / "config"
AXES = {"amplitude": Numbers(path="platform.surge.amplitude", unit="m", values=[1.0, 2.0])}


@pytest.fixture
def throw_away(monkeypatch):
    """A fact that no run has yet."""
    about = Column("deepest place of a run", "m")
    monkeypatch.setitem(RunFacts.__annotations__, "deepest_place", Annotated[float, about])
    point_columns.cache_clear()
    yield "deepest_place"
    monkeypatch.undo()
    point_columns.cache_clear()


def dataset(*runs):
    """Two runs with these facts, as a study has them."""
    model = StudyModel(scene="scenes/bench/s2c.yaml", caption="two", axes=AXES)
    study = Study("bench", "two", model, CONFIG, "standard")
    arrays = {"s_node": np.linspace(0.0, 533.0, 5), "zero_z": np.zeros(5)}
    plain = {"warnings": [], "effects": {}}
    return dataset_of(study, [Result(arrays, plain | run) for run in runs])


def test_a_new_fact_is_in_datasets_with_its_unit(throw_away):
    kept = dataset({throw_away: 3.0}, {})[throw_away]
    np.testing.assert_array_equal(kept, [3.0, np.nan])
    assert kept.attrs == {"units": "m", "long_name": "deepest place of a run"}


def test_a_new_fact_is_a_column_of_the_database_and_shown_by_plots(throw_away):
    with sqlite3.connect(":memory:") as db:
        db.executescript(schema())
        columns = {row[1]: row[2].lower() for row in db.execute("pragma table_info(points)")}
    db.close()
    assert columns[throw_away] == "real"
    assert of_points(throw_away)
    assert attributes(throw_away)["units"] == "m"


def test_no_axis_takes_the_name_of_a_new_fact(throw_away):
    plan = {"scene": "scenes/bench/s2c.yaml", "caption": "c", "axes": {throw_away: AXES["amplitude"]}}
    with pytest.raises(InputError, match=throw_away):
        check(StudyModel, plan, "study")


def test_without_its_field_it_is_nowhere():
    assert "deepest_place" not in dataset({"deepest_place": 3.0}, {})
    assert "deepest_place" not in schema()


def test_what_few_runs_have_is_in_no_dataset_without_one():
    assert "error_damage" not in dataset({"error_estimate": {"moment": 0.01}}, {})
    kept = dataset({"error_estimate": {"damage": 0.1}}, {})
    np.testing.assert_array_equal(kept["error_damage"], [0.1, np.nan])
    np.testing.assert_array_equal(kept["error_estimated"], [1, 0])


def test_an_error_without_values_is_not_estimated():
    runs = [{"error_estimate": {}}, {"error_estimate": {"moment": 0.02}}]
    kept = dataset(*runs)
    np.testing.assert_array_equal(kept["error_estimated"], [0, 1])
    np.testing.assert_array_equal(np.isfinite(kept["error_moment"]), [0, 1])


def test_every_fact_that_is_held_has_a_name_of_its_own_and_words():
    names = [column.name for column in facts.point_columns()]
    assert len(names) == len(set(names))
    assert all(column.about.long_name for column in facts.point_columns())
