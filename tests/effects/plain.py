"""Every effect once more in plain NumPy, from its equation: what it adds to which array of the state.

A plain version takes record and state and returns the arrays that the effect's force (or drive, turn,
place, motion) must leave behind. ``pull`` laws give the pull of each cylinder.
"""

from __future__ import annotations

import numpy as np
from cases import flexibility, nodes
from scipy.interpolate import CubicHermiteSpline, PPoly
from scipy.spatial.transform import Rotation

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.axial import Axial
from riserstudy.effects.axial_damping import AxialDamping
from riserstudy.effects.bending import Bending
from riserstudy.effects.bending_damping import BendingDamping
from riserstudy.effects.bending_damping_in_space import SpatialBendingDamping
from riserstudy.effects.bending_in_space import SpatialBending
from riserstudy.effects.current import Current
from riserstudy.effects.cylinder import Upright
from riserstudy.effects.cylinder_damping import CylinderDamping
from riserstudy.effects.cylinders_in_space import CylindersInSpace
from riserstudy.effects.dead_load import DeadLoad
from riserstudy.effects.drag import Drag
from riserstudy.effects.drag_over_depth import DragOverDepth
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.end_stop import EndStop
from riserstudy.effects.exchange import LentForce, ToldMotion
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.flex_joint_in_space import SpatialFlexJoint
from riserstudy.effects.foreshortening import Foreshortening
from riserstudy.effects.gas_spring import GasSpring
from riserstudy.effects.inertia import Inertia
from riserstudy.effects.inner_flex_joint import InnerFlexJoint
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.munk import Munk
from riserstudy.effects.platform_motion import Cruise, Harmonic, Position, Series
from riserstudy.effects.sliding_tension import SlidingTension
from riserstudy.effects.soil import LinearSoil, SoftClay
from riserstudy.effects.stress_gauge import StressGauge
from riserstudy.effects.support import Support
from riserstudy.effects.tabulated_law import TabulatedLaw
from riserstudy.effects.tangential_drag import TangentialDrag
from riserstudy.effects.tension_loss import TensionLoss
from riserstudy.effects.thrusters import Thrusters
from riserstudy.effects.torsion import Torsion
from riserstudy.effects.two_chamber_gas import TwoChamberGas
from riserstudy.effects.vessel import Vessel
from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave import STRETCHED, Wave
from riserstudy.effects.wave_force import WaveForce
from riserstudy.effects.weight import Weight
from riserstudy.model.layout import AXES


def along(s):
    """Lengths (n,) and unit tangents (d, n) of the segments."""
    chord = np.diff(s.r, axis=1)
    length = np.sqrt((chord**2).sum(axis=0))
    return length, chord / length


def at_nodes(s):
    """Unit tangents at the nodes, (d, n+1): of the chord from neighbour to neighbour."""
    _, tangent = along(s)
    chord = s.r[:, 2:] - s.r[:, :-2]
    inner = chord / np.sqrt((chord**2).sum(axis=0))
    return np.concatenate([tangent[:, :1], inner, tangent[:, -1:]], axis=1)


def across(vector, tangent):
    return vector - (vector * tangent).sum(axis=0) * tangent


def spread(low, q, up=None):
    """Loads per length at the nodes to nodal forces: 5/12 own node, 1/12 the other."""
    out = np.zeros_like(q)
    out[:, :-1] += low * (5.0 * q[:, :-1] + q[:, 1:]) / 12.0
    out[:, 1:] += (low if up is None else up) * (5.0 * q[:, 1:] + q[:, :-1]) / 12.0
    return out


def lump(low, q, up):
    """The same with all of a node's load on itself."""
    out = np.zeros_like(q)
    out[:, :-1] += 0.5 * low * q[:, :-1]
    out[:, 1:] += 0.5 * up * q[:, 1:]
    return out


def axes(record, s):
    """Unit vectors at the nodes along which water slips past, (d, n+1)."""
    if record.horizontal:
        return np.repeat(np.eye(len(s.dim))[:, -1:], s.r.shape[1], axis=1)
    return at_nodes(s)


