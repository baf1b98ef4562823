"""One run of a scene on a given mesh and step: statics, time stepping, audit.

Arrays in plain dictionaries come out; `simulation` labels them.
"""

from __future__ import annotations

import math
import time as clock
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError, StepFailed
from riserstudy.model.layout import AXES, stiffness
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.model.tensioner_law import leaves_table, stops_touched
from riserstudy.scene.models import Scene
from riserstudy.scene.tensioners import Tensioners
from riserstudy.scene.vessel import Coupling
from riserstudy.simulation.coupling import march_in_turns, sides_of
from riserstudy.simulation.equilibrium import rounding, settle
from riserstudy.simulation.failure import suspect
from riserstudy.simulation.hermite_run import solve_small_angle
from riserstudy.simulation.stable_step import explicit_limit
from riserstudy.simulation.time_stepping import march_on, method_of, steps_in
from riserstudy.solve.evaluate import energies, move_to
from riserstudy.solve.explicit import leapfrog
from riserstudy.solve.record import Record, evaluate_once, new_record
from riserstudy.solve.sums import DONE, EVALUATIONS, HALVED, ITERATIONS, STEPS, new_sums

FloatArray = NDArray[np.float64]
EXPLICIT_BOUND = 1e12  # sum of squared velocities (m2/s2) that no riser reaches
EVERYWHERE = "everywhere"  # histories at all nodes
UNEXPLAINED = 1e-3  # share of the energy exchanged that may stay unexplained


def single(scene: Scene, mesh: Mesh, step: float | None, stations: str = "asked for") -> Result:
    """One run on a given mesh and step, without error estimate; histories at ``stations``, or EVERYWHERE."""
    if scene.analysis.solver == "hermite":
        return solve_small_angle(scene, mesh, step)
    started = clock.perf_counter()
    model, equilibrium = settle(scene, mesh)
    state = model.s
    arrays = {"s_node": mesh.s, "l0": mesh.l0}
    names = quantities(model)
    static, probe = _tabulated(model)
    for k, name in enumerate(names):
        arrays[name + "_static"] = static[k]
    if scene.top.tensioners:
        arrays["tensioner_stroke_static"], arrays["tensioner_force_static"] = np.split(
            probe[: 2 * scene.top.tensioners.count], 2
        )
    arrays["zero_z"] = state.r[-1, : len(mesh.s)].copy()
    for name in "xy":
        if name in names:
            arrays["zero_" + name] = np.zeros(len(mesh.s))
    facts: dict[str, Any] = {
        "effects": {e.name: e.because for e in model.effects},
        "elements": len(mesh.l0),
        "directions": len(state.dim),
        "statics_iterations": equilibrium.iterations,
        "warnings": [],
    }
    if scene.vessel:
        facts["coupling"] = {"scheme": "as one"}
    if scene.analysis.duration is not None and step is not None:
        _march(scene, model, mesh, step, stations, arrays, facts)
    _check_finite(arrays)
    _check_tension(scene, arrays, facts)
    if scene.top.tensioners:
        facts["warnings"] += leaves_table(scene.top.tensioners, _reaches(arrays))
        facts["warnings"] += _stops(scene.top.tensioners, arrays)
    facts["solve_seconds"] = clock.perf_counter() - started
    return Result(arrays, facts)


def _reaches(arrays: dict[str, FloatArray]) -> FloatArray:
    """Reach of all cylinders, at rest and whenever it was recorded."""
    names = ("tensioner_stroke_static", "tensioner_stroke")
    return np.concatenate([arrays[name].ravel() for name in names if name in arrays])


def _stops(rig: Tensioners, arrays: dict[str, FloatArray]) -> list[str]:
    """What there is to tell of the end stops, at rest and over time."""
    told = stops_touched(rig, arrays["tensioner_stroke_static"])
    if "tensioner_stroke" in arrays:
        told += stops_touched(rig, arrays["tensioner_stroke"], arrays["time"])
    return told


def quantities(model: Model) -> list[str]:
    """Names of the quantities that a record holds, in its order."""
    d = len(model.s.dim)
    places = ["xyz"[axis] for axis in AXES[d]]
    return [*places, "effective_tension", *(["bending_moment"] if len(model.s.dof) > d else [])]


def _tabulated(model: Model) -> tuple[FloatArray, FloatArray]:
    """Quantities at the nodes at rest, and what devices report."""
    state, own = model.spare.value, model.s
    state.r[:], state.moment[:], state.clock[:] = own.r, own.moment, own.clock
    state.platform[:], state.deck[:] = own.platform, own.deck
    state.v[:] = 0.0
    state.a[:] = 0.0
    record = new_record([state.clock[0]], [0], state)
    evaluate_once(model.programs, model.spare, record)
    return record.value.values.copy(), record.value.probe[0].copy()


