"""A calendar: shares of workable hours by month and year."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from riserstudy.dataset.table import Table
from riserstudy.figures.style import headline

CELL = 0.42  # inches


def calendar(shares: Table, title: str) -> Figure:
    """Months by years, each with its share of workable hours (%).

    ``shares``: table from `riserstudy.seas.hours.Hours.by_month`.
    """
    months = shares.columns[1:13]
    values = np.array(
        [[float(cell) if isinstance(cell, float) else np.nan for cell in row[1:13]] for row in shares.rows]
    )
    years = [str(row[0]) for row in shares.rows]
    figure = Figure((7.2, 1.6 + CELL * len(years)), dpi=150, layout="constrained")
    ax = figure.subplots()
    image = ax.imshow(values, cmap="viridis", vmin=0.0, vmax=100.0, aspect="auto")
    for (row, column), value in np.ndenumerate(values):
        if np.isfinite(value):
            colour = "black" if value > 60.0 else "white"
            ax.text(column, row, f"{value:.0f}", ha="center", va="center", color=colour, fontsize=8)
    ax.set_xticks(range(12), months)
    ax.set_yticks(range(len(years)), years)
    ax.set_facecolor("0.9")  # colour of months without a record
    figure.colorbar(image, ax=ax, label="workable hours (%)", shrink=0.9)
    headline(figure, title)
    return figure
