"""Workable hours of a record over settings of a riser: bands, months, limits that reduce them, waits."""

from __future__ import annotations

from textwrap import fill

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.errors import InputError
from riserstudy.figures.grid import called, evenly_spaced
from riserstudy.figures.names import in_words
from riserstudy.figures.style import COLOURS, headline, legend_below, panel_title, panels

MOST = 6  # largest number of settings that are drawn, equally spaced
WRAPPED = 20  # letters of the name of a limit in a line
STACKED = " "  # a name that no axis has
FLAT = 2.0  # smallest range of the axis of months, in per cent of the hours
# dimensions that are not settings
OVER = ("riser_mode", "limit", "month", "year", "window", "sea_state")


def workable_hours(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """Workable hours of each setting and mode with their bands, by month, by limit, and the waits.

    Raises InputError when the dataset has no workable hours.
    """
    if "workable" not in dataset:
        title = str(dataset.attrs.get("title", "dataset"))
        found = "the dataset has no workable hours"
        raise InputError(title, "plot", found, "use a dataset that the study file lists under `seas`")
    every = _settings(dataset)
    drawn = [every[k] for k in evenly_spaced(len(every), MOST)]
    figure, (hours, months, limits, waits) = panels(2, 2, 3.0)
    _hours(hours, drawn)
    _months(months, drawn)
    _limits(limits, drawn)
    if "window" in dataset.dims:
        _waits(waits, drawn)
    else:
        waits.remove()
    if len(drawn) > 1:
        legend_below(figure, *months.get_legend_handles_labels(), 4)
    headline(figure, _finding(every))
    return figure


def _settings(dataset: xr.Dataset) -> list[tuple[str, xr.Dataset]]:
    """Each setting with its name, "" for a single one."""
    axes = [str(dim) for dim in dataset["workable"].dims if dim not in OVER]
    names = [*_OF_SETTINGS, *(n for n in _OF_WINDOWS if n in dataset)]
    hours = dataset[names]
    if not axes:
        return [("", hours)]
    flat = hours.stack({STACKED: axes})
    places = [
        ", ".join(called(dataset[axis][k]) for axis, k in zip(axes, index, strict=True))
        for index in np.ndindex(*(dataset.sizes[axis] for axis in axes))
    ]
    return [(place, flat.isel({STACKED: k})) for k, place in enumerate(places)]


_OF_SETTINGS = (
    *("workable", "workable_at_worst", "workable_at_best", "mean_year_low", "mean_year_high"),
    *("workable_by_month", "exceeded", "exceeded_alone"),
)
_OF_WINDOWS = ("wait_p50", "wait_p90")


def _hours(ax: Axes, drawn: list[tuple[str, xr.Dataset]]) -> None:
    """Share of workable hours of each setting, one row per mode, with both bands."""
    rows, ticks = 0, []
    for k, (_, one) in enumerate(drawn):
        for mode in one["riser_mode"].values:
            of = one.sel(riser_mode=mode)
            share = 100.0 * float(of["workable"])
            if np.isnan(share):
                continue
            years = [100.0 * float(of[f"mean_year_{end}"]) for end in ("low", "high")]
            riser = [100.0 * float(of[f"workable_at_{end}"]) for end in ("worst", "best")]
            ax.plot(years, [rows, rows], color=COLOURS[k], linewidth=1.0)
            ax.plot(riser, [rows, rows], color=COLOURS[k], linewidth=5.0, alpha=0.35)
            ax.plot(share, rows, "o", color=COLOURS[k], markersize=4.0)
            ticks.append(str(mode))
            rows += 1
    ax.set_yticks(range(rows), ticks, fontsize="small")
    ax.set_ylim(rows - 0.5, -0.5)
    ax.set_xlabel("workable hours (%)")
    panel_title(ax, "wide: error of the response; thin: mean year")


def _months(ax: Axes, drawn: list[tuple[str, xr.Dataset]]) -> None:
    """Share of workable hours by month, for the first mode."""
    for k, (name, one) in enumerate(drawn):
        values = 100.0 * one["workable_by_month"].isel(riser_mode=0)
        ax.plot(range(12), values, "o-", color=COLOURS[k], markersize=3.0, label=name)
    low, high = ax.get_ylim()
    if high - low < FLAT:
        middle = min(max(0.5 * (low + high), 0.5 * FLAT), 100.0 - 0.5 * FLAT)
        ax.set_ylim(middle - 0.55 * FLAT, middle + 0.55 * FLAT)
    months = [str(name)[0] for name in drawn[0][1]["month"].values]
    ax.set_xticks(range(12), months)
    ax.set_ylabel("workable hours (%)")
    panel_title(ax, f"{drawn[0][1]['riser_mode'].values[0]} by month")


def _limits(ax: Axes, drawn: list[tuple[str, xr.Dataset]]) -> None:
    """Share of hours in which each limit is exceeded, and in which only this limit is."""
    names = [fill(in_words(str(n)), WRAPPED) for n in drawn[0][1]["limit"].values]
    height = 0.8 / len(drawn)
    for k, (_, one) in enumerate(drawn):
        places = np.arange(len(names)) + (k - (len(drawn) - 1) / 2.0) * height
        ax.barh(places, 100.0 * one["exceeded"], height, color=COLOURS[k], alpha=0.4)
        ax.barh(places, 100.0 * one["exceeded_alone"], height, color=COLOURS[k])
    ax.set_yticks(range(len(names)), names, fontsize="small")
    ax.invert_yaxis()
    ax.set_xlabel("hours in which a limit is exceeded (%)")
    panel_title(ax, "dark: hours in which only this limit is exceeded")


def _waits(ax: Axes, drawn: list[tuple[str, xr.Dataset]]) -> None:
    """Median and 90 % quantile of waits for a window, for the first mode."""
    for k, (_, one) in enumerate(drawn):
        of = one.isel(riser_mode=0)
        ax.plot(of["window"], of["wait_p50"], "o-", color=COLOURS[k], markersize=3.0)
        ax.plot(of["window"], of["wait_p90"], "s--", color=COLOURS[k], markersize=3.0)
    ax.set_xlabel("length of a weather window (h)")
    ax.set_ylabel("wait (h)")
    panel_title(ax, "wait: 50 % (line), 90 % (dashes) of starts")
    if not any(np.isfinite(one[name].isel(riser_mode=0)).any() for _, one in drawn for name in _OF_WINDOWS):
        first = drawn[0][1]
        windows = " or ".join(f"{hours:g}" for hours in first["window"].values)
        text = f"no {windows} h of {first['riser_mode'].values[0]}\nwithout a break in the record"
        ax.text(0.5, 0.5, text, transform=ax.transAxes, ha="center", va="center")
        ax.set(xticks=[], yticks=[])
        return
    ax.set_ylim(bottom=0.0)


def _finding(every: list[tuple[str, xr.Dataset]]) -> str:
    """The finding: smallest and largest known share of workable hours of the settings, in the first mode."""
    mode = str(every[0][1]["riser_mode"].values[0]).capitalize()
    shares = [100.0 * float(one["workable"].isel(riser_mode=0)) for _, one in every]
    shares = [share for share in shares if np.isfinite(share)]
    if not shares:
        return f"Workable hours of {mode.lower()} are not known"
    low, high = f"{min(shares):.1f}", f"{max(shares):.1f}"
    if max(shares) == 0.0:
        return f"{mode} is possible in no hour of the record"
    if low == high:
        return f"{mode} is possible in {low} % of the hours"
    return f"{mode} is possible in {low} % to {high} % of the hours"
