"""The Hamilton-principle riser paper: results against which its claims and errata are checked.

If a dataset has both solvers, the beam is judged, which is the paper's method. Shares of a length count from
the bottom. Trends are compared between all neighbouring values of an axis.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from riserstudy.grading.grade import Found, judged
from riserstudy.grading.margin import above, below
from riserstudy.grading.word_of_size import Word
from riserstudy.grading.yardstick import Condition, all_along, all_of, growing, more
from riserstudy.records.arrays import FloatArray
from riserstudy.records.numerals import rounded_up

LUMPED, BEAM = "lumped masses", "Hermite beam"
PERIOD = 8.0  # s, wave period, over which slow motion is averaged
PHASES = {"first": (0.0, 16.0), "second": (16.0, 260.0), "last": (260.0, 300.0)}  # s
SETTLED = 0.005  # share of the last mean; config/published/fem_riser.yaml, B4
DURATION, PAPER_STEP = 300.0, 5e-4  # s, of the paper's runs
STABLE = 260.0  # s, simulated time for which the paper states 46 hours
CHORD = "the line between the ends"
TOGETHER = ("B5", "B6", "B7", "B8", "B9", "B10")


# Fig 3: the sea


def fades_with_depth(water: xr.Dataset, share: float, within: float) -> Found:
    """Wave motion decreases to a share of its surface value within a share of the depth; value: the depth."""
    places = []
    for name in ("wave_velocity", "wave_acceleration"):
        size = abs(water[name]).max("time")
        faded = size["below_surface"].where(size <= share * size.isel(below_surface=0)).min("below_surface")
        places.append(faded / water["below_surface"].max())
    deepest = xr.concat(places, "of").max("of")
    return judged(deepest, below(deepest, within))


# Fig 4: three phases


def fast_at_first(motion: xr.Dataset, at_least: float) -> Found:
    """Mid-length deflects faster in the first two wave periods than in the second phase; value: ratio."""
    x = middle(motion)
    rates = {name: (at(x, end) - at(x, start)) / (end - start) for name, (start, end) in PHASES.items()}
    ratio = abs(rates["first"]) / abs(rates["second"])
    return judged(ratio, above(ratio, at_least))


def reciprocates(motion: xr.Dataset, at_least: float) -> Found:
    """Deflection averaged over a wave reverses in the second phase; value: reversal / last average."""
    slow = averaged(middle(motion))
    start, end = PHASES["second"]
    within = slow.sel(time=slice(start, end))
    highest = np.maximum.accumulate(within.values, axis=within.get_axis_num("time"))
    back = (within.copy(data=highest) - within).max("time")
    share = back / abs(slow.isel(time=-1))
    return judged(share, above(share, at_least))


def periodic_at_last(motion: xr.Dataset, within: float) -> Found:
    """Motion is steady by the last phase; value: settling time (s)."""
    time = settling_time(motion, within)
    return judged(time, below(time, PHASES["last"][0] + 1.0))


def settling_time(motion: xr.Dataset, within: float) -> xr.DataArray:
    """Time (s) after which the average over a wave stays within a share of its last value.

    Interpolation is linear between the averages; a record with a missing average has no such time.
    """
    slow = averaged(middle(motion))
    last, times = slow.isel(time=-1), slow["time"].values

    def of(over: FloatArray) -> float:
        away = np.flatnonzero(over > 0.0)
        if np.isnan(over).any():
            return np.nan
        if not away.size:
            return 0.0
        k = int(away[-1])
        share = over[k] / (over[k] - over[k + 1])
        return float(times[k] + share * (times[k + 1] - times[k]))

    time: xr.DataArray = xr.apply_ufunc(
        of, abs(slow - last) - within * abs(last), input_core_dims=[["time"]], vectorize=True
    )
    return time


def middle(motion: xr.Dataset) -> xr.DataArray:
    """Deflection at mid-length over time (m), relative to its first value, for any position of the top."""
    x = solved(motion["x"])
    x = x.isel(s=x.sizes["s"] // 2, drop=True)
    return x - x.isel(time=0, drop=True)


def averaged(x: xr.DataArray) -> xr.DataArray:
    """Mean over the wave period around each time for which the record contains this whole period.

    The outputs at both ends of the period have half the weight of the others: the mean of a motion that also
    drifts is its level in the middle of the period.
    """
    step = float(x["time"][1] - x["time"][0])
    count = round(PERIOD / step)
    ends = xr.zeros_like(x.isel(time=slice(count, None)))
    total = x.cumulative_integrate("time")
    gained = total.isel(time=slice(count, None)).values - total.isel(time=slice(None, -count)).values
    times = x["time"].values[count:] - 0.5 * PERIOD
    return ends.copy(data=gained / (count * step)).assign_coords(time=times)


def at(x: xr.DataArray, time: float) -> xr.DataArray:
    """Value at a time."""
    return x.sel(time=time, method="nearest", drop=True)


# Fig 5: positions along the riser


def deflects_at_mid_length(trends: xr.Dataset, within: float) -> Found:
    """The largest deflection occurs near mid-length; value: its position, by the line it is measured from."""
    names = {"the vertical": "deflection_place", CHORD: "deflection_from_line_place"}
    lines = xr.DataArray(list(names), dims="deflection_from", name="deflection_from")
    place = xr.concat([base(trends, name) for name in names.values()], lines)
    return judged(place, below(abs(place - 0.5), within))


def bends_near_the_ends(trends: xr.Dataset, within: float) -> Found:
    """Stress and angle of each half are largest near its end; value: largest distance from an end."""
    names = ("stress_from_bottom", "stress_from_top", "angle_from_bottom", "angle_from_top")
    farthest = xr.concat([base(trends, name) for name in names], "of").max("of")
    return judged(farthest, below(farthest, within))


def base(trends: xr.Dataset, name: str) -> xr.DataArray:
    """A measure of the base case (over the top offset, if varied), or else of the longest riser."""
    if f"{name}_by_offset" in trends:
        return trends[f"{name}_by_offset"]
    label = f"{name}_by_ratio"
    if label in trends:
        return solved(trends[label]).sel(tension_ratio=1.3, drop=True)
    return solved(trends[f"{name}_by_length"]).isel(length=-1, drop=True)


# Figs 6 to 8: trends


def trend(trends: xr.Dataset, measures: list[str], axis: str, grows: float, change: Word) -> Found:
    """All measures increase (1) or decrease (-1) along an axis; value: last / first of the first measure.

    Deflection is measured from the line between the ends, if the dataset has it: the top may have drifted.
    """
    dims = {"length": "length", "ratio": "tension_ratio", "factor": "buoyant_factor"}
    dim = dims[axis]
    named = [f"{name}_by_{axis}" for name in measures]
    bent = [name.replace("deflection", "deflection_from_line") for name in named]
    along = [solved(trends[b if b in trends else n]) for b, n in zip(bent, named, strict=True)]
    value = along[0].isel({dim: -1}, drop=True) / along[0].isel({dim: 0}, drop=True)
    return judged(value, all_of(*(growing(measure, dim, change, grows) for measure in along)))


def larger_at_the_shortest(trends: xr.Dataset, measures: list[str], larger: Word) -> Found:
    """All measures are larger at the first length than at each other length, whose order does not count.

    Value: largest value at another length / value at the first, of the first measure.
    """
    shortest, others = {"length": 0}, {"length": slice(1, None)}
    along = [solved(trends[f"{name}_by_length"]) for name in measures]
    value = along[0].isel(others).max("length") / along[0].isel(shortest, drop=True)
    each = (all_along(more(v.isel(shortest, drop=True), v.isel(others), larger), "length") for v in along)
    return judged(value, all_of(*each))


def solved(values: xr.DataArray) -> xr.DataArray:
    """Values by the paper's beam if there are both solvers; else unchanged."""
    return values.sel(solver=BEAM, drop=True) if "solver" in values.dims else values


