"""The one door for users, studies and tests: a scene becomes a labelled dataset."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.effects.catalogue import absent
from riserstudy.names import ENDINGS, attributes
from riserstudy.scene.load import SceneFile
from riserstudy.solve.kernel_cache import mends_kernel_cache

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.result import Result


S_DIGITS = 9  # decimals of arclengths (m), by which a node is selected


@mends_kernel_cache
def simulate(scene: SceneFile | str | Path, accuracy: float | None = None) -> xr.Dataset:
    """Simulate a scene.

    Parameters
    ----------
    scene : a scene from :func:`riserstudy.load_scene`, or the path of its file.
    accuracy : relative accuracy of displacement and moment asked for, in place of the scene's mesh,
        step or accuracy.

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
    from riserstudy.run import run
    from riserstudy.scene.load import read_scene

    file = scene if isinstance(scene, SceneFile) else read_scene(scene)
    if accuracy is not None:
        file = at_accuracy(file, f"{100 * accuracy!r} %")
    return to_dataset(run(file.scene()), file)


def at_accuracy(file: SceneFile, accuracy: str) -> SceneFile:
    """The scene with an accuracy asked for in place of mesh and step."""
    wanted = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": accuracy}
    return file.with_values(wanted, "accuracy")


def to_dataset(result: Result, file: SceneFile) -> xr.Dataset:
    """Label the arrays of a run, and say what they are."""
    dataset = labelled(result)
    for label in dataset.variables:
        dataset[label].attrs = attributes(str(label))
    dataset.attrs = {
        "Conventions": "CF-1.11",
        "title": file.tree.get("title", ""),
        "source": file.source,
        "effects_off": json.dumps(absent(set(result.facts["effects"]))),
        **{key: _text(value) for key, value in result.facts.items()},
        "provenance": json.dumps(provenance(file)),
    }
    return dataset


def labelled(result: Result) -> xr.Dataset:
    """The arrays of a run with their dimensions, without attributes."""
    import xarray as xr

    arrays = result.arrays
    data = {label: (dims, arrays[name]) for label, (dims, name) in quantities(arrays).items()}
    return xr.Dataset(data, coordinates(arrays))


def coordinates(arrays: dict[str, Any]) -> dict[str, Any]:
    """Coordinates of a run; arclengths, which are sums of segments, rounded so that 533 m is found."""
    coords: dict[str, Any] = {
        name: (name, arrays[name].round(S_DIGITS) if name != "time" else arrays[name])
        for name in ("time", "s", "s_node")
        if name in arrays
    }
    if (force := arrays.get("tensioner_force_static")) is not None:
        coords["cylinder"] = ("cylinder", list(range(len(force))))
    if "time" not in arrays:
        coords["s"] = ("s", coords["s_node"][1])
    return coords


def quantities(arrays: dict[str, Any]) -> dict[str, tuple[tuple[str, ...], str]]:
    """Quantities of a run: dimensions, and the name of the array; statics have short names too."""
    coords = coordinates(arrays)
    found = {
        name: (dimensions(name, values), name)
        for name, values in arrays.items()
        if name not in coords and name != "l0" and not name.startswith("zero_")
    }
    if "time" not in arrays:
        for name in [name for name in found if name.endswith("_static")]:
            dims = found[name][0]
            found[name.removesuffix("_static")] = (("s",) if "s_node" in dims else dims, name)
    return found


def dimensions(name: str, values: Any) -> tuple[str, ...]:
    """Dimensions of an array of a run, by its name and shape."""
    if name.startswith("tensioner_"):
        return ("time", "cylinder")[-values.ndim :]
    if name.endswith(tuple(ENDINGS)):
        return ("s_node",)
    return ("time", "s")[: values.ndim]


def provenance(file: SceneFile) -> dict[str, Any]:
    """Version, engine and scene behind a result, with the origin of each value that has one."""
    from riserstudy import __version__
    from riserstudy.digests import engine_digest

    return {
        "riserstudy": __version__,
        "engine": engine_digest(),
        "scene": file.tree,
        "origins": {path: o.status for path, o in file.origins.items()},
        "plain_values": "published" if file.tree.get("paper") else "given",
    }


def _text(value: Any) -> Any:
    return value if isinstance(value, int | float | str) else json.dumps(value)
