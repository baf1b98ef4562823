"""Screening for vortex-induced vibration: modes that may lock in, their places and amplitudes, and the drag.

A mode of frequency f may lock in where the current's reduced velocity U / (f D) is within bounds. There it
receives power, as in the synchronisation model, from a lift of coefficient C_v in phase with the velocity of
the riser across the flow. It loses power by drag along the whole riser. At its amplitude, both powers are
equal over a cycle. Waves, other modes and structural damping are neglected.

References
----------
Thorsen, Saevik and Larsen, 2014, J. Fluids Struct. 49, for lift and drag; added drag C_d (1 + 2.1 A/D) as
Vandiver, 1983, has it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError, SimulationError
from riserstudy.model.layout import AXES
from riserstudy.model.sea import current_velocity, in_water
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.at_rest import at_rest
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.modes import MOST_MODES, mesh_of_modes, modes_of
from riserstudy.solve.evaluate import shape_of

if TYPE_CHECKING:
    import xarray as xr


PHASES = 64  # number of phases of a cycle over which power is averaged
LARGEST = 10.0  # largest ratio of amplitude to diameter in the search for a balance
FIRST = 20  # number of modes computed first; more follow, as long as the current can excite them
TWINS = 1e-3  # largest relative difference of frequencies of one mode in two directions
TURNS = 90  # directions of vibration that are compared, over half a turn
PARTS = 32  # of a segment, along each of which the speed is linear; even, so that the middle is an end
HALF_WAVE = 4.0  # segments in a half-wave of a mode from which on the mesh resolves it
LEAST_ACROSS = 0.1  # smallest share of a mode's motion across the flow, where it may lock in


class Coefficients(NamedTuple):
    """Assumed coefficients; each has a range in the literature."""

    strouhal: float = 0.2  # shedding frequency / (U / D): 0.17 to 0.25 for a cylinder at rest
    slowest: float = 4.0  # smallest reduced velocity at which a mode may lock in
    fastest: float = 8.0  # largest reduced velocity at which a mode may lock in
    lift: float = 1.2  # coefficient of the force in phase with velocity
    drag: float | None = None  # absent: coefficients of the scene
    drag_gain: float = 2.1  # increase of the relative drag per ratio of amplitude to diameter


class Flow(NamedTuple):
    """The current at the middles of the segments of a riser at rest, from the bottom up; (n,) each."""

    z: FloatArray  # elevation (m)
    length: FloatArray  # m
    speed: FloatArray  # speed of the water across the riser, or across the part in water (m/s)
    diameter: FloatArray  # m
    drag: FloatArray  # coefficient
    across: FloatArray | None = None  # (3, n) unit vectors across riser and flow; None: in a plane
    # (parts + 1, n) speeds (m/s) at the ends of parts of the segments, 0 out of water; () if not needed
    ends: FloatArray = np.empty(0)
    heights: FloatArray = np.empty(0)  # (parts + 1, n) elevations of these ends (m)
    wet: FloatArray | float = 1.0  # (n,) share of each segment that is in water
    sized: NDArray[np.bool_] | bool = True  # (n,) false where no diameter is known, and 1 m stands for it

    def excited(self, frequency: float, given: Coefficients) -> tuple[FloatArray, FloatArray]:
        """Share of each part on which a mode (Hz) may lock in, and largest reduced velocity, (parts, n)."""
        reduced = self.ends / (frequency * self.diameter)
        low, high = np.minimum(reduced[1:], reduced[:-1]), np.maximum(reduced[1:], reduced[:-1])
        within = np.minimum(high, given.fastest) - np.maximum(low, given.slowest)
        even = (within >= 0.0) & (high == low)
        share = np.divide(np.maximum(within, 0.0), high - low, out=even.astype(float), where=high > low)
        return np.where(low > 0.0, share, 0.0), np.minimum(high, given.fastest)


def screening(file: SceneFile, coefficients: Coefficients | None = None) -> xr.Dataset:
    """Lateral modes that a scene's current may excite.

    Raises InputError when the scene has no current, or tows the riser, or a coefficient is not valid.
    Raises SimulationError when there is no equilibrium.

    Parameters
    ----------
    file : SceneFile
        A scene with a current. Its modes are about its static equilibrium in this current.
    coefficients : Coefficients
        Assumed coefficients; absent: the defaults of this class.

    Returns
    -------
    xarray.Dataset
        Over ``z``, the elevations (m) of the middles of the segments: ``current_speed`` across the riser
        (m/s), ``shedding_frequency`` (Hz). Over ``mode``, the modes that may lock in, by their numbers among
        all modes: ``natural_frequency`` (Hz), ``excited_length`` (m), ``excited_from`` and ``excited_to``
        (m, elevations between which it is excited, perhaps not everywhere), ``slowest_current`` and
        ``fastest_current`` (m/s, speeds across the riser between which the mode may lock in anywhere),
        ``amplitude`` (largest ratio to the diameter along the riser), ``amplitude_limit`` (the same if the
        whole riser were excited in the phase of its flow, the largest of excited places) and ``drag_factor``
        (mean over the excited length). Over both, ``excited`` and ``relative_amplitude``. The attribute
        ``warning`` states that the mesh does not resolve all of these modes.
    """
    given = _checked(coefficients or Coefficients())
    scene = file.resolved()
    if scene.current is None:
        why = "missing, but without a current no vortices are shed"
        raise InputError(file.source, "current", why, "add a current")
    if scene.platform and scene.platform.cruise:
        towed = "has no effect on the screening, which uses the current only"
        allowed = "remove it, and give the speed of the water past the riser as the current"
        raise InputError(file.source, "platform.cruise", towed, allowed)
    flow = flow_along(scene, given)
    found = modes_of(scene, FIRST)
    highest = float((flow.speed / flow.diameter).max()) / given.slowest
    while (count := found.sizes["mode"]) < MOST_MODES and found["frequency"].max() < highest:
        found = modes_of(scene, min(2 * count, MOST_MODES))
        if found.sizes["mode"] <= count:
            break  # there are no more modes
    if not highest > 0.0:
        raise SimulationError(
            "current: it does not flow across the riser, so no vortices are shed; check the profile"
        )
    return _dataset(file, flow, found, given)


def flow_along(scene: Resolved, given: Coefficients) -> Flow:
    """The full current, without its ramp, across a riser at rest.

    Raises SimulationError when there is no equilibrium.
    """
    mesh, d = mesh_of_modes(scene)
    model, _ = settle(at_rest(scene), mesh, d)
    shape_of(model.programs, model.state)
    n = len(mesh.l0)
    tangent, ends = np.zeros((3, n)), np.zeros((3, PARTS + 1, n))
    axes = list(AXES[d])
    tangent[axes] = model.s.tangent
    share = np.linspace(0.0, 1.0, PARTS + 1)[:, np.newaxis]
    heights = (1.0 - share) * model.s.r[-1, :n] + share * model.s.r[-1, 1 : n + 1]
    z = heights[PARTS // 2]
    if scene.current:  # the profile itself: near jumps, the loads of the nodes use another current
        elevations, velocity = current_velocity(scene.current, scene.water)
        for c in axes[:-1]:
            ends[c] = np.interp(heights, elevations, velocity[c])
    wetted = in_water(scene, heights)
    parts = wetted[1:] & wetted[:-1]
    wet = parts.mean(axis=0)
    ends -= (ends * tangent[:, np.newaxis]).sum(axis=0) * tangent[:, np.newaxis]
    speeds = np.where(wetted, np.linalg.norm(ends, axis=0), 0.0)
    across = ends[:, PARTS // 2]
    # at the middle of a segment, or the mean of its part in water
    mean = (0.5 * (speeds[1:] + speeds[:-1]) * parts).sum(axis=0) / np.maximum(parts.sum(axis=0), 1)
    speed = np.where(wet == 1.0, np.linalg.norm(across, axis=0), mean)
    diameter, drag = np.full(n, math.nan), np.zeros(n)
    for e, k in enumerate(mesh.section):
        if k < len(scene.riser):  # otherwise the segment is the telescopic joint
            section = scene.riser[k]
            size = section.drag.diameter if section.drag else section.outer_diameter
            diameter[e] = size or math.nan
            if wet[e]:
                drag[e] = given.drag or _coefficient(section, float(z[e]))
    bare = np.isnan(diameter)  # no diameter for vortex shedding
    sideways = None
    if d == len("xyz"):
        sideways = np.cross(tangent, across, axis=0) / np.where(speed > 0.0, speed, np.inf)
    speed, diameter = np.where(bare, 0.0, speed), np.where(bare, 1.0, diameter)
    speeds = np.where(bare, 0.0, speeds)
    return Flow(z, mesh.l0, speed, diameter, drag, sideways, speeds, heights, wet, ~bare)


def _coefficient(section: Section, z: float) -> float:
    """The scene's drag coefficient at an elevation (m); 0 without drag."""
    if section.drag is None:
        return 0.0
    if not section.drag.table:
        return section.drag.constant
    elevations, coefficients = np.array(section.drag.table).T
    return float(np.interp(z, elevations, coefficients))