def all_settled(trends: xr.Dataset, within: float) -> Found:
    """No case drifts by more than a share of its deflection; value: the largest share, by studied cases.

    The studied cases are the three lengths, or all cases of Figs 6 to 8.
    """
    over = {"length": "length", "ratio": "tension_ratio", "factor": "buoyant_factor"}
    drifts = {axis: solved(trends[f"drift_by_{axis}"]).max(dim) for axis, dim in over.items()}
    every = xr.concat(drifts.values(), "of").max("of")
    names = ["lengths", "lengths, tension ratios and buoyant factors"]
    cases = xr.DataArray(names, dims="studied_cases", name="studied_cases")
    most = xr.concat([drifts["length"], every], cases)
    return judged(most, below(most, within))


def together(trends: xr.Dataset, mid: float, near: float, change: Word) -> Found:
    """Claims B5 to B10 are all true; value: number of true claims among the six."""
    each = each_of_them(trends, mid, near, change)
    return judged((each.margin > 0.0).sum("claim").astype(float), all_along(each, "claim"))


def claims(trends: xr.Dataset, change: float, mid: float = 0.1, near: float = 0.1) -> xr.DataArray:
    """Truth of B5 to B10 over ``claim`` and the dimensions of the measures; ``change``: bound of the word."""
    word = Word("change", change, False, change)
    return each_of_them(trends, mid, near, word).margin > 0.0


