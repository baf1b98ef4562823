"""The records of a freely floating platform: hull, thrusters, and torsion of the riser."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from riserstudy.effects.munk import Munk
from riserstudy.effects.thrusters import Thrusters
from riserstudy.effects.torsion import Torsion
from riserstudy.effects.vessel import Vessel
from riserstudy.model.model import Effect, Report
from riserstudy.model.sea import surface_current
from riserstudy.records.arrays import FloatArray
from riserstudy.scene import vessel as scenes
from riserstudy.scene.resolve import Resolved

AHEAD = ("platform_speed", "riser_reaction", "environment_force")  # reported by direction
YAW, THRUST, THRUST_MOMENT = "platform_yaw", "thrust", "thrust_moment"
SWAY = 1  # direction


def loose_nodes(scene: Resolved, d: int) -> int:
    """Number of nodes beyond the riser: one for yaw and lag of the thrust, one for the lag of the moment."""
    of = scene.vessel
    if of is None:
        return 0
    turns = bool(of.yaw) and d == 3
    lags = bool(of.thrusters and of.thrusters.lag)
    return int(turns or lags) + int(turns and lags and bool(of.thrusters and of.thrusters.yaw))


def unknowns(scene: Resolved, d: int, top: int) -> list[tuple[int, int]]:
    """(node, direction) pairs that are free in a dynamic run of a floating vessel, but held in statics."""
    of = scene.vessel
    if of is None:
        return []
    horizontal = [(top, 0)] + ([(top, SWAY)] if of.sway and d == 3 else [])
    free = list(horizontal)
    if of.thrusters and of.thrusters.lag:
        free += [(top + 1, direction) for _, direction in horizontal]
        if of.yaw and of.thrusters.yaw and d == 3:
            free.append((top + 2, 0))
    if of.yaw and d == 3:
        free.append((top + 1, d - 1))
    return free


def floating(scene: Resolved, d: int, node: int, probe: Report) -> Iterator[Effect]:
    """Effects of a vessel at a node; ``probe`` reserves reported values by name and returns their index."""
    of = scene.vessel
    if of is None:
        return
    sway, yaw = of.sway or scenes.Sway(), of.yaw if d == 3 else None
    inertia = yaw.inertia + (yaw.added_inertia or 0.0) if yaw else 0.0
    # radius of gyration: the arc of the yaw then has the vessel's mass as its inertia
    radius = math.sqrt(inertia / of.mass) if yaw else 1.0
    loose = node + 1 if yaw else 0
    names = [f"{name}_{axis}" for axis in "xy"[: d - 1] for name in AHEAD]
    current, wind = _surface_current(scene), of.wind
    rig = scene.top.tensioners
    mass = of.mass + np.array([of.added_mass or 0.0, sway.added_mass or 0.0])
    heading = of.heading or 0.0
    record = Vessel(
        node=node,
        yaw=loose,
        radius=radius,
        heading=heading,
        mass=mass,
        turning=inertia / radius**2,
        hull=np.array([of.hull_drag or 0.0, sway.hull_drag or 0.0 if of.sway else of.hull_drag or 0.0]),
        spin=((yaw.hull_drag or 0.0) if yaw else 0.0) / radius**3,
        current=current,
        area=wind.drag if wind else 0.0,
        wind=_towards(wind.speed, wind.heading) if wind else np.zeros(2),
        drift=_towards(of.wave_drift.force, of.wave_drift.heading) if of.wave_drift else np.zeros(2),
        cylinders=rig.count if rig and rig.arrangement else 0,
        probe=probe(*names, *([YAW] if yaw else [])),
    )
    yield Effect("vessel", record, "vessel")
    if of.thrusters:
        yield from _thrusters(of, of.thrusters, record, d, probe)
    if yaw and mass[0] != mass[1] and current.any():
        munk = Munk(node, loose, radius, heading, float(mass[0] - mass[1]), current)
        yield Effect("Munk moment", munk, "vessel.yaw, current")
    twist = sum(section.twist for section in scene.riser)
    if yaw and twist and scene.bottom.hold != "free":  # a free lower end turns with the vessel
        spring = Torsion(loose, 1.0 / (twist * radius**2))
        yield Effect("torsion", spring, "vessel.yaw, riser.shear_modulus")


def _thrusters(
    of: scenes.Vessel, law: scenes.Thrusters, vessel: Vessel, d: int, probe: Report
) -> Iterator[Effect]:
    """Effects of thrust in the horizontal plane, and of the moment about the vertical axis."""
    across = law.sway.gain if law.sway else 0.0
    slowing = (law.sway.velocity_gain or 0.0) if law.sway else 0.0
    count = 2 if of.sway and d == 3 else 1
    plane = Thrusters(
        node=vessel.node,
        first=0,
        count=count,
        gain=_turned(law.gain, across, vessel.heading),
        damping=_turned(law.velocity_gain or 0.0, slowing, vessel.heading),
        command=_towards(law.command, law.heading),
        rise=law.rise or 0.0,
        saturation=law.saturation or math.inf,
        lag=law.lag or 0.0,
        mass=float(vessel.mass[0]),
        arm=1.0,
        probe=probe(*(f"{THRUST}_{axis}" for axis in "xy"[:count])),
    )
    yield Effect("thrusters", plane, "vessel.thrusters")
    if law.yaw is None or vessel.yaw == 0:
        return
    arc = vessel.radius
    turning = plane._replace(
        node=vessel.yaw,
        first=d - 1,
        count=1,
        gain=np.diag([law.yaw.gain / arc**2, 0.0]),
        damping=np.diag([(law.yaw.velocity_gain or 0.0) / arc**2, 0.0]),
        command=np.array([(law.yaw.command or 0.0) * arc, 0.0]),
        saturation=(law.yaw.saturation or math.inf) / arc,
        mass=vessel.turning,
        arm=arc,
        probe=probe(THRUST_MOMENT),
    )
    yield Effect("heading control", turning, "vessel.thrusters.yaw")


def _surface_current(scene: Resolved) -> FloatArray:
    """Velocity of the current at the surface (m/s)."""
    if not (scene.current and scene.water):
        return np.zeros(2)
    return surface_current(scene.current, scene.water)


def _towards(size: float, heading: float | None) -> FloatArray:
    """The vector in x and y of a size along a heading."""
    return size * np.array([math.cos(heading or 0.0), math.sin(heading or 0.0)])


def _turned(along: float, across: float, heading: float) -> FloatArray:
    """The matrix in x and y of coefficients along and across the hull."""
    ahead, aside = _towards(1.0, heading), _towards(1.0, heading + 0.5 * math.pi)
    return along * np.outer(ahead, ahead) + across * np.outer(aside, aside)
