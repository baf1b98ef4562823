"""The ledger of a scene with prices: share of run time by effect, what is solved for, and why."""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.errors import SimulationError
from riserstudy.numerics.ablation import fixed
from riserstudy.numerics.effect_cost import REST, costs, freedom
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle

BUDGET = 5e5  # node-steps a timed run; shares do not depend on how long it is


class Prices(NamedTuple):
    """Share of run time by effect, and what else is to be said."""

    share: dict[str, float]
    said: list[str]


def priced(file: SceneFile) -> Prices:
    """Measure what the effects of a scene cost, on its own mesh and step or on plain ones.

    A scene that cannot be run has a ledger without prices, and says why.
    """
    if file.scene().analysis.solver:
        return Prices({}, ["no times: measured for lumped masses only"])
    try:
        alone, mesh = fixed(file, BUDGET)
        scene = alone.scene()
        model, _ = settle(scene, mesh)
        share = {cost.name: cost.share for cost in costs(scene, mesh, scene.analysis.step)}
    except SimulationError as error:
        return Prices({}, [f"no times: {error}"])
    unknowns, because = freedom(scene, model)
    step = f", step {scene.analysis.step:.4g} s" if scene.analysis.step else ""
    said = [
        f"{len(mesh.l0)} segments{step}; the solver and all else takes {100 * share.pop(REST):.0f} %",
        f"{unknowns} degrees of freedom: {because}",
    ]
    return Prices(share, said)