def each_of_them(trends: xr.Dataset, mid: float, near: float, change: Word) -> Condition:
    """Conditions of B5 to B10 over ``claim`` and the dimensions of the measures."""
    middle = deflects_at_mid_length(trends, mid).at({"deflection_from": CHORD})  # as in B9
    checks = [middle, bends_near_the_ends(trends, near)]
    checks += [larger_at_the_shortest(trends, [name], change) for name in ("vibration", "stress")]
    checks += [trend(trends, [name], "length", 1.0, change) for name in ("deflection", "angle")]
    names = xr.DataArray(list(TOGETHER), dims="claim", name="claim")
    margins = [check.margin for check in checks if check.margin is not None]
    same = [check.same for check in checks if check.same is not None]
    return Condition(xr.concat(margins, names), xr.concat(same, names))


# the numerical settings


def grid_suffices(grid: xr.Dataset, finer: xr.Dataset, element: str, step: float, at_most: float) -> Found:
    """Error at an element length and time step; value: the larger error of deflection and moment.

    The reference is ``finer``, runs with equal inputs. If the runs form a grid, it is the grid's finest run.
    """
    if "element" in grid.dims:
        grid = grid.sel(element=element, time_step=step, drop=True)
        finer = finest(finer)
    error = difference(grid, finer)
    return judged(error, below(error, at_most))


def grid_error(grid: xr.Dataset) -> xr.DataArray:
    """Larger relative error of largest deflection and largest moment, for each mesh and time step."""
    return difference(grid, finest(grid))


def finest(grid: xr.Dataset) -> xr.Dataset:
    """The run with the shortest elements and the shortest time step."""
    return grid.sel(element="2.5 m", drop=True).sel(time_step=float(grid["time_step"].min()), drop=True)


def difference(runs: xr.Dataset, others: xr.Dataset) -> xr.DataArray:
    """Larger relative difference, of largest deflection and of largest moment, from other runs."""
    apart = [abs(mine / theirs - 1.0) for mine, theirs in zip(_largest(runs), _largest(others), strict=True)]
    worst: xr.DataArray = xr.concat(apart, "of").max("of", skipna=False)
    return worst


def _largest(runs: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray]:
    """Largest deflection from the line between the ends (m) and largest moment (N m) along the riser.

    The top is held, and may have drifted to either side. Runs may have different nodes.
    """
    line = runs["x_max"].isel(s_node=-1, drop=True) * runs["s_node"] / runs["s_node"][-1]
    bent, moment = (
        xr.concat([abs(runs[f"{name}_{side}"] - origin) for side in ("max", "min")], "side")
        for name, origin in (("x", line), ("bending_moment", 0.0))
    )
    return bent.max(("side", "s_node")), moment.max(("side", "s_node"))


# errata: text with results of simulations


def deeper(trends: xr.Dataset) -> dict[str, Any]:
    """Largest deflection (m) of the three lengths."""
    deflections = solved(trends["deflection_by_length"]).values
    return dict(zip(("first", "second", "third"), map(float, deflections), strict=True))


def readings(table: xr.Dataset, rest: xr.Dataset) -> dict[str, Any]:
    """Largest deflection (m) by interpretation at least and largest factor, and of R1 in the final state."""
    deflection = table["deflection_by_factor"]
    out: dict[str, Any] = {}
    for reading in ("R1", "R2", "R3", "R4"):
        low, high = deflection.sel(reading=reading).values[[0, -1]]
        out |= {f"{reading}_low": float(low), f"{reading}_high": float(high)}
    return out | {"rest": float(rest["deflection_by_case"].sel(softest="factor 0.9"))}


def stiff_joints(table: xr.Dataset) -> dict[str, Any]:
    """Bending stress (MPa) at 500 m and 1500 m, without joints and with stiff ones."""
    stress = table["stress_by_length"].sel(tide=0.75, wave_height=8.0) / 1e6
    out: dict[str, Any] = {}
    for name, joints in (("soft", "none"), ("stiff", "7.3 MN m/rad")):
        low, high = stress.sel(joints=joints).values[[0, -1]]
        out |= {f"{name}_short": float(low), f"{name}_long": float(high)}
    return out


