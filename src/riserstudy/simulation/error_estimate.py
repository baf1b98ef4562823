"""How far two runs are apart, and what that says of the error of the finer one."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.result import Result
from riserstudy.scene.limits import ANGLES
from riserstudy.simulation.curve import SAME, at_stations, curve_of, largest_moment
from riserstudy.simulation.section_forces import shear
from riserstudy.simulation.vibration_statistics import (
    NONE,
    Statistics,
    apart,
    of_plain,
    statistics,
)

Array = NDArray[np.float64]
Arrays = dict[str, Array]

#: quantities whose errors an accuracy bounds, and by which mesh and step are chosen
CONTROLLED = ("displacement", "tension", "moment", "damage")
HISTORIES = ("x", "y", "z", "effective_tension", "bending_moment")
MOST_FALL = 8.0  # of successive differences that an estimate trusts: third order
FLAT = 1e-9  # curvature that is none (1/m): a strain of 5e-10 at the wall of a riser a metre thick
UPRIGHT = 1e-9  # rad: an angle that is none
LEAST_FALL = 1.5
STEEPEST_FALL = 20.0  # of fourth order it is 16
SURE_FALL = 4.0  # where mesh and step both changed between them: second
SURE = {"angle": SURE_FALL, "shear": 2.0}


def estimate(
    now: dict[str, float], before: dict[str, float] | None, most: float = MOST_FALL
) -> dict[str, float]:
    """Relative error of the finest of three runs, each twice as fine as the last, from their differences.

    Where differences fall by a factor q, what is left is 1 / (q - 1) of the last; q is taken as no more
    than ``most``, and as `LEAST_FALL` where it is smaller, unknown, or more than any method's order gives:
    then the coarsest of the three was still far off. It is taken as no more than what a quantity is sure of:
    second order of angles, tangents at the ends of segments; first order of shear, the slope of the moment,
    near jumps of the load.
    """
    error = {}
    for name, value in now.items():
        fall = (before or {}).get(name, 0.0) / value if value > 0.0 else most
        if fall > STEEPEST_FALL:
            fall = LEAST_FALL
        trusted = min(most, SURE.get(name, most))
        error[name] = value / (min(max(fall, LEAST_FALL), trusted) - 1.0)
    return error


def controlled(error: dict[str, float]) -> dict[str, float]:
    """Relative errors (1) without those of angles and shear, which are estimated and choose nothing."""
    return {name: value for name, value in error.items() if name in CONTROLLED}


def deciding(error: dict[str, float]) -> float:
    """The relative error (1) that counts: of moment, or of tension and displacement where there is none."""
    return error.get("moment", max(controlled(error).values(), default=math.nan))


def difference(coarse: Result, fine: Result) -> dict[str, float]:
    """Relative difference of two runs, by quantity.

    Envelopes and the static state are compared at the nodes of the coarse run, the largest moment wherever
    it is, histories at those nodes or at stations, so that an error in phase counts too; between nodes
    values are those of the elements. A vibration of vortices is compared by its statistics, where there is
    one.

    Where one run tells every second, fourth, ... output of the other, those that both tell are compared.
    Angles of flex joints are compared at rest, over time, and by their extremes over all steps where both
    runs have these; shear by its envelopes over all steps and at rest, at the nodes of the coarse run, and by
    its largest value. The scale is the largest value anywhere.
    """
    differences = {}
    histories = _histories(coarse.arrays, fine.arrays)
    if _vibrates(fine):
        return (
            apart(*_vibrations(coarse, fine, histories))
            | _angle_of([*_statistics(coarse, fine)])
            | _damage(coarse, fine)
        )
    for name, fields in (
        ("displacement", ("x", "y", "z")),
        ("tension", ("effective_tension",)),
        ("moment", ("bending_moment",)),
    ):
        scale, off = 0.0, 0.0
        for field in fields:
            pairs = [*_states(coarse.arrays, fine.arrays, field)]
            if field in histories:
                pairs.append(histories[field])
            for low, up in pairs:
                scale = max(scale, float(np.abs(up).max()))
                off = max(off, float(np.abs(up - low).max()))
        peaks = [largest_moment(one.arrays) for one in (coarse, fine)] if name == "moment" else []
        if peaks and peaks[0] and peaks[1]:
            off = max(off, abs(peaks[1][0] - peaks[0][0]))
        rounding = _rounding(name, fine.arrays)
        if scale > rounding:
            differences[name] = off / scale if off > rounding else 0.0
    of_shear = _shear(coarse.arrays, fine.arrays)
    if of_shear is not None:  # no smaller than that of the moment, whose slope it is
        differences["shear"] = max(of_shear, differences.get("moment", 0.0))
    return differences | _angle_of([*_angles(coarse, fine)]) | _damage(coarse, fine)


def _vibrates(run: Result) -> bool:
    """Whether vortices make the riser vibrate, by more than rounding may."""
    least = NONE * float(run.arrays["s_node"][-1])
    return "vibration_since" in run.facts and run.facts["vibration_rms"] > least


def _angle_of(pairs: list[tuple[Array, Array]]) -> dict[str, float]:
    """Relative difference of angles (rad), over the largest of them; nothing where all are upright."""
    scale = max((float(np.abs(up).max()) for _, up in pairs), default=0.0)
    if not scale > UPRIGHT:
        return {}
    off = max(float(np.abs(up - low).max()) for low, up in pairs)
    return {"angle": off / scale if off > UPRIGHT else 0.0}


def _vibrations(
    coarse: Result, fine: Result, histories: dict[str, tuple[Array, Array]]
) -> tuple[Statistics, Statistics]:
    """Statistics of two runs of a vibration, where both are compared."""
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
    """Statistics of a run of a vibration at its own places; None of one that is not judged."""
    if "statistics" in run.facts:
        return of_plain(run.facts["statistics"])
    if not _vibrates(run):
        return None
    histories = {name: (values, values) for name, values in _histories_of(run.arrays).items()}
    return _vibrations(run, run, histories)[0]


def _histories_of(arrays: Arrays) -> Arrays:
    """Histories of a run, displacements counted from where those of other runs are."""
    zero = curve_of(arrays).straight
    return {
        name: arrays[name] - zero(_zero(arrays, name), arrays["s"])
        for name in HISTORIES
        if name in arrays
    }


def _statistics(coarse: Result, fine: Result) -> Iterator[tuple[Array, Array]]:
    """Statistics of angles of flex joints in both runs (rad), from the time on at which these are judged."""
    since = fine.facts["vibration_since"]
    for name in ANGLES:
        if name in coarse.arrays and name in fine.arrays:
            low, up = (run.arrays[name][run.arrays["time"] >= since] for run in (coarse, fine))
            yield np.array([low.mean(), low.std()]), np.array([up.mean(), up.std()])
        ends, finer = _extremes(coarse, name), _extremes(fine, name)
        if ends is not None and finer is not None:
            yield ends, finer


def _shear(coarse: Arrays, fine: Arrays) -> float | None:
    """Relative difference of shear at the coarse run's nodes, and of the largest; None where there is none.

    Between nodes shear of either run is straight: two meshes may share the ends of sections alone.
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


