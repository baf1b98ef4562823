"""Largest and smallest values along the riser, or the static state of static runs."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.grid import ENDINGS, SIZE, about, absent, key, label, points, read
from riserstudy.figures.style import COLOURS, panels
from riserstudy.study.plots import USUAL

PANELS = 3


def envelope(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One panel per quantity, with a colour for each of a few points of the grid."""
    names = of or [name for name in USUAL["envelope"] if _sides(dataset, name)][:PANELS]
    if missing := [name for name in names or USUAL["envelope"] if not _sides(dataset, name)]:
        raise absent(dataset, missing[0])
    figure, axes = panels(1, len(names), 4.2, sharey=True)
    curves = points(dataset)
    for ax, name in zip(axes, names, strict=True):
        ends = _sides(dataset, name)
        for colour, (called, point) in zip(COLOURS, curves, strict=False):
            for end, word in zip(ends, (called, None), strict=False):
                values = read(point[end].dropna(point[end].dims[-1]))
                ax.plot(values, read(values[values.dims[-1]]), color=colour, label=word)
        known = dataset[name] if name in dataset else xr.DataArray(0.0, name=name)
        ax.set_xlabel(label(known if about(known) else dataset[ends[0]]))
    axes[0].set_ylabel(label(xr.DataArray(0.0, name="s")))
    key(figure, axes[0])
    return figure


def _sides(dataset: xr.Dataset, name: str) -> list[str]:
    """Variables with the extremes of a quantity along the riser, or with its static state."""
    there = [str(n) for n, v in dataset.items() if {"s", "s_node"} & {*v.dims} and "time" not in v.dims]
    both = [name + end for end in ENDINGS if name + end in there]
    return both or [one for one in (name + SIZE, name) if one in there][:1]
