"""Fitting the calibrated values of a study to printed numbers."""

from dataclasses import replace
from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.grading.published import read_published
from riserstudy.jobs import calibration
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

CONFIG = Path(__file__).parents[2] / "config"
PAPER, IDS = "mao_hangoff", ("N1", "N3")


@pytest.fixture(scope="module")
def nearest():
    """The study that the chapter fits, on few segments and long steps."""
    file = read_studies(CONFIG, PAPER)
    made = Study(PAPER, "nearest", file.studies["nearest"], CONFIG, "standard", None, file.readings)
    coarse = {"analysis.mesh": {"elements": 20}, "analysis.step": "1 s"}
    return replace(made, model=made.model.replaced(set=made.model.set | coarse))


@pytest.fixture(scope="module")
def items():
    file = read_studies(CONFIG, PAPER)
    published = read_published(CONFIG, PAPER, set(file.datasets))
    return [item for item in published.items if item.id in IDS]


def test_the_search_finds_the_least_of_a_worst_miss():
    """Two edges that meet in a valley, whose floor is lowest at one place."""
    found = calibration.search(lambda x: max(abs(x[0] - 0.3), 2.0 * abs(x[1] - 0.8)) + 0.05, [0.9, 0.1])
    assert found.shares == pytest.approx([0.3, 0.8], abs=5e-3)
    assert found.miss == pytest.approx(0.05, abs=5e-3)


def test_the_search_stays_in_the_ranges():
    found = calibration.search(lambda x: abs(x[0] - 2.0) + abs(x[1] + 1.0), [0.5, 0.5])
    assert found.shares == pytest.approx([1.0, 0.0], abs=1e-6)


def test_free_are_the_calibrated_values_that_have_a_range(nearest):
    free = {one.path: one for one in calibration.free_values(nearest)}
    layer = free["current.profile.layer"]
    assert (layer.low, layer.high, layer.unit) == (10.0, 300.0, "m")
    assert set(free) == {
        path for path, value in nearest.model.set.items() if isinstance(value, dict) and "calibrated" in value
    }


def test_what_has_no_unit_is_a_number():
    drag = calibration.Free("riser[0].drag.coefficient", 1.0, 0.6, 1.4, "")
    assert drag.value(0.25) == 0.8
    assert calibration.Free("bottom.body.mass", 130.0, 100.0, 140.0, "t").value(0.5) == "120 t"


def test_scenes_of_a_search_hold_what_is_tried_and_are_calibrated(nearest):
    free = calibration.free_values(nearest)
    tried = calibration.with_values(nearest, free, [0.5] * len(free))
    assert tried.base.tree["current"]["profile"]["layer"] == "155 m"
    assert tried.base.origins["current.profile.layer"].status == "calibrated"


@pytest.mark.long
def test_fitting_improves_on_where_it_began_and_tells_what_it_found(nearest, items, capsys):
    free = calibration.free_values(nearest)
    began = calibration.with_values(nearest, free, [(f.start - f.low) / (f.high - f.low) for f in free])
    before = calibration.worst_miss(calibration.values_of(began, items, {}), items)
    fit = calibration.calibrate(nearest, items, {}, 12)
    assert fit.miss < before
    told = capsys.readouterr().out
    assert "current.profile.layer: " in told
    assert "N1: " in told
    assert "printed 58.2" in told


def test_without_a_range_or_a_number_there_is_nothing_to_fit(nearest, items):
    bare = replace(nearest, model=nearest.model.replaced(set={}))
    with pytest.raises(InputError, match="no value is calibrated within a range"):
        calibration.calibrate(bare, items, {}, 1)
    with pytest.raises(InputError, match="no published numbers"):
        calibration.calibrate(nearest, [], {}, 1)
