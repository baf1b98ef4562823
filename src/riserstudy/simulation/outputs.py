"""Outputs of a run: the state at rest, histories, envelopes, angles, strokes, reported values of devices."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.result import Result
from riserstudy.model.bending import flexibility
from riserstudy.model.joints import TURNS
from riserstudy.model.layout import AXES, corners, layout_of, stiffness
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.model.platform_motion import centre
from riserstudy.model.space_out import joint_of
from riserstudy.model.stops import beyond_its_barrels, joint_stops_touched, stops_touched
from riserstudy.model.tensioner_law import leaves_table, pushes
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.records.warning import RunWarning
from riserstudy.scene.analysis import Output
from riserstudy.scene.ends import TelescopicJoint
from riserstudy.scene.forcing import Position
from riserstudy.scene.limits import ANGLES
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.tensioners import Tensioners
from riserstudy.simulation.curve import at_stations, curve_of, largest_moment
from riserstudy.solve.program import Packed
from riserstudy.solve.record import NO_SECTION, Record, Section, new_record
from riserstudy.solve.write_down import evaluate_once

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

# nodes relative to a segment's lower node, from which values in it are interpolated
WINDOW = (-1, 0, 1, 2)


class AtRest(NamedTuple):
    """Positions in the state at rest."""

    reach: FloatArray  # (cylinders,) m
    joint: float  # length of the top segment (m)
    top: float  # elevation (m)


def quantities(model: Model) -> list[str]:
    """Names of the quantities in a record, in its order."""
    d = len(model.s.dim)
    places = ["xyz"[axis] for axis in AXES[d]]
    return [*places, "effective_tension", *(["bending_moment"] if len(model.s.dof) > d else [])]


def at_rest(scene: Resolved, model: Model, mesh: Mesh) -> Arrays:
    """The mesh, and the state at rest at all nodes, ``_static``."""
    record = _tabulated(model)
    static, probe = record.values, record.probe[0]
    names = quantities(model)
    arrays: Arrays = {"s_node": mesh.s, "l0": mesh.l0}
    for name, values in zip(names, static, strict=False):
        arrays[name + "_static"] = values
    if scene.top.tensioners:
        count = scene.top.tensioners.count
        arrays["tensioner_stroke_static"] = probe[:count]
        arrays["tensioner_force_static"] = probe[count : 2 * count]
    for name, values in angles(scene, model, mesh, record).items():
        arrays[name + "_static"] = values[0]
    if "largest_stress" in model.probes:
        arrays["largest_stress_static"] = probe[model.probes["largest_stress"]]
    if joint := joint_of(scene):
        arrays["joint_stroke_static"] = np.array(positions(model).joint - joint.length)
    arrays["zero_z"] = model.s.r[-1, : len(mesh.s)].copy()
    for name in set("xy").intersection(names):
        arrays["zero_" + name] = np.zeros(len(mesh.s))
    of = layout_of(scene, mesh, None, len(model.s.dim))
    arrays["mesh_corner"] = np.zeros(len(mesh.s))
    arrays["mesh_corner"][corners(of)] = 1.0
    if len(model.s.dof) > len(model.s.dim):
        arrays["mesh_flexibility"] = flexibility(of)
        if scene.top.telescopic_joint:
            arrays["mesh_above_ring_static"] = _above_ring(model, record)[0]
    return arrays


def _above_ring(model: Model, record: Record) -> FloatArray:
    """Moment (N m) above the jump at a ring, where a telescopic joint begins: (time,) or (time, 3)."""
    d, m = len(model.s.dim), len(model.s.dof) - len(model.s.dim)
    moment = record.end[:, -1, d + m : d + 2 * m]
    return moment if m == 3 else moment[:, 0]


def _tabulated(model: Model) -> Record:
    """The record of a model at rest: quantities at the nodes, ends, reported values of devices."""
    state, own = model.spare.value, model.s
    state.r[:], state.moment[:], state.clock[:] = own.r, own.moment, own.clock
    state.platform[:], state.deck[:], state.carried[:] = own.platform, own.deck, own.carried
    state.v[:] = 0.0
    state.a[:] = 0.0
    record = new_record([state.clock[0]], [0], state)
    evaluate_once(model.programs, model.spare, record)
    written: Record = record.value
    return written


def positions(model: Model) -> AtRest:
    """Positions of cylinders, joint and top in a model at rest."""
    state = model.s
    top = len(state.l0)
    joint = float(np.linalg.norm(state.r[:, top] - state.r[:, top - 1]))
    return AtRest(state.reach.copy(), joint, float(state.r[-1, top]))


class Wanted(NamedTuple):
    """The requested histories: at places, or at all nodes."""

    places: FloatArray | None  # m
    nodes: NDArray[np.int64]  # nodes from which they are interpolated


def wanted(arrays: Arrays, stations: list[float] | None) -> Wanted:
    """The nodes that histories at stations (m) require; all nodes without stations."""
    if stations is None:
        return Wanted(None, np.arange(len(arrays["s_node"])))
    places = np.array(stations, float)
    e, share = curve_of(arrays).segment(places)
    last = len(arrays["s_node"]) - 1
    nodes = {
        int(node)
        for first, x in zip(e, share, strict=True)
        for node in ([first + int(x)] if x in (0.0, 1.0) else first + np.array(WINDOW))
    }
    return Wanted(places, np.array(sorted(node for node in nodes if 0 <= node <= last)))


def empty_record(
    arrays: Arrays,
    model: Model,
    output: Output,
    end: float,
    of: Wanted,
    section: Section = NO_SECTION,
    room: int = 0,
) -> Packed:
    """Record for the outputs of a march up to a time (s); ``section`` and ``room`` as in `new_record`."""
    first = output.start or 0.0
    count = math.floor((end - first) / output.interval * (1.0 + 1e-12) + 1e-9)
    times = first + output.interval * np.arange(count + 1)
    bends = "mesh_flexibility" in arrays
    middle = curve_of(arrays).middle_weights if bends else None
    return new_record(times, of.nodes, model.s, middle, section, room)


def histories(arrays: Arrays, model: Model, record: Record, of: Wanted) -> Arrays:
    """Histories at places or at nodes, and envelopes at all nodes."""
    names = quantities(model)
    ends = {"time": record.time} | envelopes(model, record)
    full: Arrays = {}
    for k, name in enumerate(names):
        # values interpolated between steps may exceed the peaks of the parabolas by a third-order error
        least, most = (ends[name + side][of.nodes] for side in ("_min", "_max"))
        full[name] = np.clip(record.history[:, k, :], least, most)
    if "mesh_flexibility" in arrays:
        ends["mesh_moment_max"] = record.largest[len(names), :-1]
        ends["mesh_moment_min"] = record.smallest[len(names), :-1]
    if "mesh_above_ring_static" in arrays:
        ends["mesh_above_ring"] = _above_ring(model, record)
        most, least = record.largest[len(names), -1], record.smallest[len(names), -1]
        ends["mesh_above_ring_absmax"] = np.maximum(abs(most), abs(least))
    if len(names) < record.history.shape[1]:
        full["mesh_moment"] = record.history[:, len(names) :, :]
    if of.places is None:
        return ends | full | {"s": arrays["s_node"]}
    return ends | _at_places(arrays | ends, full, of.nodes, of.places)


def envelopes(model: Model, record: Record) -> Arrays:
    """Largest and smallest values of the quantities of a record at the nodes, (n + 1,)."""
    sides = (("_max", record.largest), ("_min", record.smallest))
    return {name + end: of[k] for k, name in enumerate(quantities(model)) for end, of in sides}


def _at_places(arrays: Arrays, full: Arrays, nodes: NDArray[np.int64], places: FloatArray) -> Arrays:
    """Histories at places from histories at some nodes; at a node they equal its history to the last bit."""
    whole = {name: np.zeros((*values.shape[:-1], len(arrays["s_node"]))) for name, values in full.items()}
    for name, values in full.items():
        whole[name][..., nodes] = values
    return at_stations(arrays | whole, places)


def keep_stations(result: Result, stations: list[float] | None) -> None:
    """Keep histories only at the requested stations (m); None: at all nodes.

    Histories at all nodes keep the components of the moment, which later interpolation to other nodes
    requires.
    """
    arrays = result.arrays
    if stations is None:
        return
    if "s" in arrays:
        arrays |= at_stations(arrays, np.array(stations, float))
    for name in ("mesh_moment", "mesh_above_ring"):
        arrays.pop(name, None)


def over_time(scene: Resolved, model: Model, mesh: Mesh, record: Record, rest: AtRest) -> Arrays:
    """Angles, strokes, forces and motions over time."""
    series = angles(scene, model, mesh, record)
    if scene.top.tensioners:
        c = scene.top.tensioners.count
        series["tensioner_stroke"] = record.probe[:, :c]
        series["tensioner_force"] = record.probe[:, c : 2 * c]
        series["stroke"] = record.probe[:, 0] - rest.reach[0]
    elif scene.platform and scene.top.z == "free":
        series["stroke"] = _deck_heave(scene, record, rest) - (record.top[:, -1] - rest.top)
    if joint := joint_of(scene):
        series["stroke"] = record.end[:, 1, -1] - rest.joint
        series["joint_stroke"] = record.end[:, 1, -1] - joint.length
    for name, k in model.probes.items():
        if name not in TURNS:
            series[name] = record.probe[:, k]
    if scene.vessel:
        series |= _of_vessel(scene, len(model.s.dim) == 3, record, series)
    return series


def angles(scene: Resolved, model: Model, mesh: Mesh, record: Record) -> Arrays:
    """Angles of flex joints (rad): of the tangents against the lower stack and the platform's vertical."""
    d = len(model.s.dim)
    ends = _ends(scene, model, mesh, record)
    arrays = {name: _lean(t, upright, d) for name, (t, upright) in ends.items()}
    of_joints = {name: k for name, k in model.probes.items() if name in ANGLES}
    return arrays | {name: record.probe[:, k] for name, k in of_joints.items()}


