"""Stability in one picture: outcomes of hard cases, and the longest time steps of the methods."""

from __future__ import annotations

from itertools import zip_longest
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from chapters.numerics.answers import hard
from chapters.numerics.figures.methods import EXPLICIT, look_of
from chapters.numerics.outcome import REFUSALS, Outcome
from riserstudy.figures.direct import legible
from riserstudy.figures.style import headline

#: colours of the outcomes of cases
ENDS = {
    "accurate to 1 %": "#2f8f5b",
    "inaccurate, with a warning": "#e8a93a",
    "refused with a reason": "#5b9bd5",
    "finished, without a reference solution": "#6f6f6f",
    "not as expected": "#c0392b",
}
ACCURATE, FLAGGED, REFUSED, UNJUDGED, WRONG = ENDS
#: methods of the lower panel, if they were run; the table has all
METHODS = ("gen.-alpha 0.8", "Newmark 1/4 1/2", "TR-BDF2", "ESDIRK4", EXPLICIT)
NAMES = {"gen.-alpha 0.8": "generalised-alpha", "Newmark 1/4 1/2": "Newmark"}  # in the key
SHORTEST = 0.01  # least ratio to the default step on the axis; an arrow marks less
LIMIT = "predicted explicit limit"
MORE, LESS = ">", "<"  # marks of a range without upper limit, and of one off the axis
SAME = 1e-9  # relative difference below which steps count as equal
WORST = 2  # least number of cases that are named


def stability(stability: xr.Dataset) -> Figure:
    """Squares for the cases of each family above, ranges of steps by family and method below."""
    families = list(dict.fromkeys(map(str, stability["family"].values)))
    methods = [m for m in METHODS if m in stability["method"].values]
    stepped = [name for name in families if not np.isnan(_ranges(stability, name, methods)).all()]
    heights = [
        0.25 * len(families) + 0.17 * len(worst(stability)) + 0.5,
        0.09 * len(methods) * len(stepped) + 0.9,
    ]
    figure = Figure((9.6, sum(heights) + 0.8), dpi=150, layout="constrained")
    above, below = figure.subplots(2, 1, height_ratios=heights)
    _squares(above, stability, families)
    _steps(below, stability, stepped, methods)
    if stepped:
        _steps_key(figure, below, [m for m in METHODS if m not in methods])
    headline(figure, answer(stability))
    return figure


def ended(stability: xr.Dataset) -> list[str]:
    """Outcome of each case, in the words of the key."""
    ends = []
    for outcome, met in zip(
        map(str, stability["written_outcome"].values), stability["as_expected"].values, strict=True
    ):
        kinds: dict[str, str] = {Outcome.ACCURATE: ACCURATE, Outcome.INACCURATE: FLAGGED}
        kinds |= dict.fromkeys(REFUSALS, REFUSED)
        end = kinds.get(outcome, UNJUDGED)
        ends.append(end if met else WRONG)
    return ends


def answer(stability: xr.Dataset) -> str:
    """Title: number of cases that ended as expected, and errors without a warning that references show."""
    counts = hard(stability)
    many = f"All {counts.cases}" if counts.met == counts.cases else f"{counts.met} of {counts.cases}"
    shown = f"{counts.silent or 'no'} silent error{'' if counts.silent < 2 else 's'}"
    return f"{many} hard cases end as expected; {counts.compared} references show {shown}"


def worst(stability: xr.Dataset) -> list[int]:
    """Indices of the cases to name: all not as expected, and the ones with the largest errors."""
    error = np.nan_to_num(stability["written_error"].values, nan=-1.0)
    wrong = ~stability["as_expected"].values
    order = [int(case) for case in np.lexsort((-error, ~wrong)) if wrong[case] or error[case] > 0.0]
    return order[: max(WORST, int(wrong.sum()))]


def _squares(ax: Axes, stability: xr.Dataset, families: list[str]) -> None:
    ends, rank = ended(stability), {end: place for place, end in enumerate(ENDS)}
    of = stability["family"].values.astype(str)
    named = worst(stability)
    rows = [
        sorted(map(int, np.flatnonzero(of == family)), key=lambda case: rank[ends[case]])
        for family in families
    ]
    named = [case for row in rows for case in row if case in named]  # numbered from top to bottom
    most = 0
    for row, here in enumerate(rows):
        for place, case in enumerate(here):
            ax.add_patch(Rectangle((place, row - 0.4), 0.8, 0.8, facecolor=ENDS[ends[case]]))
            if case in named:
                number = str(named.index(case) + 1)
                ax.text(place + 0.4, row, number, ha="center", va="center", fontsize="small")
        most = max(most, len(here))
    notes = "\n".join(f"{k}  {_named(stability, case)}" for k, case in enumerate(named, start=1))
    ax.text(-0.1, len(families) - 0.35, notes, va="top", fontsize="small")
    ax.set_xlim(-0.3, max(most, 12) + 9)  # room for the key at the longest row
    ax.set_ylim(len(families) - 0.4 + 0.55 * len(named), -0.6)
    ax.set_yticks(range(len(families)), families, fontsize="small")
    ax.set_xticks([])
    ax.tick_params(length=0)
    for side in ax.spines.values():
        side.set_visible(False)
    present = [end for end in ENDS if end in ends]
    ax.legend(
        handles=[Patch(facecolor=ENDS[end], label=f"{ends.count(end)} {end}") for end in present],
        loc="center right", fontsize="small", frameon=False,
    )  # fmt: skip
    ax.set_title("(a) one square per case, run as its scene is written", loc="left", fontsize="small")