def _checked(given: Coefficients) -> Coefficients:
    for name, value in given._asdict().items():
        if value is not None and not (math.isfinite(value) and value > 0.0):
            raise InputError("screening", name, f"{value} is not above 0", "give a finite number above 0")
    if given.slowest >= given.fastest:
        found = f"{given.fastest} is not above slowest, {given.slowest:g}"
        raise InputError("screening", "fastest", found, f"give more than {given.slowest:g}")
    return given


def amplitude_of(
    flow: Flow,
    shape: FloatArray,
    excited: NDArray[np.bool_] | FloatArray,
    frequency: float,
    lift: float,
    across: FloatArray | None = None,
) -> float:
    """Amplitude (m) at which the power that a mode receives from the flow equals its loss by drag.

    With the riser's velocity v across a flow of speed U, and their resultant V, the mode receives the power
    per length rho/2 D C_v V U cos(t) v where it is excited, and loses rho/2 D C_d V v^2 everywhere.

    Parameters
    ----------
    shape : (n,) magnitude of the mode across the riser at the middles of segments; the largest is 1.
    excited : (n,) true where lift acts, or the share of each segment on which it acts (1).
    frequency : frequency of the mode (Hz).
    across : (n,) component of the shape across the flow, on which lift does work; absent: the whole shape.

    Returns
    -------
    0 if no place is excited, or if the amplitude is below 1e-8 diameters; infinite without drag.
    """
    from scipy.optimize import brentq

    across = shape if across is None else across
    if not ((excited > 0.0) & (across > 0.0)).any():
        return 0.0
    cosine = np.cos(2.0 * math.pi * (np.arange(PHASES) + 0.5) / PHASES)[:, np.newaxis]
    push = lift * excited * flow.speed

    def gained(amplitude: float) -> float:
        fastest = 2.0 * math.pi * frequency * amplitude * cosine
        v = fastest * shape
        both = np.hypot(v, flow.speed)
        power = flow.diameter * both * (push * cosine * fastest * across - flow.wet * flow.drag * v * v)
        return float((power.mean(axis=0) * flow.length).sum()) / amplitude

    largest = LARGEST * float(flow.diameter.max())
    if gained(largest) > 0.0:
        return math.inf
    least = 1e-9 * largest
    if gained(least) <= 0.0:
        return 0.0
    return float(brentq(gained, least, largest, xtol=1e-12 * largest))