def axial(record, s):
    length, tangent = along(s)
    return {"force": nodes(record.stiffness * (length - s.l0) * tangent)}


def axial_damping(record, s):
    _, tangent = along(s)
    rate = (np.diff(s.v, axis=1) * tangent).sum(axis=0)
    return {"force": nodes(record.damping * rate * tangent)}


def weight(record, s):
    out = np.zeros_like(s.force)
    out[record.direction] = record.load
    return {"force": out}


def inertia(record, s):
    return {"force": -spread(record.mass, s.a)}


def added_mass(record, s):
    return {"force": -spread(record.mass, across(s.a, axes(record, s)))}


def pressed(record, s, tangent=None):
    u = across(s.water - s.v, axes(record, s) if tangent is None else tangent)
    return np.sqrt((u**2).sum(axis=0)) * u


def drag(record, s, tangent=None):
    return {"force": spread(record.low, pressed(record, s, tangent), record.up)}


def tangential_drag(record, s):
    _, tangent = along(s)
    slip = s.water - s.v
    u = (0.5 * (slip[:, :-1] + slip[:, 1:]) * tangent).sum(axis=0)
    half, out = 0.5 * record.low * np.abs(u) * u * tangent, np.zeros_like(s.force)
    out[:, :-1] += half
    out[:, 1:] += half
    return {"force": out}


def drag_over_depth(record, s):
    """Coefficients by many points in each segment, instead of piece by piece."""
    share = (np.arange(100_000) + 0.5) / 100_000
    low, up = np.zeros((2, len(s.l0)))
    for e, scale in enumerate(record.scale):
        z = s.r[-1, e] + share * (s.r[-1, e + 1] - s.r[-1, e])
        # a jump is a slope over a micrometre
        at = record.elevation + 1e-6 * np.append(0.0, np.diff(record.elevation) == 0.0)
        c = scale * np.interp(z, at, record.coefficient)
        low[e], up[e] = 2.0 * ((1.0 - share) * c).mean(), 2.0 * (share * c).mean()
    return {"force": spread(low, pressed(record, s), up)}


def current(record, s):
    share = s.clock[1] * min(1.0, s.clock[0] / record.ramp if record.ramp else 1.0)
    speed = np.interp(s.r[-1], record.elevation, record.speed)
    out = np.zeros_like(s.water)
    out[:-1] = share * record.heading[:, None] * speed
    return {"water": out}


def wave(record, s):
    """Velocity and acceleration of the water, component by component, from the potential's formulas."""
    t, d = s.clock[0], record.depth
    p = np.pi / record.ramp if t < record.ramp else 0.0
    grown, rate = (0.5 * (1 - np.cos(p * t)), 0.5 * p * np.sin(p * t)) if p else (1.0, 0.0)
    water, water_rate = np.zeros((2, *s.r.shape))
    for i in range(s.r.shape[1]):
        x = record.heading @ s.r[:-1, i]
        z = s.r[-1, i] - record.surface
        angle = record.number * x - record.frequency * t + record.phase
        eta = grown * (record.amplitude * np.cos(angle)).sum()
        if record.above == STRETCHED:
            z = (min(z, eta) + d) * d / (d + eta) - d
        z = min(z, 0.0)
        speed, kd = record.amplitude * record.frequency, record.number * d
        u = speed * np.cosh(record.number * (z + d)) / np.sinh(kd)
        w = speed * np.sinh(record.number * (z + d)) / np.sinh(kd)
        water[:-1, i] = record.heading * grown * (u * np.cos(angle)).sum()
        water[-1, i] = grown * (w * np.sin(angle)).sum()
        f = record.frequency
        along = (u * (grown * f * np.sin(angle) + rate * np.cos(angle))).sum()
        water_rate[:-1, i] = record.heading * along
        water_rate[-1, i] = (w * (rate * np.sin(angle) - grown * f * np.cos(angle))).sum()
    return {"water": water, "water_rate": water_rate}


def wave_force(record, s):
    return {"force": spread(record.mass, across(s.water_rate, at_nodes(s)))}


def angles(s):
    _, tangent = along(s)
    return np.unwrap(np.arctan2(tangent[0], tangent[1]))


