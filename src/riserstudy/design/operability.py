"""Offsets at which limits are reached, to both sides of the well, for risers at rest, limit by limit.

An offset is the distance of the riser's top from the well along x, or along another direction. The platform,
the tensioners and their deck have the same offset. The platform's position across it, and its tilts, stay
as they are.

Waves are represented by a dynamic allowance, which is added to the static value of an output. Limits on means
have no allowance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from riserstudy.dataset.limits import Error, demand_of, error_of, rows_of, taken_by, too_coarse
from riserstudy.errors import InputError, SimulationError
from riserstudy.model.mesh import Mesh, own_mesh
from riserstudy.records.arrays import FloatArray
from riserstudy.records.facts import RunFacts
from riserstudy.scene.at_rest import at_rest, static
from riserstudy.scene.forcing import Position
from riserstudy.scene.limit_inputs import lacks
from riserstudy.scene.limits import Limit
from riserstudy.scene.pressures import not_in_demand
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.refine import run
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import single
from riserstudy.simulation.tolerance import MOMENT
from riserstudy.study.processes import each

NODES = 17  # number of initial offsets of a search, the same for all limits
CLOSE = 0.05  # m, tolerance of an offset
EXACT = 15  # digits of a direction, so that a right angle moves nothing across itself
#: dynamic allowance of an output, in the SI unit of its limit: at all places, or by place
Added = float | Mapping[str, float]
#: a dynamic allowance, or a function that gives it for an offset (m)
Allowed = Added | Callable[[float], Added]


class Offsets(NamedTuple):
    """Offsets (m) between which a limit is met.

    Infinite: not reached within the search. NaN: exceeded at every offset, or not evaluated because of the
    missing inputs in ``missing``. If the limit is met in several ranges, this is the one nearest to the well.
    ``also``: an offset outside of it at which the limit is met, too, such as on the other side of the well;
    NaN: at none of the first offsets of the search.
    """

    low: float
    high: float
    missing: str = ""
    also: float = math.nan


def offsets(
    scene: Resolved, reach: float, allowances: Mapping[str, Added], towards: float = 0.0
) -> list[Offsets]:
    """The offsets between which each limit of a scene is met.

    Parameters
    ----------
    scene : a scene with limits, whose top is held, on a platform or on a vessel.
    reach : largest offset of the search to both sides (m).
    allowances : dynamic allowances by output, in the SI unit of its limit, at all places of the output or by
        place as in extremes; absent: none.
    towards : direction of positive offsets, from x towards y (rad).
    """
    limits = scene.limits or []
    moved(scene, 0.0, towards)  # refuses a scene without an offset that can be changed
    try:
        at = AtRest(scene, reach, towards)
    except SimulationError as failure:
        missing = f"a static equilibrium ({failure})"
        return [Offsets(math.nan, math.nan, missing) for _ in limits]
    return offsets_at(at, limits, reach, allowances)


def offsets_at(
    at: AtRest, limits: Sequence[Limit], reach: float, allowances: Mapping[str, Allowed]
) -> list[Offsets]:
    """The same for some limits, with static solutions that are shared with other limits.

    Allowances by output are those of extremes, so limits on means have none.
    """
    each = [0.0 if limit.side == "mean" else allowances.get(limit.output, 0.0) for limit in limits]
    return [offsets_of(at, limit, reach, one) for limit, one in zip(limits, each, strict=True)]


def chart(
    scenes: Sequence[Resolved], reach: float, allowances: Mapping[str, Added], processes: int = 1
) -> list[list[Offsets]]:
    """The same for several scenes, such as different currents and mud densities, in several processes."""
    task = partial(offsets, reach=reach, allowances=allowances)
    return list(each(task, scenes, processes))


class AtRest:
    """A scene at rest at several offsets, each computed once and shared by all limits.

    Parameters
    ----------
    reach : largest offset (m) for which the mesh must be sufficient.
    towards : direction of positive offsets, from x towards y (rad).
    """

    def __init__(self, scene: Resolved, reach: float, towards: float = 0.0) -> None:
        self.scene, self.reach, self.towards = scene, reach, towards
        self.mesh = own_mesh(scene) or _fine_enough(scene, reach, towards)
        self.rows: dict[float, list[dict[str, Any]]] = {}  # extremes by offset
        self.lost: dict[float, str] = {}  # reasons for missing equilibria, by offset
        self.estimated: dict[float, RunFacts] = {}  # facts with an estimated error, by offset

    def extremes(self, offset: float) -> list[dict[str, Any]]:
        """Extremes of the outputs at an offset (m). Raises SimulationError when no equilibrium is found."""
        if offset in self.lost:
            raise SimulationError(self.lost[offset])
        if offset not in self.rows:
            try:
                found = single(moved(self.scene, offset, self.towards), self.mesh, None)
                self.rows[offset] = found.facts["extremes"]
            except SimulationError as failure:
                self.lost[offset] = str(failure)
                raise
        return self.rows[offset]

    def error_of(self, output: str, offset: float) -> Error:
        """Estimated error of an output at an offset (m), on the prescribed mesh of the scene.

        Raises SimulationError when no equilibrium is found.
        """
        if offset not in self.estimated:
            self.estimated[offset] = run(moved(static(self.scene), offset, self.towards)).facts
        return error_of(output, self.estimated[offset], own_mesh=True)


def moved(scene: Resolved, offset: float, towards: float = 0.0) -> Resolved:
    """The scene at rest, with the riser's top, the platform and the tensioners at an offset (m).

    Raises InputError when the riser's top is not held horizontally in the direction ``towards`` (rad), or the
    solver does not evaluate limits.
    """
    if solver := scene.analysis.solver:
        found = f"the solver {solver!r} does not evaluate limits"
        raise InputError("scene", "analysis.solver", found, "remove it")
    return at_offset(at_rest(scene), offset, towards)


def offset_of(scene: Resolved, towards: float = 0.0) -> float:
    """Offset of the riser's top from the well (m), with the platform in calm water."""
    return float(_place(scene) @ _along(towards))


