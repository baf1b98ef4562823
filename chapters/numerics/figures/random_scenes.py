"""Random scenes run to a tolerance: estimated error, true error, and work."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from chapters.numerics.figures.scenes import family_in_words
from riserstudy.figures.style import COLOURS, GREY, headline, legend_below, mosaic, panel_title

HONEST = (0.5, 5.0)  # range of the ratio of estimated to true error
CHEAP = (5.0, 10.0)  # target ratios to the cheapest work: median, 95 % of scenes
JITTER = 0.18  # largest displacement of a mark from its row
ROOM = 18.0  # upper end of the axis of errors, relative to the tolerance, with names of scenes
LEAST = 1e-6  # error below which a point is drawn at the edge


def random_scenes(random_scenes: xr.Dataset) -> Figure:
    """Estimated and true error; work with the tolerance, divided by the least work at fixed mesh and step."""
    figure, (left, right) = mosaic(["a a a b b"], (4.4,))
    _errors(left, random_scenes)
    _costs(right, random_scenes)
    keys = [ax.get_legend_handles_labels() for ax in (left, right)]
    legend_below(figure, [*keys[0][0], *keys[1][0]], [*keys[0][1], *keys[1][1]], 2)
    tolerance = f"error at a tolerance of {100 * float(random_scenes.attrs['requested']):g} %"
    panel_title(left, "; ".join(filter(None, [tolerance, not_judged(random_scenes)])))
    panel_title(right, "work of all refinements")
    headline(figure, answer(random_scenes))
    return figure


def answer(of: xr.Dataset) -> str:
    """Title: number of judged scenes that meet their tolerance."""
    requested, true = float(of.attrs["requested"]), of["true"].dropna("drawn")
    met = int((true <= requested).sum())
    if not true.size:
        return f"None of {of.sizes['drawn']} random scenes could be judged"
    many = f"All {met}" if met == true.size else f"{met} of {true.size}"
    return f"{many} {'judged ' if not_judged(of) else ''}random scenes meet their tolerance"


def not_judged(of: xr.Dataset) -> str:
    """Number of scenes without a true error, in words; empty if all have one."""
    left = int(of["true"].isnull().sum())
    return f"{left} scene{'s are' if left > 1 else ' is'} not judged" if left else ""


def _errors(ax: Axes, of: xr.Dataset) -> None:
    """Draw one mark per scene; scenes that exceed the tolerance are named by their family."""
    requested = float(of.attrs["requested"])
    true, estimated = (np.maximum(of[name], LEAST) for name in ("true", "estimated"))
    ends = np.array([LEAST, 1.0])
    band = "(a) estimate of 0.5 to 5 times the error"
    ax.fill_between(ends, HONEST[0] * ends, HONEST[1] * ends, color="0.92", lw=0.0, label=band)
    ax.plot(ends, ends, color=GREY, linewidth=0.8, label="(a) estimate equal to the error")
    ax.axvline(requested, color="black", linestyle=":", linewidth=1.0, label="(a) tolerance")
    missed = (of["true"] > requested).values
    for here, colour, words in (
        (~missed, COLOURS[0], ""),
        (missed, COLOURS[1], ", error above the tolerance"),
    ):
        for held_out, kind in ((False, "used to tune"), (True, "held out from tuning")):
            chosen = here & (of["held_out"] == held_out).values
            if chosen.any():
                ax.plot(
                    true[chosen], estimated[chosen], "o", color=colour, markersize=5, label=kind + words,
                    markerfacecolor=colour if held_out else "none",
                )  # fmt: skip
    for k in np.flatnonzero(missed):
        family = family_in_words(str(of["family"].values[k])).replace(", ", ",\n", 1)
        ax.annotate(
            family, (float(true[k]), float(estimated[k])),
            xytext=(6, 0), textcoords="offset points", ha="left", va="center", fontsize="small",
            color=COLOURS[1],
        )  # fmt: skip
    ax.set_xscale("log")
    ax.set_yscale("log")
    low = max(LEAST, 0.5 * float(of["true"].where(of["true"] > 0.0).min()))
    largest = max(1.5 * float(of[name].max()) for name in ("true", "estimated"))
    ax.set_xlim(low, max((ROOM if missed.any() else 3.0) * requested, largest))
    ax.set_ylim(ax.get_xlim())
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
        axis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("true error (%)")
    ax.set_ylabel("estimated error (%)")


def _costs(ax: Axes, of: xr.Dataset) -> None:
    """Draw one row of work ratios per family, with marks as in the other panel."""
    ratio = (of["work_asked"] / of["work_fixed"]).values
    judged, held_out = of["true"].notnull().values, of["held_out"].values.astype(bool)
    families = list(dict.fromkeys(of["family"].values.tolist()))
    for row, family in enumerate(families):
        here = (of["family"] == family).values & judged
        none = int(np.isnan(ratio[here]).sum())
        ax.annotate(
            f"{none} of {here.sum()}" if here.any() else "none judged", (1.02, row),
            xycoords=("axes fraction", "data"), va="center", fontsize="small", annotation_clip=False,
        )  # fmt: skip
        for kind in (False, True):
            values = ratio[here & (held_out == kind)]
            rows = row + JITTER * np.sin(2.4 * np.arange(len(values)))
            ax.plot(values, rows, "o", color=COLOURS[0], markersize=5,
                    markerfacecolor=COLOURS[0] if kind else "none")  # fmt: skip
    ax.annotate(
        "scenes with no\ncheaper single run", (1.02, 1.01), xycoords="axes fraction", va="bottom",
        fontsize="small", annotation_clip=False,
    )  # fmt: skip
    for limit, of_which, line in zip(CHEAP, ("median", "95 %"), ("-.", "--"), strict=True):
        label = f"(b) target, {of_which} of the scenes: {limit:g}"
        ax.axvline(limit, color="0.4", linestyle=line, linewidth=1.0, label=label)
    ax.set_xscale("log")
    ax.set_xticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
    ax.set_yticks(range(len(families)), list(map(family_in_words, families)), fontsize="small")
    ax.set_xlim(0.7, max(20.0, 1.5 * float(np.nanmax(ratio, initial=1.0))))
    ax.set_ylim(len(families) - 0.5, -0.5)
    ax.set_xlabel("work of all refinements /\nwork of the cheapest single run")