def _march(
    scene: Scene,
    model: Model,
    mesh: Mesh,
    step: float,
    where: str,
    arrays: dict[str, FloatArray],
    facts: dict[str, Any],
) -> None:
    a = scene.analysis
    if a.duration is None or a.output is None:
        return
    coupling = scene.vessel and scene.vessel.coupling
    if coupling:
        steps = steps_in(coupling.interval, step)
        sides = sides_of(scene, model, steps)
        model, step = sides.riser, coupling.interval / steps
    state = model.s
    reach_at_rest = state.reach.copy()
    top = len(mesh.l0)
    joint_at_rest = float(np.linalg.norm(state.r[:, top] - state.r[:, top - 1]))
    top_at_rest = float(state.r[-1, top])
    if a.start == "unstretched":
        bottom = state.r[-1, 0]
        state.r[-1, : top + 1] = bottom + mesh.s
    if a.start == "undeflected":
        still, _ = settle(scene.model_copy(update={"current": None}), mesh, len(state.dim))
        state.r[:], state.moment[:] = still.s.r, still.s.moment
    move_to(model.programs, model.state, 0.0)
    if not coupling:
        count = steps_in(a.duration, step)
        step = a.duration / count
    times = _times(a.output.start or 0.0, a.duration, a.output.interval)
    stations = _stations(mesh.s, None if where == EVERYWHERE else a.output.stations)
    notes = new_record(times, stations, state)
    sums = new_sums()
    before = sum(energies(model.programs, model.state))
    if coupling:
        turn, _ = method_of(scene, mesh, step, steps)
        outcome, facts["coupling"] = march_in_turns(sides, coupling, turn, a.duration, notes, sums)
    elif a.method == "explicit":
        limit = explicit_limit(scene, model)
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
            notes,
            sums,
        )
        facts["stable_step"] = limit
    else:
        outcome = march_on(scene, model, mesh, step, notes, sums)
    if outcome != DONE:
        raise StepFailed(_why(model, mesh, sums, step))
    after = sum(energies(model.programs, model.state))
    _audit(facts, sums, before, after, step)
    if coupling:
        _account_for_exchange(facts, coupling)
    names, record = quantities(model), notes.value
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
        arrays["tensioner_force"] = record.probe[:, c : 2 * c]
        arrays["stroke"] = record.probe[:, 0] - reach_at_rest[0]
        facts["largest_stroke"] = float(np.abs(record.probe[:, :c]).max())
    elif scene.platform and scene.top.z == "free":
        arrays["stroke"] = record.platform[:, 2] - (record.top[:, -1] - top_at_rest)
    if mesh.joint:
        arrays["stroke"] = record.end[:, 1, -1] - joint_at_rest
    for name, k in model.probes.items():
        arrays[name] = record.probe[:, k]
    if scene.vessel:
        arrays["platform_surge"] = record.top[:, 0] - (scene.top.offset or 0.0)
        turns_aside = len(state.dim) == 3
        if scene.vessel.sway:
            arrays["platform_sway"] = record.top[:, int(turns_aside)] * turns_aside
        if scene.vessel.yaw and not turns_aside:
            arrays["platform_yaw"] = np.zeros(len(record.time))


def _times(start: float, end: float, interval: float) -> FloatArray:
    count = math.floor((end - start) / interval * (1.0 + 1e-12) + 1e-9)
    return np.asarray(start + interval * np.arange(count + 1), np.float64)


def _stations(nodes: FloatArray, wanted: list[float] | None) -> NDArray[np.int64]:
    """The nodes next to the stations."""
    if wanted is None:
        return np.arange(len(nodes))
    return np.array([int(np.abs(nodes - s).argmin()) for s in wanted])


def keep_stations(result: Result, wanted: list[float] | None) -> None:
    """Keep histories only where they are asked for."""
    arrays = result.arrays
    if wanted is None or "s" not in arrays:
        return
    kept = _stations(arrays["s"], wanted)
    for name in ("x", "y", "z", "effective_tension", "bending_moment"):
        if name in arrays:
            arrays[name] = arrays[name][:, kept]
    arrays["s"] = arrays["s"][kept]


def _angles(
    scene: Scene, model: Model, mesh: Mesh, record: Record, arrays: dict[str, FloatArray]
) -> None:
    """Angles of the riser's end tangents: against the lower stack, and the platform's vertical."""
    d = len(model.s.dim)
    if d == 1:
        return
    upwards = np.array([0.0, 0.0, 1.0])
    if scene.bottom.hold == "wellhead":
        arrays["lfj_angle"] = _lean(_end_direction(scene, model, mesh, record, 0), upwards, d)
    if scene.vessel and len(model.s.dof) > d:
        arrays["ufj_angle"] = _lean(_end_direction(scene, model, mesh, record, -1), upwards, d)
    if scene.platform and scene.top.x == "platform":
        turned, upright = record.platform[:, 3:], upwards
        if turned.any():  # rotations take longer than a short run
            upright = Rotation.from_euler("xyz", turned).apply(upwards)
        arrays["ufj_angle"] = _lean(_end_direction(scene, model, mesh, record, -1), upright, d)


