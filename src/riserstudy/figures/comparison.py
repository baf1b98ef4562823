"""A run compared with a table of another program or a measurement: one panel per column."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from riserstudy.dataset.comparison import Pair
from riserstudy.dataset.unit_systems import read_in
from riserstudy.figures.names import in_words
from riserstudy.figures.style import COLOURS, headline, key_below, panel_title, panels

MOST = 6  # largest number of panels


def comparison(pairs: Sequence[Pair], title: str, other: str) -> Figure:
    """Both over time, or along the riser, in the reader's units.

    ``title``: title of the run. ``other``: name of the table.
    """
    chosen = pairs[:MOST]
    figure, axes = panels(len(chosen), 1, 2.2, sharex=True)
    length, unit_of_length = read_in("m") if pairs[0].axis == "s" else (1.0, "")
    for ax, pair in zip(axes, chosen, strict=True):
        factor, unit = read_in(pair.unit)
        along = length * pair.along
        ax.plot(along, factor * pair.ours, color=COLOURS[0], linewidth=1.2, label="run")
        ax.plot(along, factor * pair.theirs, color=COLOURS[1], linestyle="--", linewidth=1.2, label=other)
        panel_title(ax, in_words(pair.name))
        ax.set_ylabel(unit if unit != "1" else "")
    arclength = f"arclength from the bottom ({unit_of_length})"
    axes[-1].set_xlabel("time (s)" if pairs[0].axis == "time" else arclength)
    key_below(figure, axes[-1], 2)
    headline(figure, f"{title} compared with {other}")
    return figure