def rotations(scene: Resolved, model: Model, mesh: Mesh, record: Record) -> Arrays:
    """Angles of flex joints in space with their directions: rotations about x, y and z, (time, 3) rad."""
    arrays: Arrays = {}
    for name, (t, upright) in _ends(scene, model, mesh, record).items():
        across = np.cross(np.broadcast_to(upright, t.shape), t)
        sine = np.linalg.norm(across, axis=1, keepdims=True)
        angle = np.arctan2(sine, (t * upright).sum(axis=1, keepdims=True))
        arrays[name] = across * np.divide(angle, sine, out=np.ones_like(sine), where=sine > 0.0)
    if TURNS[0] in model.probes:
        first = model.probes[TURNS[0]]
        arrays["lfj_angle"] = record.probe[:, first : first + len(TURNS)]
    return arrays


def rotations_at_rest(scene: Resolved, model: Model, mesh: Mesh) -> Arrays:
    """Angles of flex joints in space with their directions for a model at rest, (3,) rad, by name."""
    return {name: of[0] for name, of in rotations(scene, model, mesh, _tabulated(model)).items()}


def _deck_heave(scene: Resolved, record: Record, rest: AtRest) -> FloatArray:
    """Vertical motion of the deck above the riser from its rest position, (time,), m: by heave and tilts."""
    place = (scene.platform and scene.platform.position) or Position()
    heave, tilts = record.platform[:, 2] - (place.heave or 0.0), record.platform[:, 3:]
    if not tilts.any():
        return heave
    from scipy.spatial.transform import Rotation

    arm = np.array([scene.top.offset or 0.0, 0.0, rest.top]) - centre(scene.platform)
    still = [place.roll or 0.0, place.pitch or 0.0, place.yaw or 0.0]
    turned, at_rest = (Rotation.from_euler("xyz", of).apply(arm)[..., 2] for of in (tilts, still))
    return np.asarray(heave + turned - at_rest)


