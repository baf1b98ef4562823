"""How figures look: size, colours, labels with units from the variable table."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

#: colours that stay apart for colour-blind readers and in grey
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
GREY = "#888888"
WIDTH = 6.4  # inches


def panels(
    rows: int = 1, columns: int = 1, height: float = 3.4, **options: bool
) -> tuple[Figure, list[Axes]]:
    """Empty figure with a grid of panels, lettered when there are several."""
    figure = Figure(
        (WIDTH if columns == 1 else 1.6 * WIDTH, height * rows), dpi=150, layout="constrained"
    )
    grid = figure.subplots(rows, columns, squeeze=False, **options)
    axes = list(grid.flat)
    for letter, ax in zip("abcdefghijkl", axes, strict=False):
        ax.grid(True, color="0.9", linewidth=0.6)
        ax.set_axisbelow(True)
        if len(axes) > 1:
            ax.set_title(f"({letter})", loc="left", fontsize="medium")
    return figure, axes
