"""Effects of a scene: unknowns and their reasons, effects that could be added, shares of run time."""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.advice.ablation import fixed
from riserstudy.advice.changes import fitting
from riserstudy.advice.effect_cost import REST, costs, freedom
from riserstudy.effects.catalogue import catalogue
from riserstudy.errors import SimulationError
from riserstudy.model.build import build
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle

BUDGET = 5e5  # node-steps of a timed run; the shares do not depend on its length


def could_have(file: SceneFile) -> set[str]:
    """Return the names of effects that a scene lacks and could use."""
    added = {change.label for change, _ in fitting(file) if change.kind == "added"}
    return {
        name
        for name, effect in catalogue().items()
        if any(change.label in added for change in effect.changes)
    }


def solved_for(file: SceneFile) -> str:
    """Return the directions in which a scene can move, and the reasons."""
    scene = file.resolved()
    model = build(scene, fixed(file, BUDGET)[1], ring_elevation=0.0)
    return freedom(scene, model).directions


class Prices(NamedTuple):
    """Shares of run time by effect, and a remark."""

    share: dict[str, float]
    sentences: list[str]


def priced(file: SceneFile) -> Prices:
    """Measure the cost of the effects of a scene, with its own mesh and step or with default ones.

    For a scene that cannot be run the result has no shares, but the reason.
    """
    if file.resolved().analysis.solver:
        return Prices({}, ["no times: measured for lumped masses only"])
    try:
        alone, mesh = fixed(file, BUDGET)
        scene = alone.resolved()
        model, _ = settle(scene, mesh)
        share = {cost.name: cost.share for cost in costs(scene, mesh, scene.analysis.step)}
    except SimulationError as error:
        return Prices({}, [f"no times: {error}"])
    free = freedom(scene, model)
    step = f", step {scene.analysis.step:.4g} s" if scene.analysis.step else ""
    text = [
        f"Timed on {len(mesh.l0)} segments{step}; the solver and all other parts take "
        f"{100 * share.pop(REST):.0f} %.",
        f"{free.unknowns} degrees of freedom: {free.because}",
    ]
    return Prices(share, text)
