"""One stored reference solution: envelopes, some instants of its histories, and its origin.

The file is compressed netCDF. Its nodes are close to the nodes of the run that it was refined from, so that
coarse runs are compared at their own nodes. Positions count from the unstretched straight riser. Values are
rounded to multiples of 1/131 072 of the largest value, far below the error of any compared run. The file
contains their second differences along the nodes, because these are small. Their double cumulative sum,
times ``unit_of_differences``, gives the values.
"""

from __future__ import annotations

import gzip
import io
import json
import zlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.result import Result
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.simulation.error_estimate import HISTORIES, statistics_of

if TYPE_CHECKING:
    import xarray as xr


ENDS = ("_static", "_min", "_max")
MANY = 60  # most nodes of a coarser run with which the middles of its segments are stored
MOST_VALUES = 8_000  # of a stored history, over nodes and outputs
LEAST_OUTPUTS = 8
RESOLUTION = 2.0**-17  # relative to the largest value
COMPONENTS = "mesh_moment"  # in space: components of the moment over time
MIDDLE = ("mesh_moment_min", "mesh_moment_max")  # at the middle of a segment
OF_SEGMENTS = ("mesh_flexibility", *MIDDLE)
OF_NODES = {"s_node", "mesh_corner", "zero_z", *(name + end for name in HISTORIES for end in ENDS)}
EXACT = {"s_node", "time", "mesh_flexibility", "mesh_corner", "zero_z"}
DIGITS = 7  # significant digits of statistics
KEPT = ("elements", "step", "statistics")  # facts that are stored
UNITS = {"x": "m", "y": "m", "z": "m", "s_node": "m", "time": "s", "effective_tension": "N"}


@dataclass(frozen=True)
class Kept:
    """A reference solution, or the reason why there is none.

    ``error``: change by the last refinement, by quantity, relative to the largest value. If refinement
    converges, it is no less than the remaining error. ``more``: further plain data that a study stores.
    """

    case: str
    scene: str
    physics: int
    engine: str
    how: str
    error: dict[str, float] = field(default_factory=dict)
    result: Result | None = None
    missing: str = ""
    more: dict[str, Any] = field(default_factory=dict)


class Damaged(Exception):
    """Error: the bytes of a file are not a stored reference solution."""


