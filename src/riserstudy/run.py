"""Run a scene: statics, then time stepping, with its audit; refine until the accuracy asked for.

Arrays in plain dictionaries come out; `simulate` labels them.
"""

from __future__ import annotations

import math
import time as clock
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.build import build, gas_force, linear_law, stiffness
from riserstudy.diagnose import suspect
from riserstudy.errors import SimulationError
from riserstudy.mesh import COARSEST, Mesh, even, graded
from riserstudy.model import Model
from riserstudy.scene.analysis import GeneralisedAlpha, Newmark
from riserstudy.scene.ends import Top
from riserstudy.scene.models import Scene
from riserstudy.solve.evaluate import energies, move_to
from riserstudy.solve.explicit import leapfrog
from riserstudy.solve.implicit import DONE, Method, generalised_alpha, march, new_ledger
from riserstudy.solve.modes import stable_step
from riserstudy.solve.record import Record, evaluate_once, new_record
from riserstudy.solve.statics import (
    Equilibrium,
    NoEquilibrium,
    find_equilibrium,
    unstable_directions,
)

FloatArray = NDArray[np.float64]
DISPLACEMENT, MOMENT = 0.002, 0.01  # default accuracy
RHO_INF = 0.8  # default spectral radius
NEWTON = 1e-9  # default tolerance of a correction, in riser lengths
REFINEMENTS = 6  # halvings of mesh and step, at most
STEPS_A_PERIOD = 48  # of the coarsest step
EXPLICIT_BOUND = 1e12  # sum of squared velocities (m2/s2) that no riser reaches
UNEXPLAINED = 1e-3  # share of the energy exchanged that may stay unexplained


@dataclass
class Result:
    """Arrays of one run by name, facts about it, and warnings."""

    arrays: dict[str, FloatArray]
    facts: dict[str, Any] = field(default_factory=dict)


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
    """Whether the string is a mere spring."""
    return all(s.mass is None and s.submerged_weight is None for s in scene.riser)


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
        if scale > 0.0:
            estimate[name] = off / scale / 3.0
    return estimate


def settle(scene: Scene, mesh: Mesh, planar: bool | None = None) -> tuple[Model, Equilibrium]:
    """Model at static equilibrium.

    Raises
    ------
    SimulationError
        When there is none to be found.
    """
    top = scene.top
    elevation = None
    before = None
    if top.held_at_tension is not None:
        free = Top(x=top.x, z="free", offset=top.offset, rotation=top.rotation)
        before = free.model_copy(update={"tension": top.held_at_tension, "body": top.body})
    elif top.tensioners and top.tensioners.mid_stroke == "riser in equilibrium":
        rig = top.tensioners
        each = float(gas_force(rig.gas, np.zeros(1))[0]) if rig.gas else linear_law(rig)[0]
        before = top.model_copy(update={"tensioners": None, "tension": rig.count * each})
    if before is not None:
        first, _ = _equilibrium(scene.model_copy(update={"top": before}), mesh, None, planar)
        elevation = float(first.s.r[-1, -1])
    return _equilibrium(scene, mesh, elevation, planar)


def _equilibrium(
    scene: Scene, mesh: Mesh, elevation: float | None, planar: bool | None
) -> tuple[Model, Equilibrium]:
    model = build(scene, mesh, elevation, planar)
    current = any(effect.name == "current" for effect in model.effects)
    tolerance = 1e-10 * float(mesh.l0.sum())
    try:
        found = find_equilibrium(model.programs, model.state, model.fixed, tolerance, current)
    except NoEquilibrium as failure:
        s = float(mesh.s[failure.node])
        raise SimulationError(
            f"no static equilibrium: {failure.residual:.3g} N are left at node {failure.node} "
            f"(s = {s:.4g} m) with {failure.load:.0%} of the current; "
            "the riser may lack tension or a support: check top tension, weights and what holds the ends"
        ) from None
    if not model.s.r[-1, -1] > model.s.r[-1, 0] and elevation is None and scene.top.z == "free":
        raise SimulationError(
            "the riser falls over: its top comes to rest below its bottom; "
            "the top tension does not carry its weight"
        )
    if found.unstable or not _stands_sideways(scene, mesh, model, elevation):
        raise SimulationError(
            "the static equilibrium is unstable, with lateral freedom counted: "
            "the riser buckles under its own weight; raise the top tension or hold the ends"
        )
    return model, found


def _stands_sideways(scene: Scene, mesh: Mesh, model: Model, elevation: float | None) -> bool:
    """Whether an axial model in compression would also stand if it could move sideways."""
    s = model.s
    tension = np.einsum("ke,ke->e", s.segment, s.tangent)
    if len(s.dim) > 1 or float(tension.min()) >= -_rounding(scene):
        return True
    top = scene.top if scene.top.x else scene.top.model_copy(update={"x": "held"})
    planar = build(scene.model_copy(update={"top": top}), mesh, elevation, planar=True)
    planar.s.r[1] = s.r[0]
    return unstable_directions(planar.programs, planar.state, planar.fixed) == 0


