"""Histories of the runs, each at the place where it varies most."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.grid import absent, key, label, points, read
from riserstudy.figures.style import COLOURS, panels

QUANTITIES = ("x", "bending_moment", "effective_tension", "ufj_angle", "stroke", "z")
PANELS = 4


def time_series(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One panel a quantity over time, a colour for each of a few points of the grid."""
    names = [n for n in of or QUANTITIES if n in dataset and "time" in dataset[n].dims][:PANELS]
    if not names:
        raise absent(dataset, (of or QUANTITIES)[0])
    figure, axes = panels(len(names), 1, 2.0, sharex=True)
    for ax, name in zip(axes, names, strict=True):
        place, said = _place(dataset[name])
        shown = dataset[[name]].isel(place)
        for colour, (called, point) in zip(COLOURS, points(shown), strict=False):
            ax.plot(point["time"], read(point[name]), color=colour, linewidth=0.9, label=called)
        ax.set_ylabel("\n".join((label(dataset[name]), said)).strip(), fontsize="small")
    axes[-1].set_xlabel(label(dataset["time"]))
    key(figure, axes[0])
    return figure


def _place(values: xr.DataArray) -> tuple[dict[str, int], str]:
    """Station or cylinder with the largest range, in the middle of the points, and its name."""
    within = next((dim for dim in ("s", "cylinder") if dim in values.dims), None)
    if within is None:
        return {}, ""
    span = values.max("time") - values.min("time")
    others = [dim for dim in span.dims if dim != within]
    k = int(span.mean(others).fillna(-1.0).argmax(within))
    at = values[within][k]
    return {within: k}, f"at {within} = {at.item():.4g} {at.attrs.get('units', '')}".removesuffix(
        " 1"
    )
