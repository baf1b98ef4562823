"""A long record is refined by way of its first piece, and errs as little as if it had been as a whole."""

from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.errors import SimulationError
from riserstudy.simulation import long_record as module
from riserstudy.simulation.error_estimate import controlled, difference
from riserstudy.simulation.long_record import LongRecord, is_long, piece_length, refinement_of
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import march
from riserstudy.simulation.time_limit import Watch
from riserstudy.simulation.tolerance import allowed

RISER = Path(__file__).parents[2] / "examples/drilling_riser/config/scenes/riser.yaml"
DURATION = 3000  # s, more than ten pieces


def record(seed=1, accuracy=0.01, duration=DURATION, **wave):
    """The worked example with its six cylinders, in a sea."""
    sea = {
        "significant_height": "5 m",
        "peak_period": "11 s",
        "peak_enhancement": 2,
        "components": 40,
        "seed": seed,
    }
    response = {"platform.response.beyond": "zero", "platform.response.wave": wave or sea}
    analysis = {
        "duration": f"{duration} s",
        "output": {"interval": "1 s"},
        "accuracy": f"{100 * accuracy:g} %",
    }
    return load_scene(RISER, **response, analysis=analysis).resolved()


def work(refinement):
    return sum(run["elements"] * run["newton_iterations"] for run in refinement.spent)


@pytest.mark.long
@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_it_errs_by_less_than_asked_and_works_less(seed):
    scene = record(seed)
    by_piece, as_whole = LongRecord(scene), Refinement(scene)
    one, other = by_piece.result(), as_whole.result()
    assert max(controlled(one.facts["error_estimate"]).values()) <= 0.01
    assert one.facts["warnings"] == other.facts["warnings"]
    assert by_piece.finest_mesh is by_piece.mesh
    fine = march(scene, by_piece.mesh.halved(), 0.5 * by_piece.step, extremes=False)
    true = difference(one, fine)
    for name, error in true.items():
        assert error <= allowed(0.01).get(name, 1.0)
        assert error <= 1.5 * one.facts["error_estimate"][name]
    assert work(by_piece) < work(as_whole)


@pytest.mark.long
def test_a_whole_that_errs_more_than_its_piece_is_refined_further(monkeypatch):
    """Runs of the whole are made to differ ten times as much as they do."""
    scene = record()
    first = LongRecord(scene)
    first.result()

    def exaggerated(coarse, fine):
        found = difference(coarse, fine)
        long = coarse.arrays["time"][-1] > 2.0 * piece_length(scene)
        return {name: (10.0 if long else 1.0) * value for name, value in found.items()}

    monkeypatch.setattr(module, "difference", exaggerated)
    second = LongRecord(scene)
    result = second.result()
    assert len(second.spent) > len(first.spent)
    assert len(second.mesh.l0) / second.step > len(first.mesh.l0) / first.step
    assert max(controlled(result.facts["error_estimate"]).values()) <= 0.01


@pytest.mark.long
def test_where_the_whole_cannot_be_run_so_it_is_refined_as_any_record(monkeypatch):
    scene = record()
    wanted = Refinement(scene).result()

    def failing(scene, *_, **__):
        raise SimulationError("no such run")

    monkeypatch.setattr(module, "march", failing)
    found = LongRecord(scene).result()
    np.testing.assert_array_equal(found.arrays["x_max"], wanted.arrays["x_max"])
    assert found.facts["error_estimate"] == wanted.facts["error_estimate"]


def test_only_long_irregular_records_go_by_a_piece():
    assert is_long(record())
    assert isinstance(refinement_of(record(), Watch()), LongRecord)
    assert not isinstance(refinement_of(record(), Watch(60.0)), LongRecord)
    short = record(duration=0.5 * DURATION)
    assert not is_long(short)
    assert not isinstance(refinement_of(short, Watch()), LongRecord)
    assert not is_long(record(height="3 m", period="10 s"))