def bending(record, s):
    length, tangent = along(s)
    turn = np.zeros(s.turn.shape)
    turn[0, 1:-1] = np.diff(angles(s))
    turn[0] -= flexibility(s) @ s.moment[0]
    shear = -np.diff(s.moment[0]) / length
    across_segment = np.array([tangent[1], -tangent[0]])
    return {"turn": turn, "force": nodes(shear * across_segment)}


def bending_damping(record, s):
    length, tangent = along(s)
    dv = np.diff(s.v, axis=1)
    rate = (tangent[1] * dv[0] - tangent[0] * dv[1]) / length
    return {"turn": record.time * nodes(rate[None, :])}


def foreshortening(record, s):
    low, up = s.moment[:, :-1], s.moment[:, 1:]
    _, tangent = along(s)
    squares = (low**2 + low * up + up**2).sum(axis=0)
    return {"force": nodes(record.slope * squares * tangent)}


def flex_joint(record, s):
    out = np.zeros(s.turn.shape)
    held = record.lean + record.follows * s.platform[0, 4]
    away = angles(s)[0 if record.node == 0 else -1] - held
    out[0, record.node] = away if record.node == 0 else -away
    return {"turn": out}


def upright(record, s):
    force = np.zeros_like(s.force)
    force[-1, record.node] = s.pull.sum()
    reach = s.platform[0, 2] - s.r[-1, record.node] + record.zero
    rate = s.platform[1, 2] - s.v[-1, record.node] + 0.0 * record.zero
    return {"force": force, "reach": reach, "reach_rate": rate}


def gas_spring(record, s):
    left = record.volume - record.area * s.reach
    return {"pull": record.area * record.pressure * (record.volume / left) ** record.exponent}


def two_chamber_gas(record, s):
    high = 1.0 - record.high_area * s.reach / record.high_volume
    low = 1.0 + record.low_area * s.reach / record.low_volume
    up = record.high_area * record.high_pressure * high**-record.exponent
    down = record.low_area * record.low_pressure * low**-record.exponent
    return {"pull": up - down - record.weight}


def tabulated_law(record, s):
    return {"pull": record.working * PPoly(record.force, record.reach)(s.reach)}


def linear_spring(record, s):
    return {"pull": record.tension + record.stiffness * s.reach}


def cylinder_damping(record, s):
    return {"pull": record.damping * s.reach_rate}


def end_stop(record, s):
    above = np.maximum(s.reach - record.longest, 0.0)
    below = np.minimum(s.reach - record.shortest, 0.0)
    return {"pull": record.stiffness * (above + below)}


def end_mass(record, s):
    i = record.node
    out = np.zeros_like(s.force)
    u = (s.water - s.v)[:-1, i]
    out[:-1, i] = record.drag[0] * np.sqrt((u**2).sum()) * u
    out[-1, i] = -record.weight - record.drag[1] * abs(s.v[-1, i]) * s.v[-1, i]
    return {"force": out}


def end_mass_inertia(record, s):
    out = np.zeros_like(s.force)
    out[:, record.node] = -record.mass * s.a[:, record.node]
    return {"force": out}


def inner_flex_joint(record, s):
    out = s.probe.copy()
    moment = (
        s.moment[0, record.node] if len(s.dim) == 2 else np.linalg.norm(s.moment[:, record.node])
    )
    out[record.probe] = record.flex * moment
    return {"probe": out}


def sliding_tension(record, s):
    length, tangent = along(s)
    pulls = np.zeros(len(length))
    beyond = max(length[record.segment] - record.stop, 0.0)
    pulls[record.segment] = record.tension + record.stiffness * beyond
    return {"force": nodes(pulls * tangent)}


def radial(s, node):
    """Horizontal distance of nodes and unit vectors away from where they stood."""
    aside = s.r[:-1, node]
    away = np.sqrt((aside**2).sum(axis=0))
    return away, aside / np.where(away > 0.0, away, 1.0)


