"""The difference of two runs, by quantity."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from itertools import chain

import numpy as np

from riserstudy.dataset.result import Result
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.scene.limits import ANGLES, OF_ONE_PLACE
from riserstudy.simulation.curve import SAME, at_stations, curve_of, largest_moment
from riserstudy.simulation.section_forces import shear
from riserstudy.simulation.until import LOWER_ANGLE
from riserstudy.simulation.vortex_vibration_statistics import (
    NONE,
    Statistics,
    apart,
    of_plain,
    rounding_of,
    statistics,
)

#: quantities whose errors a tolerance limits, and which determine mesh and time step
CONTROLLED = ("displacement", "tension", "moment", "damage")
HISTORIES = ("x", "y", "z", "effective_tension", "bending_moment")
# curvature of the softest section that counts as zero (1/m): a strain of 5e-10 at a radius of half a metre
FLAT = 1e-9


def controlled(error: dict[str, float]) -> dict[str, float]:
    """Relative errors (1) of the quantities that determine mesh and time step."""
    return {name: value for name, value in error.items() if name in CONTROLLED}


def deciding(error: dict[str, float]) -> float:
    """The decisive relative error (1): of moment; without moments, the largest of the other quantities."""
    return error.get("moment", max(controlled(error).values(), default=math.nan))


def difference(coarse: Result, fine: Result) -> dict[str, float]:
    """Relative difference of two runs, by quantity.

    Envelopes and the static state are compared at the nodes of the coarse run, and the largest moment at any
    place. Histories are compared at these nodes or at stations, so an error in phase is included. Between
    nodes, values are those of the elements. A vortex-induced vibration is compared by its statistics.

    If one run has only every second, fourth, ... output of the other, the common outputs are compared. Angles
    of flex joints, strokes and tensioner forces are compared at rest, over time, and by their extremes over
    all steps if both runs have these. The angle of a lower flex joint is compared until a disconnect opens
    the joint. Shear is compared by its envelopes over all steps and at rest, at the nodes of the coarse run,
    and by its largest value. After a disconnect, the lift is compared over time, and by its maximum and the
    clearance. Differences are divided by the largest value anywhere.
    """
    differences = {}
    histories = _histories(coarse.arrays, fine.arrays)
    if _vibrates(fine):
        return (
            apart(*_vibrations(coarse, fine, histories))
            | _of_one_place(coarse, fine, _statistics)
            | _of_disconnect(coarse, fine)
            | _damage(coarse, fine)
        )
    for name, fields in (
        ("displacement", ("x", "y", "z")),
        ("tension", ("effective_tension",)),
        ("moment", ("bending_moment",)),
    ):
        states = [[*_states(coarse.arrays, fine.arrays, field)] for field in fields]
        moving = [histories[field] for field in fields if field in histories]
        pairs = [*chain.from_iterable(states), *moving]
        sizes = [(float(np.abs(up).max()), float(np.abs(up - low).max())) for low, up in pairs]
        at_rest = [of_field[-1] for of_field in states if of_field]
        sizes += _lengths(at_rest, moving) if name == "displacement" else []
        scale, off = (max((size[k] for size in sizes), default=0.0) for k in (0, 1))
        peaks = [largest_moment(one.arrays) for one in (coarse, fine)] if name == "moment" else []
        if peaks and peaks[0] and peaks[1]:
            off = max(off, abs(peaks[1][0] - peaks[0][0]))
        rounding = _rounding(name, fine.arrays)
        if scale > rounding:
            differences[name] = off / scale if off > rounding else 0.0
    of_shear = _shear(coarse.arrays, fine.arrays)
    if of_shear is not None:  # at least the difference of the moment, whose slope is the shear
        differences["shear"] = max(of_shear, differences.get("moment", 0.0))
    return (
        differences
        | _of_one_place(coarse, fine, _values)
        | _of_disconnect(coarse, fine)
        | _damage(coarse, fine)
    )


def _vibrates(run: Result) -> bool:
    """Whether vortices make the riser vibrate by more than rounding errors."""
    least = NONE * float(run.arrays["s_node"][-1])
    return "vibration_since" in run.facts and run.facts["vibration_rms"] > least


Pair = tuple[FloatArray, FloatArray]
Pairs = Iterator[Pair]


def _of_one_place(
    coarse: Result, fine: Result, compared: Callable[[Result, Result, str, float], Pairs]
) -> dict[str, float]:
    """Relative differences of angles, strokes and tensioner forces, by quantity, without those that are zero.

    The difference of the angle of a flex joint that hardly moves is small by chance. It is therefore at least
    that of the other joint, while both are joints.

    Parameters
    ----------
    compared : values of an output in both runs that are compared, up to a time (s).
    """
    found: dict[str, float] = {}
    for key, names in OF_ONE_PLACE.items():
        until = _until(fine, key)
        pairs = [pair for name in names for pair in compared(coarse, fine, name, until)]
        others = [name for name in ANGLES if key in ANGLES and name != key]
        more = chain.from_iterable(compared(coarse, fine, name, until) for name in others)
        found |= _relative(key, pairs, _rounding(key, fine.arrays), more)
    return found


def _relative(key: str, pairs: list[Pair], rounding: float, more: Iterable[Pair] = ()) -> dict[str, float]:
    """Largest difference of a quantity, divided by its largest value; empty if all values are zero.

    ``more``: other values, whose differences count, too.
    """
    scale = max((float(np.abs(up).max(initial=0.0)) for _, up in pairs), default=0.0)
    if not scale > rounding:
        return {}
    off = max(float(np.abs(up - low).max(initial=0.0)) for low, up in chain(pairs, more))
    return {key: off / scale if off > rounding else 0.0}


def _of_disconnect(coarse: Result, fine: Result) -> dict[str, float]:
    """Relative differences of the overpull, and of lift and clearance together; empty without a disconnect.

    A clearance that only one of the runs has differs by the largest lift.
    """
    if "lift" not in coarse.arrays or "lift" not in fine.arrays:
        return {}
    low, up = coarse.facts, fine.facts

    def of(name: str) -> list[tuple[FloatArray, FloatArray]]:
        return [(np.array([low[name]]), np.array([up[name]]))] if name in low and name in up else []  # type: ignore[literal-required]

    lifts = [*_over_common_outputs(coarse.arrays, fine.arrays, "lift"), *of("lift_max"), *of("clearance_min")]
    if ("clearance_min" in low) != ("clearance_min" in up):
        highest = float(np.abs(fine.arrays["lift"]).max())
        lifts.append((np.zeros(1), np.array([highest])))
    least = _rounding("displacement", fine.arrays)
    return _relative("overpull", of("overpull"), 0.0) | _relative("lift", lifts, least)


def _vibrations(
    coarse: Result, fine: Result, histories: dict[str, tuple[FloatArray, FloatArray]]
) -> tuple[Statistics, Statistics]:
    """Statistics of two runs of a vibration, at the places where they are compared."""
    since, places = fine.facts["vibration_since"], _places(coarse.arrays, fine.arrays)
    often, most = "vibration_frequency" in fine.facts, None
    above = fine.facts["vibration_above"]
    found = []
    for k, run in ((1, fine), (0, coarse)):
        late = run.arrays["time"] >= since
        each = {name: pair[k][late] for name, pair in histories.items()}
        found.append(statistics(each, places, run.arrays["time"][late], above, often, most))
        most = int(found[0].square.argmax())
    return found[1], found[0]


def statistics_of(run: Result) -> Statistics | None:
    """Statistics of a run's vibration at the places of its histories; None without such a vibration."""
    if "statistics" in run.facts:
        return of_plain(run.facts["statistics"])
    if not _vibrates(run):
        return None
    histories = {name: (values, values) for name, values in _histories_of(run.arrays).items()}
    return _vibrations(run, run, histories)[0]


