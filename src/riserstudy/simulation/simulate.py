"""The one door for users, studies and tests: a scene becomes a labelled dataset."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.dataset.label import to_dataset
from riserstudy.errors import InputError
from riserstudy.model.absent_effects import absent
from riserstudy.scene.load import SceneFile
from riserstudy.scene.units import to_si

if TYPE_CHECKING:
    import xarray as xr


def simulate(
    scene: SceneFile | str | Path,
    accuracy: float | None = None,
    patience: float | str | None = None,
    *,
    progress: bool = True,
) -> xr.Dataset:
    """Simulate a scene.

    Parameters
    ----------
    scene : SceneFile or str or Path
        A scene from :func:`riserstudy.load_scene`, or the path of its file.
    accuracy : float, optional
        Relative accuracy of displacement and moment requested in place of the scene's mesh, step or accuracy.
    patience : float or str, optional
        Time after which the best result so far is returned, with its estimated error: seconds, or text
        such as ``"10 min"``. The attribute ``ended_by`` and a warning then say so. A scene with a mesh of
        its own has no coarser result to return, and is refused instead. Absent: without end.
    progress : bool
        Show on a terminal or in a notebook what is run, how far it is and what is left to do.

    Returns
    -------
    xarray.Dataset
        ``x``, ``z`` (m, those that exist), ``effective_tension`` (N) and ``bending_moment`` (N m) over
        ``time`` (s) and ``s`` (m, unstretched arclength from the bottom); without ``time`` for statics.
        Envelopes (``_max``, ``_min``) and the state at rest (``_static``) over ``s_node``, at all nodes.
        Attributes hold effects, audit, error estimate and provenance as JSON text.

    Raises
    ------
    InputError
        When the scene, or the patience, cannot be meant.
    SimulationError
        When it cannot be completed, or no run ends within the patience.
    """
    from riserstudy.scene.load import read_scene
    from riserstudy.simulation.progress_line import progress_line
    from riserstudy.simulation.refine import run

    file = scene if isinstance(scene, SceneFile) else read_scene(scene)
    if accuracy is not None:
        file = at_accuracy(file, f"{100 * accuracy!r} %")
    limit = seconds(patience)
    checked = file.resolved()
    with progress_line(progress) as notify:
        result = run(checked, limit, notify=notify)
    return to_dataset(result, file, absent(set(result.facts["effects"])))


def at_accuracy(file: SceneFile, accuracy: str) -> SceneFile:
    """The scene with an accuracy requested in place of mesh and step."""
    wanted = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": accuracy}
    return file.with_values(wanted, "accuracy")


def seconds(patience: float | str | None) -> float:
    """Patience in seconds, from a number of them or text with a unit; infinite where it is absent.

    Raises
    ------
    InputError
        When it is no positive time.
    """
    allowed = "allowed is a positive number of seconds, or text such as '10 min'"
    try:
        value = math.inf if patience is None else _number(str(patience).strip())
    except ValueError:
        raise InputError("patience", "", repr(patience), allowed) from None
    if not value > 0.0:
        raise InputError("patience", "", repr(patience), allowed)
    return value


def _number(text: str) -> float:
    """Seconds, where a text is a number alone; else by its unit."""
    try:
        return float(text)
    except ValueError:
        return to_si(text, "s")
