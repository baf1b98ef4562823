"""The one door for users, studies and tests: a scene becomes a labelled dataset."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.effects.catalogue import absent
from riserstudy.names import ENDINGS, attributes
from riserstudy.scene.load import SceneFile
from riserstudy.sound import sound_kernels

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.result import Result


@sound_kernels
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
    coords: dict[str, Any] = {
        name: (name, arrays[name]) for name in ("time", "s", "s_node") if name in arrays
    }
    if (force := arrays.get("tensioner_force_static")) is not None:
        coords["cylinder"] = ("cylinder", list(range(len(force))))
    static_only = "time" not in arrays
    data: dict[str, Any] = {}
    for name, values in arrays.items():
        if name in coords or name in ("l0",) or name.startswith("zero_"):
            continue
        data[name] = (dimensions(name, values), values)
    if static_only:
        coords["s"] = ("s", arrays["s_node"])
        for name in [n for n in data if n.endswith("_static")]:
            short = name.removesuffix("_static")
            place = ("s",) if "s_node" in data[name][0] else data[name][0]
            data[short] = (place, arrays[name])
    return xr.Dataset(data, coords)


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
    from riserstudy.store import engine_digest

    return {
        "riserstudy": __version__,
        "engine": engine_digest(),
        "scene": file.tree,
        "origins": {path: o.status for path, o in file.origins.items()},
        "plain_values": "published" if file.tree.get("paper") else "given",
    }


def _text(value: Any) -> Any:
    return value if isinstance(value, int | float | str) else json.dumps(value)