def soft_clay(record, s):
    away, outwards = radial(s, record.node)
    q = away / record.y50
    line = 0.5 * np.cbrt(record.origin) * q / record.origin
    share = np.where(q <= record.origin, line, np.minimum(0.5 * np.cbrt(q), 1.0))
    out = np.zeros_like(s.force)
    out[:-1, record.node] = -record.ultimate * share * outwards
    return {"force": out}


def linear_soil(record, s):
    out = np.zeros_like(s.force)
    out[:-1, record.node] = -record.stiffness * s.r[:-1, record.node]
    return {"force": out}


def stress_gauge(record, s):
    out = s.probe.copy()
    size = np.sqrt((s.moment**2).sum(axis=0))
    ends = np.maximum(size[:-1], size[1:])
    axial = abs((s.segment * along(s)[1]).sum(axis=0)) / record.area
    out[record.probe] = (axial + record.fibre * ends)[record.first : record.last].max()
    return {"probe": out}


def of_hull(record, s):
    """Axes of the hull (2, 2), one a row, its rate of turning, velocity and acceleration (2,)."""
    lateral = len(s.r) - 1
    arc, rate = (s.r[-1, -1], s.v[-1, -1]) if lateral == 2 else (0.0, 0.0)
    angle = record.heading + arc / record.radius
    axes = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    v, a = np.zeros((2, 2))
    v[:lateral], a[:lateral] = s.v[:lateral, record.node], s.a[:lateral, record.node]
    return axes, rate / record.radius, v, a


def vessel(record, s):
    axes, _, v, _ = of_hull(record, s)
    water, air = record.current - v, record.wind - v
    total = record.drift + record.area * np.linalg.norm(air) * air
    total = total + (record.hull * np.linalg.norm(water) * (axes @ water)) @ axes
    out = np.zeros_like(s.force)
    out[: len(out) - 1, record.node] = total[: len(out) - 1]
    if record.yaw:
        out[-1, -1] = -record.spin * abs(s.v[-1, -1]) * s.v[-1, -1]
    return {"force": out}


def mass_tensor(record, angle):
    axes = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return axes.T @ np.diag(record.mass) @ axes


def by_angle(function, angle, h=1e-3):
    return (
        function(angle - 2 * h) - 8 * function(angle - h) + 8 * function(angle + h)
        - function(angle + 2 * h)
    ) / (12 * h)  # fmt: skip


def vessel_inertia(record, s):
    axes, rate, v, a = of_hull(record, s)
    angle = np.arctan2(axes[0, 1], axes[0, 0])
    tensor = mass_tensor(record, angle)
    turned = by_angle(lambda x: mass_tensor(record, x), angle)
    out = np.zeros_like(s.force)
    out[: len(out) - 1, record.node] = -(tensor @ a + rate * turned @ v)[: len(out) - 1]
    if record.yaw:
        out[-1, -1] = -record.turning * s.a[-1, -1] + 0.5 * v @ turned @ v / record.radius
    return {"force": out}


def munk(record, s):
    axes, rate, v, _ = of_hull(record, s)

    def tensor(angle):
        ahead = np.array([np.cos(angle), np.sin(angle)])
        return record.difference * np.outer(ahead, ahead)

    turned = by_angle(tensor, np.arctan2(axes[0, 1], axes[0, 0]))
    out = np.zeros_like(s.force)
    out[:2, record.node] = rate * turned @ record.current
    out[2, -1] = (0.5 * record.current - v) @ turned @ record.current / record.radius
    return {"force": out}


def thrusters(record, s):
    told = record.command * -np.expm1(-s.clock[0] / record.rise)
    n, k = record.node, record.count
    gain, damping = record.gain[:k, :k], record.damping[:k, :k]
    wanted = gain @ (told[:k] - s.r[:k, n]) - damping @ s.v[:k, n]
    size = np.linalg.norm(wanted)
    limited = wanted * min(1.0, record.saturation / size)
    out = np.zeros_like(s.force)
    out[:k, n] = record.mass / record.lag * s.v[:k, n + 1]
    out[:k, n + 1] = limited / record.mass - s.v[:k, n + 1] / record.lag
    return {"force": out}


def thrusters_inertia(record, s):
    out = np.zeros_like(s.force)
    out[: record.count, record.node + 1] = -s.a[: record.count, record.node + 1]
    return {"force": out}


