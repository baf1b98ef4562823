"""The limit of a riser that is exceeded most, over wave height and period."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from riserstudy.figures.limit_colours import colours_of
from riserstudy.figures.names import in_words
from riserstudy.figures.style import headline
from riserstudy.records.arrays import FloatArray
from riserstudy.seas.cover import scale_of
from riserstudy.seas.riser_hours import excess_of
from riserstudy.seas.surface import Surface

if TYPE_CHECKING:
    import xarray as xr

CELLS = 240  # number of cells of the map in each direction
WITHIN = "#e8e8e8"  # colour where all limits are met


def governing(responses: xr.Dataset, mode: str, share: float) -> Figure:
    """A map of the limit that is exceeded most, with the simulated sea states.

    Parameters
    ----------
    responses : from `riserstudy.seas.riser_downtime.Downtime`.
    mode, share : for the title: the mode, and the share (1) of workable hours in the record.
    """
    responses, heading = _worst_heading(responses)
    surface, simulated, held = _surface(responses)
    periods, heights = (np.linspace(simulated[:, k].min(), simulated[:, k].max(), CELLS) for k in (1, 0))
    plane = np.stack(np.meshgrid(heights, periods, indexing="ij"), axis=-1)
    excess = _excess(responses, surface.at(plane.reshape(-1, 2))).reshape(CELLS, CELLS, -1)
    unknown = np.isnan(excess).any(axis=-1)
    most = np.where(unknown, 0, np.nan_to_num(excess).argmax(axis=-1))
    displayed = np.where(np.nan_to_num(excess).max(axis=-1) > 0.0, most + 1.0, 0.0)
    displayed[unknown] = np.nan
    figure = Figure((7.2, 5.0), dpi=150, layout="constrained")
    ax = figure.subplots()
    labels = [in_words(str(name)) for name in responses["limit"].values]
    there = [int(k) for k in np.unique(displayed[~unknown])]
    colours = [WITHIN, *colours_of(responses["limit"].values).values()]
    ax.pcolormesh(
        periods, heights, displayed, cmap=ListedColormap(colours), vmin=-0.5, vmax=len(labels) + 0.5
    )
    for states, colour in ((simulated, "black"), (held, "white")):
        ax.plot(states[:, 1], states[:, 0], "o", ms=3, mfc=colour, mec="black", mew=0.5, ls="none")
    keys: list[Patch | Line2D] = [
        Patch(color=colours[k], label=labels[k - 1] if k else "all limits met") for k in there
    ]
    keys += [
        Line2D([], [], marker="o", ls="none", ms=4, mfc=colour, mec="black", label=label)
        for colour, label in (("black", "simulated"), ("white", "simulated to compare"))
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=2, fontsize="small")
    ax.set_xlabel("peak period (s)")
    ax.set_ylabel("significant wave height (m)")
    ax.set_title(heading, fontsize="small", loc="left")
    headline(figure, f"{mode.capitalize()} is possible in {100.0 * share:.1f} % of the hours")
    return figure


def _worst_heading(responses: xr.Dataset) -> tuple[xr.Dataset, str]:
    """Responses of the heading with the largest share of sea states that exceed a limit, and its name."""
    headings = responses["heading"].values
    if np.isnan(headings).all():
        return responses, ""
    covered = np.unique(headings[responses["held_out"].values == 0])  # without half-way headings
    excess = _excess(responses, responses["demand_of_limit"].values)
    beyond = np.nan_to_num(excess).max(axis=1) > 0.0
    shares = {float(h): float(beyond[headings == h].mean()) for h in covered}
    worst = max(shares, key=lambda one: shares[one])
    at = np.flatnonzero(headings == worst)
    return responses.isel(sea_state=at), f"worst of {len(shares)} headings, {worst:g} deg"


def _surface(responses: xr.Dataset) -> tuple[Surface, FloatArray, FloatArray]:
    """The response surface, the sea states that it uses, and the sea states for comparison."""
    states = np.column_stack([responses[name].values for name in ("significant_wave_height", "peak_period")])
    held = responses["held_out"].values.astype(bool)
    surface = Surface(states[~held], responses["demand_of_limit"].values[~held])
    return surface, states[~held], states[held]


def _excess(responses: xr.Dataset, demand: FloatArray) -> FloatArray:
    """Amount by which each limit is exceeded, (n, limits), as a share of the allowable."""
    allowed = responses["allowed"].values
    scale = scale_of(allowed, responses["demand_of_limit"].values)
    excess: FloatArray = excess_of(demand, allowed, responses["side"].values.tolist()) / scale
    return excess
