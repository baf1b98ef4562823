"""Natural modes as a dataset in which every variable has its name and unit.

It is apart from `modes`, so that an edit of a name or unit does not count as one of the engine.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.dataset.complete import complete
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.modes import frequency_errors, modes_of

if TYPE_CHECKING:
    import xarray as xr


def modes(scene: SceneFile | str | Path, count: int = 10) -> xr.Dataset:
    """Compute the natural modes with the lowest frequencies, about the static equilibrium of a scene.

    The mesh is that of the scene; without one, it has about 200 segments. The errors of frequencies are
    estimated from two finer meshes, with two and four times as many segments.

    Parameters
    ----------
    scene : SceneFile or str or Path
        A scene from :func:`riserstudy.load_scene`, or the path of its file.
    count : int
        Number of modes.

    Returns
    -------
    xarray.Dataset
        With the dimension ``mode``: ``frequency`` (Hz), ``frequency_error`` (estimated relative error, 1),
        ``natural_period`` (s) and ``motion``, the direction of the largest motion: lateral, axial, or yaw of
        the vessel. For an unstable direction, the frequency is negative and the period is NaN. Errors are NaN
        where a section without mass prevents finer meshes. With the dimensions ``mode`` and ``s`` (m,
        unstretched arclength from the lower end): the mode shapes ``x``, ``y``, ``z``, scaled to a largest
        component of 1. Only the directions of the model are included.

    Raises
    ------
    InputError
        When the scene is invalid, or ``count`` is below 1.
    SimulationError
        When there is no equilibrium, or a node that moves has no mass.
    """
    if count < 1:
        raise InputError("modes", "count", f"{count} is not a number of modes", "give 1 or more")
    file = scene if isinstance(scene, SceneFile) else read_scene(scene)
    dataset = modes_of(file.resolved(), count)
    errors = frequency_errors(file.resolved(), dataset["frequency"].values)
    dataset["frequency_error"] = ("mode", errors, attributes("frequency_error"))
    dataset = complete(dataset)
    dataset.attrs |= {"title": file.tree.get("title", ""), "source": file.source}
    return dataset
