"""The records of tensioners: the law of each cylinder, and where the cylinders are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects import recoil_valve as throttle
from riserstudy.effects.cylinder import Upright
from riserstudy.effects.cylinder_damping import CylinderDamping
from riserstudy.effects.cylinders_in_space import CylindersInSpace
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.end_stop import EndStop
from riserstudy.effects.gas_spring import GasSpring
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.tabulated_law import TabulatedLaw
from riserstudy.effects.two_chamber_gas import TwoChamberGas
from riserstudy.model.bending import shared_flexibility
from riserstudy.model.layout import Layout
from riserstudy.model.model import Effect
from riserstudy.model.platform_motion import centre
from riserstudy.model.space_out import ring_at_mid_stroke
from riserstudy.model.supports import top_at_rest
from riserstudy.model.tensioner_law import linear_law, table_law
from riserstudy.scene.disconnect import RecoilValve
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.tensioners import Arrangement, Tensioners

PISTONS = "top.tensioners.two_chamber_gas.pistons"
GAS_FIELDS = ("area", "pressure", "volume")


def tensioners(of: Layout) -> Iterator[Effect]:
    """Cylinders between platform and tension ring."""
    rig, ring = of.scene.top.tensioners, of.mesh.ring
    if rig is None:
        return
    valve = of.scene.disconnect and of.scene.disconnect.recoil_valve
    yield from laws(rig, of.gravity, recoil_valve(rig, valve, of.scene) if valve else [])
    yield from pistons(rig, ring, of.d)
    elevation = of.bottom + of.mesh.riser_length
    if rig.mid_stroke == "riser in equilibrium":
        elevation = ring_at_mid_stroke(of.scene)
    if rig.arrangement is None:
        yield upright(of, rig, elevation)
        return
    record = in_space(of, rig, rig.arrangement, elevation)
    yield Effect("tensioner cylinders", record, "top.tensioners.arrangement")


def laws(rig: Tensioners, gravity: float, throttled: Iterable[Effect] = ()) -> Iterator[Effect]:
    """The laws that give the pull of each cylinder, with the gravity (m/s2) that acts on pistons.

    ``throttled``: effects on the pull of the gas alone, such as a recoil valve.
    """
    each = np.array(rig.working)
    record: Any
    if rig.gas and not rig.linearised:
        gas = rig.gas
        ones = np.ones(rig.count)
        record = GasSpring(gas.area * each, gas.pressure * ones, gas.volume * ones, gas.exponent * ones)
        yield Effect("gas tensioner", record, "top.tensioners.gas")
        yield from outside(gas.outside_force * each, "gas tensioner", "top.tensioners.gas")
    elif rig.two_chamber_gas and not rig.linearised:
        both = rig.two_chamber_gas
        values = [
            getattr(side, name) * (each if name == "area" else np.ones(rig.count))
            for side in (both.high, both.low)
            for name in GAS_FIELDS
        ]
        values += [both.exponent * np.ones(rig.count), rig.piston_mass * gravity * each]
        record = TwoChamberGas(*values)
        name, why = "two-chamber gas tensioner", "top.tensioners.two_chamber_gas"
        yield Effect(name, record, why)
        yield from outside(both.outside_force * each, name, why)
    elif rig.table:
        law = table_law(rig.table, rig.interpolation)
        work = law.antiderivative()
        work.c[-1] -= float(work(0.0))
        record = TabulatedLaw(law.x, law.c, work.c, each)
        yield Effect("tabulated tensioner", record, "top.tensioners.table")
    else:
        tension, slope = linear_law(rig, gravity)
        why = "top.tensioners.linearised" if rig.any_gas else "top.tensioners.linear"
        yield Effect("linear tensioner", LinearSpring(tension * each, slope * each), why)
    yield from throttled
    if rig.damper:
        record = CylinderDamping(rig.damper * each)
        yield Effect("tensioner damping", record, "top.tensioners.damping")
    if rig.stroke:
        stop = rig.stroke
        ones = np.ones(rig.count)
        record = EndStop(stop.shortest * ones, stop.longest * ones, stop.stop_stiffness * each)
        yield Effect("end stops", record, "top.tensioners.stroke")


def outside(force: NDArray[np.float64], name: str, why: str) -> Iterator[Effect]:
    """The reduction of the gas pull by the external pressure, (cylinders,), N."""
    if np.any(force):
        yield Effect(name, LinearSpring(-force, np.zeros(len(force))), why)


def recoil_valve(rig: Tensioners, valve: RecoilValve, scene: Resolved) -> Iterator[Effect]:
    """The valves between cylinders and their gas."""
    gas, release = rig.pulling, scene.disconnect
    if gas is None or release is None:
        return  # refused by the scene
    each = np.array(rig.working)
    residual = np.full(rig.count, valve.residual)
    residual[valve.failed or []] = 1.0
    record = throttle.RecoilValve(
        resistance=each * 0.5 * valve.oil_density * gas.area**3 / (valve.discharge * valve.opening) ** 2,
        residual=residual,
        start=release.at + (valve.delay or 0.0),
        over=valve.over,
        added=np.zeros(rig.count),
    )
    yield Effect("recoil valve", record, "disconnect.recoil_valve")


def pistons(rig: Tensioners, ring: int, directions: int) -> Iterator[Effect]:
    """Mass of the pistons, which move with the ring."""
    if rig.piston_mass:
        mass = np.zeros(directions)
        mass[-1] = sum(rig.working) * rig.piston_mass
        record = EndMass(ring, 0.0, mass, np.zeros(2), np.zeros(directions))
        yield Effect("piston mass", record, PISTONS)


def upright(of: Layout, rig: Tensioners, elevation: float) -> Effect:
    """Vertical cylinders, at mid-stroke when the ring is at an elevation (m)."""
    arm = np.array(top_at_rest(of)) - centre(of.scene.platform)
    record = Upright(of.mesh.ring, np.full(rig.count, elevation), arm, np.zeros((3, 3)))
    return Effect("tensioner cylinders", record, "top.tensioners")


def in_space(of: Layout, rig: Tensioners, place: Arrangement, elevation: float) -> CylindersInSpace:
    """Cylinders in space, at mid-stroke when the ring is at an elevation (m) below the centre of the deck.

    The centre of the deck is vertically above the riser's top, so an offset of the top moves the deck, too.
    In a scene with a vessel, positions are relative to the vessel.
    """
    top, vessel = of.scene.top, of.last if of.scene.vessel else 0
    middle = np.zeros((3, 1))
    if top.x != "free":
        middle[0] = top.offset or 0.0
    bearing = np.array(place.bearings(rig.count))
    round_about = np.stack([np.cos(bearing), np.sin(bearing), np.zeros(rig.count)])
    deck = place.deck_radius * round_about
    deck[2] = place.deck_elevation
    points = place.ring_radius * round_about
    apart = deck - points
    apart[2] -= elevation
    about = centre(of.scene.platform)
    from_vessel = np.array([middle[0, 0], 0.0, 0.0]) if vessel else np.zeros(3)
    bend = shared_flexibility(of)[[-2, -1]] if of.m and of.mesh.joint else np.zeros((2, 2))
    return CylindersInSpace(
        node=of.mesh.ring,
        vessel=vessel,
        centre=about - from_vessel,
        deck=deck + middle - about[:, None],
        ring=points,
        length=np.sqrt((apart**2).sum(axis=0)),
        below=bend[0].copy(),
        above=bend[1].copy(),
        work=np.zeros((3, 3)),
        base=np.zeros((2, 3)),
    )