class _Shapes(NamedTuple):
    """Magnitudes of modes across the riser, and of their component across the flow; (modes, n) each."""

    size: FloatArray  # at the middles of the segments
    across: FloatArray  # component across the flow, at the middles
    largest: FloatArray  # the larger size at the two ends of a segment: diameters may jump there


def _shapes(flow: Flow, found: xr.Dataset, given: Coefficients) -> _Shapes:
    """The modes along the riser.

    In a plane, the modes represent the modes across the plane. In space, two modes of one frequency may
    vibrate in any two directions; they are rotated to maximise the power that one of them receives where it
    may lock in.
    """
    nodes = np.stack([found[name].values for name in "xyz" if name in found], axis=1)
    frequency, power = found["frequency"].values, flow.length * flow.diameter * flow.speed**2
    k = 0
    while flow.across is not None and k < len(nodes) - 1:
        pair = nodes[k : k + 2]
        if frequency[k] > 0.0 and frequency[k + 1] <= (1.0 + TWINS) * frequency[k]:
            share = flow.excited(frequency[k], given)[0].mean(axis=0)
            turn = _strongest((_middles(pair) * flow.across).sum(axis=1), share * power)
            c, s = math.cos(turn), math.sin(turn)
            nodes[k : k + 2] = np.einsum("ij,jkn->ikn", np.array([[c, s], [-s, c]]), pair)
            k += 1
        k += 1
    middles = _middles(nodes)
    size, ends = (np.sqrt(np.square(of[:, :-1]).sum(axis=1)) for of in (middles, nodes))
    across = size if flow.across is None else np.abs((middles * flow.across).sum(axis=1))
    return _Shapes(size, across, np.maximum(ends[:, :-1], ends[:, 1:]))


