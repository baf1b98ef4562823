"""Run a scene at the accuracy asked for: refine mesh and step until the estimated error is below it."""

from __future__ import annotations

import math
import time as clock

import numpy as np

from riserstudy.errors import SimulationError
from riserstudy.mesh import COARSEST, Mesh, even, graded
from riserstudy.result import Result
from riserstudy.scene.models import Scene
from riserstudy.settle import settle
from riserstudy.single import single

DISPLACEMENT, MOMENT = 0.002, 0.01  # default accuracy
REFINEMENTS = 6  # halvings of mesh and step, at most
STEPS_A_PERIOD = 48  # of the coarsest step


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
    a = scene.analysis
    if a.mesh is not None:
        result = single(scene, even(scene, a.mesh.elements), a.step)
        if a.mesh.elements > 1 or a.step:
            other = even(scene, max(1, a.mesh.elements // 2))
            result.facts["error_estimate"] = _estimate_aside(scene, other, a.step, result)
    else:
        result = _refined(scene)
    result.facts["wall_seconds"] = clock.perf_counter() - started
    return result


def _estimate_aside(scene: Scene, mesh: Mesh, step: float | None, fine: Result) -> dict[str, float]:
    explicit = scene.analysis.method == "explicit"
    try:
        coarse = single(scene, mesh, 2.0 * step if step and not explicit else step)
    except SimulationError:
        fine.facts["warnings"].append("no error estimate: the coarser run cannot be completed")
        return {}
    return difference(coarse, fine)


def _refined(scene: Scene) -> Result:
    a = scene.analysis
    target = {"displacement": a.accuracy or DISPLACEMENT, "moment": a.accuracy or MOMENT}
    target["tension"] = target["moment"]
    mesh = _first_mesh(scene)
    step = _first_step(scene)
    coarse = single(scene, mesh, step)
    cost = coarse.facts["solve_seconds"]
    for _ in range(REFINEMENTS):
        mesh = mesh if massless(scene) else mesh.halved()
        step = 0.5 * step if step else None
        fine = single(scene, mesh, step)
        cost += fine.facts["solve_seconds"]
        estimate = difference(coarse, fine)
        fine.facts["error_estimate"] = estimate
        if all(estimate.get(name, 0.0) <= limit for name, limit in target.items()):
            break
        coarse = fine
    else:
        worst = ", ".join(f"{name} {100 * value:.2g} %" for name, value in estimate.items())
        fine.facts["warnings"].append(
            f"accuracy not reached after {REFINEMENTS} refinements: {worst} estimated"
        )
    fine.facts["solve_seconds"] = cost
    return fine


def _first_mesh(scene: Scene) -> Mesh:
    """Coarse mesh, graded where held ends confine bending to a layer sqrt(EI/T)."""
    if not scene.lateral:
        return even(scene, len(scene.riser) if massless(scene) else COARSEST)
    probe = even(scene, COARSEST)
    model, _ = settle(scene, probe)
    layers = []
    for end in (0, -1):
        rotation = (scene.bottom if end == 0 else scene.top).rotation
        flexible = model.s.flex_up[end] > 0.0 and rotation not in (None, "free")
        tension = float(np.abs(model.s.segment[:, end] @ model.s.tangent[:, end]))
        stiff = probe.l0[end] / (6.0 * model.s.flex_up[end]) if flexible else 0.0
        layers.append(math.sqrt(stiff / tension) if flexible and tension > 0 else math.inf)
    return graded(scene, (layers[0], layers[1]))


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


def difference(coarse: Result, fine: Result) -> dict[str, float]:
    """Estimated relative error of the finer of two runs, by quantity, for second-order convergence."""
    s0, s1 = coarse.arrays["s_node"], fine.arrays["s_node"]
    estimate = {}
    for name, fields in (
        ("displacement", ("x", "z")),
        ("tension", ("effective_tension",)),
        ("moment", ("bending_moment",)),
    ):
        scale, off = 0.0, 0.0
        for quantity in fields:
            for end in ("_max", "_min", "_static"):
                if quantity + end not in fine.arrays:
                    continue
                low, up = coarse.arrays[quantity + end], fine.arrays[quantity + end]
                zero = fine.arrays["zero_" + quantity] if name == "displacement" else 0.0
                zero0 = coarse.arrays["zero_" + quantity] if name == "displacement" else 0.0
                up, low = up - zero, low - zero0
                scale = max(scale, float(np.abs(up).max()))
                off = max(off, float(np.abs(np.interp(s0, s1, up) - low).max()))
        rounding = 1e-9 * float(s1[-1]) if name == "displacement" else 0.0
        if scale > rounding:
            estimate[name] = off / scale / 3.0
    return estimate