def _largest(values: Array, least: Array) -> float:
    """Largest size of values that are more than what may be rounding, 0 where none is."""
    sizes = np.abs(values)
    return float(sizes[sizes > least].max(initial=0.0))


def _rounding_of_shear(arrays: Arrays) -> Array:
    """Shear (N) that rounding may leave, over the nodes: of a moment that is none, over a segment."""
    by_segment = np.pad(FLAT / arrays["mesh_flexibility"], 1)
    return np.asarray(np.maximum(by_segment[1:], by_segment[:-1]))


def _shears(arrays: Arrays) -> Iterator[tuple[str, Array]]:
    """Shear (N) over the nodes: its envelopes over all steps, and at rest."""
    for end in ("max", "min", "static"):
        if f"shear_force_{end}" in arrays:
            yield end, arrays[f"shear_force_{end}"]
    if "shear_force_static" not in arrays and "bending_moment_static" in arrays:
        spatial = "mesh_moment_static" in arrays  # of a run that is not finished
        moment = arrays["mesh_moment_static" if spatial else "bending_moment_static"]
        yield "static", shear(arrays, moment, spatial)


def _damage(coarse: Result, fine: Result) -> dict[str, float]:
    """Relative difference of fatigue damage, where a scene has details."""
    if "damage_rate" not in fine.arrays or "damage_rate" not in coarse.arrays:
        return {}
    from riserstudy.simulation.damage import apart

    return {"damage": apart(coarse.arrays, fine.arrays)}


