"""Accuracy asked for in random scenes: what was estimated, what was true, what it cost."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, GREY, headline, key_below, panels

HONEST = (0.5, 5.0)  # estimate over error
CHEAP = (5.0, 10.0)  # times the cheapest: in the median, in 95 %
LEAST = 1e-6  # error below which a point is drawn at the edge


def random_scenes(random_scenes: xr.Dataset) -> Figure:
    """Estimated beside true error; work beside that of the cheapest fixed mesh and step."""
    figure, (left, right) = panels(1, 2, height=4.4)
    _errors(left, random_scenes)
    _costs(right, random_scenes)
    key_below(figure, left, 4)
    headline(figure, answer(random_scenes))
    return figure


def answer(of: xr.Dataset) -> str:
    """How many scenes are as accurate as they ask, and how honest their estimates are."""
    asked, true = float(of.attrs["requested"]), of["true"].dropna("drawn")
    ratio = (of["estimated"] / of["true"].where(of["true"] > 0.0)).dropna("drawn")
    honest = ((ratio >= HONEST[0]) & (ratio <= HONEST[1])).sum()
    return (
        f"{int((true <= asked).sum())} of {true.size} random scenes reach the {100 * asked:g} % that "
        f"they ask for; in {int(honest)} the estimate is between half and five times the error"
    )


def _families(of: xr.Dataset) -> list[str]:
    return list(dict.fromkeys(of["family"].values.tolist()))


def _errors(ax: Axes, of: xr.Dataset) -> None:
    asked = float(of.attrs["requested"])
    ends = np.array([LEAST, 1.0])
    ax.fill_between(ends, HONEST[0] * ends, HONEST[1] * ends, color="0.92", linewidth=0.0)
    ax.plot(ends, ends, color=GREY, linewidth=0.8)
    ax.axvline(asked, color="black", linestyle=":", linewidth=1.0)
    for k, family in enumerate(_families(of)):
        for held_out in (False, True):
            here = (of["family"] == family) & (of["held_out"] == held_out)
            one = of.isel(drawn=np.flatnonzero(here.values))
            ax.plot(
                np.maximum(one["true"], LEAST),
                np.maximum(one["estimated"], LEAST),
                "osD^v<>p"[k % 8],
                color=COLOURS[k % len(COLOURS)],
                markerfacecolor=COLOURS[k % len(COLOURS)] if held_out else "none",
                markersize=5,
                label=family if held_out else "",
            )
    ax.set_xscale("log")
    ax.set_yscale("log")
    low = max(LEAST, 0.5 * float(of["true"].where(of["true"] > 0.0).min()))
    ax.set_xlim(low, max(3.0 * asked, 1.5 * float(of["true"].max())))
    ax.set_ylim(ax.get_xlim())
    ax.set_xlabel("true error (-), dotted: the request")
    ax.set_ylabel("estimated error (-)")


def _costs(ax: Axes, of: xr.Dataset) -> None:
    ratio = of["work_asked"] / of["work_fixed"]
    judged = of["true"].notnull().values
    for k, family in enumerate(_families(of)):
        here = (of["family"] == family).values & judged
        values = np.sort(ratio.values[here])
        none = int(np.isnan(values).sum())
        text = f"{none} of {here.sum()}: none cheaper" if here.any() else "none judged"
        ax.annotate(
            text if none or not here.any() else "", (0.98, k), xycoords=("axes fraction", "data"),
            ha="right", va="center", fontsize="x-small",
        )  # fmt: skip
        ax.plot(
            values,
            np.full(len(values), k),
            "osD^v<>p"[k % 8],
            color=COLOURS[k % len(COLOURS)],
            ms=5,
        )
    for limit in CHEAP:
        ax.axvline(limit, color="black", linestyle=":", linewidth=1.0)
    ax.set_xscale("log")
    ax.set_xticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
    ax.set_yticks(range(len(_families(of))), _families(of), fontsize="small")
    ax.set_xlim(0.4, 80.0)
    ax.set_ylim(len(_families(of)) - 0.5, -0.5)
    ax.set_xlabel("work of the request over that of the cheapest (-)")