def _named(stability: xr.Dataset, case: int) -> str:
    """Describe a case in words, with its true and estimated errors, or else its outcome."""
    of = stability.isel(case=case)
    error, estimate = (100 * float(of[f"written_{name}"]) for name in ("error", "estimate"))
    if np.isnan(error):
        return f"{of['case'].values}: {of['written_outcome'].values}"
    return f"{of['case'].values}: true error {_per_cent(error)}, estimated {_per_cent(estimate)}"


def _per_cent(value: float) -> str:
    return f"{value:.0f} %" if value >= 100.0 else f"{value:.2g} %"


def _laddered(stability: xr.Dataset, family: str) -> xr.Dataset:
    """Return the cases of a family that were run with more than one step."""
    of = stability.isel(case=np.flatnonzero(stability["family"].values.astype(str) == family))
    tried = (of["step"].notnull().sum("rung") > 1).any("method").values
    return of.isel(case=np.flatnonzero(tried))


def _ranges(stability: xr.Dataset, family: str, methods: list[str]) -> NDArray[np.float64]:
    """Mean ratios of the largest accurate and largest surviving steps to the default step, (methods, 2)."""
    of = _laddered(stability, family)
    out = np.full((len(methods), 2), np.nan)
    for row, method in enumerate(methods):
        ratio = _over_default(of, method)
        out[row] = [_mean(values) for values in ratio[_drawable(ratio)].T]
    return out


def _goes_on(stability: xr.Dataset, family: str, method: str) -> bool:
    """Return whether, in any case of a range, the longest step tried survives and is therefore no limit.

    Explicit stepping is tried up to its predicted limit, which is drawn.
    """
    if method == EXPLICIT:
        return False
    of = _laddered(stability, family)
    one = of.isel(case=np.flatnonzero(_drawable(_over_default(of, method)))).sel({"method": method})
    return bool((one["largest_stable_step"] >= (1 - SAME) * one["step"].max("rung")).any())