def _middles(nodes: FloatArray) -> FloatArray:
    return np.asarray(0.5 * (nodes[..., :-1] + nodes[..., 1:]))


def _strongest(across: FloatArray, weight: FloatArray) -> float:
    """Angle (rad) by which two modes are rotated so that lift does most work on the first.

    The lift has the direction of the motion everywhere, so its work has the size of the motion across the
    flow, ``across``, (2, n), not its square. ``weight``: power of the lift per size of motion, (n,).
    """
    from scipy.optimize import minimize_scalar

    def lost(turn: float) -> float:
        return -float(weight @ np.abs(math.cos(turn) * across[0] + math.sin(turn) * across[1]))

    step = math.pi / TURNS
    best = min((k * step for k in range(TURNS)), key=lost)
    return float(minimize_scalar(lost, bounds=(best - step, best + step), options={"xatol": 1e-9}).x)


def _dataset(file: SceneFile, flow: Flow, found: xr.Dataset, given: Coefficients) -> xr.Dataset:
    """The dataset of modes whose reduced velocity is within the bounds at any place."""
    import xarray as xr

    from riserstudy.dataset.complete import complete
    from riserstudy.dataset.describe import label_variables

    size, across, largest = _shapes(flow, found, given)
    wet = flow.diameter[flow.speed > 0.0]
    rows = []
    for k, frequency in enumerate(found["frequency"].values):
        if str(found["motion"].values[k]) != "lateral" or not frequency > 0.0:
            continue
        parts, reduced = flow.excited(frequency, given)
        lift_acts, share = parts > 0.0, parts.mean(axis=0)
        excited = lift_acts.any(axis=0)
        lifted, moved = across[k, excited].max(initial=0.0), size[k, excited].max(initial=0.0)
        if not excited.any() or lifted < LEAST_ACROSS * moved:
            continue
        shape, part = size[k] / size[k].max(), across[k] / size[k].max()
        amplitude = amplitude_of(flow, shape, share, frequency, given.lift, part)
        relative = amplitude * shape / flow.diameter
        reached = amplitude * largest[k] / size[k].max() / flow.diameter
        with np.errstate(divide="ignore"):  # without drag, there is no limit
            drag = np.broadcast_to(flow.drag, reduced.shape)[lift_acts]
            limit = given.lift * reduced[lift_acts] / (2.0 * math.pi * drag)
        length = share * flow.length
        rows.append(
            {
                "mode": int(found["mode"].values[k]),
                "natural_frequency": frequency,
                "excited_length": length.sum(),
                "excited_from": flow.heights[:-1][lift_acts].min(),
                "excited_to": flow.heights[1:][lift_acts].max(),
                "slowest_current": given.slowest * frequency * wet.min(),
                "fastest_current": given.fastest * frequency * wet.max(),
                "amplitude": reached.max(where=flow.sized, initial=0.0),
                "amplitude_limit": limit.max(),
                "drag_factor": 1.0 + given.drag_gain * float((relative * length).sum() / length.sum()),
                "excited": excited,
                "relative_amplitude": np.where(flow.sized, relative, math.nan),
            }
        )
    names = [*ABOUT]
    data = {name: ("mode", np.array([row[name] for row in rows], float)) for name in names}
    over = {
        name: (("mode", "z"), np.array([row[name] for row in rows]).reshape(len(rows), len(flow.z)))
        for name in ("excited", "relative_amplitude")
    }
    shed = given.strouhal * flow.speed / flow.diameter
    dataset = xr.Dataset(
        data | over | {"current_speed": ("z", flow.speed), "shedding_frequency": ("z", shed)},
        {"mode": [row["mode"] for row in rows], "z": flow.z},
    )
    label_variables(dataset, ABOUT | ALONG)
    dataset = complete(dataset)
    dataset.attrs |= {"title": file.tree.get("title", ""), "source": file.source}
    if warning := _unresolved(found.sel(mode=[row["mode"] for row in rows])):
        dataset.attrs["warning"] = warning
    dataset.attrs |= {f"assumed_{k}": v for k, v in given._asdict().items() if v is not None}
    return dataset