def _ends(
    scene: Resolved, model: Model, mesh: Mesh, record: Record
) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Directions of the riser at ends with an angle output, (time, 3), and their reference directions."""
    d = len(model.s.dim)
    found: dict[str, tuple[FloatArray, FloatArray]] = {}
    if d == 1:
        return found
    upwards = np.array([0.0, 0.0, 1.0])
    if scene.bottom.hold == "wellhead":
        found["lfj_angle"] = (_end_direction(scene, model, mesh, record, 0), upwards)
    on_vessel = scene.vessel and len(model.s.dof) > d
    on_platform = scene.platform and scene.top.x == "platform"
    if on_vessel or on_platform or scene.top.x == "held":
        turned, upright = record.platform[:, 3:], upwards
        # the rotations would take longer than a short run
        if scene.top.x != "held" and turned.any():
            from scipy.spatial.transform import Rotation

            upright = Rotation.from_euler("xyz", turned).apply(upwards)
        found["ufj_angle"] = (_end_direction(scene, model, mesh, record, -1), upright)
    return found


def _of_vessel(scene: Resolved, turns_aside: bool, record: Record, reported: Arrays) -> Arrays:
    """Surge, and sway and yaw if present, of a vessel: low-frequency and first-order motion together."""
    still = np.zeros(len(record.time))
    series: Arrays = {"platform_surge": record.top[:, 0] - (scene.top.offset or 0.0)}
    if scene.platform:
        series["platform_surge"] = reported["low_frequency_surge"] + record.platform[:, 0]
    if scene.vessel and scene.vessel.sway:
        series["platform_sway"] = record.top[:, int(turns_aside)] * turns_aside
        if scene.platform:
            low = series["low_frequency_sway"] = reported.get("low_frequency_sway", still)
            series["platform_sway"] = low + record.platform[:, 1]
    if scene.vessel and scene.vessel.yaw and not turns_aside:
        series["platform_yaw"] = still
    return series


def sizes(arrays: Arrays) -> Arrays:
    """Largest magnitudes over time, ``_absmax``, at all nodes, of quantities whose sign is a convention."""
    return {
        f"{name}_absmax": np.maximum(abs(arrays[name + "_max"]), abs(arrays[name + "_min"]))
        for name, of in QUANTITIES.items()
        if "_absmax" in of.endings and name + "_max" in arrays
    }


def peaks(arrays: Arrays) -> RunFacts:
    """Largest bending moment on the curve, and its place; largest displacement of a node."""
    found: RunFacts = {"largest_displacement": _largest_displacement(arrays)}
    if (peak := largest_moment(arrays)) is not None:
        found |= {"largest_bending_moment": peak[0], "largest_bending_moment_s": peak[1]}
    return found


def _largest_displacement(arrays: Arrays) -> float:
    """Upper bound of the displacement of a node from the upright riser (m), from its envelopes and at rest.

    Estimated errors of displacements are shares of the largest displacement in any direction.
    """
    square = np.zeros_like(arrays["s_node"])
    for name in "xyz":
        ends = (name + end for end in ("_max", "_min", "_static"))
        away = [abs(arrays[end] - arrays["zero_" + name]) for end in ends if end in arrays]
        if away:
            square += np.max(away, axis=0) ** 2
    return float(np.sqrt(square.max()))


def of_tensioners(rig: Tensioners, arrays: Arrays, every_step: Arrays) -> list[RunWarning]:
    """Warnings about cylinders that push, outside their law or at their stops, at rest and over time.

    ``every_step``: time, strokes and pulls of all time steps; empty if only outputs are known.
    """
    over_time, all_steps = every_step or arrays, bool(every_step)
    moving = [over_time["tensioner_stroke"]] if "tensioner_stroke" in over_time else []
    rest = arrays["tensioner_stroke_static"]
    found = leaves_table(rig, np.concatenate([reach.ravel() for reach in (rest, *moving)]))
    found += stops_touched(rig, rest)
    found += pushes(arrays["tensioner_force_static"])
    if "tensioner_force" in over_time:
        found += pushes(over_time["tensioner_force"], over_time["time"])
    for reach in moving:
        found += stops_touched(rig, reach, over_time["time"], all_steps)
    return found


def of_joint(joint: TelescopicJoint, arrays: Arrays, every_step: Arrays) -> list[RunWarning]:
    """Warnings about contact with the stops of a telescopic joint; arguments as in `of_tensioners`."""
    rest = joint.length + arrays["joint_stroke_static"]
    found = joint_stops_touched(joint, rest.reshape(1))
    over_time, lengths = every_step or arrays, rest.reshape(1)
    if "joint_stroke" in over_time:
        length = joint.length + over_time["joint_stroke"][:, None]
        found += joint_stops_touched(joint, length, over_time["time"], bool(every_step))
        lengths = np.append(lengths, length)
    return found + beyond_its_barrels(joint, lengths)


def _end_direction(scene: Resolved, model: Model, mesh: Mesh, record: Record, end: int) -> FloatArray:
    """Direction of the riser at an end, (time, 3): direction of the end segment plus its bending."""
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
        from scipy.spatial.transform import Rotation

        return np.asarray(Rotation.from_rotvec(bend).apply(t))
    cosine, sine = np.cos(bend[:, 0]), np.sin(bend[:, 0])
    return np.column_stack([cosine * t[:, 0] + sine * t[:, 2], t[:, 1], cosine * t[:, 2] - sine * t[:, 0]])


def _lean(t: FloatArray, upright: FloatArray, d: int) -> FloatArray:
    """Angle between directions (rad): in a plane, from ``upright`` towards +x; in space, its magnitude."""
    along = (t * upright).sum(axis=1)
    if d == 2:
        return np.asarray(np.arctan2(upright[..., 2] * t[:, 0] - upright[..., 0] * t[:, 2], along))
    across = np.cross(np.broadcast_to(upright, t.shape), t)
    return np.asarray(np.arctan2(np.linalg.norm(across, axis=1), along))
