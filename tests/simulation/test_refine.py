"""What is refined, and when the estimated error is believed: on made-up errors of mesh and step."""

import math
from pathlib import Path
from types import SimpleNamespace

import pytest

from riserstudy.scene.load import read_scene
from riserstudy.simulation import refine as module
from riserstudy.simulation.error_estimate import estimate
from riserstudy.simulation.refine import run

SCENE = Path(__file__).parents[2] / "config/scenes/bench/s2.yaml"
SETS = {"analysis.mesh": None, "analysis.step": None, "analysis.method": None}


def refined(monkeypatch, error):
    """Segments, step and estimate that a run ends with where its moment errs by ``error(n, h)``."""

    def single(scene, mesh, step, *stations):
        facts = {"elements": len(mesh.l0), "step": step, "solve_seconds": 0.0, "warnings": []}
        return SimpleNamespace(facts=facts, arrays={"bending_moment": None})

    def difference(coarse, fine):
        off = [error(one.facts["elements"], one.facts["step"]) for one in (coarse, fine)]
        return {"displacement": 0.0, "tension": 0.0, "moment": abs(off[0] - off[1])}

    monkeypatch.setattr(module, "single", single)
    monkeypatch.setattr(module, "difference", difference)
    monkeypatch.setattr(module, "keep_stations", lambda *_: None)
    facts = run(read_scene(SCENE).with_values(SETS, "test").scene()).facts
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


def test_an_error_that_does_not_matter_is_not_seen_anew(monkeypatch):
    n, h, _ = refined(monkeypatch, lambda n, h: 40.0 * h**2 + 0.01 / n)
    assert n == refined(monkeypatch, lambda n, h: 0.01 / n)[0]
    assert h < refined(monkeypatch, lambda n, h: 0.01 / n)[1]


@pytest.mark.parametrize(
    "fall, most, left", [(4, 8.0, 1 / 3), (16, 8.0, 1 / 7), (16, 4.0, 1 / 3), (1, 8.0, 1)]
)
def test_what_is_left_follows_from_the_fall_of_differences(fall, most, left):
    assert estimate({"moment": 1.0}, {"moment": fall}, most)["moment"] == pytest.approx(left)
