"""The recipe for long records: a prescribed mesh and time step, found on a short piece of the record.

A run with a tolerance refines the whole record. If the tolerance is finer than 5 %, a mesh and a step with an
error of 5 % on the first piece take less time. Coarser runs then estimate the error of the whole record.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from riserstudy.errors import SimulationError
from riserstudy.model.mesh import COARSEST
from riserstudy.scene.analysis import Layers, Mesh
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import controlled
from riserstudy.simulation.forecast import forecast
from riserstudy.simulation.piece import piece_of
from riserstudy.simulation.refine import run
from riserstudy.simulation.starting_mesh import end_layers

LONG_RECORD = 1200.0  # duration of an irregular sea (s) from which on the recipe saves time
ROUGH = 0.05  # relative tolerance to which the piece is refined


class Recipe(NamedTuple):
    """A mesh and a time step for a long record, with their estimated error and time."""

    mesh: Mesh
    step: float  # s
    piece: float  # duration of the piece on which they were found (s)
    error: dict[str, float]  # estimated relative error on the piece
    seconds: float  # estimated time of the whole record, with its error estimate (s)

    @property
    def words(self) -> str:
        """Options to add to the command."""
        parts = [f"elements: {self.mesh.elements}"]
        layers = self.mesh.layers
        if layers:
            ends = (("bottom", layers.bottom), ("top", layers.top))
            given = ", ".join(f"{name}: {value:.3g} m" for name, value in ends if value)
            parts.append(f"layers: {{{given}}}")
        mesh = ", ".join(parts)
        return f"--set analysis.mesh='{{{mesh}}}' --set analysis.step='{self.step:.4g} s'"


def recipe(scene: Resolved) -> Recipe | None:
    """The recipe for a long record; None for other scenes, and with a mesh or a tolerance of 5 % or more.

    Raises SimulationError when the piece cannot be completed.
    """
    if not _long(scene) or scene.analysis.mesh or (scene.analysis.accuracy or 0.0) >= ROUGH:
        return None
    rough = scene.replaced(analysis=scene.analysis.replaced(accuracy=ROUGH, step=None))
    found = forecast(rough)
    if found is None:
        return None
    low, high = (length if math.isfinite(length) else None for length in end_layers(scene))
    layers = Layers.model_construct(bottom=low, top=high) if low or high else None
    elements, step = found.elements, found.step
    error = _error(_with(scene, elements, layers, step), found.piece)
    while coarser := _coarser(scene, elements, layers, step, found.piece):
        elements, step, error = coarser
    whole = _with(scene, elements, layers, step)
    price = forecast(whole)
    seconds = price.seconds if price else math.nan
    mesh = Mesh.model_construct(elements=elements, layers=layers)
    return Recipe(mesh, step, found.piece, error, seconds)


def _coarser(
    scene: Resolved, elements: int, layers: Layers | None, step: float, piece: float
) -> tuple[int, float, dict[str, float]] | None:
    """A longer step (s), or a coarser mesh, that suffices for a piece (s), with its error; else None."""
    for fewer, longer in ((elements, 2.0 * step), (elements // 2, step)):
        if fewer < COARSEST:
            continue
        try:
            error = _error(_with(scene, fewer, layers, longer), piece)
        except SimulationError:
            continue
        if error and max(controlled(error).values()) <= ROUGH:
            return fewer, longer, error
    return None


def _error(scene: Resolved, piece: float) -> dict[str, float]:
    error: dict[str, float] = run(piece_of(scene, piece)).facts["error_estimate"]
    return error


def _with(scene: Resolved, elements: int, layers: Layers | None, step: float) -> Resolved:
    """The scene with a prescribed mesh and time step (s)."""
    mesh = Mesh.model_construct(elements=elements, layers=layers)
    return scene.replaced(analysis=scene.analysis.replaced(accuracy=None, mesh=mesh, step=step))


def _long(scene: Resolved) -> bool:
    return bool(scene.irregular_waves) and (scene.analysis.duration or 0.0) > LONG_RECORD