def torsion(record, s):
    out = np.zeros_like(s.force)
    out[-1, record.yaw] = -record.stiffness * s.r[-1, record.yaw]
    return {"force": out}


def waterline(record, s):
    """Nodes with dry segments alone see no water; shares are tested with the waterline."""
    dry = record.surface + s.level < s.r[-1]
    alone = dry & np.append(True, dry[:-1]) & np.append(dry[1:], True)
    return {name: np.where(alone, 0.0, getattr(s, name)) for name in ("water", "water_rate")}


def pull(record, s):
    out = np.zeros_like(s.force)
    out[:, record.node] = record.load
    return {"force": out}


def tension_loss(record, s):
    gone = np.clip((s.clock[0] - record.start) / record.over, 0.0, 1.0)
    out = np.zeros_like(s.force)
    out[:, record.node] = record.load * np.sin(0.5 * np.pi * gone) ** 2
    return {"force": out}


def lent_force(record, s):
    out = np.zeros_like(s.force)
    for c, load in enumerate(record.load.T):
        out[c, record.node] = np.interp(s.clock[0], record.time, load)
    return {"force": out}


def lent_force_reports(record, s):
    out = s.probe.copy()
    moves = [(s.v[c, record.node], s.a[c, record.node]) for c in range(record.load.shape[1])]
    out[record.probe : record.probe + 2 * len(moves)] = np.ravel(moves)
    return {"probe": out}


def told_motion(record, s):
    out = {name: getattr(s, name).copy() for name in "rva"}
    for c in range(record.path.shape[2]):
        path = CubicHermiteSpline(record.time, record.path[0, :, c], record.path[1, :, c])
        out["r"][c, record.node] = path(s.clock[0])
        out["v"][c, record.node] = path(s.clock[0], 1)
        out["a"][c, record.node] = np.interp(s.clock[0], record.time, record.path[2, :, c])
    return out


def carried(platform, point):
    """Position, velocity, acceleration (3, 3) of a point turned with the platform, by differences."""

    def at(t):
        angles = platform[0, 3:] + t * platform[1, 3:] + 0.5 * t * t * platform[2, 3:]
        return Rotation.from_euler("xyz", angles).apply(point)

    h = 1e-3
    five = [at(k * h) for k in (-2, -1, 0, 1, 2)]
    rate = (five[0] - 8 * five[1] + 8 * five[3] - five[4]) / (12 * h)
    bend = (-five[0] + 16 * five[1] - 30 * five[2] + 16 * five[3] - five[4]) / (12 * h * h)
    return np.array([five[2], rate, bend])


def support(record, s):
    """Accelerations by differences: compared apart."""
    moved = s.platform[:, :3] + carried(s.platform, record.arm)
    moved[0] += record.place - record.arm
    out = {name: getattr(s, name).copy() for name in ("r",)}
    for k, axis in enumerate(record.axis):
        if record.held[k]:
            out["r"][k, record.node] = moved[0, axis]
    return out


def rotations(a, b):
    """Vectors of the rotations that take directions (3, k) into others."""
    across = np.cross(a, b, axis=0)
    sine = np.sqrt((across**2).sum(axis=0))
    return across * np.arctan2(sine, (a * b).sum(axis=0)) / sine


def spatial_bending(record, s):
    length, t = along(s)
    turn = np.zeros_like(s.turn)
    turn[:, 1:-1] = rotations(t[:, :-1], t[:, 1:])
    turn -= s.moment @ flexibility(s)
    return {
        "turn": turn,
        "force": nodes(np.cross(t, np.diff(s.moment, axis=1), axis=0) / length),
    }


def spatial_bending_damping(record, s):
    length, t = along(s)
    rate = np.cross(t, np.diff(s.v, axis=1), axis=0) / length
    return {"turn": record.time * nodes(rate)}


def spatial_flex_joint(record, s):
    out = np.zeros(s.turn.shape)
    held = carried(s.platform, record.lean)[0][:, None]
    _, t = along(s)
    out[:, -1:] = rotations(t[:, -1:], held)
    return {"turn": out}


