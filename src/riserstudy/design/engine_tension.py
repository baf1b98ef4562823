"""Minimum tension by the engine: the top tension at which no effective tension at rest is negative."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from riserstudy.design import tension as formula
from riserstudy.design.tension import Tolerances, carrying_tension, columns_above
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import own_mesh
from riserstudy.records.arrays import FloatArray
from riserstudy.records.numerals import newtons
from riserstudy.scene.at_rest import at_rest
from riserstudy.scene.pressures import mud_above_the_riser
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation import outputs
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.section_forces import riser_foot
from riserstudy.simulation.starting_mesh import coarsest_mesh

# smallest effective tension, as a share of the top tension, at which the iteration ends
EXACT = 1e-10
SUFFICIENT = 1e-6  # the same, above which the iteration has not converged after the last equilibrium
PLENTY = 1.5  # initial top tension, as a multiple of the formula's tension
MOST = 20  # largest number of equilibria


class Slack(NamedTuple):
    """Top tension at which the smallest effective tension of a riser at rest is zero, and its place."""

    tension: float  # N
    s: float  # m from the bottom
    left: float  # remaining effective tension there (N)


def lacks(scene: Resolved) -> list[str]:
    """Fields that a scene lacks for the engine, in addition to those for the formula."""
    top, joint = scene.top, scene.top.telescopic_joint
    pulled = top.tension is not None or top.tensioners or (joint and joint.tension is not None)
    return [] if pulled else ["top.tension, top.telescopic_joint.tension or top.tensioners"]


def needed(scene: Resolved, tolerances: Tolerances) -> Slack:
    """Smallest top tension at which no point of a riser at rest has a negative effective tension.

    In each iteration, the top tension is reduced by the smallest effective tension, until this is zero.
    Tensioners are replaced by a constant tension at the ring, along the telescopic joint if there is one.
    Raises SimulationError when no equilibrium is found, or the iteration does not converge.
    """
    heavy = _with_tolerances(scene, tolerances)
    tension = PLENTY * formula.governing(scene, tolerances).tension
    for _ in range(MOST):
        s, left = along(with_tension(heavy, tension))
        slackest = int(left.argmin())
        if abs(left[slackest]) <= EXACT * tension:
            break
        tension -= float(left[slackest])
    if abs(left[slackest]) > SUFFICIENT * tension:
        raise SimulationError(
            f"minimum top tension: the search did not converge in {MOST} static runs. At a top tension of "
            f"{newtons(tension)}, the effective tension at s = {s[slackest]:.4g} m is "
            f"{newtons(float(left[slackest]))}, not 0; give more analysis.mesh.elements"
        )
    above = mud_above_the_riser(scene)
    return Slack(tension + above, float(s[slackest]), float(left[slackest]))


def along(scene: Resolved) -> tuple[FloatArray, FloatArray]:
    """Arclength from the bottom (m) and effective tension (N) of a riser at rest, each (nodes of the riser,).

    Stack and conductor below the riser's flex joint are excluded, because they stand on the seabed. Raises
    SimulationError when no equilibrium is found.
    """
    mesh = own_mesh(scene) or coarsest_mesh(scene)
    model, _ = settle(at_rest(scene), mesh)
    first = riser_foot(scene, mesh)
    return mesh.s[first:], outputs.at_rest(scene, model, mesh)["effective_tension_static"][first:]


def with_tension(scene: Resolved, tension: float) -> Resolved:
    """The scene with a constant tension (N) at the ring, instead of its tension or tensioners."""
    top, joint = scene.top, scene.top.telescopic_joint
    changed: dict[str, Any] = {"tension": tension}
    if joint and (joint.tension is not None or top.tensioners):
        changed = {"telescopic_joint": joint.replaced(**changed), "tension": None}
    return scene.replaced(top=top.replaced(**changed, tensioners=None))


def _with_tolerances(scene: Resolved, tolerances: Tolerances) -> Resolved:
    """The scene with weights of steel, ring included, and lifts of modules changed by their tolerances."""
    of = columns_above(scene)
    steel, lift, water = (-np.diff(values) for values in (of.steel, of.lift, of.water))
    weights = carrying_tension(steel, lift, -water, tolerances)
    sections = [
        section.replaced(submerged_weight=weight / section.total_length)
        for section, weight in zip(scene.riser, weights.tolist(), strict=True)
    ]
    changed: dict[str, Any] = {"riser": sections}
    if body := scene.top.body:
        weight = tolerances.weight * scene.ring_weight
        heavy = body.replaced(submerged_weight=weight, density=None, displaced_volume=None)
        changed["top"] = scene.top.replaced(body=heavy)
    return scene.replaced(**changed)
