"""Style of figures, and plots that fit any grid."""

from __future__ import annotations

import math
import zlib
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.files.whole import whole_file

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from riserstudy.study.figures import FigureModel


# PNG attribute: rows that a page cuts off if it shows the title as text
HEAD_ROWS = "Headline rows"


def module_of_plot(plot: str) -> str:
    """The module that draws a plot for any grid, by a function with the name of the plot."""
    return f"riserstudy.figures.{plot.replace(' ', '_')}"


def draw_plot(model: FigureModel, dataset: xr.Dataset) -> Figure:
    """A figure with a plot for any grid, with the numbers of its axes in increasing order."""
    from riserstudy.figures.grid import axes_of
    from riserstudy.figures.style import as_written

    for axis in axes_of(dataset):
        if axis in dataset.coords and dataset[axis].dtype.kind in "fiu":
            dataset = dataset.sortby(axis)

    module = import_module(module_of_plot(str(model.plot)))
    with as_written():
        figure: Figure = getattr(module, module.__name__.rpartition(".")[2])(dataset, model.of)
    return figure


def save(figure: Figure, *targets: Path) -> None:
    """Write a figure in the formats of the targets' endings, each completely or not at all.

    A PNG contains a description in words, which becomes its alternative text; CSV contains the plotted
    values. Raises SimulationError when a file cannot be written, as on a full disk.
    """
    import matplotlib as mpl

    from riserstudy.figures.figure_text import csv_table

    figure.draw_without_rendering()  # computes the layout once
    # The same layout for all formats. With a layout engine, even one that does nothing, matplotlib prepares
    # the figure again for each format; None removes the engine unless the settings name one.
    with mpl.rc_context({"figure.autolayout": False, "figure.constrained_layout.use": False}):
        figure.set_layout_engine(None)
    for target in targets:
        target.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(target, zlib.error) as partial:  # zlib.error: a PDF that is not closed
            if target.suffix == ".csv":
                partial.write_text(csv_table(figure), "utf-8")
            else:
                kind = target.suffix.removeprefix(".")
                figure.savefig(partial, format=kind, metadata=_metadata(figure, target.suffix))


def _head_rows(figure: Figure) -> int:
    """Rows of pixels of the title above all panels, 0 without a title."""
    title = figure.get_suptitle()
    written = next((text for text in figure.texts if title and text.get_text() == title), None)
    if written is None:
        return 0
    below = float(figure.bbox.height - written.get_window_extent().y0)
    return max(0, math.ceil(below) + 2)


def _metadata(figure: Figure, suffix: str) -> dict[str, str | None] | None:
    from riserstudy.figures.figure_text import description, headline

    if suffix == ".png":
        metadata: dict[str, str | None] = {"Title": headline(figure), "Description": description(figure)}
        return metadata | {HEAD_ROWS: str(_head_rows(figure))}
    return {"CreationDate": None} if suffix == ".pdf" else None