def _along(towards: float) -> FloatArray:
    """Unit vector (x, y) of a direction (rad), without the rounding of right angles."""
    return np.round([math.cos(towards), math.sin(towards)], EXACT)


def _place(scene: Resolved) -> FloatArray:
    """Position (x, y) of the riser's top above the well (m), with the platform in calm water."""
    place = scene.platform and scene.platform.position
    follows = scene.top.x == "platform" and place
    aside = (place.surge or 0.0, place.sway or 0.0) if follows and place else (0.0, 0.0)
    return np.array([(scene.top.offset or 0.0) + aside[0], aside[1]])


def at_offset(scene: Resolved, offset: float, towards: float = 0.0) -> Resolved:
    """The scene, also in motion, with the riser's top, the platform and the tensioners at an offset (m).

    Raises InputError when the riser's top is not held horizontally, or not in the direction ``towards``
    (rad, from x towards y).
    """
    top, along = scene.top, _along(towards)
    if top.x == "platform" and scene.platform:
        place = _place(scene) + (offset - offset_of(scene, towards)) * along
        position = scene.platform.position or Position()
        position = position.replaced(surge=float(place[0]) - (top.offset or 0.0))
        if along[1]:
            position = position.replaced(sway=float(place[1]))
        return scene.replaced(platform=scene.platform.replaced(position=position))
    if top.x in ("held", "vessel") and not along[1]:
        offset *= float(along[0])
        moved: dict[str, Any] = {"top": top.replaced(offset=offset)}
        about = scene.platform and scene.platform.centre_of_rotation
        # the centre of rotation moves with the platform, which tilts about it
        if scene.platform and about:
            about = about.replaced(x=(about.x or 0.0) + offset - (top.offset or 0.0))
            moved["platform"] = scene.platform.replaced(centre_of_rotation=about)
        return scene.replaced(**moved)
    if top.x in ("held", "vessel"):
        found, allowed = f"{top.x!r} holds offsets along x only", "write `platform`, or omit --towards"
        raise InputError("scene", "top.x", found, allowed)
    allowed = "write `held`, `platform` or `vessel`"
    found = f"{top.x!r} does not hold the riser at an offset" if top.x else "missing, so no offset is held"
    raise InputError("scene", "top.x", found, allowed)


def _fine_enough(scene: Resolved, reach: float, towards: float) -> Mesh:
    """The finest of the meshes that the tolerance requires above the well and at both ends of the search."""
    accuracy = 0.5 * (scene.analysis.accuracy or MOMENT)  # the other half is for the offset itself
    still = scene.replaced(analysis=scene.analysis.replaced(duration=None, accuracy=accuracy))
    meshes, why = [], None
    for offset in (0.0, -reach, reach):
        try:
            refinement = Refinement(moved(still, offset, towards))
            refinement.result()
        except SimulationError as failure:
            why = why or failure
            continue
        meshes.append(refinement.finest_mesh)
    if not meshes and why:
        raise why
    return max(meshes, key=lambda mesh: len(mesh.l0))


def offsets_of(at: AtRest, limit: Limit, reach: float, allowance: Allowed) -> Offsets:
    """The offsets between which one limit is met, with its allowance; arguments as of `offsets`."""
    if missing := lacks(at.scene, limit):
        return Offsets(math.nan, math.nan, ", ".join(missing))
    over = partial(excess, at, limit, allowance)
    first = np.linspace(-reach, reach, NODES).tolist()
    for offset in first:
        with suppress(SimulationError):
            at.extremes(offset)
    if not at.rows:
        return Offsets(math.nan, math.nan, "a static equilibrium")
    try:
        tried = sorted(at.rows)
        best = min(tried, key=over)
        inside = _nearest_to_well(over, at, first, best)
        if over(best) > 0.0:
            inside = _least(over, best, tried)
        if over(inside) > 0.0:
            return Offsets(math.nan, math.nan, _why_none(at, limit, over(inside), best, tried))
        _climb(over, at, first)
        found = Offsets(_edge(over, inside, at, -1), _edge(over, inside, at, 1))
        outside = [one for one in first if one in at.rows and not found.low <= one <= found.high]
        also = min((one for one in outside if over(one) <= 0.0), key=abs, default=math.nan)
        return _if_sure(at, limit, found._replace(also=also))
    except SimulationError as failure:
        return Offsets(math.nan, math.nan, f"a static equilibrium ({failure})")


