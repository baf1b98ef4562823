"""March through the release of the lower end, and what the riser did above the stack."""

from __future__ import annotations

from typing import Any

import numpy as np

from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.model.release import fading, released
from riserstudy.scene.models import Scene
from riserstudy.simulation import outputs
from riserstudy.simulation.time_stepping import march_on
from riserstudy.solve.evaluate import energies, forces_and_tangent
from riserstudy.solve.program import Frozen
from riserstudy.solve.sums import DONE, Sums

STILL = 1e-6  # share of the tension above the connector that is rounding
TOUCHING = 1e-6  # lift that is contact (m)


def march_through(
    scene: Scene,
    model: Model,
    mesh: Mesh,
    step: float,
    record: Frozen,
    sums: Sums,
    facts: dict[str, Any],
) -> tuple[Model, int, float]:
    """March to the release and on from it, by steps of ``step`` (s).

    Returns the model as it ends, DONE or why it stopped, and the energy that the release took out of the
    account (J); the facts gain what of it is the joint's at the lower end.

    Raises
    ------
    SimulationError
        When the riser stands on the stack at the release.
    """
    if scene.disconnect is None:
        return model, march_on(scene, model, mesh, step, record, sums), 0.0
    at = scene.disconnect.at
    outcome = march_on(scene, model, mesh, step, record, sums, until=at)
    if outcome != DONE:
        return model, outcome, 0.0
    pull = _overpull(model)
    if pull < -STILL * float(abs(model.s.segment).max()):
        raise SimulationError(
            f"disconnect: at {at:g} s the riser stands on the stack with {-pull:.4g} N, and would fall: "
            "raise top.tension or take another moment"
        )
    before = energies(model.programs, model.state)[0]
    freed = released(model)
    facts["taken_by_the_release"] = before - energies(freed.programs, freed.state)[0]
    if over := scene.disconnect.over:
        freed = released(model, fading(model, at, over))
    taken = before - energies(freed.programs, freed.state)[0]
    outcome = march_on(scene, freed, mesh, step, record, sums, since=at)
    return freed, outcome, float(taken)


def _overpull(model: Model) -> float:
    """Force that lifts the lower end off the stack (N)."""
    forces_and_tangent(model.programs, model.state)
    return float(model.s.force[-1, 0])


def enter_lift(scene: Scene, arrays: outputs.Arrays, facts: dict[str, Any]) -> None:
    """Enter lift, clearance and re-contact into the facts, with a warning where the riser comes down.

    ``arrays`` hold time (s), lift (m) and its rate (m/s), (times,).
    """
    if scene.disconnect is None or "lift" not in arrays:
        return
    after = arrays["time"] > scene.disconnect.at
    lift = arrays["lift"][after]
    if not len(lift):
        return
    time = arrays["time"][after]
    facts["lift_max"] = float(lift.max())
    facts["lift_rate_max"] = float(arrays["lift_rate"][after].max())
    falls = np.flatnonzero(np.diff(lift) < 0.0)
    if len(falls):
        facts["clearance_min"] = float(lift[falls[0] :].min())
    below = np.flatnonzero(lift < -TOUCHING)
    if len(below):
        facts["recontact_time"] = float(time[below[0]])
        facts["warnings"].append(
            f"disconnect: the lower end is back on the stack at {time[below[0]]:.4g} s, and "
            f"{-lift.min():.3g} m below it later: it is not stopped there, what follows is not to be believed"
        )