def reduced(result: Result, nodes: FloatArray | None = None) -> Result:
    """Reduce a run with histories at all nodes to the compared arrays, at fewer nodes and outputs.

    For vortex-induced vibration, statistics replace histories.

    Parameters
    ----------
    nodes : arclengths (m) of the nodes of a coarser run; None: all nodes of the run itself.
    """
    arrays = result.arrays
    keep = np.arange(len(arrays["s_node"])) if nodes is None else next_to(nodes, arrays["s_node"])
    less = {name: values[keep] for name, values in arrays.items() if name in OF_NODES}
    less |= _of_segments(arrays, keep)
    less["l0"] = np.diff(less["s_node"])
    facts, vibration = result.facts, statistics_of(result)
    if vibration is not None:
        plain = _rounded(vibration.at(less["s_node"]).plain())
        return Result(less, facts | {"statistics": plain})
    if "time" in arrays:
        outputs = len(arrays["time"])
        nth = max(1, outputs // max(LEAST_OUTPUTS, MOST_VALUES // len(keep)))
        less |= {"s": less["s_node"], "time": arrays["time"][::nth]}
        for name in (*HISTORIES, COMPONENTS):
            if name in arrays:
                less[name] = np.ascontiguousarray(arrays[name][::nth, ..., keep])
    return Result(less, facts)


def _rounded(value: Any) -> Any:
    """Round plain numbers to the digits that a comparison needs."""
    if isinstance(value, dict):
        return {name: _rounded(one) for name, one in value.items()}
    if isinstance(value, list):
        return [_rounded(one) for one in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


def next_to(nodes: FloatArray, s: FloatArray) -> NDArray[np.int64]:
    """Indices of the nodes of a mesh (m) nearest to a coarser mesh's nodes or middles of its segments."""
    middles = 0.5 * (nodes[1:] + nodes[:-1]) if len(nodes) <= MANY else nodes
    near = np.union1d(nodes, middles)
    up = np.clip(np.searchsorted(s, near), 1, len(s) - 1)
    nearest = np.where(near - s[up - 1] < s[up] - near, up - 1, up)
    return np.asarray(np.union1d(nearest, [0, len(s) - 1]))


def _of_segments(arrays: Arrays, keep: NDArray[np.int64]) -> Arrays:
    """Values of the segments between stored nodes, whose sections are the sections of the coarser mesh."""
    low, up = keep[:-1], keep[1:]
    less = {name: arrays[name][low] for name in OF_SEGMENTS if name in arrays}
    for name in MIDDLE:
        if name in less:  # the middle of joined segments is a node
            at_node = arrays[name.replace(COMPONENTS, "bending_moment")][(low + up) // 2]
            less[name] = np.where(up - low > 1, at_node, less[name])
    return less


def packed(kept: Kept) -> bytes:
    """Return a reference solution as the bytes of a file; equal solutions give equal bytes."""
    import xarray as xr

    dataset = xr.Dataset(attrs={"Conventions": "CF-1.11", "about": json.dumps(_about(kept))})
    arrays = kept.result.arrays if kept.result else {}
    follow = {"l0", "s"} | ({"bending_moment"} if COMPONENTS in arrays else set())
    for name in sorted(set(arrays) - follow):
        values = arrays[name]
        attributes: dict[str, Any] = {"units": _unit(name)}
        if name not in EXACT:
            values = values - _zero(arrays, name)
            attributes["unit_of_differences"] = RESOLUTION * float(np.abs(values).max()) or 1.0
            whole = np.rint(values / attributes["unit_of_differences"]).astype(np.int32)
            values = np.diff(whole, n=2, axis=-1, prepend=np.zeros((*whole.shape[:-1], 2), np.int32))
        dataset[name] = (_dims(name), values, attributes)
        dataset[name].encoding["_FillValue"] = None
    content: bytes = bytes(dataset.to_netcdf(engine="scipy"))
    return gzip.compress(content, 9, mtime=0)


def unpacked(content: bytes) -> Kept:
    """Return the reference solution from the bytes of its file.

    Raises
    ------
    Damaged
        When the bytes cannot be read as a stored reference solution.
    """
    import xarray as xr

    try:
        file = io.BytesIO(gzip.decompress(content))
        with xr.open_dataset(file, engine="scipy", decode_times=False) as dataset:
            about = json.loads(dataset.attrs["about"])
            arrays = {str(name): _values(of) for name, of in dataset.variables.items()}
    except (OSError, EOFError, zlib.error, ValueError, KeyError, TypeError) as error:
        raise Damaged(str(error)) from None
    facts = about.pop("facts")
    for name in arrays:
        if name not in EXACT:
            arrays[name] += _zero(arrays, name)
    if COMPONENTS in arrays:
        arrays["bending_moment"] = np.linalg.norm(arrays[COMPONENTS], axis=1)
    if arrays:
        arrays |= {"s": arrays["s_node"], "l0": np.diff(arrays["s_node"])}
    return Kept(**about, result=Result(arrays, facts) if arrays else None)


def _values(of: xr.Variable) -> FloatArray:
    """Values of a variable, stored directly or as second differences."""
    values = np.array(of.values, float)
    if "unit_of_differences" in of.attrs:
        values = values.cumsum(axis=-1).cumsum(axis=-1) * float(of.attrs["unit_of_differences"])
    return values


def _zero(arrays: Arrays, name: str) -> FloatArray | float:
    """Elevations (m) from which the values of a quantity count; 0 for a quantity other than z."""
    of_z = name == "z" or (name[0] == "z" and name[1:] in ENDS)
    return arrays["zero_z"] if of_z else 0.0


def _about(kept: Kept) -> dict[str, Any]:
    """Return everything except the arrays, as plain data."""
    names = ("case", "scene", "physics", "engine", "how", "error", "missing", "more")
    facts: dict[str, Any] = {**kept.result.facts} if kept.result else {}
    kept_facts = {name: facts[name] for name in KEPT if name in facts}
    return {name: getattr(kept, name) for name in names} | {"facts": kept_facts}


def _dims(name: str) -> tuple[str, ...]:
    if name in HISTORIES:
        return ("time", "s_node")
    if name == COMPONENTS:
        return ("time", "axis", "s_node")
    if name == "time":
        return (name,)
    return ("segment",) if name in OF_SEGMENTS else ("s_node",)


def _unit(name: str) -> str:
    if name == "mesh_corner":
        return "1"
    if name == "mesh_flexibility":
        return "m-2 N-1"
    named = name.replace("zero_", "")
    for end in ENDS:
        named = named.removesuffix(end)
    return UNITS.get(named, "N m")