def _drawable(ratio: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Select the cases for a range: cases with both ends; without any, cases with one end; else all."""
    known = np.isfinite(ratio)
    for of in (known.all(axis=1), known.any(axis=1)):
        if of.any():
            return np.asarray(of)
    return np.ones(len(ratio), bool)


def _over_default(stability: xr.Dataset, method: str) -> NDArray[np.float64]:
    """Ratios of a method's largest accurate and largest surviving steps to the default step, (case, 2)."""
    of = stability.sel({"method": method})
    names = ("largest_accurate_step", "largest_stable_step")
    ratios = [(of[name] / stability["written_step"]).values for name in names]
    return np.column_stack(ratios)


def _mean(values: NDArray[np.float64]) -> float:
    """Geometric mean of the finite values; NaN without any."""
    known = values[np.isfinite(values)]
    return float(np.exp(np.log(known).mean())) if known.size else np.nan


def _explicit_limit(stability: xr.Dataset, family: str) -> float:
    """Mean ratio of the predicted explicit limit to the default step, over the cases of its range."""
    of = stability.isel(case=np.flatnonzero(stability["family"].values.astype(str) == family))
    ratio = (of["explicit_limit"] / of["written_step"]).values
    return _mean(ratio[_drawable(_over_default(of, EXPLICIT))] if EXPLICIT in of["method"] else ratio)


def _without_explicit(stability: xr.Dataset, family: str) -> str:
    """Reason why a family has no range of explicit steps; "" if it has one."""
    if not np.isnan(_ranges(stability, family, [EXPLICIT])).all():
        return ""
    outcomes = _laddered(stability, family).sel({"method": EXPLICIT})["outcome"].values.astype(str)
    if (outcomes == Outcome.REFUSED).all():
        return "not possible with this effect"
    return "runs exceed the limit of work" if (outcomes == Outcome.TOO_LONG).any() else "no stable step found"


def _steps(ax: Axes, stability: xr.Dataset, families: list[str], methods: list[str]) -> None:
    height, ticked = 1.0 / (len(methods) + 1.2), False
    for row, family in enumerate(families):
        on = [_goes_on(stability, family, method) for method in methods]
        for k, (accurate, stable) in enumerate(_ranges(stability, family, methods)):
            y = row + (k - 0.5 * (len(methods) - 1)) * height
            colour = look_of(methods[k])[1]
            ends = [max(x, SHORTEST) for x in (accurate, stable) if np.isfinite(x)]
            ax.plot(ends, [y] * len(ends), color=colour, linewidth=3.0, alpha=0.45, zorder=2)
            ax.plot(
                max(accurate, SHORTEST),
                y,
                LESS if accurate < SHORTEST else "o",
                color=colour,
                markersize=3.5,
                zorder=3,
                label=NAMES.get(methods[k], methods[k]) if not row else "",
            )
            mark = MORE if on[k] else LESS if stable < SHORTEST else "o"
            ax.plot(
                max(stable, SHORTEST), y, mark, color=colour, markersize=5.5, markerfacecolor="none", zorder=3
            )
        if np.isfinite(limit := _explicit_limit(stability, family)):
            y = row + (0.5 * (len(methods) - 1) if EXPLICIT in methods else 0.0) * height
            if limit >= SHORTEST:
                ax.plot(limit, y, "|", color="black", markersize=11, markeredgewidth=1.6, zorder=4)
            ax.plot([], [], "|", color="black", label="" if ticked else LIMIT)
            ticked = True
        if EXPLICIT in methods and (reason := _without_explicit(stability, family)):
            at = (0.01, row + (methods.index(EXPLICIT) - 0.5 * (len(methods) - 1)) * height)
            ax.annotate(
                f"{EXPLICIT}: {reason}", at, xycoords=("axes fraction", "data"), va="center",
                fontsize="small", color=legible(look_of(EXPLICIT)[1]),
            )  # fmt: skip
    ax.axvline(1.0, color="0.5", linewidth=0.8, zorder=1)
    ax.set_xscale("log")
    ax.set_yticks(range(len(families)), families, fontsize="small")
    ax.set_ylim(len(families) - 0.5, -0.5)
    for edge in range(1, len(families)):
        ax.axhline(edge - 0.5, color="0.92", linewidth=0.8, zorder=0)
    ax.tick_params(axis="y", length=0)
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    if families:
        ax.annotate(
            "engine's own time step", (1.0, -0.5), xytext=(-4, -3), textcoords="offset points",
            ha="right", va="top", fontsize="small", color="0.35",
        )  # fmt: skip
    ax.set_xlabel("time step / step that the engine chooses: longer steps →")
    ax.set_title(f"(b) {_bearable(stability, families, methods)}", loc="left", fontsize="small")


def _steps_key(figure: Figure, ax: Axes, absent: list[str]) -> None:
    """Draw two rows below the panel: the colours of methods, and the marks of the ends of ranges."""
    handles, labels = ax.get_legend_handles_labels()
    methods = [
        Line2D([], [], color=handle.get_color(), linewidth=3.0)
        for handle, label in zip(handles, labels, strict=True)
        if label != LIMIT and isinstance(handle, Line2D)
    ]
    names = [label for label in labels if label != LIMIT]
    if absent:
        methods.append(Line2D([], [], linestyle=""))
        names.append(f"not run at this tier: {', '.join(absent)}")
    drawn = {str(line.get_marker()) for line in ax.lines if np.size(line.get_xdata())}
    grey: dict[str, Any] = {"color": "0.4", "linestyle": "", "markersize": 5.5}
    marks = {
        "accurate": Line2D([], [], marker="o", **grey | {"markersize": 3.5}),
        "stable": Line2D([], [], marker="o", markerfacecolor="none", **grey),
        MORE: Line2D([], [], marker=MORE, markerfacecolor="none", **grey),
        LESS: Line2D([], [], marker=LESS, markerfacecolor="none", **grey),
        "|": Line2D([], [], marker="|", color="black", linestyle="", markersize=11),
    }
    words = {
        "accurate": "longest accurate step",
        "stable": "longest stable step",
        MORE: "stable at longest step tested",
        LESS: f"below {SHORTEST:g}",
        "|": LIMIT,
    }
    seen = [mark for mark in marks if mark in ("accurate", "stable") or mark in drawn]
    empty = (Line2D([], [], linestyle=""), "")
    rows = zip_longest(
        zip(methods, names, strict=True), ((marks[m], words[m]) for m in seen), fillvalue=empty
    )
    entries, texts = zip(*(one for pair in rows for one in pair), strict=True)
    figure.legend(  # filled column by column: methods in the upper row, marks in the lower
        entries, texts, loc="outside lower center", ncols=len(texts) // 2, fontsize="small",
        frameon=False, columnspacing=1.2, handlelength=1.4,
    )  # fmt: skip


def _bearable(stability: xr.Dataset, families: list[str], methods: list[str]) -> str:
    """Title: the method that is accurate at the longest steps, and in how many families."""
    ranges = np.array([_ranges(stability, family, methods)[:, 0] for family in families])
    seen = ranges[~np.isnan(ranges).all(axis=1)] if len(ranges) else ranges
    if not len(seen):
        return "longest accurate and stable time steps"
    first = seen >= (1 - SAME) * np.nanmax(seen, axis=1)[:, None]
    count = int(first.sum(axis=0).max())
    leading = [k for k in range(len(methods)) if first[:, k].sum() == count]
    tied = int((first[:, leading].any(axis=1) & (first.sum(axis=1) > 1)).sum())
    others = f" ({tied} tied)" if tied else ""
    names = " and ".join(NAMES.get(methods[k], methods[k]) for k in leading)
    stays = "stays" if len(leading) == 1 else "stay"
    return (
        f"{names} {stays} accurate at the longest steps in {count} of {len(seen)} families of cases{others}"
    )
