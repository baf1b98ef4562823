"""Run a scene at the accuracy asked for: refine mesh and step until the estimated error is below it."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from riserstudy.build import stiffness
from riserstudy.devices import pile_length
from riserstudy.errors import PhysicallyUnstable, SimulationError, StepFailed
from riserstudy.mesh import COARSEST, Layer, Mesh, even, graded
from riserstudy.result import Result
from riserstudy.scene.models import Scene
from riserstudy.sea import depth_of_action
from riserstudy.settle import settle
from riserstudy.single import EVERYWHERE, keep_stations, single

Array = NDArray[np.float64]
Arrays = dict[str, Array]

DISPLACEMENT, MOMENT = 0.002, 0.01  # default accuracy
LONG = 80.0  # risers, in layer lengths, whose even mesh would be too coarse at ends
RUNS = 16  # halvings of mesh or step, at most
MOST_FALL = 8.0  # of successive differences that an estimate trusts
STEPS_A_PERIOD = 24  # of the coarsest step


def run(scene: Scene) -> Result:
    """Simulate a scene.

    With mesh and step in the scene they are used, and a run on half as many segments and twice the step
    tells the error. Otherwise mesh and step are halved until the estimated error of displacement and
    moment is below the accuracy asked for.

    Raises
    ------
    SimulationError
        When no equilibrium is found or a step fails: time, node, effect and remedy.
    """
    started = clock.perf_counter()
    result = _refined(scene) if scene.analysis.mesh is None else _as_asked(scene)
    result.facts["wall_seconds"] = clock.perf_counter() - started
    return result


def _as_asked(scene: Scene) -> Result:
    """A run with the scene's own mesh and step; its error from two coarser runs."""
    a = scene.analysis
    elements = a.mesh.elements if a.mesh else 1
    result = single(scene, even(scene, elements), a.step)
    if elements == 1 and not a.step:
        return result
    runs = [result]
    for k in (2, 4):
        step = k * a.step if a.step and a.method != "explicit" else a.step
        try:
            runs.insert(0, single(scene, even(scene, max(1, elements // k)), step, EVERYWHERE))
        except SimulationError:  # a coarse mesh may buckle, a long step fail
            break
    if len(runs) == 1:
        result.facts["warnings"].append("no error estimate: the coarser run cannot be completed")
        result.facts["error_estimate"] = {}
        return result
    result.facts["error_estimate"] = estimate(
        difference(*runs[-2:]), difference(*runs[:2]) if len(runs) > 2 else None
    )
    return result


def _refined(scene: Scene) -> Result:
    """Refine mesh or step, whichever errs more, until both errors together are below what is asked for.

    Every run is compared with the one before, which differs in mesh or in step alone.
    """
    a = scene.analysis
    target = {"displacement": a.accuracy or DISPLACEMENT, "moment": a.accuracy or MOMENT}
    target["tension"] = target["moment"]
    mesh, step = _first_mesh(scene), _first_step(scene)
    ways = [] if massless(scene) else ["mesh"]
    ways += ["step"] if step else []
    if not ways:  # a massless spring at rest is exact
        return single(scene, mesh, step)
    before: dict[str, dict[str, float]] = {}
    error: dict[str, dict[str, float]] = {}
    cost, way, astray = 0.0, ways[0], 0
    result: Result | None = None
    for left in range(RUNS, -1, -1):
        try:
            finer = single(scene, mesh, step, EVERYWHERE)
        except StepFailed:
            if left == 0 or step is None:
                raise
            step, result = 0.5 * step, None
            continue
        except PhysicallyUnstable:
            raise
        except SimulationError:  # no equilibrium found on this mesh
            astray += 1
            if astray > 2 or "mesh" not in ways:
                raise
            mesh, result = mesh.halved(), None
            continue
        cost += finer.facts["solve_seconds"]
        if result is not None:
            now = difference(result, finer)
            error[way] = estimate(now, before.get(way))
            before[way] = now
        result = finer
        total = {name: sum(e.get(name, 0.0) for e in error.values()) for name in target}
        finer.facts["error_estimate"] = {k: v for k, v in total.items() if k in before.get(way, {})}
        unknown = [w for w in ways if w not in error]
        if not unknown and all(total[name] <= limit for name, limit in target.items()):
            break
        way = unknown[0] if unknown else max(ways, key=lambda w: _excess(error[w], target))
        mesh = mesh.halved() if way == "mesh" else mesh
        step = 0.5 * step if step and way == "step" else step
    else:
        worst = ", ".join(f"{name} {100 * value:.2g} %" for name, value in total.items())
        finer.facts["warnings"].append(
            f"accuracy not reached after {RUNS} refinements: {worst} estimated"
        )
    finer.facts["solve_seconds"] = cost
    keep_stations(finer, a.output.stations if a.output else None)
    return finer


def _excess(error: dict[str, float], target: dict[str, float]) -> float:
    return max(error.get(name, 0.0) / limit for name, limit in target.items())


def _first_mesh(scene: Scene) -> Mesh:
    """Coarse mesh, graded where held ends confine bending to a layer sqrt(EI/T), and under waves."""
    if not scene.lateral:
        return even(scene, len(scene.riser) if massless(scene) else COARSEST)
    probe = even(scene, COARSEST)
    for left in (2, 1, 0):
        try:
            model, _ = settle(scene, probe)
            break
        except PhysicallyUnstable:
            raise
        except SimulationError:  # so coarse a mesh may have no equilibrium
            if left == 0:
                raise
            probe = probe.halved()
    layers = []
    for end in (0, probe.ring - 1):
        rotation = (scene.bottom if end == 0 else scene.top).rotation
        held = rotation not in (None, "free") or (end > 0 and probe.joint)
        flexible = model.s.flex_up[end] > 0.0
        tension = float(np.abs(model.s.segment[:, end] @ model.s.tangent[:, end]))
        share = 6.0 if held else 12.0  # of a segment's flexibility, see `bending`
        stiff = probe.l0[end] / (share * model.s.flex_up[end]) if flexible else 0.0
        layer = math.sqrt(stiff / tension) if flexible and tension > 0 else math.inf
        # a short riser's even mesh is fine enough for an end that turns freely, and of higher order
        layers.append(layer if held or probe.riser_length > LONG * layer else math.inf)
    if scene.wave and scene.water:
        layers[1] = min(layers[1], depth_of_action(scene.wave, scene.water, scene.gravity or 0.0))
    found = [Layer(0.0, layers[0]), Layer(probe.riser_length, layers[1])]
    for k, section in enumerate(scene.riser):
        if section.flex_joint_below:
            e = probe.foot(k)
            tension = float(np.abs(model.s.segment[:, e] @ model.s.tangent[:, e]))
            length = math.sqrt(stiffness(section).bending / tension) if tension else math.inf
            found.append(Layer(float(probe.s[e]), length))
    longest = {}
    if scene.soil:
        conductor = scene.riser[0]
        longest[0] = 0.5 * pile_length(scene.soil, conductor, stiffness(conductor).bending)
    confined = longest or any(layer.length < math.inf for layer in found)
    return graded(scene, found, longest=longest) if confined else probe


def massless(scene: Scene) -> bool:
    """Whether the string is a mere spring, which one segment represents exactly."""
    bare = all(s.mass is None and s.submerged_weight is None for s in scene.riser)
    return bare and not scene.lateral


def _first_step(scene: Scene) -> float | None:
    if scene.analysis.duration is None:
        return None
    period = scene.shortest_period
    if period is None:
        period = min(20.0, scene.analysis.duration / 4.0)
    return period / STEPS_A_PERIOD


def estimate(now: dict[str, float], before: dict[str, float] | None) -> dict[str, float]:
    """Error of the finest of three runs, each twice as fine as the last, from their differences.

    Where differences fall by a factor q, what is left is 1 / (q - 1) of the last; q is taken as at most
    8 (third order), and as 2 where it is smaller or unknown.
    """
    error = {}
    for name, value in now.items():
        fall = (before or {}).get(name, 0.0) / value if value > 0.0 else MOST_FALL
        error[name] = value / (min(max(fall, 2.0), MOST_FALL) - 1.0)
    return error


def difference(coarse: Result, fine: Result) -> dict[str, float]:
    """Relative difference of two runs, by quantity.

    Envelopes and the static state are compared at all nodes, histories at the stations, so that an
    error in phase counts too. The scale is the largest value anywhere.
    """
    found = {}
    for name, fields in (
        ("displacement", ("x", "y", "z")),
        ("tension", ("effective_tension",)),
        ("moment", ("bending_moment",)),
    ):
        scale, off = 0.0, 0.0
        for field in fields:
            for low, up in _pairs(coarse.arrays, fine.arrays, field):
                scale = max(scale, float(np.abs(up).max()))
                off = max(off, float(np.abs(up - low).max()))
        rounding = 1e-9 * float(fine.arrays["s_node"][-1]) if name == "displacement" else 0.0
        if scale > rounding:
            found[name] = off / scale
    return found


def _pairs(coarse: Arrays, fine: Arrays, field: str) -> Iterator[tuple[Array, Array]]:
    """The same values of both runs: envelopes, static state, histories; displacements from straight."""
    s0, s1 = coarse["s_node"], fine["s_node"]
    zero0, zero1 = (a.get("zero_" + field, np.zeros_like(a["s_node"])) for a in (coarse, fine))
    for end in ("_max", "_min", "_static"):
        if field + end in fine:
            yield coarse[field + end] - zero0, np.interp(s0, s1, fine[field + end] - zero1)
    if field in fine and "time" in coarse:
        mine, yours = coarse["s"], fine["s"]
        _, here, there = np.intersect1d(
            np.round(mine, 6), np.round(yours, 6), assume_unique=False, return_indices=True
        )
        if len(here):
            low = coarse[field][:, here] - np.interp(mine[here], s0, zero0)
            yield low, fine[field][:, there] - np.interp(yours[there], s1, zero1)
        else:  # no station on a node of the coarse mesh
            low = make_interp_spline(mine, coarse[field] - zero0, k=min(3, len(mine) - 1), axis=1)
            yield low(yours), fine[field] - np.interp(yours, s1, zero1)