def _histories_of(arrays: Arrays) -> Arrays:
    """Histories of a run, with displacements relative to positions that do not depend on the run."""
    zero = curve_of(arrays).straight
    return {
        name: arrays[name] - zero(_zero(arrays, name), arrays["s"]) for name in HISTORIES if name in arrays
    }


def _statistics(coarse: Result, fine: Result, name: str, end: float) -> Pairs:
    """Statistics of an output of one place in both runs, over the evaluated time up to an end (s)."""
    since, until = fine.facts["vibration_since"], min(end, _until(fine, name))
    if name in coarse.arrays and name in fine.arrays:
        low, up = (
            run.arrays[name][(run.arrays["time"] >= since) & (run.arrays["time"] <= until)]
            for run in (coarse, fine)
        )
        if len(low) and len(up):
            yield np.array([low.mean(), low.std()]), np.array([up.mean(), up.std()])
    if end >= _until(fine, name):  # extremes are those of all times at which the output counts
        yield from _both_extremes(coarse, fine, name)


def _shear(coarse: Arrays, fine: Arrays) -> float | None:
    """Relative difference of shear at the coarse run's nodes, and of the largest shear; None without shear.

    Between nodes, shear of either run is linear: two meshes may share only the ends of sections.
    """
    if "mesh_flexibility" not in fine:
        return None
    low, up = dict(_shears(coarse)), dict(_shears(fine))
    both = [end for end in up if end in low]
    least = _rounding_of_shear(fine)
    scale = max((_largest(up[end], least) for end in both), default=0.0)
    if not scale > 0.0:
        return None
    places, s = coarse["s_node"], fine["s_node"]
    rounding = np.interp(places, s, least)
    off = max(_largest(np.interp(places, s, up[end]) - low[end], rounding) for end in both)
    peak = max(float(np.abs(low[end]).max()) for end in both)
    return max(off, abs(scale - peak)) / scale


