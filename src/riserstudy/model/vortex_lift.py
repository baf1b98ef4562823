"""Vortex-induced vibration of a riser's sections, and the phases that it begins with."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.vortex_lift import PHASE, VARIABLES, VortexLift
from riserstudy.model.layout import Layout
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect, Model
from riserstudy.model.sea import fastest_current
from riserstudy.scene.models import Scene
from riserstudy.scene.riser import VortexInducedVibration

FloatArray = NDArray[np.float64]
VORTICES = 10  # over which lift comes up where the scene does not say
WAVES = 16  # cosines along the riser of which phases at the begin are made


def vortex_lift(of: Layout) -> Iterator[Effect]:
    """Lift of the sections that shed vortices, in space."""
    sections = [section.viv for section in of.scene.riser]
    if of.d < 3 or not any(sections):
        return
    each = [0.5 * of.density * v.coefficient * v.diameter if v else 0.0 for v in sections]
    scale = of.per_segment(lambda k: each[k]) * of.mesh.l0
    columns = [
        [v.diameter, v.frequencies[1], v.frequencies[1] - v.frequencies[0],
         v.frequencies[2] - v.frequencies[1], v.memory] if v else [0.0] * 5
        for v in sections
    ]  # fmt: skip
    diameter, *frequencies = at_nodes(
        of.mesh, np.array(columns), np.array([bool(v) for v in sections])
    )
    record = VortexLift(
        scale, scale, np.zeros((3, of.last + 1)), diameter, np.array(frequencies),
        ramp_of(of.scene), 0, np.zeros((VARIABLES, of.last + 1)),
    )  # fmt: skip
    yield Effect("vortex-induced vibration", record, "riser.viv")


def at_nodes(mesh: Mesh, values: FloatArray, there: NDArray[np.bool_]) -> FloatArray:
    """Values of sections (sections, k), in their unit, at the nodes (k, n+1): means by length."""
    section = np.minimum(mesh.section, len(values) - 1)
    length = np.where(there[section] & (mesh.section < len(values)), mesh.l0, 0.0)
    weight = np.zeros(len(mesh.l0) + 1)
    out = np.zeros((values.shape[1], len(weight)))
    for side in (slice(None, -1), slice(1, None)):
        weight[side] += length
        out[:, side] += values[section].T * length
    return out / np.where(weight > 0.0, weight, 1.0)


def shedding(scene: Scene) -> list[VortexInducedVibration]:
    """What sections shed vortices by; ramp and seed are the same in all of them."""
    return [section.viv for section in scene.riser if section.viv]


def ramp_of(scene: Scene) -> float:
    """Time over which lift comes up (s)."""
    ramp = shedding(scene)[0].ramp
    if ramp is not None:
        return ramp
    if scene.current is None:
        raise TypeError("no ramp and no current")  # refused by the scene
    return VORTICES * shedding_period(scene, 1)


def shedding_period(scene: Scene, which: int = 2) -> float:
    """Shortest period of vortices in the current (s), by one of the three frequencies; infinite for none."""
    if scene.current is None or not shedding(scene):
        return math.inf
    speed = fastest_current(scene.current, scene.water)
    if speed == 0.0:
        return math.inf
    return min(v.diameter / (v.frequencies[which] * speed) for v in shedding(scene))


def first_phases(scene: Scene, mesh: Mesh, model: Model) -> None:
    """Give a model the phases that its lift begins with: smooth along the riser, whatever the mesh."""
    if not len(model.s.internal):
        return
    random = np.random.default_rng(shedding(scene)[0].seed)
    share = mesh.s / mesh.s[-1]
    for k, turn in enumerate(random.uniform(0.0, 2.0 * np.pi, WAVES)):
        model.s.internal[PHASE] += np.pi * np.sqrt(2.0 / WAVES) * np.cos(np.pi * k * share + turn)
    model.s.internal_known[:] = model.s.internal
