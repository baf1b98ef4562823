"""Histories of runs, each at the place of its largest variation."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.dataset.unit_systems import read_in
from riserstudy.figures.grid import absent, key, label, points, read
from riserstudy.figures.style import COLOURS, panels
from riserstudy.study.plots import USUAL

PANELS = 4


def time_series(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One panel per quantity over time, with a colour for each of a few points of the grid."""
    there = [n for n, values in dataset.items() if "time" in values.dims]
    names = of or [name for name in USUAL["time series"] if name in there][:PANELS]
    if missing := [name for name in names or USUAL["time series"] if name not in there]:
        raise absent(dataset, missing[0])
    figure, axes = panels(len(names), 1, 2.0, sharex=True)
    for ax, name in zip(axes, names, strict=True):
        place, text = _place(dataset[name])
        displayed = dataset[[name]].isel(place)
        for colour, (called, point) in zip(COLOURS, points(displayed), strict=False):
            ax.plot(point["time"], read(point[name]), color=colour, linewidth=0.9, label=called)
        ax.set_ylabel("\n".join((label(dataset[name]), text)).strip(), fontsize="small")
    axes[-1].set_xlabel(label(dataset["time"]))
    key(figure, axes[0])
    return figure


def _place(values: xr.DataArray) -> tuple[dict[str, int], str]:
    """Station or cylinder with the largest range, on average over the points, and its name."""
    within = next((dim for dim in ("s", "cylinder") if dim in values.dims), None)
    if within is None:
        return {}, ""
    span = values.max("time") - values.min("time")
    others = [dim for dim in span.dims if dim != within]
    k = int(span.mean(others).fillna(-1.0).argmax(within))
    factor, unit = read_in(values[within].attrs.get("units", ""))
    at = factor * values[within][k].item()
    return {within: k}, f"at {within} = {at:.4g}{'' if unit == '1' else f' {unit}'}"
