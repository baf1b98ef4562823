"""The one door for users, studies and tests: a scene becomes a labelled dataset."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.dataset.label import to_dataset
from riserstudy.model.absent_effects import absent
from riserstudy.scene.load import SceneFile

if TYPE_CHECKING:
    import xarray as xr


def simulate(
    scene: SceneFile | str | Path,
    accuracy: float | None = None,
    tell: Callable[[str], None] | None = None,
) -> xr.Dataset:
    """Simulate a scene.

    Parameters
    ----------
    scene : a scene from :func:`riserstudy.load_scene`, or the path of its file.
    accuracy : relative accuracy of displacement and moment asked for, in place of the scene's mesh,
        step or accuracy.
    tell : is told after each refinement how far a run is that takes long.

    Returns
    -------
    Dataset with ``x``, ``z`` (m, those that exist), ``effective_tension`` (N) and ``bending_moment``
    (N m) over ``time`` (s) and ``s`` (m, unstretched arclength from the bottom); without ``time`` for
    statics. Envelopes (``_max``, ``_min``) and the state at rest (``_static``) over ``s_node``, at all
    nodes. Attributes hold effects, audit, error estimate and provenance as JSON text.

    Raises
    ------
    InputError
        When the scene cannot be meant.
    SimulationError
        When it cannot be completed.
    """
    from riserstudy.scene.load import read_scene
    from riserstudy.simulation.refine import run

    file = scene if isinstance(scene, SceneFile) else read_scene(scene)
    if accuracy is not None:
        file = at_accuracy(file, f"{100 * accuracy!r} %")
    result = run(file.scene(), tell=tell)
    return to_dataset(result, file, absent(set(result.facts["effects"])))


def at_accuracy(file: SceneFile, accuracy: str) -> SceneFile:
    """The scene with an accuracy asked for in place of mesh and step."""
    wanted = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": accuracy}
    return file.with_values(wanted, "accuracy")