def _unresolved(modes: xr.Dataset) -> str:
    """The warning that some of the modes have few segments in a half-wave; empty if all are resolved."""
    shapes = np.stack([modes[name].values for name in "xy" if name in modes])
    few = {}
    for k, mode in enumerate(modes["mode"].values):
        along = shapes[np.abs(shapes[:, k]).max(axis=1).argmax(), k]
        zeros = np.flatnonzero(along[1:] * along[:-1] < 0.0)
        half_wave = float(np.diff(zeros).min(initial=len(along)))
        if half_wave < HALF_WAVE:
            few[int(mode)] = half_wave
    if not few:
        return ""
    count = shapes.shape[-1] - 1
    enough = math.ceil(HALF_WAVE / min(few.values()) * count)
    return (
        f"analysis.mesh: {count} segments are too few: from mode {min(few)} on, half-waves have fewer than "
        f"{HALF_WAVE:g} segments, and frequencies and amplitudes may have large errors; give about {enough} "
        "segments"
    )


ABOUT = {
    "natural_frequency": ("Hz", "natural frequency in still water"),
    "excited_length": ("m", "length of the riser on which the mode may lock in"),
    "excited_from": ("m", "lowest elevation at which the mode may lock in"),
    "excited_to": ("m", "highest elevation at which the mode may lock in"),
    "slowest_current": ("m s-1", "lowest speed across the riser at which the mode may lock in"),
    "fastest_current": ("m s-1", "highest speed across the riser at which the mode may lock in"),
    "amplitude": ("1", "largest amplitude divided by diameter"),
    "amplitude_limit": ("1", "amplitude divided by diameter at which lift equals drag at one place"),
    "drag_factor": ("1", "drag coefficient divided by that of a riser without vibration"),
}
ALONG = {
    "current_speed": ("m s-1", "speed of the current across the riser"),
    "shedding_frequency": ("Hz", "frequency at which vortices are shed"),
    "excited": ("1", "whether the mode may lock in, at least on a part of the segment"),
    "relative_amplitude": ("1", "amplitude over diameter, where a diameter is known"),
}
