"""What is refined, and when the estimated error is believed: on made-up errors of mesh and step."""

import math
import random
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest

from riserstudy.errors import SimulationError, StepFailed, TakesTooLong
from riserstudy.model.mesh import even
from riserstudy.records.warning import sentences
from riserstudy.scene.load import read_scene
from riserstudy.simulation import refinement as module
from riserstudy.simulation.refine import run
from riserstudy.simulation.remaining_error import estimate
from riserstudy.simulation.run import single
from riserstudy.simulation.time_limit import Watch

SCENE = Path(__file__).parents[2] / "config/scenes/bench/s2.yaml"
SETS = {"analysis.mesh": None, "analysis.step": None, "analysis.method": None}


def refined(monkeypatch, error, longest=math.inf, lost=0):
    """Segments, step and estimate that a run ends with where its moment errs by ``error(n, h)``.

    Steps above the longest (s) fail, and the first ``lost`` meshes have no equilibrium.
    """
    without = set()

    def march(scene, mesh, step, watch, rest=None, extremes=True):
        if step > longest:
            raise StepFailed("made up")
        if len(mesh.l0) in without or len(without) < lost:
            without.add(len(mesh.l0))
            raise SimulationError("made up")
        facts = {"elements": len(mesh.l0), "step": step, "solve_seconds": 0.0, "warnings": []}
        return SimpleNamespace(facts=facts, arrays={"bending_moment": None})

    def difference(coarse, fine):
        off = [error(one.facts["elements"], one.facts["step"]) for one in (coarse, fine)]
        return {"displacement": 0.0, "tension": 0.0, "moment": abs(off[0] - off[1])}

    monkeypatch.setattr(module, "march", march)
    monkeypatch.setattr(module, "finish", lambda scene, mesh, result: result)
    monkeypatch.setattr(module, "difference", difference)
    monkeypatch.setattr(module, "keep_stations", lambda *_: None)
    facts = run(read_scene(SCENE).with_values(SETS, "test").resolved()).facts
    return facts["elements"], facts["step"], facts["error_estimate"]["moment"]


@pytest.mark.parametrize(
    "error",
    [
        lambda n, h: 40.0 / n**2 + h**2,
        lambda n, h: 2.0 / n + 0.05 * h,
        # what a fine mesh changes, long steps damp
        lambda n, h: 40.0 * h**2 + 0.1 / n + 2.0 / n * math.exp(-((h / 0.02) ** 2)),
        # what short steps change, a coarse mesh does not have
        lambda n, h: 3000.0 / n**2 + 0.02 * h**2 + 0.2 * h * math.exp(-((200.0 / n) ** 2)),
    ],
    ids=["second order", "first order", "hidden by the step", "hidden by the mesh"],
)
def test_an_accuracy_is_reached_whichever_error_hides_the_other(monkeypatch, error):
    n, h, estimated = refined(monkeypatch, error)
    assert abs(error(n, h)) <= 0.01
    assert 0.5 * abs(error(n, h)) <= estimated <= 0.01


@pytest.mark.parametrize("seed", range(40))
def test_an_accuracy_is_reached_by_meshes_and_steps_that_can_be_run(seed, monkeypatch):
    draw = random.Random(seed)
    of_mesh, of_step = (10.0 ** draw.uniform(-1.0, 2.5) for _ in range(2))
    longest = draw.choice([math.inf, 10.0 ** draw.uniform(-2.0, 0.0)])

    def error(n, h):
        return of_mesh / n**2 + of_step * h**2

    n, h, estimated = refined(monkeypatch, error, longest, draw.randint(0, 2))
    assert h <= longest
    assert error(n, h) <= 0.01
    assert 0.9 * error(n, h) <= estimated <= 0.01


@pytest.mark.parametrize("lost", [3, 4])
def test_a_refinement_ends_where_three_meshes_have_no_equilibrium(lost, monkeypatch):
    with pytest.raises(SimulationError, match="made up"):
        refined(monkeypatch, lambda n, h: 1.0 / n**2, lost=lost)


def test_an_error_that_does_not_matter_is_not_seen_anew(monkeypatch):
    n, h, _ = refined(monkeypatch, lambda n, h: 40.0 * h**2 + 0.01 / n)
    assert n == refined(monkeypatch, lambda n, h: 0.01 / n)[0]
    assert h < refined(monkeypatch, lambda n, h: 0.01 / n)[1]


