"""Largest and smallest value of every output, where and when, section by section and at its ends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.mesh import Mesh
from riserstudy.records.seen import Peak, Seen
from riserstudy.scene.limits import ALONG, UNITS
from riserstudy.scene.outputs import wall_lacks
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.section_forces import riser_foot
from riserstudy.simulation.wall_stress import nodes_of

FloatArray = NDArray[np.float64]
Arrays = dict[str, FloatArray]
NEAR = 0.02  # share of a range from its extreme, within which an output shows when it is
ROUNDING = 1e-9  # share of a value
OVER_TIME = tuple(name for name in UNITS if name not in ALONG)


def extremes(
    scene: Resolved, mesh: Mesh, arrays: Arrays, histories: Arrays, of: Seen
) -> list[dict[str, Any]]:
    """A row for each output and place: its largest and smallest value with arclength (m) and time (s).

    Values along the riser are those of envelopes at the nodes, which see every step. Their times are those of
    the outputs, and absent where no output is near the extreme. Means are from the time on at which all ramps
    are over, where the run goes on after it. A run at rest has no times, and its values are their own means.
    The mean of an angle in space is the size of the mean rotation, as in a plane it has its sign.

    Parameters
    ----------
    histories : of outputs along the riser, (time, n + 1), beside those among the arrays.
    """
    rows = []
    time = arrays.get("time", np.zeros(0))
    later = time >= scene.built_up if len(time) and scene.built_up < time[-1] else time >= 0.0
    for name in ALONG:
        for where, nodes in places(scene, mesh, name):
            if row := _along(name, where, nodes, arrays, histories, later):
                rows.append(row)
    for name in OVER_TIME:
        if row := _over_time(name, arrays, later):
            row |= _seen_by_steps(scene, mesh, name, arrays, of.peaks)
            if name in of.rotations:
                row["mean"] = float(np.linalg.norm(of.rotations[name][later].mean(axis=0)))
            rows.append(row)
    return rows


def _seen_by_steps(
    scene: Resolved, mesh: Mesh, name: str, arrays: Arrays, peaks: Mapping[str, Peak]
) -> dict[str, float]:
    """Largest and smallest value of an output over time by all steps; empty where only outputs are known."""
    if name in peaks:
        return peaks[name]._asdict()
    if name == "lower_end_tension" and "effective_tension_max" in arrays:
        foot = riser_foot(scene, mesh)
        return {
            "largest": float(arrays["effective_tension_max"][foot]),
            "smallest": float(arrays["effective_tension_min"][foot]),
        }
    return {}


def places(scene: Resolved, mesh: Mesh, name: str) -> Iterator[tuple[str, slice]]:
    """Places along the riser that an output has, by what limits call them, with their nodes."""
    for k, section in enumerate(scene.riser):
        if name == "von_mises_stress" and wall_lacks(scene, section):
            continue  # at its ends there is that of its neighbours
        nodes = nodes_of(mesh, k)
        yield section.name, nodes
        yield f"lower end of {section.name}", slice(nodes.start, nodes.start + 1)
        yield f"upper end of {section.name}", slice(nodes.stop - 1, nodes.stop)


def _along(
    name: str,
    where: str,
    nodes: slice,
    arrays: Arrays,
    histories: Arrays,
    later: NDArray[np.bool_],
) -> dict[str, Any] | None:
    moving = name + "_max" in arrays
    ends = ("_max", "_min") if moving else ("_static", "_static")
    if name + ends[0] not in arrays:
        return None
    most, least = (arrays[name + end][nodes] for end in ends)
    if np.isnan(most).any():
        return None
    high, low = int(most.argmax()), int(least.argmin())
    history = histories.get(name, arrays.get(name)) if moving else None
    row: dict[str, Any] = {"output": name, "where": where}
    for side, values, k in (("largest", most, high), ("smallest", least, low)):
        row[side] = float(values[k])
        row[side + "_s"] = float(arrays["s_node"][nodes][k])
    if history is not None and history.shape[-1] == len(arrays["s_node"]):
        for side, k, which in (("largest", high, np.argmax), ("smallest", low, np.argmin)):
            seen = history[:, nodes][:, k]
            output = int(which(seen))
            near = NEAR * (most[k] - least[k]) + ROUNDING * abs(row[side])
            if abs(seen[output] - row[side]) <= near:
                row[side + "_time"] = float(arrays["time"][output])
        if nodes.stop - nodes.start == 1:
            row["mean"] = float(history[later][:, nodes].mean())
    elif not moving and nodes.stop - nodes.start == 1:
        row["mean"] = row["largest"]
    return row


def _over_time(name: str, arrays: Arrays, later: NDArray[np.bool_]) -> dict[str, Any] | None:
    """Of one value a time; of cylinders the row is that of all of them."""
    row: dict[str, Any] = {"output": name, "where": ""}
    rest = arrays.get(name + "_static")
    if name in arrays and "time" in arrays:
        values = arrays[name].reshape(len(arrays["time"]), -1)
        high, low = (np.unravel_index(f(values), values.shape)[0] for f in (np.argmax, np.argmin))
        row |= {"largest": float(values.max()), "largest_time": float(arrays["time"][high])}
        row |= {"smallest": float(values.min()), "smallest_time": float(arrays["time"][low])}
        values = values[later]
    elif rest is not None:
        values = rest.reshape(1, -1)
        row |= {"largest": float(values.max()), "smallest": float(values.min())}
    else:
        return None
    return row | {"mean": float(values.mean())}
