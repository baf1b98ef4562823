"""Shares of run time, verdicts without moments and the order of advice, where times and runs are invented."""

import math
import time as clock

import numpy as np
import pytest
from random_rigs import moving, shed_vortices, written

from riserstudy.advice import ablation, effect_cost, recommendations
from riserstudy.advice.ablation import Ablation, Changed, Measured, Peaks, fixed, measure
from riserstudy.advice.effect_shares import priced
from riserstudy.advice.recommendations import COULD_GO, MISSING, NEEDED, NO_GAIN, NOT_MISSED, advice, row
from riserstudy.dataset.result import Result
from riserstudy.effects.catalogue import changes
from riserstudy.effects.registry import ROLES
from riserstudy.effects.vortex_lift import VortexLift
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.audit import UNEXPLAINED
from riserstudy.solve.evaluate import Programs

REMOVED = [one for one in changes() if one.kind == "removed"]
ADDED = [one for one in changes() if one.kind == "added"]


def rig(seed, **more):
    """A drawn rig that moves."""
    return SceneFile("rig.yaml", written(moving(seed, **more)))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("explicit", [False, True])
def test_each_call_has_its_share_of_the_shortest_time(seed, explicit, monkeypatch):
    """Bending: its law and turning angles at each evaluation, and its tangent at each iteration.

    The pipe's mass: inertia at each evaluation, a matrix at each iteration, kinetic energy at each step. An
    explicit integration has no matrices, but lumps the masses at each step.
    """
    draw = np.random.default_rng(seed)
    steps, outputs = int(draw.integers(100, 900)), int(draw.integers(2, 90))
    iterations = 0 if explicit else int(draw.integers(1000, 9000))
    times = draw.uniform(1.0, 2.0, effect_cost.RUNS)
    facts = {"newton_iterations": iterations, "steps": steps}
    runs = iter([(Result({"time": np.zeros(outputs)}, facts), t) for t in times])
    monkeypatch.setattr(effect_cost, "_ran", lambda *_: next(runs))
    monkeypatch.setattr(effect_cost, "_time_of", lambda *_: 1e-6)
    file, mesh = fixed(rig(seed), 1e4)
    found = effect_cost.costs(file.resolved(), mesh, 0.1)
    forces, matrices = iterations + steps + outputs, iterations or steps
    calls = {name: round(share * min(times) / 1e-6) for name, _, share in found[:-1]}
    assert calls == {name: count for name, count, _ in found[:-1]}
    assert calls["bending"] == 2 * forces + iterations
    assert calls["inertia"] == forces + matrices + steps
    assert sum(cost.share for cost in found) == pytest.approx(1.0)


@pytest.mark.parametrize("seed", range(6))
def test_a_busy_machine_does_not_change_the_shares(seed, monkeypatch):
    """Other work interrupts a run for nine times its own time; times scatter by less than a factor of 2.5."""
    file, mesh = fixed(rig(seed), 1e5)
    scene = file.resolved()
    alone = 1.0 - effect_cost.costs(scene, mesh, scene.analysis.step)[-1].share
    run = effect_cost.single

    def interrupted(*arguments):
        result = run(*arguments)
        lost = 9.0 * result.facts["solve_seconds"]
        clock.sleep(lost)
        result.facts["solve_seconds"] += lost
        return result

    monkeypatch.setattr(effect_cost, "single", interrupted)
    busy = 1.0 - effect_cost.costs(scene, mesh, scene.analysis.step)[-1].share
    assert 1.0 / 2.5 < busy / alone < 2.5


def test_every_role_has_a_count_of_its_calls():
    assert sorted([*effect_cost.PER, *effect_cost.SELDOM]) == sorted(Programs._fields)