def _nearest_to_well(over: Callable[[float], float], at: AtRest, first: list[float], best: float) -> float:
    """The first offset (m) nearest to the well at which the limit is met; ``best`` if none meets it.

    Cylinders at their stops pull the riser straight, so a limit on an angle can be met again, and with a
    larger margin, far beyond the offset at which it is reached.
    """
    met = [one for one in first if one in at.rows and over(one) <= 0.0]
    return min(met, key=lambda one: (abs(one), over(one)), default=best)


def _if_sure(at: AtRest, limit: Limit, found: Offsets) -> Offsets:
    """The offsets, unless the prescribed mesh is too coarse for the output at them."""
    if at.scene.analysis.mesh is None:
        return found
    ends = {min(max(end, -at.reach), at.reach) for end in (found.low, found.high)}
    error = max((at.error_of(limit.output, end) for end in ends), key=lambda one: one.size)
    missing = too_coarse(limit, error)
    return Offsets(math.nan, math.nan, missing) if missing else found


def excess(at: AtRest, limit: Limit, allowance: Allowed, offset: float) -> float:
    """Amount by which a limit is exceeded at an offset (m), in the SI unit of its output; below 0: met.

    Raises SimulationError when no equilibrium is found at the offset.
    """
    over, allowed = [], allowance(offset) if callable(allowance) else allowance
    for row in rows_of(at.scene, limit, at.extremes(offset)):
        if found := demand_of(at.scene, limit, [row]):
            added = allowed[row["where"]] if isinstance(allowed, Mapping) else allowed
            over.append(_excess_of(at.scene, limit, found[0], added))
    if not over:
        raise SimulationError(
            f"the static run at an offset of {offset:g} m has no {limit.output}; remove this limit"
        )
    return max(over)


def _excess_of(scene: Resolved, limit: Limit, demand: float, allowance: float) -> float:
    """Excess of a demand at rest, with an allowance; all in one unit."""
    if limit.side == "smallest":
        return limit.allowable + allowance + not_in_demand(scene, limit) - demand
    return demand + allowance - limit.allowable


def _least(over: Callable[[float], float], near: float, tried: list[float]) -> float:
    """Offset (m) at which the excess of a limit is smallest, near the best offset that was tried."""
    k = tried.index(near)
    ends = tried[max(k - 1, 0)], tried[min(k + 1, len(tried) - 1)]
    return float(minimize_scalar(over, bounds=ends, method="bounded", options={"xatol": CLOSE}).x)


def _why_none(at: AtRest, limit: Limit, least: float, best: float, tried: list[float]) -> str:
    """What is missing to know an offset at which a limit is met; empty if it is exceeded at every offset.

    ``least``: the smallest excess that was found, near the best offset (m) of all that were tried.
    """
    k = tried.index(best)
    low, _, high = [-math.inf, *tried, math.inf][k : k + 3]
    for offset, why in at.lost.items():
        if low < offset < high:  # the limit may be met before it
            return f"a static equilibrium ({why})"
    mud = not_in_demand(at.scene, limit)
    return taken_by(mud) if least <= mud else ""


def _climb(over: Callable[[float], float], at: AtRest, first: list[float]) -> None:
    """Try further offsets where a limit that is met at neighbouring offsets may be exceeded between them.

    The excess may have a maximum there: the smallest tension is least about where the riser is upright. The
    maximum exceeds the largest of three values by at most the difference to the smallest one, if the excess
    rises less steeply between them than before.
    """
    tried = [one for one in first if one in at.rows]
    values = [over(one) for one in tried]
    for k, top in enumerate(values):
        near = slice(max(k - 1, 0), k + 2)
        if max(values[near]) > top or top > 0.0 or 2.0 * top <= min(values[near]):
            continue
        ends = tried[near][0], tried[near][-1]
        if any(ends[0] < gone < ends[1] for gone in at.lost):
            continue  # an interval that reaches it is not evaluated
        minimize_scalar(lambda x: -over(x), bounds=ends, method="bounded", options={"xatol": CLOSE})


def _edge(over: Callable[[float], float], inside: float, at: AtRest, side: int) -> float:
    """The first offset (m) to a side of ``inside`` at which a limit is reached; infinite if it is not.

    Raises SimulationError when an offset before that has no equilibrium.
    """
    last = inside
    for offset in sorted([*at.rows, *at.lost], key=lambda one: side * one):
        if side * (offset - inside) <= 0.0:
            continue
        if over(offset) > 0.0:
            return float(brentq(over, last, offset, xtol=CLOSE))
        last = offset
    return side * math.inf