def _angles(coarse: Result, fine: Result) -> Iterator[tuple[Array, Array]]:
    """Angles of flex joints in both runs (rad): at rest, over the outputs of both, and their extremes."""
    low, up = coarse.arrays, fine.arrays
    steps = _every(low, up) if "time" in low and "time" in up else (1, 1)
    for name in ANGLES:
        if name + "_static" in low and name + "_static" in up:
            yield low[name + "_static"], up[name + "_static"]
        if name in low and name in up:
            yield low[name][:: steps[0]], up[name][:: steps[1]]
        ends, finer = _extremes(coarse, name), _extremes(fine, name)
        if ends is not None and finer is not None:
            yield ends, finer


def _extremes(run: Result, name: str) -> Array | None:
    """Smallest and largest value of an output by all steps; None of a run that was only to be compared."""
    if peak := run.seen.peaks.get(name):
        return np.array([peak.smallest, peak.largest])
    rows = [row for row in run.facts.get("extremes", []) if row["output"] == name]
    return np.array([rows[0]["smallest"], rows[0]["largest"]]) if rows else None


def _rounding(name: str, arrays: Arrays) -> float:
    """Displacement (m), tension (N) or moment (N m) that is none, and may be what rounding leaves."""
    if name == "displacement":
        return NONE * float(arrays["s_node"][-1])
    if name == "moment" and "mesh_flexibility" in arrays:
        return FLAT * float((arrays["l0"] / arrays["mesh_flexibility"]).max())
    return 0.0


def _zero(arrays: Arrays, field: str) -> Array:
    """Positions that displacements count from, at the nodes."""
    return arrays.get("zero_" + field, np.zeros_like(arrays["s_node"]))


def _states(coarse: Arrays, fine: Arrays, field: str) -> Iterator[tuple[Array, Array]]:
    """Envelopes and static state of both runs at the nodes of the coarse one."""
    curve = curve_of(fine)
    between = curve.straight if field == "effective_tension" else curve.cubic
    for end in ("_max", "_min", "_static"):
        if field + end in fine:
            low = coarse[field + end] - _zero(coarse, field)
            yield low, between(fine[field + end] - _zero(fine, field), coarse["s_node"])


def _histories(coarse: Arrays, fine: Arrays) -> dict[str, tuple[Array, Array]]:
    """Histories of both runs by field: at the nodes of the coarse one, or at the fine one's stations."""
    if "time" not in coarse or "time" not in fine:
        return {}
    low, up = map(_thinned, (coarse, fine), _every(coarse, fine))
    places = _places(coarse, fine)
    if len(fine["s"]) == len(fine["s_node"]):
        up = _at(up, places)
    else:
        low = _at(low, places)
    pairs: dict[str, tuple[Array, Array]] = {}
    for field in HISTORIES:
        if field in up and field in low:
            away = [curve_of(run).straight(_zero(run, field), places) for run in (coarse, fine)]
            pairs[field] = low[field] - away[0], up[field] - away[1]
    return pairs


def _places(coarse: Arrays, fine: Arrays) -> Array:
    """Where histories of both runs are compared (m): the coarse one's nodes or the fine one's stations."""
    return coarse["s_node"] if len(fine["s"]) == len(fine["s_node"]) else fine["s"]


def _thinned(arrays: Arrays, every: int) -> Arrays:
    """Arrays of a run with one of so many of its outputs."""
    names = (*HISTORIES, "mesh_moment")
    return arrays | {name: arrays[name][::every] for name in names if name in arrays}


def _every(coarse: Arrays, fine: Arrays) -> tuple[int, int]:
    """Which outputs of two runs are those of both: every so many."""
    intervals = [
        run["time"][1] - run["time"][0] if len(run["time"]) > 1 else 0.0 for run in (coarse, fine)
    ]
    both = max(intervals)
    low, up = (round(both / interval) if interval else 1 for interval in intervals)
    return low, up


def _at(arrays: Arrays, places: Array) -> Arrays:
    """Histories at places; those of nodes as they are."""
    node = np.searchsorted(arrays["s_node"], places - SAME * arrays["s_node"][-1])
    if np.allclose(arrays["s_node"][node], places, rtol=0.0, atol=SAME * arrays["s_node"][-1]):
        return {name: arrays[name][:, node] for name in HISTORIES if name in arrays}
    return at_stations(arrays, places)
