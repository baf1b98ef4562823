"""Statics by continuation: a riser is moved to its offset in parts, and then loaded from the side.

Newton's iteration fails from afar: a riser that is not under tension yet hardly resists a line load.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from riserstudy.effects.current import Current
from riserstudy.errors import SimulationError
from riserstudy.model.build import build
from riserstudy.model.mesh import Mesh, lowest_leaning
from riserstudy.model.model import Model
from riserstudy.records.numerals import newtons
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.statics import Equilibrium, NoEquilibrium, find_equilibrium

SMALLEST_PART = 1e-3  # smallest part of the offset; parts are halved down to it


class Settled(NamedTuple):
    """A model in static equilibrium, and facts about the search."""

    model: Model
    equilibrium: Equilibrium


class Folded(NoEquilibrium):
    """In the only equilibrium that was found, a segment of the riser is folded back."""


class Lost(NamedTuple):
    """A model without an equilibrium, and the reason."""

    model: Model
    why: NoEquilibrium


def search(model: Model, mesh: Mesh) -> Equilibrium:
    """Bring a model to static equilibrium from its present shape.

    Raises NoEquilibrium with the node and residual of the last attempt.
    """
    tolerance = 1e-10 * float(mesh.l0.sum())
    current = model.has(Current)
    found = find_equilibrium(model.programs, model.state, model.fixed_at_rest, tolerance, current)
    if (node := folded_at(model)) is not None:
        raise Folded(node, found.residual, 1.0)
    return found


def folded_at(model: Model) -> int | None:
    """A node at which the riser is folded, or None. An equilibrium with a fold is an artefact of the mesh.

    A pipe with bending stiffness turns by less than a right angle from segment to segment, otherwise the mesh
    does not resolve it. A string may turn sharply, but no single segment may point against both neighbours.
    """
    tangent = model.s.tangent
    against = (tangent[:, 1:] * tangent[:, :-1]).sum(axis=0) < 0.0
    if len(model.s.dof) == len(model.s.dim):
        against = against[1:] & against[:-1]
    return int(against.argmax()) + 1 if against.any() else None


def by_parts(scene: Resolved, mesh: Mesh, elevation: float | None, lost: Lost) -> Settled:
    """The equilibrium of a riser with an offset, which is applied in parts; then current and line loads act.

    Raises SimulationError when the top has no offset and no line load acts, or parts become too small.

    Parameters
    ----------
    elevation : elevation of the ring (m), as in `build`.
    lost : model that has no equilibrium from its initial shape, and the reason.
    """
    if not any(_aside(scene, 1.0)) and not any(section.lateral_load for section in scene.riser):
        raise _failed(scene, mesh, lost.why, 0.0)
    d = len(lost.model.s.dim)
    sections = [section.replaced(lateral_load=None) for section in scene.riser]
    calm = scene.replaced(current=None, riser=sections)
    reached, part, total = 0.0, 1.0, 0
    last = build(_moved(calm, 0.0), mesh, elevation, d)
    try:
        total += search(last, mesh).iterations
        while reached < 1.0:
            share = min(1.0, reached + part)
            model = build(_moved(calm, share), mesh, elevation, d)
            _continue(model, last, _aside(scene, share - reached), mesh, scene)
            try:
                total += search(model, mesh).iterations
            except NoEquilibrium:
                part *= 0.5
                if part < SMALLEST_PART:
                    raise
                continue
            last, reached, part = model, share, 2.0 * part
        model = build(scene, mesh, elevation, d)
        _continue(model, last, (0.0, 0.0), mesh, scene)
        equilibrium = search(model, mesh)
    except NoEquilibrium as fault:
        raise _failed(scene, mesh, fault, reached) from None
    return Settled(model, equilibrium._replace(iterations=total + equilibrium.iterations))


def _aside(scene: Resolved, share: float) -> tuple[float, float]:
    """A share of the offset of a riser's top, along x and y (m)."""
    position = scene.platform and scene.platform.position
    surge, sway = (position.surge, position.sway) if position else (None, None)
    return share * ((scene.top.offset or 0.0) + (surge or 0.0)), share * (sway or 0.0)


def _moved(scene: Resolved, share: float) -> Resolved:
    """The scene with a share of its offset."""
    top, platform = scene.top, scene.platform
    changed: dict[str, Any] = {}
    if top.offset:
        changed["top"] = top.replaced(offset=share * top.offset)
    if platform and platform.position:
        kept = platform.position
        moved = {n: share * v for n in ("surge", "sway") if (v := getattr(kept, n)) is not None}
        changed["platform"] = platform.replaced(position=kept.replaced(**moved))
    return scene.replaced(**changed)


def _continue(model: Model, last: Model, further: tuple[float, float], mesh: Mesh, scene: Resolved) -> None:
    """Start from the last shape, further inclined (m) above the lowest node that can be inclined."""
    state = model.s
    foot = lowest_leaning(scene, mesh)
    lean = np.clip((mesh.s - mesh.s[foot]) / (mesh.s[-1] - mesh.s[foot]), 0.0, 1.0)
    state.r[:], state.moment[:], state.carried[:] = last.s.r, last.s.moment, last.s.carried
    for axis, way in zip(range(len(state.dim) - 1), further, strict=False):
        state.r[axis, : len(mesh.s)] += way * lean


def _failed(scene: Resolved, mesh: Mesh, failure: NoEquilibrium, reached: float) -> SimulationError:
    """The error of a failed search: place, load and remedy."""
    s = float(mesh.s[failure.node])
    where = f"node {failure.node} (s = {s:.4g} m)"
    under = [f"under {failure.load:.0%} of the current"] if scene.current else []
    if any(way := _aside(scene, 1.0)):
        under.append(f"for top offsets beyond {reached:.1%} of {np.hypot(*way):.4g} m")
    remedy = "check top tension, weights and supports of the ends"
    if scene.soil and (scene.bottom.elevation or 0.0) + s <= scene.soil.mudline:
        depth = scene.soil.mudline - (scene.bottom.elevation or 0.0) - s
        where += f", {depth:.4g} m below the mudline"
        remedy = "check the strength of the soil, the length of the conductor, offset and top tension"
    causes = " ".join(["", *under])
    if isinstance(failure, Folded):
        return SimulationError(
            f"in the only static equilibrium found{causes}, the riser folds back on itself in one segment "
            f"at {where}, where it buckles for lack of tension; increase the top tension, or give more "
            f"analysis.mesh.elements; {remedy}"
        )
    return SimulationError(
        f"no static equilibrium was found{causes}: an unbalanced force of {newtons(failure.residual)} "
        f"remains at {where}; {remedy}"
    )