def _end_direction(scene: Scene, model: Model, mesh: Mesh, record: Record, end: int) -> FloatArray:
    """Direction of the riser at an end, (time, 3): the end segment's, turned by its own bending."""
    d = len(model.s.dim)
    m = len(model.s.dof) - d
    t = np.zeros((len(record.time), 3))
    t[:, AXES[d]] = record.end[:, end, :d]
    if m == 0:
        return t
    # from the middle of the end segment to its end, curvature varying linearly
    own, far = record.end[:, end, d : d + m], record.end[:, end, d + m : d + 2 * m]
    joint = scene.top.telescopic_joint if end == -1 else None
    stiff = joint.bending_stiffness if joint else stiffness(scene.riser[mesh.section[end]]).bending
    softness = mesh.l0[end] / stiff
    bend = (softness if end == -1 else -softness) * (own / 3.0 + far / 6.0)
    if m == 3:
        return np.asarray(Rotation.from_rotvec(bend).apply(t))
    cosine, sine = np.cos(bend[:, 0]), np.sin(bend[:, 0])
    return np.column_stack(
        [cosine * t[:, 0] + sine * t[:, 2], t[:, 1], cosine * t[:, 2] - sine * t[:, 0]]
    )


def _lean(t: FloatArray, upright: FloatArray, d: int) -> FloatArray:
    """Angle between directions (rad): in a plane from ``upright`` towards +x, in space its size."""
    across = np.cross(np.broadcast_to(upright, t.shape), t)
    size = np.arctan2(np.linalg.norm(across, axis=1), (t * upright).sum(axis=1))
    return np.asarray(size * np.sign(across[:, 1]) if d == 2 else size)


def _audit(facts: dict[str, Any], sums: Any, before: float, after: float, step: float) -> None:
    held, supplied, dissipated, numerical, exchanged = (float(x) for x in sums.work)
    residual = held + supplied - dissipated - numerical - (after - before)
    still = 1e-12 * max(abs(before), abs(after), 1.0)  # rounding of a riser that stays at rest (J)
    scale = max(exchanged, abs(after - before), still / UNEXPLAINED)
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
    facts["steps"] = int(sums.count[STEPS])
    facts["newton_iterations"] = int(sums.count[ITERATIONS])
    facts["halved_steps"] = int(sums.count[HALVED])
    if abs(residual) > UNEXPLAINED * scale:
        facts["warnings"].append(
            f"energy: {abs(residual) / scale:.2g} of what was exchanged is unexplained; "
            "refine mesh and step"
        )


def _account_for_exchange(facts: dict[str, Any], coupling: Coupling) -> None:
    """Name the energy that the exchange made: no support moves where a vessel floats but the told one."""
    audit = facts["audit"]
    made = audit.pop("work_of_supports")
    facts["audit"] = {"work_of_supports": 0.0, "made_by_exchange": made, **audit}
    if coupling.scheme == "staggered":
        share = abs(made) / max(audit["exchanged"], 1e-300)
        facts["warnings"].append(
            f"vessel.coupling: the exchange every {coupling.interval:g} s made {made:.3g} J, {share:.2g} of "
            "what was exchanged; the error estimate knows mesh and step, not the interval"
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
    # a stack and conductor below the riser's flex joint are meant to stand
    lengths = np.cumsum([section.total_length for section in scene.riser])
    joints = [k for k, section in enumerate(scene.riser) if section.flex_joint_below]
    foot = lengths[joints[0] - 1] if joints else 0.0
    k = int(np.where(arrays["s_node"] < foot, np.inf, tension).argmin())
    if facts["directions"] < 3 and tension[k] < -rounding(scene):
        facts["warnings"].append(
            f"effective tension falls to {tension[k]:.3g} N at s = {arrays['s_node'][k]:.4g} m: "
            "a riser may go slack or buckle there; this run has "
            + ("no lateral freedom" if facts["directions"] == 1 else "no freedom out of its plane")
        )


def _why(model: Model, mesh: Mesh, sums: Any, step: float) -> str:
    """What to tell about a step that failed."""
    time, node, size = sums.failure
    how = "Newton's iteration did not converge even after halving the step"
    if sums.count[EVALUATIONS]:
        how = "velocities grow without bound"
    return (
        f"stopped at t = {time:.6g} s, node {int(node)} (s = {mesh.s[int(node)]:.4g} m), last correction "
        f"{size:.3g} m: {how}; largest force there: "
        f"{suspect(model, int(node))}. Take a smaller step, a ramp for sudden motions, or check "
        "stroke and tension"
    )
