"""Effects of the fluids around and inside the riser string: contents, added mass, wave force, drag."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.current import Current
from riserstudy.effects.drag import Drag
from riserstudy.effects.drag_over_depth import DragOverDepth
from riserstudy.effects.tangential_drag import TangentialDrag
from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave import CONSTANT, NONE, STRETCHED, Wave
from riserstudy.effects.wave_force import WaveForce
from riserstudy.model.current_jump import spread, up_to_surface
from riserstudy.model.layout import Layout
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect
from riserstudy.model.sea import components_of, current_table, current_velocity, still_surface, wave_numbers
from riserstudy.model.vortices import vortex_forces
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import IrregularSea, RegularWave
from riserstudy.scene.water import Water

ABOVE = {"none": NONE, "constant": CONSTANT, "stretched": STRETCHED}


def current(of: Layout) -> Iterator[Effect]:
    """The current, if the riser can move laterally."""
    flow = of.scene.current
    if flow is None or of.d == 1:
        return
    if not flow.turns:
        z, speed = current_table(flow, of.scene.water)
        velocity = speed[np.newaxis]
    else:
        z, velocity = current_velocity(flow, of.scene.water)
    if (surface := still_surface(of.scene)) is not None:
        z, velocity = up_to_surface(z, velocity, surface)
    z, velocity = spread(z, velocity, of.upright)
    if not flow.turns:
        parts = [(flow.towards, velocity[0])]
    else:
        parts = list(zip((0.0, 0.5 * math.pi), velocity, strict=True))[: of.d - 1]
    for heading, speed in parts:
        near = np.zeros(of.last + 1, np.int64)
        record = Current(z, speed, of.along(heading), near, flow.ramp or 0.0)
        yield Effect("current", record, "current")


def wave(of: Layout) -> Iterator[Effect]:
    """The flow of waves, if the riser can move laterally."""
    sea, water = of.scene.wave, of.scene.water
    if sea and water and of.d > 1:
        yield Effect("wave", wave_of(sea, water, of.gravity, of.along(sea.heading)), "wave")


def hydrodynamics(of: Layout) -> Iterator[Effect]:
    """Effects of water and contents; a model with one direction has only tangential drag."""
    across = of.d > 1
    added = [*_added_mass(of)] if across else []
    waves = [*_wave_force(of)] if across else []
    drags = [*_drag(of)] if across else []
    constant = [drag for drag in drags if isinstance(drag.record, Drag)]
    by_depth = [drag for drag in drags if isinstance(drag.record, DragOverDepth)]
    tangential = [*_tangential(of)]
    lifts = [*vortex_forces(of)]
    if across:
        yield from _contents(of.scene, of.mesh)
    yield from [*added, *waves, *constant, *tangential, *lifts]
    yield from _waterline(of.scene, [*drags, *tangential, *lifts], added, waves, of.last)
    yield from by_depth  # after the waterline, which changes their scale


def _contents(scene: Resolved, mesh: Mesh) -> Iterator[Effect]:
    inside = over(mesh, [s.contents_mass for s in scene.riser])
    if np.any(inside):
        yield Effect("contents", AddedMass(inside, -inside, 0), "riser.contents")


def _added_mass(of: Layout) -> Iterator[Effect]:
    """Added mass of water that moves with the pipe, across the pipe or horizontally."""
    for direction in (None, "horizontal"):
        _, added = _accelerated(of, direction)
        if np.any(added):
            record = AddedMass(added, -added, int(direction is not None))
            yield Effect("added mass", record, "riser.added_mass")


def _wave_force(of: Layout) -> Iterator[Effect]:
    """The force in proportion to the water's acceleration, of displaced water and added mass."""
    force = np.zeros(of.last)
    for direction in (None, "horizontal"):
        displaced, added = _accelerated(of, direction)
        force += displaced + added
    if of.scene.wave and np.any(force):
        record = WaveForce(force, np.zeros((of.d, of.last + 1)))
        yield Effect("wave force", record, "wave, riser.added_mass")