def _rounding(scene: Scene) -> float:
    """Compression that a weightless riser may show by rounding (N)."""
    return 1e-9 * max(stiffness(section).axial for section in scene.riser)


def single(scene: Scene, mesh: Mesh, step: float | None) -> Result:
    """One run on a given mesh and step, without error estimate."""
    started = clock.perf_counter()
    model, equilibrium = settle(scene, mesh)
    state = model.s
    arrays = {"s_node": mesh.s, "l0": mesh.l0}
    names = quantities(model)
    static, probe = _tabulated(model)
    for k, name in enumerate(names):
        arrays[name + "_static"] = static[k]
    if scene.top.tensioners:
        arrays["tensioner_stroke_static"], arrays["tensioner_force_static"] = np.split(probe, 2)
    arrays["zero_z"] = state.r[-1].copy()
    if "x" in names:
        arrays["zero_x"] = np.zeros(len(mesh.s))
    facts: dict[str, Any] = {
        "effects": {e.name: e.because for e in model.effects},
        "elements": len(mesh.l0),
        "directions": len(state.dim),
        "statics_iterations": equilibrium.iterations,
        "warnings": [],
    }
    if scene.analysis.duration is not None and step is not None:
        _march(scene, model, mesh, step, arrays, facts)
    _check_finite(arrays)
    _check_tension(scene, arrays, facts)
    facts["solve_seconds"] = clock.perf_counter() - started
    return Result(arrays, facts)


def quantities(model: Model) -> list[str]:
    """Names of the quantities that a record holds, in its order."""
    d, m = len(model.s.dim), len(model.s.dof) - len(model.s.dim)
    moments = {0: [], 1: ["bending_moment"]}[m]
    return [*(["x", "z"] if d == 2 else ["z"]), "effective_tension", *moments]


def _tabulated(model: Model) -> tuple[FloatArray, FloatArray]:
    """Quantities at the nodes at rest, and what devices report."""
    state, own = model.spare.value, model.s
    state.r[:], state.moment[:], state.clock[:] = own.r, own.moment, own.clock
    state.v[:] = 0.0
    state.a[:] = 0.0
    record = new_record([state.clock[0]], [0], state)
    evaluate_once(model.programs, model.spare, record)
    return record.values.copy(), record.probe[0].copy()


def _march(
    scene: Scene,
    model: Model,
    mesh: Mesh,
    step: float,
    arrays: dict[str, FloatArray],
    facts: dict[str, Any],
) -> None:
    a = scene.analysis
    if a.duration is None or a.output is None:
        return
    state = model.s
    reach_at_rest = state.reach.copy()
    top_at_rest = float(state.r[-1, -1])
    if a.start == "unstretched":
        bottom = state.r[-1, 0]
        state.r[-1] = bottom + mesh.s
        move_to(model.programs, model.state, 0.0)
    count = max(1, math.ceil(a.duration / step * (1.0 - 1e-9)))
    step = a.duration / count
    times = _times(a.output.start or 0.0, a.duration, a.output.interval)
    stations = _stations(mesh, a.output.stations)
    record = new_record(times, stations, state)
    ledger = new_ledger()
    before = sum(energies(model.programs, model.state))
    if a.method == "explicit":
        limit = stable_step(model.programs, model.state, model.fixed)
        if step > limit:
            raise SimulationError(
                f"analysis.step {step:.4g} s is above the stable step {limit:.4g} s of explicit "
                f"stepping on {len(mesh.l0)} segments; take a smaller step, fewer segments, or an "
                "implicit method"
            )
        outcome = leapfrog(
            model.programs,
            model.state,
            model.spare,
            step,
            count,
            EXPLICIT_BOUND,
            model.fixed,
            record,
            ledger,
        )
        facts["stable_step"] = limit
    else:
        method = _method(scene, mesh, step, count)
        outcome = march(
            model.programs, model.state, model.spare, method, model.fixed, record, ledger
        )
    if outcome != DONE:
        raise SimulationError(_why(model, mesh, ledger, step))
    after = sum(energies(model.programs, model.state))
    _audit(facts, ledger, before, after, step)
    names = quantities(model)
    arrays["time"] = record.time
    arrays["s"] = mesh.s[stations]
    for k, name in enumerate(names):
        arrays[name] = record.history[:, k, :]
        arrays[name + "_max"] = record.largest[k]
        arrays[name + "_min"] = record.smallest[k]
    _angles(scene, model, mesh, record, arrays)
    if scene.top.tensioners:
        c = scene.top.tensioners.count
        arrays["tensioner_stroke"] = record.probe[:, :c]
        arrays["tensioner_force"] = record.probe[:, c:]
        arrays["stroke"] = record.probe[:, 0] - reach_at_rest[0]
        facts["largest_stroke"] = float(np.abs(record.probe[:, :c]).max())
    elif scene.platform and scene.top.z == "free" and record.station[-1] == len(mesh.l0):
        z = record.history[:, len(state.dim) - 1, -1]
        arrays["stroke"] = record.platform[:, 2] - (z - top_at_rest)


