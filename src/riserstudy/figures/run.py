"""Plots of one run: extremes along the riser, histories, shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.errors import InputError
from riserstudy.figures.range_graph import range_graph
from riserstudy.figures.shape import shape
from riserstudy.figures.style import as_written, headline
from riserstudy.figures.time_series import PANELS, time_series
from riserstudy.study.plots import USUAL

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def _usual(run: xr.Dataset) -> list[str] | None:
    """Histories of a run that has none of the usual ones; None if it has the usual ones."""
    there = [str(name) for name, values in run.items() if "time" in values.dims]
    return None if set(USUAL["time series"]).intersection(there) else there[:PANELS] or None


def draw(kind: str, run: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One plot of a run, by its kind: ``range``, ``time-series`` or ``shape``.

    Raises InputError when the run has none of the requested quantities.
    """
    title = str(run.attrs.get("title", "")) or "a run"
    if kind == "shape" and of:
        raise InputError("--of", of[0], "has no effect on a shape, which shows positions only", "omit --of")
    if kind == "time-series" and "time" not in run:
        found = "a static run has no time series"
        raise InputError(title, "analysis.duration", found, "choose the figure range or shape")
    with as_written():
        if kind == "range":
            return range_graph(run, title, of)
        if kind == "shape":
            return shape(run, title)
        figure = time_series(run, of or _usual(run))
        headline(figure, f"{title}: over time, where each quantity varies most")
    return figure