def _largest(values: FloatArray, least: FloatArray) -> float:
    """Largest magnitude of values above their rounding errors; 0 if there is none."""
    sizes = np.abs(values)
    return float(sizes[sizes > least].max(initial=0.0))


def _rounding_of_shear(arrays: Arrays) -> FloatArray:
    """Rounding error of shear (N) at the nodes: that of a moment, divided by a segment's length."""
    by_segment = np.pad(_rounding_of_moment(arrays) / arrays["l0"], 1)
    return np.asarray(np.maximum(by_segment[1:], by_segment[:-1]))


def _shears(arrays: Arrays) -> Iterator[tuple[str, FloatArray]]:
    """Shear (N) at the nodes: its envelopes over all steps, and at rest."""
    for end in ("max", "min", "static"):
        if f"shear_force_{end}" in arrays:
            yield end, arrays[f"shear_force_{end}"]
    if "shear_force_static" not in arrays and "bending_moment_static" in arrays:
        spatial = "mesh_moment_static" in arrays  # a run before `finish`
        moment = arrays["mesh_moment_static" if spatial else "bending_moment_static"]
        yield "static", shear(arrays, moment, spatial, arrays.get("mesh_above_ring_static"))


def _damage(coarse: Result, fine: Result) -> dict[str, float]:
    """Relative difference of fatigue damage, if the scene has details."""
    if "damage_rate" not in fine.arrays or "damage_rate" not in coarse.arrays:
        return {}
    from riserstudy.simulation.fatigue_damage import apart

    return {"damage": apart(coarse.arrays, fine.arrays)}


def _values(coarse: Result, fine: Result, name: str, end: float) -> Pairs:
    """An output of one place in both runs: at rest, over their common outputs to an end (s), its extremes."""
    low, up = coarse.arrays, fine.arrays
    if name + "_static" in low and name + "_static" in up:
        yield low[name + "_static"], up[name + "_static"]
    yield from _over_common_outputs(low, up, name, min(end, _until(fine, name)))
    if end >= _until(fine, name):
        yield from _both_extremes(coarse, fine, name)


def _until(run: Result, name: str) -> float:
    """Time (s) until which an output counts: a disconnect ends the angle of a lower flex joint."""
    return run.facts.get("lower_joint_until", math.inf) if name == LOWER_ANGLE else math.inf


def _over_common_outputs(low: Arrays, up: Arrays, name: str, until: float = math.inf) -> Pairs:
    """A history in both runs at their common outputs up to a time (s), if both have it."""
    if all(of in run for of in ("time", name) for run in (low, up)):
        every = _every(low, up)
        count = int((up["time"][:: every[1]] <= until).sum())
        yield low[name][:: every[0]][:count], up[name][:: every[1]][:count]


def _both_extremes(coarse: Result, fine: Result, name: str) -> Pairs:
    """Extremes of an output over all steps in both runs, if both have them."""
    ends, finer = _extremes(coarse, name), _extremes(fine, name)
    if ends is not None and finer is not None:
        yield ends, finer


def _extremes(run: Result, name: str) -> FloatArray | None:
    """Smallest and largest value of an output over all steps; None for a run that is only compared."""
    if peak := run.seen.peaks.get(name):
        return np.array([peak.smallest, peak.largest])
    rows = [row for row in run.facts.get("extremes", []) if row["output"] == name]
    return np.array([rows[0]["smallest"], rows[0]["largest"]]) if rows else None