def wind_changes(table: xr.Dataset) -> dict[str, Any]:
    """Least and largest relative change of the largest deflection by the wind-driven current, by length."""
    deflection = table["deflection_by_length"]
    change = deflection.drop_sel(wind="none") / deflection.sel(wind="none", drop=True) - 1.0
    shares: dict[str, Any] = {}
    for name, length in (("short", 500.0), ("long", 2000.0)):
        one = change.sel(length=length)
        shares |= {f"least_{name}": float(one.min()), f"most_{name}": float(one.max())}
    return shares


def run_time(own: xr.Dataset) -> dict[str, Any]:
    """Time of the paper's 600 000 steps on 400 elements, measured or estimated from longer steps."""
    steps = own["time_step"].values
    finest = float(steps.min())
    seconds = float(own["solve_seconds"].sel(time_step=finest))
    a_step = seconds / (DURATION / finest)
    whole = a_step * DURATION / PAPER_STEP
    times = {
        "milliseconds": 1e3 * a_step,
        "seconds": whole,
        "paper_milliseconds": 46 * 3.6e6 * PAPER_STEP / STABLE,
    }
    if finest > PAPER_STEP:
        words = (
            "With the paper's elements, time steps and integration rule, the run would take an estimated "
            f"{whole:.0f} s; this tier does not include it."
        )
        return times | {"run": words}
    apart = []
    moments = [abs(own[f"bending_moment_{side}"]).max("s_node") for side in ("max", "min")]
    for runs in (own["x_max"].max("s_node"), xr.concat(moments, "side").max("side")):
        short, long = (float(runs.sel(time_step=step)) for step in (finest, float(steps.max())))
        apart.append(abs(long / short - 1.0))
    longer = f"Time steps of {float(steps.max()):g} s change the largest deflection and moment"
    words = (
        f"With the paper's elements, time steps and integration rule, the run takes {seconds:.0f} s. "
        f"{longer} by at most {rounded_up(100 * max(apart))} %."
    )
    return times | {"run": words}


def settling(tides: xr.Dataset) -> dict[str, Any]:
    """Reversal (share), settling time (s) and last deflection (m) of mid-length under three tides."""
    back = reciprocates(tides, 0.0).value
    last = averaged(middle(tides)).isel(time=-1)
    time = settling_time(tides, SETTLED)
    settled: dict[str, Any] = {}
    for name, tide in (("weakest", float(tides["tide"].min())), ("weak", 0.2), ("chosen", 0.75)):
        at = {"tide": tide}
        settled |= {
            f"{name}_tide": tide,
            f"{name}_back": float(back.sel(at)),
            f"{name}_time": float(time.sel(at)),
            f"{name}_deflection": float(last.sel(at)),
        }
    return settled


def top_drift(table: xr.Dataset) -> dict[str, Any]:
    """Deflection (m), its position and the largest angle (deg) with the top held at three offsets."""
    offsets = table["top_offset"]
    drifts: dict[str, Any] = {}
    for name, value in (("against", float(offsets.min())), ("none", 0.0), ("along", float(offsets.max()))):
        one = table.sel(top_offset=value)
        drifts |= {
            f"{name}_offset": value,
            f"{name}_deflection": float(one["deflection_by_offset"]),
            f"{name}_place": float(one["deflection_place_by_offset"]),
            f"{name}_angle": float(np.degrees(one["angle_by_offset"])),
        }
    return drifts


def solvers(runs: xr.Dataset) -> dict[str, Any]:
    """Difference between lumped masses and Hermite beam, at the weakest and the strongest tide."""
    apart = differences(runs)
    largest = abs(runs["x"].sel(solver=BEAM)).max(("time", "s"))
    return {
        "weak": float(apart["x"][0]), "strong": float(apart["x"][-1]),
        "weak_deflection": float(largest[0]), "strong_deflection": float(largest[-1]),
        "weak_moment": float(apart["bending_moment"][0]), "strong_moment": float(apart["bending_moment"][-1]),
    }  # fmt: skip


def differences(runs: xr.Dataset) -> xr.Dataset:
    """Largest difference between the solvers / largest value, of deflection and moment."""
    both = runs[["x", "bending_moment"]]
    apart = abs(both.sel(solver=LUMPED) - both.sel(solver=BEAM))
    return apart.max(("time", "s")) / abs(both.sel(solver=BEAM)).max(("time", "s"))
