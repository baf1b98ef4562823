"""Natural modes of the points of a study, stored like points, with a key that differs from the run's key."""

from __future__ import annotations

import hashlib
from functools import cache
from typing import TYPE_CHECKING, Any

from riserstudy.files.digests import dependencies, digest
from riserstudy.study import store
from riserstudy.study.grid import Point

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile
    from riserstudy.study.study import Study

MODES = "riserstudy.simulation.modes"
# number of stations along the riser for shapes, about the number of nodes of a usual mesh
STATIONS = 201
#: variables over ``mode`` and ``s_relative``; others are over ``mode`` alone
SHAPES = ("mode_shape_x", "mode_shape_y", "mode_shape_z")


def key_of_modes(key: str, count: int) -> str:
    """Key of ``count`` modes of the scene of a point."""
    about = f"{key} {count} modes {_code()}"
    return hashlib.sha256(about.encode()).hexdigest()[:32]


@cache
def _code() -> str:
    """Digest of the code that computes modes, which the engine's digest may not include."""
    return digest(dependencies(MODES))


def lacks_modes(study: Study, point: Point) -> bool:
    """Whether a study requests modes of a point that are not stored."""
    count = study.model.modes
    return count is not None and store.get(key_of_modes(point.key, count)) is None


def make_modes(study: Study, point: Point, file: SceneFile) -> None:
    """Compute the modes of a point and store them.

    Raises SimulationError when the scene has no equilibrium, or a node that moves has no mass.
    """
    count = study.model.modes or 0
    store.put(key_of_modes(point.key, count), modes_result(file, count), file)


def modes_result(file: SceneFile, count: int) -> Result:
    """``count`` modes of a scene as arrays, by the names of ``variables_of``."""
    import numpy as np

    from riserstudy.dataset.result import Result
    from riserstudy.simulation.modes import frequency_errors, modes_of

    found = modes_of(file.resolved(), count)
    share = found["s"].values / found["s"].values[-1]
    at = np.linspace(0.0, 1.0, STATIONS)
    arrays = {
        "natural_frequency": found["frequency"].values,
        "frequency_error": frequency_errors(file.resolved(), found["frequency"].values),
        "natural_period": found["natural_period"].values,
        "mode_motion": found["motion"].values.astype("U8"),
    }
    for name in "xyz":
        if name in found:
            shape = [np.interp(at, share, row) for row in found[name].values]
            arrays[f"mode_shape_{name}"] = np.array(shape)
    return Result(arrays, {})


def add_modes(dataset: xr.Dataset, study: Study) -> None:
    """Add modes over the axes, ``mode`` and, for shapes, ``s_relative``, if the study requests them.

    A point with fewer modes, such as an axial spring, has NaN for the missing modes. A point that could not
    be completed has NaN for all.
    """
    import numpy as np

    from riserstudy.dataset.variables import attributes

    count = study.model.modes
    if count is None:
        return
    stored = [store.get(key_of_modes(point.key, count)) for point in study.plan]
    variables = variables_of([None if one is None else one.arrays for one in stored], count)
    shape = tuple(len(steps) for steps in study.axes.values())
    for name, values in variables.items():
        dims = (*study.axes, "mode", "s_relative")[: len(shape) + values.ndim - 1]
        dataset[name] = (dims, values.reshape((*shape, *values.shape[1:])), attributes(name))
    dataset.coords["mode"] = ("mode", np.arange(1, count + 1), attributes("mode"))
    along = np.linspace(0.0, 1.0, STATIONS)
    dataset.coords["s_relative"] = ("s_relative", along, attributes("s_relative"))


def variables_of(stored: list[dict[str, NDArray[Any]] | None], count: int) -> dict[str, NDArray[Any]]:
    """Arrays of n points, (n, count), and for shapes (n, count, STATIONS); None: a point without modes."""
    import numpy as np

    names = dict.fromkeys(name for arrays in stored for name in arrays or ())
    found: dict[str, NDArray[Any]] = {}
    for name in names:
        inner = (count, STATIONS) if name in SHAPES else (count,)
        text = name == "mode_motion"
        found[name] = np.full((len(stored), *inner), "" if text else np.nan, object if text else float)
        for k, arrays in enumerate(stored):
            if arrays is not None and name in arrays:
                found[name][k, : len(arrays[name])] = arrays[name]
    return found