@pytest.mark.parametrize("seed", range(4))
def test_vortices_are_timed_where_their_phases_are_solved(seed, monkeypatch):
    """At each evaluation of forces, as the force itself."""
    tree = shed_vortices(moving(seed, spatial=True, conductor=False))
    facts = {"newton_iterations": 900, "steps": 300}
    timed = []
    monkeypatch.setattr(effect_cost, "_ran", lambda *_: (Result({"time": np.zeros(50)}, facts), 1.0))
    monkeypatch.setattr(effect_cost, "assemble", lambda calls, _: timed.append(calls[0]) or np.zeros((1, 2)))
    monkeypatch.setattr(effect_cost, "_time_of", lambda *_: 1e-6)
    file, mesh = fixed(SceneFile("rig.yaml", written(tree)), 1e4)
    found = {one.name: one.calls for one in effect_cost.costs(file.resolved(), mesh, 0.1)}
    functions = ROLES[VortexLift]
    assert {functions["internal"], functions["string"]} <= {function for function, _ in timed}
    assert found["vortex-induced vibration"] >= 2 * (900 + 300 + 50)


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0, 1.5, 10.0])
def test_runs_that_do_not_balance_their_energy_are_marked(share, monkeypatch):
    facts = {"audit": {"unexplained_share": share * UNEXPLAINED}}
    facts |= {"smallest_tension": 5.0, "solve_seconds": 0.25}
    monkeypatch.setattr(ablation, "single", lambda *_: Result({}, facts))
    monkeypatch.setattr(ablation, "peaks", lambda _: Peaks(1.0, 2.0, 3.0))
    found = Measured()
    measure(found, None, None, 0.1)
    assert (found.unbalanced, found.smallest_tension, found.times) == (share > 1.0, 5.0, [0.25])


@pytest.mark.parametrize("sizes, small", [((0.0, 0.0), True), ((0.5, 0.0), False), ((0.0, -0.5), False)])
def test_without_moments_before_and_after_displacement_and_tension_decide(sizes, small):
    """As of strings."""
    base = Ablation(None, None, None, peaks=Peaks(1.0, math.nan, 1.0), times=[1.0])
    after = Peaks(1.0 + sizes[0], math.nan, 1.0 + sizes[1])
    for change, verdicts in ((REMOVED[0], (COULD_GO, NEEDED)), (ADDED[0], (NOT_MISSED, MISSING))):
        found = row(base, Changed(change, peaks=after, times=[0.5]), (0.02, 0.05, 0.05))
        assert found.verdict == verdicts[not small]


@pytest.mark.parametrize("seed", range(6))
def test_recommended_changes_are_listed_first(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    file = rig(seed)
    base = Ablation(*fixed(file, 1e4), 0.1, peaks=Peaks(1.0, 1.0, 1.0), times=[1.0])
    base.changed = [
        Changed(one, peaks=Peaks(1.0, 1.0 + draw.choice([0.0, 0.3]), 1.0), times=[draw.choice([0.5, 1.0])],
                message=str(draw.choice(["", "", "no equilibrium"])))
        for one in [*draw.choice(len(REMOVED), 8, replace=False)]
        for one in [REMOVED[one]]
    ]  # fmt: skip
    base.changed += [Changed(one, peaks=Peaks(1.0, 1.0 + draw.choice([0.0, 0.3]), 1.0), times=[1.0])
                     for one in ADDED[:6]]  # fmt: skip
    draw.shuffle(base.changed)
    monkeypatch.setattr(recommendations, "ablate", lambda *_, **__: base)
    monkeypatch.setattr(recommendations, "_uncertain", lambda *_: "")
    order = [COULD_GO, MISSING, NEEDED, NO_GAIN, NOT_MISSED, "cannot be run"]
    places = [order.index(one.verdict) for one in advice(file).rows]
    assert places == sorted(places)
    assert len(set(places)) > 2


@pytest.mark.parametrize("seed", range(6))
def test_a_cut_run_has_its_budget_of_nodes_and_steps(seed):
    """Whole runs that are shorter keep their duration."""
    draw = np.random.default_rng(seed)
    file = rig(seed)
    for budget in draw.uniform(1e3, 1e5, 4):
        cut, mesh = fixed(file, budget)
        a, before = cut.resolved().analysis, file.resolved().analysis
        work = a.duration / a.step * len(mesh.s)
        assert work == pytest.approx(budget) or (a.duration == before.duration and work < budget)


def test_shares_of_a_scene_at_rest_are_of_its_iterations():
    """A static run has no steps, so nothing is called by step or output."""
    still = rig(1).with_values({"analysis.duration": None, "analysis.output": None}, "")
    found = priced(still.with_values({"analysis.step": None}, ""))
    assert "bending" in found.share
    assert "added mass" not in found.share
    assert sum(found.share.values()) <= 1.0 + 1e-9 or "take 0 %" in found.sentences[0]
