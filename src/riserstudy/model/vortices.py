"""Vortex forces on a riser's sections: lift, varying drag, and their initial phases."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.synchronisation import PHASE, VARIABLES
from riserstudy.effects.vortex_drag import VortexDrag
from riserstudy.effects.vortex_lift import VortexLift
from riserstudy.model.layout import Layout, unstretched
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect, Model
from riserstudy.model.platform_motion import largest_speed
from riserstudy.model.sea import current_velocity, speed_at_crest
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.geometry import NEAR
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import VortexInducedVibration

#: coefficient and frequencies of a section's force, and its other inputs; None for a section without force
Shed = tuple[float, list[float], VortexInducedVibration] | None
VORTICES = 10  # default ramp of the lift, in shedding periods
PLACES = 200  # number of places along a section at which the current is evaluated
IDLE = 0.01  # share of the vortices' power that is neglected
WAVES = 16  # number of cosines along the riser whose sum is the initial phase


def vortex_forces(of: Layout) -> Iterator[Effect]:
    """Lift and varying drag of the sections that shed vortices, in a model in space."""
    sections = [section.viv for section in of.scene.riser]
    if of.d < 3:
        return
    if any(sections):
        across = [(v.coefficient, v.frequencies, v) if v else None for v in sections]
        yield Effect("vortex-induced vibration", VortexLift(*_record(of, across, 0)), "riser.viv")
    if any(v and v.in_line for v in sections):
        along = [
            (v.in_line.coefficient, v.in_line.frequencies, v) if v and v.in_line else None for v in sections
        ]
        record = VortexDrag(*_record(of, along, VARIABLES))
        yield Effect("in-line vortex-induced vibration", record, "riser.viv.in_line")


def _record(of: Layout, each: list[Shed], first: int) -> tuple[Any, ...]:
    """Fields of the record of one of the forces, from the inputs of the sections.

    ``first``: row of the force's phases among the internal variables.
    """
    scales = [0.5 * of.density * one[0] * one[2].diameter if one else 0.0 for one in each]
    scale = of.per_segment(lambda k: scales[k]) * of.mesh.l0 * of.above_ground
    columns = [[0.0] * 5 if one is None else _column(one[1], one[2]) for one in each]
    diameter, *frequencies = at_nodes(of.mesh, np.array(columns), np.array([one is not None for one in each]))
    nodes = of.last + 1
    return (
        scale, scale, np.zeros((3, nodes)), diameter, np.array(frequencies),
        ramp_of(of.scene), first, np.zeros((VARIABLES, nodes)),
    )  # fmt: skip


def _column(frequencies: list[float], viv: VortexInducedVibration) -> list[float]:
    """Diameter (m), free frequency, its largest decrease and increase, and memory (1)."""
    low, free, high = frequencies
    return [viv.diameter, free, free - low, high - free, viv.memory]


def at_nodes(mesh: Mesh, values: FloatArray, there: NDArray[np.bool_]) -> FloatArray:
    """Values of sections, (sections, k), at the nodes, (k, n+1): means by length, in the same unit."""
    section = np.minimum(mesh.section, len(values) - 1)
    length = np.where(there[section] & (mesh.section < len(values)), mesh.l0, 0.0)
    weight = np.zeros(len(mesh.l0) + 1)
    out = np.zeros((values.shape[1], len(weight)))
    for side in (slice(None, -1), slice(1, None)):
        weight[side] += length
        out[:, side] += values[section].T * length
    return out / np.where(weight > 0.0, weight, 1.0)


def shedding(scene: Resolved) -> list[VortexInducedVibration]:
    """Inputs of the sections that shed vortices; ramp and seed are the same in all of them."""
    return [section.viv for section in scene.riser if section.viv]


def ramp_of(scene: Resolved) -> float:
    """Time over which the lift increases to its full value (s)."""
    ramp = shedding(scene)[0].ramp
    if ramp is not None:
        return ramp
    if scene.current is None:
        raise TypeError("no ramp and no current")  # refused by the scene
    return VORTICES * shedding_period(scene, free=True)


def shedding_period(scene: Resolved, free: bool = False) -> float:
    """Shortest period of vortices in the current past the riser (s); infinite without vortices.

    If the riser is held at its lower end while the platform cruises, its upper end meets another flow.
    ``free``: period of the lift on a riser at rest; else of the highest frequency of lift or varying drag.
    """
    if not shedding(scene):
        return math.inf
    _, velocity = _flow(scene)
    speed = float(np.linalg.norm(velocity, axis=0).max())
    if not free and scene.bottom.hold != "free":
        speed = max(speed, float(np.linalg.norm(velocity - _cruise(scene), axis=0).max()))
    if speed == 0.0:
        return math.inf
    return min(
        v.diameter / ((v.frequencies[1] if free else v.highest_frequency) * speed) for v in shedding(scene)
    )


def shortest_shedding_period(scene: Resolved, drift: float = 0.0) -> float:
    """Shortest period of vortices (s) if current, largest wave and platform move in the worst directions.

    It is that of the current in a scene without waves and motions of the platform, and that of the wave in
    one without current; infinite without vortices. ``drift``: largest speed of a vessel after a run (m/s).
    """
    shortest = shedding_period(scene)
    if not shedding(scene):
        return shortest
    moved = drift
    if scene.top.x in ("platform", "vessel"):
        top = np.array([scene.top.offset or 0.0, 0.0, unstretched(scene).top])
        moved = max(moved, largest_speed(scene, top))
    if moved and scene.bottom.hold != "free":
        moved += float(np.linalg.norm(_cruise(scene)))
    sections = [*_shedding_sections(scene)]
    if not sections or ((scene.wave is None or scene.water is None) and moved == 0.0):
        return shortest
    places = np.concatenate([of.places for of in sections])
    speed = _speed(scene, places) + moved
    if scene.wave and scene.water:
        speed += speed_at_crest(scene.wave, scene.water, scene.gravity or 0.0, places)
    fastest = speed.reshape(len(sections), -1).max(axis=1)
    own = [
        of.viv.diameter / (of.viv.highest_frequency * u)
        for of, u in zip(sections, fastest, strict=True)
        if u > 0.0
    ]
    return float(min([shortest, *own]))


def synchronised(scene: Resolved, frequency: float, edge: float = 0.0) -> float:
    """Share of the riser's length (1) along which vortices can excite it at a frequency (Hz).

    ``edge``: relative margin by which the frequency may be outside the range of the vortices.
    """
    within = 0.0
    for viv, length, places in _shedding_sections(scene):
        low, high = (end * _speed(scene, places) / viv.diameter for end in viv.frequencies[::2])
        reached = (low <= frequency * (1.0 + edge)) & (frequency * (1.0 - edge) <= high)
        within += length * float(reached.mean())
    return within / sum(section.total_length for section in scene.riser)


def slowest(scene: Resolved) -> float:
    """Lowest frequency (Hz) of vortex-induced vibration in the current; slower motion is not counted as such.

    It is half of the lowest synchronisation frequency along the riser. Places with slow flow are neglected
    that together receive at most the share `IDLE` of the power, which is proportional to the cube of the
    speed. A vibration whose amplitude varies also varies the drag, and the riser then moves along the flow
    more slowly than this frequency. 0 without current.
    """
    rates, frequencies = [np.zeros(0)], [np.zeros(0)]
    for viv, length, places in _shedding_sections(scene):
        speed = _speed(scene, places)
        rates.append(viv.diameter * speed**3 * length)
        frequencies.append(viv.frequencies[0] * speed / viv.diameter)
    power, each = np.concatenate(rates), np.concatenate(frequencies)
    if power.sum() == 0.0:
        return 0.0
    order = each.argsort()
    taken = power[order].cumsum() / power.sum()
    return 0.5 * float(each[order][int(np.searchsorted(taken, IDLE))])


class _Section(NamedTuple):
    """The part of a section in the water, if it sheds vortices."""

    viv: VortexInducedVibration
    length: float  # (m)
    places: FloatArray  # (PLACES,) elevations before the riser stretches, from end to end (m)


def _shedding_sections(scene: Resolved) -> Iterator[_Section]:
    """Parts of the sections in the water that shed vortices, from the lowest on."""
    surface = scene.water.surface if scene.water else None
    highest = math.inf if surface is None else surface
    lowest = -math.inf if scene.ground is None else scene.ground
    foot = unstretched(scene).bottom
    for section in scene.riser:
        head = foot + section.total_length
        low, high = max(foot, lowest), min(head, highest)
        if section.viv and high - low > NEAR:
            yield _Section(section.viv, high - low, np.linspace(low, high, PLACES))
        foot = head


def _flow(scene: Resolved) -> tuple[FloatArray, FloatArray]:
    """Elevations (m), and the velocity of the current there, relative to a towed riser, (2, n), m/s."""
    z, velocity = np.zeros(1), np.zeros((2, 1))
    if scene.current:
        z, velocity = current_velocity(scene.current, scene.water)
    if scene.bottom.hold == "free":
        velocity = velocity - _cruise(scene)
    return z, velocity


def _cruise(scene: Resolved) -> FloatArray:
    """Velocity of the platform's cruise, (2, 1), m/s."""
    cruise = scene.platform.cruise if scene.platform else None
    if cruise is None:
        return np.zeros((2, 1))
    heading = cruise.heading or 0.0
    return cruise.speed * np.array([[math.cos(heading)], [math.sin(heading)]])


def _speed(scene: Resolved, elevations: FloatArray) -> FloatArray:
    """Speed of the flow past the riser at elevations in the water (m), (k,), m/s."""
    z, velocity = _flow(scene)
    return np.asarray(np.hypot(*(np.interp(elevations, z, part) for part in velocity)))


def first_phases(scene: Resolved, mesh: Mesh, model: Model) -> None:
    """Set the initial phases of the lift in a model: smooth along the riser, and the same on any mesh."""
    if not len(model.s.internal):
        return
    random = np.random.default_rng(shedding(scene)[0].seed)
    share = mesh.s / mesh.s[-1]
    for first in range(PHASE, len(model.s.internal), VARIABLES):
        for k, turn in enumerate(random.uniform(0.0, 2.0 * np.pi, WAVES)):
            wave = np.cos(np.pi * k * share + turn)
            model.s.internal[first] += np.pi * np.sqrt(2.0 / WAVES) * wave
    model.s.internal_known[:] = model.s.internal