def _accelerated(of: Layout, direction: str | None) -> tuple[FloatArray, FloatArray]:
    """Displaced and added mass of the segments whose added mass has a direction, (n,) each, kg."""
    around = [s.added_mass for s in of.scene.riser]
    these = [a if a and a.direction == direction else None for a in around]
    displaced = [a.displaced(of.density) if a else 0.0 for a in these]
    added = [a.coefficient * m if a else 0.0 for a, m in zip(these, displaced, strict=True)]
    return _in_water(of, displaced), _in_water(of, added)


def _drag(of: Layout) -> Iterator[Effect]:
    """One effect for all constant coefficients, and one for each table over elevation, by direction."""
    drags, n = [s.drag for s in of.scene.riser], of.last
    for direction, table in dict.fromkeys((a.direction, a.table) for a in drags if a):
        these = [a if a and (a.direction, a.table) == (direction, table) else None for a in drags]
        horizontal, scratch = int(direction is not None), np.zeros((of.d, n + 1))
        scale = [0.5 * of.density * a.diameter if a else 0.0 for a in these]
        if table:
            low, up = np.zeros((2, n))
            elevation, coefficient = np.array(table).T.copy()
            slope, whole = np.zeros((3, n)), _in_water(of, scale)
            record = DragOverDepth(low, up, scratch, horizontal, whole, elevation, coefficient, slope)
            yield Effect("drag", record, "riser.drag")
            continue
        whole = _in_water(of, [x * a.constant if a else 0.0 for x, a in zip(scale, these, strict=True)])
        if np.any(whole):
            yield Effect("drag", Drag(whole, whole, scratch, horizontal), "riser.drag")


def _tangential(of: Layout) -> Iterator[Effect]:
    """Drag along the pipe."""
    around = [s.tangential_drag for s in of.scene.riser]
    rho = of.density
    scale = _in_water(of, [0.5 * rho * math.pi * a.coefficient * a.diameter if a else 0.0 for a in around])
    if np.any(scale):
        yield Effect("tangential drag", TangentialDrag(scale), "riser.tangential_drag")


def _waterline(
    scene: Resolved, drags: list[Effect], added: list[Effect], waves: list[Effect], n: int
) -> Iterator[Effect]:
    """Effects that reduce drag, added mass and wave force to wet shares, by writing those effects' arrays."""
    if scene.water is None or scene.water.surface is None:
        return
    resisting: list[Any] = [effect.record for effect in drags]
    moving: list[Any] = [effect.record for effect in added]
    carrying: list[Any] = [effect.record for effect in waves]
    rows = zip_longest(
        [drag.scale if isinstance(drag, DragOverDepth) else drag.low for drag in resisting],
        [record.mass for record in moving],
        [record.minus for record in moving],
        [record.mass for record in carrying],
    )
    for row in rows:
        drag, mass, minus, wave = (np.zeros(n) if a is None else a for a in row)
        full = np.stack([drag, mass, wave])
        record = Waterline(scene.water.surface, full, np.ones(n), drag, mass, minus, wave)
        yield Effect(
            "waterline", record, "water.surface, riser.drag, riser.tangential_drag, riser.added_mass"
        )


def wave_of(sea: RegularWave | IrregularSea, water: Water, gravity: float, heading: FloatArray) -> Wave:
    """The record of a wave or sea that travels along a horizontal unit vector, (d - 1,); gravity in m/s2."""
    if water.surface is None or water.seabed is None:
        raise TypeError("waves on water without levels")  # refused by the scene
    depth = water.surface - water.seabed
    amplitude, frequency, phase = components_of(sea)
    number = wave_numbers(frequency, water, gravity)
    return Wave(
        amplitude, frequency, number, phase, heading,
        water.surface, depth, sea.ramp or 0.0, ABOVE[sea.above_mean_level], np.zeros((3, len(amplitude))),
    )  # fmt: skip


def _in_water(of: Layout, value: Sequence[float]) -> FloatArray:
    """Section values per metre times the lengths (m) of the segments' parts above the ground, (n,)."""
    return over(of.mesh, value) * of.above_ground


def over(mesh: Mesh, value: Sequence[float]) -> FloatArray:
    """Section values per metre times segment lengths (m), (n,); zero in a telescopic joint."""
    return np.array([*value, 0.0])[mesh.section] * mesh.l0