def _method(scene: Scene, mesh: Mesh, step: float, count: int) -> Method:
    a = scene.analysis
    tolerance = (a.newton_tolerance or NEWTON) * float(mesh.l0.sum())
    if isinstance(a.method, Newmark):
        parameters = (0.0, 0.0, a.method.beta, a.method.gamma)
    else:
        rho = a.method.rho_inf if isinstance(a.method, GeneralisedAlpha) else RHO_INF
        parameters = generalised_alpha(rho)
    return Method(*parameters, step, count, tolerance, iterations=12, halvings=6)


def _times(start: float, end: float, interval: float) -> FloatArray:
    count = math.floor((end - start) / interval * (1.0 + 1e-12) + 1e-9)
    return np.asarray(start + interval * np.arange(count + 1), np.float64)


def _stations(mesh: Mesh, wanted: list[float] | None) -> NDArray[np.int64]:
    if wanted is None:
        return np.arange(len(mesh.s))
    return np.array([int(np.abs(mesh.s - s).argmin()) for s in wanted])


def _angles(
    scene: Scene, model: Model, mesh: Mesh, record: Record, arrays: dict[str, FloatArray]
) -> None:
    """Angles of the riser's end tangents: against the lower stack, and the platform's vertical."""
    if len(model.s.dim) == 1:
        return
    m = len(model.s.dof) - 2
    angle = np.arctan2(record.end[:, :, 0], record.end[:, :, 1])
    if m:  # from the middle of the end segment to its end, curvature varying linearly
        for k, (end, sign) in enumerate(((0, -1.0), (-1, 1.0))):
            bending = stiffness(scene.riser[mesh.section[end]]).bending
            turned = mesh.l0[end] / bending * (record.end[:, k, 2] / 3 + record.end[:, k, 3] / 6)
            angle[:, k] += sign * turned
    if scene.bottom.hold == "wellhead":
        arrays["lfj_angle"] = angle[:, 0]
    if scene.platform and scene.top.x == "platform":
        arrays["ufj_angle"] = angle[:, 1] - record.platform[:, 4]


def _audit(facts: dict[str, Any], ledger: Any, before: float, after: float, step: float) -> None:
    held, supplied, dissipated, numerical, exchanged = (float(x) for x in ledger.work)
    residual = held + supplied - dissipated - numerical - (after - before)
    scale = max(exchanged, abs(after - before), 1e-300)
    facts["step"] = step
    facts["audit"] = {
        "work_of_supports": held,
        "work_of_water_and_devices": supplied,
        "dissipated": dissipated,
        "numerically_dissipated": numerical,
        "stored": after - before,
        "exchanged": exchanged,
        "unexplained": residual,
        "unexplained_share": abs(residual) / scale,
    }
    facts["steps"] = int(ledger.count[0])
    facts["newton_iterations"] = int(ledger.count[1])
    facts["halved_steps"] = int(ledger.count[2])
    if abs(residual) > UNEXPLAINED * scale:
        facts["warnings"].append(
            f"energy: {abs(residual) / scale:.2g} of what was exchanged is unexplained; "
            "refine mesh and step"
        )


def _check_finite(arrays: dict[str, FloatArray]) -> None:
    """Nothing undefined leaves the solver."""
    for name, values in arrays.items():
        if not np.isfinite(values).all():
            raise SimulationError(
                f"{name} is not finite in {int((~np.isfinite(values)).sum())} places although every "
                "step converged; please report the scene"
            )


def _check_tension(scene: Scene, arrays: dict[str, FloatArray], facts: dict[str, Any]) -> None:
    tension = arrays.get("effective_tension_min", arrays["effective_tension_static"])
    k = int(tension.argmin())
    facts["smallest_tension"] = float(tension[k])
    facts["smallest_tension_s"] = float(arrays["s_node"][k])
    if facts["directions"] == 1 and tension[k] < -_rounding(scene):
        facts["warnings"].append(
            f"effective tension falls to {tension[k]:.3g} N at s = {arrays['s_node'][k]:.4g} m: "
            "a riser free to move sideways would go slack or buckle; this run has no lateral freedom"
        )


def _why(model: Model, mesh: Mesh, ledger: Any, step: float) -> str:
    """What to tell about a step that failed."""
    time, node, size = ledger.failure
    how = "Newton's iteration did not converge even after halving the step"
    if ledger.count[3]:
        how = "velocities grow without bound"
    return (
        f"stopped at t = {time:.6g} s, node {int(node)} (s = {mesh.s[int(node)]:.4g} m), last correction "
        f"{size:.3g} m: {how}; largest force there: "
        f"{suspect(model, int(node))}. Take a smaller step, a ramp for sudden motions, or check "
        "stroke and tension"
    )