def cylinders_in_space(record, s):
    axes = AXES[len(s.dim)]
    ring = np.zeros((2, 3))
    ring[0, axes], ring[1, axes] = s.r[:, record.node], s.v[:, record.node]
    force = np.zeros_like(s.force)
    reach, rate = [], []
    for c in range(len(record.length)):
        deck = s.platform[:, :3] + carried(s.platform, record.deck[:, c])
        line = record.centre + deck[0] - ring[0]
        distance = np.sqrt((line**2).sum())
        reach.append(distance - record.length[c])
        rate.append(line @ (deck[1] - ring[1]) / distance)
        force[:, record.node] += s.pull[c] * line[axes] / distance
    return {"force": force, "reach": np.array(reach), "reach_rate": np.array(rate)}


def position(record, t):
    return record.displacement


def harmonic(record, t):
    out = np.zeros(6)
    ramp = np.where(record.ramp > 0.0, record.ramp, 1e-300)
    grown = np.where(t < ramp, 0.5 * (1.0 - np.cos(np.pi * np.minimum(t / ramp, 1.0))), 1.0)
    value = record.amplitude * np.sin(record.frequency * t + record.phase) * grown
    np.add.at(out, record.motion, value)
    return out


def cruise(record, t):
    out = np.zeros(6)
    sailed = 0.5 * t**2 / record.ramp if t < record.ramp else t - 0.5 * record.ramp
    out[record.motion] = record.speed * sailed
    return out


def series(record, t):
    out = np.zeros(6)
    t = np.clip(t, record.time[0], record.time[-1])
    k = min(np.searchsorted(record.time, t, side="right") - 1, len(record.time) - 2)
    out[record.motion] = np.polyval(record.coefficient[:, k], t - record.time[k])
    return out


#: role of the kernel function that each plain version stands for, and the version
VERSIONS = {
    Axial: [("string", axial)],
    AxialDamping: [("string", axial_damping)],
    Weight: [("string", weight)],
    Inertia: [("string_inertia", inertia)],
    AddedMass: [("string_inertia", added_mass)],
    Drag: [("string", drag)],
    TangentialDrag: [("string", tangential_drag)],
    DragOverDepth: [("drive string", drag_over_depth)],
    Current: [("drive", current)],
    Wave: [("drive", wave)],
    WaveForce: [("string", wave_force)],
    Bending: [("turn string", bending)],
    BendingDamping: [("turn", bending_damping)],
    SpatialBending: [("turn string", spatial_bending)],
    SpatialBendingDamping: [("turn", spatial_bending_damping)],
    SpatialFlexJoint: [("place turn", spatial_flex_joint)],
    CylindersInSpace: [("place drive device", cylinders_in_space)],
    Foreshortening: [("string", foreshortening)],
    FlexJoint: [("turn", flex_joint)],
    Upright: [("drive device", upright)],
    GasSpring: [("law", gas_spring)],
    TwoChamberGas: [("law", two_chamber_gas)],
    TabulatedLaw: [("law", tabulated_law)],
    LinearSpring: [("law", linear_spring)],
    CylinderDamping: [("law", cylinder_damping)],
    EndStop: [("law", end_stop)],
    EndMass: [("device", end_mass), ("device_inertia", end_mass_inertia)],
    InnerFlexJoint: [("probe", inner_flex_joint)],
    SlidingTension: [("string", sliding_tension)],
    SoftClay: [("device", soft_clay)],
    LinearSoil: [("device", linear_soil)],
    StressGauge: [("probe", stress_gauge)],
    Vessel: [("device", vessel), ("device_inertia", vessel_inertia)],
    Munk: [("device", munk)],
    Thrusters: [("device", thrusters), ("device_inertia", thrusters_inertia)],
    LentForce: [("device", lent_force), ("probe", lent_force_reports)],
    ToldMotion: [("place", told_motion)],
    Torsion: [("device", torsion)],
    Waterline: [("drive", waterline)],
    DeadLoad: [("device", pull)],
    TensionLoss: [("device", tension_loss)],
    Support: [("place", support)],
}

MOTIONS = {Position: position, Harmonic: harmonic, Cruise: cruise, Series: series}
