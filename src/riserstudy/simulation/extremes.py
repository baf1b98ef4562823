"""Largest and smallest value of every output with place and time, by section and at the ends of sections."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any

import numpy as np

from riserstudy.model.mesh import Mesh
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.records.seen import Peak, Seen
from riserstudy.scene.limit_inputs import lacks_outputs, times_of_mean
from riserstudy.scene.limits import ALONG, UNITS
from riserstudy.scene.quantities import QUANTITIES, wall_lacks
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.section_forces import riser_foot
from riserstudy.simulation.step_peaks import peaks_of, within
from riserstudy.simulation.until import LOWER_ANGLE, until_release
from riserstudy.simulation.wall_stress import nodes_of
from riserstudy.simulation.working_cylinders import FORCE, has_failures, smallest_pull

# largest distance of an output from the extreme for its time to be used, as a share of the range
NEAR = 0.02
ROUNDING = 1e-9  # relative rounding error of a value
OVER_TIME = tuple(name for name in UNITS if name not in ALONG)


def extremes(
    scene: Resolved, mesh: Mesh, arrays: Arrays, histories: Arrays, of: Seen
) -> list[dict[str, Any]]:
    """A row for each output and place: its largest and smallest value with arclength (m) and time (s).

    Values along the riser are from the envelopes at the nodes, which include every time step. Their times are
    times of outputs, and absent if no output is near the extreme. Means begin after all ramps, if the run
    continues after them, and cover whole periods of a periodic motion. They are taken over all time steps.
    Means of values along the riser are taken over outputs, and absent if the outputs see few phases of the
    motion. A static run has no times, and its values are also the means. In space, the mean of an angle is
    the magnitude of the mean rotation; in a plane it has a sign. Of cylinders it is the mean of the one with
    the largest mean. The smallest pull is that of a cylinder that has not failed. ``histories``: histories
    along the riser, (time, n + 1), in addition to those in ``arrays``.
    """
    rows = []
    for name in ALONG:
        for where, nodes in places(scene, mesh, name):
            if row := _along(scene, name, where, nodes, arrays, histories):
                rows.append(row)
    for name in OVER_TIME:
        if row := _over_time(name, until_release(scene, name, arrays)):
            row |= _seen_by_steps(scene, mesh, name, arrays, of.peaks)
            row |= _mean_over_time(scene, name, arrays, of)
            if name == FORCE and name not in of.peaks:
                row |= smallest_pull(scene, arrays, {})
            rows.append(row)
    return rows


def peaks_that_count(scene: Resolved, of: Seen) -> dict[str, Peak]:
    """Peaks over all steps: of the angle of a lower flex joint until its release, of cylinders that work."""
    peaks = peaks_of(of.steps["time"], {k: v for k, v in of.steps.items() if k != "time"}, of.rotations)
    if FORCE in peaks:
        peaks[FORCE] = peaks[FORCE]._replace(**smallest_pull(scene, {}, of.steps))
    held = until_release(scene, LOWER_ANGLE, of.steps)
    if held is of.steps:
        return peaks
    angle = {LOWER_ANGLE: held[LOWER_ANGLE]}
    vectors = {name: of.rotations[name][: len(held["time"])] for name in angle if name in of.rotations}
    return peaks | peaks_of(held["time"], angle, vectors)


def within_peaks(scene: Resolved, histories: Arrays, of: Seen, sizes: Collection[str]) -> Arrays:
    """Histories at the outputs, limited to the peaks over all steps; arguments as of `step_peaks.within`.

    An angle that ends with the release of its joint is limited until then. A cylinder may fail to zero.
    """
    peaks = dict(of.peaks)
    if FORCE in peaks and has_failures(scene):
        peaks[FORCE] = peaks[FORCE]._replace(smallest=min(peaks[FORCE].smallest, 0.0))
    limited = within(histories, peaks, sizes)
    held = until_release(scene, LOWER_ANGLE, histories)
    if held is not histories and LOWER_ANGLE in limited:
        count = len(held["time"])
        parts = limited[LOWER_ANGLE][:count], histories[LOWER_ANGLE][count:]
        limited[LOWER_ANGLE] = np.concatenate(parts)
    return limited


def _seen_by_steps(
    scene: Resolved, mesh: Mesh, name: str, arrays: Arrays, peaks: Mapping[str, Peak]
) -> dict[str, float]:
    """Largest and smallest value of an output over all time steps; empty if only outputs are known."""
    if name in peaks:
        return peaks[name]._asdict()
    if (along := QUANTITIES[name].at_foot_of) and f"{along}_max" in arrays:
        foot = riser_foot(scene, mesh)
        return {
            "largest": float(arrays[f"{along}_max"][foot]),
            "smallest": float(arrays[f"{along}_min"][foot]),
        }
    return {}


def places(scene: Resolved, mesh: Mesh, name: str) -> Iterator[tuple[str, slice]]:
    """Places along the riser that an output has, named as in limits, with their nodes."""
    for k, section in enumerate(scene.riser):
        if name == "von_mises_stress" and wall_lacks(scene, section):
            continue  # at its ends there is the value of its neighbours
        nodes = nodes_of(mesh, k)
        yield section.name, nodes
        yield f"lower end of {section.name}", slice(nodes.start, nodes.start + 1)
        yield f"upper end of {section.name}", slice(nodes.stop - 1, nodes.stop)


def _along(
    scene: Resolved, name: str, where: str, nodes: slice, arrays: Arrays, histories: Arrays
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
            mean = _time_mean(scene, name, arrays["time"], history[:, nodes])
            if mean is not None:
                row["mean"] = float(mean[0])
    elif not moving and nodes.stop - nodes.start == 1:
        row["mean"] = row["largest"]
    return row


def _over_time(name: str, arrays: Arrays) -> dict[str, Any] | None:
    """The row of an output with one value per time; for cylinders, one row for all of them together."""
    row: dict[str, Any] = {"output": name, "where": ""}
    rest = arrays.get(name + "_static")
    if name in arrays and "time" in arrays:
        if not len(arrays["time"]):
            return None
        values = arrays[name].reshape(len(arrays["time"]), -1)
        high, low = (np.unravel_index(f(values), values.shape)[0] for f in (np.argmax, np.argmin))
        row |= {"largest": float(values.max()), "largest_time": float(arrays["time"][high])}
        row |= {"smallest": float(values.min()), "smallest_time": float(arrays["time"][low])}
    elif rest is not None:
        values = rest.reshape(1, -1)
        row |= {"largest": float(values.max()), "smallest": float(values.min())}
        row["mean"] = row["largest"]
    else:
        return None
    return row


def _mean_over_time(scene: Resolved, name: str, arrays: Arrays, of: Seen) -> dict[str, float]:
    """The mean of an output over all steps, if known, the largest of all cylinders; empty at rest."""
    mean = mean_of(scene, name, arrays, of)
    if mean is None:
        return {}
    return {"mean": float(np.linalg.norm(mean) if name in of.rotations else mean.max())}


def mean_of(scene: Resolved, name: str, arrays: Arrays, of: Seen) -> FloatArray | None:
    """The mean of an output over time, in its unit; of cylinders (k,), of a rotation in space (3,).

    None if it is not known.
    """
    by_steps = name in of.steps
    held = until_release(scene, name, of.steps if by_steps else arrays)
    if name not in held or "time" not in held or not len(held["time"]):
        return None
    values = of.rotations.get(name, held[name])[: len(held["time"])]
    return _time_mean(scene, name, held["time"], values, by_steps)


def _time_mean(
    scene: Resolved, name: str, times: FloatArray, values: FloatArray, by_steps: bool = False
) -> FloatArray | None:
    """Mean over time of values, (time, ...), linear in between; None if outputs see few phases of motion."""
    if not by_steps and lacks_outputs(scene):
        return None
    start = times_of_mean(scene, name, float(times[-1])).start
    later = int(np.searchsorted(times, start, "right"))
    if later == len(times):
        return np.asarray(values[-1])
    if later:
        share = (start - times[later - 1]) / (times[later] - times[later - 1])
        first = values[later - 1] + share * (values[later] - values[later - 1])
        times = np.concatenate([[start], times[later:]])
        values = np.concatenate([first[None], values[later:]])
    if len(times) == 1:
        return np.asarray(values[0])
    return np.asarray(np.trapezoid(values, times, axis=0) / (times[-1] - times[0]))
