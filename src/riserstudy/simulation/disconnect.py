"""The release of the lower end, and the lift of the riser above the stack."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.dataset.clearance import TOUCHING, lowest_after_rise
from riserstudy.errors import SimulationError
from riserstudy.model.disconnect import fading, released, stack_contact
from riserstudy.model.draining import draining, flow_of
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.records.numerals import newtons
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.evaluate import energies, forces_and_tangent

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts


STILL = 1e-6  # share of the largest tension that counts as rounding
# horizontal distance (m) from the well within which a lower end counts as above the stack
ABOVE = 1.0


def let_go(scene: Resolved, mesh: Mesh, facts: RunFacts, model: Model) -> Model:
    """The model with its lower end released; the facts receive the energy (J) that the release removes.

    Raises SimulationError when the riser presses on the stack at the release, and the scene has no contact
    with the stack.
    """
    release = scene.disconnect
    if release is None:
        raise TypeError("nothing lets go")  # excluded by the caller
    pull = _overpull(model)
    if release.stack is None and pull < -STILL * float(abs(model.s.segment).max()):
        raise SimulationError(
            f"disconnect: at {release.at:g} s the riser presses on the BOP stack with {newtons(-pull)}, so "
            "it would fall after the disconnect; increase top.tension, disconnect at another time, or "
            "give disconnect.stack"
        )
    if pull < -STILL * float(abs(model.s.segment).max()):
        text = (
            "disconnect: at {at:.4g} s the overpull is negative, {pull:.4g} kN: the LMRP presses on the BOP "
            "stack and does not lift off; increase the top tension"
        )
        facts["warnings"].append(warning("negative_overpull", text, {"at": release.at, "pull": pull / 1e3}))
    before = energies(model.programs, model.state)[0]
    freed = released(model)
    facts["taken_by_the_release"] = before - energies(freed.programs, freed.state)[0]
    facts["overpull"] = pull
    more = [*stack_contact(scene), *draining(scene, mesh, model)]
    if release.over:
        more += fading(model, release.at, release.over)
    return released(model, more) if more else freed


def _overpull(model: Model) -> float:
    """Force that lifts the lower end off the stack (N)."""
    forces_and_tangent(model.programs, model.state)
    return float(model.s.force[-1, 0])


def enter_lift(scene: Resolved, arrays: Arrays, facts: RunFacts) -> None:
    """Add lift, clearance and re-contact to the facts, with warnings about re-contact.

    ``arrays`` hold time (s), lift (m), its rate (m/s) and the distance from the well (m), (times,), at all
    steps if these were recorded.
    """
    if scene.disconnect is None or "lift" not in arrays:
        return
    after = arrays["time"] > scene.disconnect.at
    lift = arrays["lift"][after]
    if not len(lift):
        return
    time, aside = arrays["time"][after], arrays["lift_aside"][after]
    facts["lift_max"] = float(lift.max())
    facts["lift_rate_max"] = float(arrays["lift_rate"][after].max())
    lowest = lowest_after_rise(time, lift)
    if lowest is not None:
        facts["clearance_min"] = float(lift[lowest])
        facts["clearance_time"] = float(time[lowest])
        facts["clearance_aside"] = float(aside[lowest])
    below = np.flatnonzero(lift < -TOUCHING)
    if len(below):
        facts["recontact_time"] = float(time[below[0]])
        facts["recontact_aside"] = float(aside[below].max())
        kind, values = "recontact", {"time": time[below[0]]}
        text = "disconnect: the LMRP re-contacts the stack at {time:.4g} s"
        if scene.disconnect.stack is None:
            kind, values = "recontact_without_stack", values | {"depth": -lift.min()}
            text += (
                " and sinks up to {depth:.3g} m below it, because the scene has no stack to stop it; "
                "do not use results after this time, or give disconnect.stack"
            )
        facts["warnings"].append(warning(kind, text, values))
        if scene.disconnect.stack and facts["recontact_aside"] > ABOVE:
            facts["warnings"].append(_contact_aside(time[below], aside[below]))
    if column := flow_of(scene):
        facts["contents_speed_max"] = float(abs(column.speed).max())
        facts["contents_top_min"] = float(column.top.min())


def _contact_aside(time: FloatArray, aside: FloatArray) -> RunWarning:
    """A warning about contact beside the stack, from the times (s) of contact and the distances then (m)."""
    return warning(
        "contact_beside_the_stack",
        "disconnect: the LMRP touches the level of the stack up to {aside:.3g} m aside from the well, first "
        f"more than {ABOVE:g} m aside at {{first:.4g}} s; disconnect.stack has no width, so check that the "
        "stack is there, and end the run before this time if it is not",
        {"aside": aside.max(), "first": time[aside > ABOVE][0]},
    )


def rows_of_limits(scene: Resolved, facts: RunFacts) -> list[dict[str, Any]]:
    """Overpull (N) and clearance (m) as rows of extremes, if the run has them."""
    release = scene.disconnect
    if release is None:
        return []
    values = {
        "overpull": (facts.get("overpull"), release.at),
        "lmrp_clearance": (facts.get("clearance_min"), facts.get("clearance_time")),
    }
    return [
        {"output": name, "where": "", "mean": value}
        | dict.fromkeys(("largest", "smallest"), value)
        | {f"{side}_time": time for side in ("largest", "smallest")}
        for name, (value, time) in values.items()
        if value is not None
    ]
