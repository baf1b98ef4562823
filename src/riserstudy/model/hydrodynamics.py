"""What fluid around and inside does to the riser string: contents, added mass, force of waves, drags."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.drag import Drag
from riserstudy.effects.drag_over_depth import DragOverDepth
from riserstudy.effects.tangential_drag import TangentialDrag
from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave import CONSTANT, NONE, STRETCHED, Wave
from riserstudy.effects.wave_force import WaveForce
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect
from riserstudy.model.sea import components_of, wave_number
from riserstudy.scene.forcing import Water
from riserstudy.scene.models import Scene
from riserstudy.scene.sea import IrregularSea, RegularWave

FloatArray = NDArray[np.float64]
ABOVE = {"none": NONE, "constant": CONSTANT, "stretched": STRETCHED}


def wet(scene: Scene, mesh: Mesh, d: int) -> Iterator[Effect]:
    """Their effects in ``d`` directions; along a line there is none but tangential drag."""
    rho = scene.water.density if scene.water else 0.0
    across = [*_masses(scene, mesh, d, rho), *_drag(scene, mesh, d, rho)] if d > 1 else []
    effects = [*across, *_tangential(scene, mesh, rho)]
    yield from [e for e in effects if not isinstance(e.record, DragOverDepth)]
    yield from _waterline(scene, effects, len(mesh.l0))
    # after the waterline, which changes their scale
    yield from [e for e in effects if isinstance(e.record, DragOverDepth)]


def _masses(scene: Scene, mesh: Mesh, d: int, rho: float) -> Iterator[Effect]:
    """What goes with the pipe, and with the water's acceleration."""
    inside = over(mesh, [s.contents_mass for s in scene.riser])
    if np.any(inside):
        yield Effect("contents", AddedMass(inside, -inside, 0), "riser.contents")
    accelerated = np.zeros(len(mesh.l0))
    for direction in (None, "horizontal"):
        around = [s.added_mass for s in scene.riser]
        these = [a if a and a.direction == direction else None for a in around]
        displaced = [a.displaced(rho) if a else 0.0 for a in these]
        added = over(
            mesh, [a.coefficient * m if a else 0.0 for a, m in zip(these, displaced, strict=True)]
        )
        accelerated += over(mesh, displaced) + added
        if np.any(added):
            record = AddedMass(added, -added, int(direction is not None))
            yield Effect("added mass", record, "riser.added_mass")
    if scene.wave and np.any(accelerated):
        force = WaveForce(accelerated, np.zeros((d, len(mesh.l0) + 1)))
        yield Effect("wave force", force, "wave, riser.added_mass")


def _drag(scene: Scene, mesh: Mesh, d: int, rho: float) -> Iterator[Effect]:
    """One effect for all constant coefficients, and one for each table over elevation, by direction."""
    drags = [s.drag for s in scene.riser]
    for direction, table in dict.fromkeys((a.direction, a.table) for a in drags if a):
        these = [a if a and (a.direction, a.table) == (direction, table) else None for a in drags]
        horizontal, scratch = int(direction is not None), np.zeros((d, len(mesh.l0) + 1))
        scale = [0.5 * rho * a.diameter if a else 0.0 for a in these]
        if table:
            low, up = np.zeros((2, len(mesh.l0)))
            points = np.array(table).T.copy()
            record = DragOverDepth(low, up, scratch, horizontal, over(mesh, scale), *points)
            yield Effect("drag", record, "riser.drag")
            continue
        whole = over(
            mesh, [x * a.constant if a else 0.0 for x, a in zip(scale, these, strict=True)]
        )
        if np.any(whole):
            yield Effect("drag", Drag(whole, whole, scratch, horizontal), "riser.drag")


def _tangential(scene: Scene, mesh: Mesh, rho: float) -> Iterator[Effect]:
    """Drag along the pipe."""
    around = [s.tangential_drag for s in scene.riser]
    scale = over(
        mesh, [0.5 * rho * math.pi * a.coefficient * a.diameter if a else 0.0 for a in around]
    )
    if np.any(scale):
        yield Effect("tangential drag", TangentialDrag(scale), "riser.tangential_drag")


def _waterline(scene: Scene, effects: list[Effect], n: int) -> Iterator[Effect]:
    """What wets segments in part, by changing the arrays of the others, where there is a surface."""
    if scene.water is None or scene.water.surface is None:
        return

    def records(name: str) -> list[Any]:
        return [effect.record for effect in effects if effect.name == name]

    drags = records("drag") + records("tangential drag")
    added = records("added mass")
    rows = zip_longest(
        [drag.scale if isinstance(drag, DragOverDepth) else drag.low for drag in drags],
        [record.mass for record in added],
        [record.minus for record in added],
        [record.mass for record in records("wave force")],
    )
    for row in rows:
        drag, mass, minus, wave = (np.zeros(n) if a is None else a for a in row)
        full = np.stack([drag, mass, wave])
        record = Waterline(scene.water.surface, full, np.ones(n), drag, mass, minus, wave)
        yield Effect(
            "waterline",
            record,
            "water.surface, riser.drag, riser.tangential_drag, riser.added_mass",
        )


def wave_of(
    sea: RegularWave | IrregularSea, water: Water, gravity: float, heading: FloatArray
) -> Wave:
    """Components of a wave or sea, travelling along a horizontal unit vector."""
    if water.surface is None or water.seabed is None:
        raise TypeError("waves on water without levels")  # refused by the scene
    depth = water.surface - water.seabed
    amplitude, frequency, phase = components_of(sea)
    number = np.array([wave_number(w, depth, gravity) for w in frequency])
    return Wave(
        amplitude, frequency, number, phase, heading,
        water.surface, depth, sea.ramp or 0.0, ABOVE[sea.above_mean_level],
    )  # fmt: skip


def over(mesh: Mesh, value: Sequence[float]) -> FloatArray:
    """Values per length of the sections, over the segments: (n,); none in a telescopic joint."""
    return np.array([*value, 0.0])[mesh.section] * mesh.l0