def patient(monkeypatch, patience):
    """The result of runs that each take twice the time of the one before, the first a second."""
    spent = [0.0]

    def march(scene, mesh, step, watch, rest=None, extremes=True):
        seconds = 1.0 + spent[0]
        spent[0] += seconds
        if spent[0] > watch.patience:
            raise TakesTooLong("broken off")
        facts = {"elements": len(mesh.l0), "step": step, "solve_seconds": seconds, "warnings": []}
        return SimpleNamespace(facts=facts, arrays={"bending_moment": None})

    def difference(coarse, fine):
        sizes = [one.facts["elements"] ** -2 + one.facts["step"] ** 2 for one in (coarse, fine)]
        return {"displacement": 0.0, "tension": 0.0, "moment": 40.0 * (sizes[0] - sizes[1])}

    monkeypatch.setattr(module, "march", march)
    monkeypatch.setattr(module, "finish", lambda scene, mesh, result: result)
    monkeypatch.setattr(module, "difference", difference)
    monkeypatch.setattr(module, "keep_stations", lambda *_: None)
    monkeypatch.setattr(Watch, "spent", property(lambda _: spent[0]))
    told = []
    scene = read_scene(SCENE).with_values(SETS, "test").resolved()
    return run(scene, patience, notify=lambda what, _: told.append(what)).facts, told


def test_patience_ends_with_the_finest_run_and_its_estimate(monkeypatch):
    facts, told = patient(monkeypatch, 100.0)
    # runs end after 1, 3, 7, 15, 31, 63 s; the next would end after 127 s
    assert [one["solve_seconds"] for one in facts["refinements"]] == [1, 2, 4, 8, 16, 32]
    assert facts["elements"] == facts["refinements"][-1]["elements"]
    true = 40.0 * (facts["elements"] ** -2 + facts["step"] ** 2)
    assert facts["error_estimate"]["moment"] == pytest.approx(true, rel=0.2)
    assert facts["ended_by"] == "patience of 100 s"
    (warning,) = sentences(facts["warnings"])
    assert warning.startswith("accuracy not reached within the time limit of 100 s after 6 runs")
    assert f"moment {100 * facts['error_estimate']['moment']:.2g} %, " in warning
    assert len(told) == 6
    assert told[0].startswith("run 1: ")
    assert "to go" in told[-1]


def test_patience_that_ends_before_there_is_an_estimate_says_so(monkeypatch):
    facts, _ = patient(monkeypatch, 6.0)
    assert facts["error_estimate"] == {}
    assert "errors are not estimated" in sentences(facts["warnings"])[0]


def test_patience_that_ends_before_the_first_run_is_an_error(monkeypatch):
    with pytest.raises(
        TakesTooLong, match=r"^no run was completed within the time limit of 0.5 s: broken off; "
    ):
        patient(monkeypatch, 0.5)


def test_patience_that_suffices_is_not_told(monkeypatch):
    facts, _ = patient(monkeypatch, 1e9)
    assert "ended_by" not in facts
    assert facts["warnings"] == []
    assert facts["error_estimate"]["moment"] <= 0.01


@pytest.mark.long
@pytest.mark.parametrize("method", [None, "ESDIRK4", "explicit"])
def test_a_march_is_broken_off_when_its_time_is_up(method):
    """A million seconds by steps of 2 ms would take hours."""
    sets = {"duration": "1e6 s", "output": {"interval": "10 s"}, "step": "2 ms", "method": method}
    file = read_scene(SCENE).with_values(
        {"analysis": sets | {"mesh": {"elements": 8}}, "top.z": "free"}, "test"
    )
    with pytest.raises(TakesTooLong, match=r"time limit of 1 s, stopped with .* of the outputs"):
        run(file.resolved(), 1.0, estimated=False)


class AtOnce(Watch):
    """Breaks everything off before it begins."""

    @contextmanager
    def over(self, record, sums):
        sums.stop[0] = 1
        yield


@pytest.mark.parametrize("scheme", ["staggered", "iterated"])
def test_turns_are_broken_off_on_either_side(scheme):
    """The platform's own march is the first of a turn."""
    file = read_scene(SCENE.parents[1] / "liu2017/ref_0.yaml").with_values(
        {"vessel.coupling": {"scheme": scheme, "interval": "1 s"}}, "test"
    )
    scene = file.resolved()
    with pytest.raises(TakesTooLong, match="stopped with 0 % of the outputs"):
        single(scene, even(scene, 20), 0.1, watch=AtOnce())


@pytest.mark.parametrize(
    "fall, most, left",
    [(4, 8.0, 1 / 3), (16, 8.0, 1 / 7), (16, 4.0, 1 / 3), (1, 8.0, 2), (30, 8.0, 2), (0, 8.0, 2)],
)
def test_what_is_left_follows_from_the_fall_of_differences(fall, most, left):
    assert estimate({"moment": 1.0}, {"moment": fall}, most)["moment"] == pytest.approx(left)