def _rounding(name: str, arrays: Arrays) -> float:
    """Value of a quantity, in its SI unit, that counts as zero, since it may be a rounding error."""
    if name == "moment" and "mesh_flexibility" in arrays:
        return _rounding_of_moment(arrays)
    return rounding_of(name, float(arrays["s_node"][-1]))


def _rounding_of_moment(arrays: Arrays) -> float:
    """Moment (N m) that counts as zero: of the softest section, since stiff sections have the same error.

    If all sections are stiff, it is the moment of the largest tension about a negligible displacement.
    """
    softest = FLAT * float((arrays["l0"] / arrays["mesh_flexibility"]).min())
    ends = (f"effective_tension_{end}" for end in ("max", "min", "static"))
    tension = max(float(np.abs(arrays[end]).max()) for end in ends if end in arrays)
    return min(softest, _rounding("displacement", arrays) * tension)


def _zero(arrays: Arrays, field: str) -> FloatArray:
    """Reference positions of displacements, at the nodes."""
    return arrays.get("zero_" + field, np.zeros_like(arrays["s_node"]))


def _states(coarse: Arrays, fine: Arrays, field: str) -> Pairs:
    """Envelopes and static state of both runs at the nodes of the coarse run."""
    curve = curve_of(fine)
    between = curve.straight if field == "effective_tension" else curve.cubic
    for end in ("_max", "_min", "_static"):
        if field + end in fine:
            low = coarse[field + end] - _zero(coarse, field)
            yield low, between(fine[field + end] - _zero(fine, field), coarse["s_node"])


def _lengths(
    at_rest: list[tuple[FloatArray, FloatArray]], moving: list[tuple[FloatArray, FloatArray]]
) -> list[tuple[float, float]]:
    """Largest length of the displacement, and of its difference, at rest and over time (m).

    Each list has the values of both runs by direction. Unlike components, lengths do not depend on the
    direction of the axes.
    """
    found = []
    for pairs in filter(None, (at_rest, moving)):
        low, up = (np.stack([pair[k] for pair in pairs]) for k in (0, 1))
        length, off = (float(np.linalg.norm(of, axis=0).max()) for of in (up, up - low))
        found.append((length, off))
    return found


def _histories(coarse: Arrays, fine: Arrays) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Histories of both runs by field: at the nodes of the coarse run, or at the stations of the fine run."""
    if "time" not in coarse or "time" not in fine:
        return {}
    low, up = map(_thinned, (coarse, fine), _every(coarse, fine))
    places = _places(coarse, fine)
    if len(fine["s"]) == len(fine["s_node"]):
        up = _at(up, places)
    else:
        low = _at(low, places)
    pairs: dict[str, tuple[FloatArray, FloatArray]] = {}
    for field in HISTORIES:
        if field in up and field in low:
            away = [curve_of(run).straight(_zero(run, field), places) for run in (coarse, fine)]
            pairs[field] = low[field] - away[0], up[field] - away[1]
    return pairs


def _places(coarse: Arrays, fine: Arrays) -> FloatArray:
    """Places (m) at which histories are compared: nodes of the coarse run, or stations of the fine run."""
    return coarse["s_node"] if len(fine["s"]) == len(fine["s_node"]) else fine["s"]


def _thinned(arrays: Arrays, every: int) -> Arrays:
    """Arrays of a run with one of every ``every`` outputs."""
    names = (*HISTORIES, "mesh_moment", "mesh_above_ring")
    return arrays | {name: arrays[name][::every] for name in names if name in arrays}


def _every(coarse: Arrays, fine: Arrays) -> tuple[int, int]:
    """Intervals, as numbers of outputs, of the common outputs in the coarse and in the fine run."""
    intervals = [run["time"][1] - run["time"][0] if len(run["time"]) > 1 else 0.0 for run in (coarse, fine)]
    both = max(intervals)
    low, up = (round(both / interval) if interval else 1 for interval in intervals)
    return low, up


def _at(arrays: Arrays, places: FloatArray) -> Arrays:
    """Histories at places; without interpolation if the places are nodes."""
    node = np.searchsorted(arrays["s_node"], places - SAME * arrays["s_node"][-1])
    if np.allclose(arrays["s_node"][node], places, rtol=0.0, atol=SAME * arrays["s_node"][-1]):
        return {name: arrays[name][:, node] for name in HISTORIES if name in arrays}
    return at_stations(arrays, places)
