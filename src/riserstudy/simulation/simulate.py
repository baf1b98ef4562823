"""The entry point for users, studies and tests: from a scene to a labelled dataset."""

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
        Tolerance of displacement, moment and tension, as a fraction of 1. It replaces mesh, time step and
        accuracy of the scene.
    patience : float or str, optional
        Time limit: a number of seconds, or text such as ``"10 min"``. After this time, the result is the
        finest completed run with its estimated error; the attribute ``ended_by`` and a warning state this.
        A scene with a prescribed mesh and time step has no coarser result, so the time limit then ends the
        simulation without a result. By default there is no time limit.
    progress : bool
        Show the current run, its progress and the approximate time left, on a terminal or in a notebook.

    Returns
    -------
    xarray.Dataset
        Positions ``x``, ``y``, ``z`` (m; only the directions that the scene includes),
        ``effective_tension`` (N) and ``bending_moment`` (N m), with the dimensions ``time`` (s) and ``s``
        (m, unstretched arclength from the lower end). A static run has no ``time``. Envelopes (names with
        ``_max``, ``_min``) and the static equilibrium (``_static``) have the dimension ``s_node``: all nodes.
        Attributes contain effects, audit, error estimate and provenance as JSON text.

    Raises
    ------
    InputError
        When the scene or the time limit is invalid.
    SimulationError
        When the simulation cannot be completed, or no run ends within the time limit.
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
    """The scene with a tolerance in place of mesh and time step."""
    wanted = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": accuracy}
    return file.with_values(wanted, "accuracy")


def seconds(patience: float | str | None) -> float:
    """Time limit in seconds, from a number of seconds or text with a unit; infinite if absent.

    Raises InputError when it is not a positive time.
    """
    allowed = "give a positive number of seconds, or text such as '10 min'"
    try:
        value = math.inf if patience is None else _number(str(patience).strip())
    except ValueError:
        raise InputError("patience", "", f"{patience!r} is not a time", allowed) from None
    if not value > 0.0:
        raise InputError("patience", "", f"{patience!r} is not above 0 s", allowed)
    return value


def _number(text: str) -> float:
    """Seconds, from a text with a number alone or with a unit."""
    try:
        return float(text)
    except ValueError:
        return to_si(text, "s")
