"""Content of a figure, extracted from the figure: a description in words for blind readers, and numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import PathCollection, PolyCollection, QuadMesh
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.transforms import Bbox

from riserstudy.files.csv_files import csv_text
from riserstudy.records.arrays import FloatArray

SENTENCE = 30  # number of characters from which on the title of a panel counts as a statement
_LETTER = re.compile(r"^\([a-z]\)\s*")
MOST_NAMED = 6  # largest number of lines of a panel that are named in words
HEADER = ("panel", "x", "y", "series", "x_value", "y_value", "colour_value")


class Series(NamedTuple):
    """One series of a panel: its name, and values of x, y and colour."""

    name: str
    values: FloatArray  # (n, 3), the third nan if colour has no value


def headline(figure: Figure) -> str:
    """The statement of a figure: its title, or the title of its first panel; "" if it has none."""
    axes = _visible_axes(figure)
    panel = _LETTER.sub("", _title(axes[0])) if axes else ""
    return _plain(figure.get_suptitle()) or (panel if len(panel) > SENTENCE else "")


def description(figure: Figure) -> str:
    """Description of a figure: panels with their titles, axes and named series."""
    panels = [panel for ax in _visible_axes(figure) if (panel := _panel(ax))]
    head = figure.get_suptitle()
    count = f"{len(panels)} panels. " if len(panels) > 1 else ""
    return " ".join([*([f"{head}."] if head else []), count + " ".join(panels)]).replace("\n", " ")


def csv_table(figure: Figure) -> str:
    """All plotted values as CSV text: one row per value, to six digits."""
    rows: list[tuple[str, ...]] = []
    for number, ax in enumerate(_visible_axes(figure), start=1):
        title = _title(ax) or str(number)
        labels, x_words, y_words = _labels(ax), _words(ax.xaxis), _words(ax.yaxis)
        for one in _series(ax):
            rows += [
                (title, *labels, one.name, _called(x, x_words), _called(y, y_words), _cell(colour))
                for x, y, colour in one.values
            ]
    return csv_text(HEADER, rows)


def _words(axis: Axis) -> dict[float, str]:
    """Words at the positions 0, 1, 2 of an axis, or at 0.5, 1.5; empty if an axis has numbers."""
    places = np.asarray(axis.get_majorticklocs(), float)
    if not len(places) or places[0] not in (0.0, 0.5) or (np.diff(places) != 1.0).any():
        return {}
    written = axis.get_major_formatter()
    words = [_plain(written(place, k)) for k, place in enumerate(places)]
    numbers = [_cell(place) for place in places]
    if written(places[-1] + 10.25, 0) or words == numbers or not all(words):  # formats any number
        return {}
    return dict(zip(places, words, strict=True))


def _called(value: float, words: dict[float, str]) -> str:
    """The word at a value, if its axis has words; else the number."""
    nearest = min(words, key=lambda place: abs(place - value), default=np.inf)
    return words[nearest] if abs(nearest - value) < 0.5 else _cell(value)


def _visible_axes(figure: Figure) -> list[Axes]:
    return [ax for ax in figure.axes if ax.get_visible() and ax.get_label() != "<colorbar>"]


def _panel(ax: Axes) -> str:
    series = [*_series(ax)]
    if not series and not ax.has_data():
        return ""
    title = _plain(f"{_title(ax)} {ax.get_title(loc='right')}")
    x, y = _labels(ax)
    axes = " over ".join(word for word in (y, x) if word)
    names = list(dict.fromkeys(one.name for one in series if one.name))
    many = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    named = f": {'; '.join(names[:MOST_NAMED])}{many}" if names else ""
    return f"{title + ': ' if title else ''}{axes or 'a drawing'}{named}."


def _title(ax: Axes) -> str:
    return _plain(" ".join(t for loc in ("left", "center") if (t := ax.get_title(loc=loc))))


def _labels(ax: Axes) -> tuple[str, str]:
    """Names of both axes; a shared axis has its name at one of the panels, or at the figure."""
    figure, shared_x = ax.get_figure(root=True), ax.get_shared_x_axes().get_siblings(ax)
    shared_y = ax.get_shared_y_axes().get_siblings(ax)
    of_x = [ax.get_xlabel(), *(other.get_xlabel() for other in shared_x)]
    of_y = [ax.get_ylabel(), *(other.get_ylabel() for other in shared_y)]
    if figure is not None:
        of_x, of_y = [*of_x, figure.get_supxlabel()], [*of_y, figure.get_supylabel()]
    x, y = (next(filter(None, names), "") for names in (of_x, of_y))
    return _plain(x), _plain(y)


def _plain(text: str) -> str:
    return " ".join(text.replace("$", "").split())


def _series(ax: Axes) -> Iterator[Series]:
    for artist in ax.get_children():
        label = " ".join(str(artist.get_label() or "").split())
        name = "" if label.startswith("_") else label
        values = _values(artist)
        if values is not None and len(values):
            yield Series(name, values)
    for bars in ax.containers:
        label = " ".join(str(bars.get_label() or "").split())
        boxes = [patch.get_bbox() for patch in getattr(bars, "patches", [])]
        if boxes:
            across = getattr(bars, "orientation", None) == "horizontal"
            ends = [_middle_of_end(box, across) for box in boxes]
            yield Series("" if label.startswith("_") else label, np.array(ends))


def _middle_of_end(bar: Bbox, across: bool) -> tuple[float, float, float]:
    """The end of a bar that its value determines, at the middle of its width."""
    if across:
        return bar.x1, 0.5 * (bar.y0 + bar.y1), np.nan
    return 0.5 * (bar.x0 + bar.x1), bar.y1, np.nan


def _values(artist: Any) -> FloatArray | None:
    if isinstance(artist, Line2D):
        return _columns(artist.get_xdata(orig=False), artist.get_ydata(orig=False))
    if isinstance(artist, QuadMesh):
        array, grid = artist.get_array(), np.asarray(artist.get_coordinates())
        if array is None:
            return None
        if array.size != grid[..., 0].size:  # one value per cell, not per corner
            grid = _places(_places(grid).swapaxes(0, 1)).swapaxes(0, 1)
        return _columns(grid[..., 0].ravel(), grid[..., 1].ravel(), array.ravel())
    if isinstance(artist, PathCollection):
        places = np.ma.getdata(artist.get_offsets())
        array = artist.get_array()
        colour = array.ravel() if array is not None and array.size == len(places) else None
        return _columns(places[:, 0], places[:, 1], colour)
    if isinstance(artist, Polygon):
        return _columns(*artist.get_xy().T)
    if isinstance(artist, PolyCollection | ContourSet):
        corners = [path.vertices for path in artist.get_paths()]
        return _columns(*np.concatenate(corners).T) if corners else None
    return None


def _places(edges: FloatArray) -> FloatArray:
    """Places whose midpoints are the edges (n + 1, ...) of cells; if there are none, middles of cells."""
    middle = 0.5 * (edges[1:] + edges[:-1])
    places = middle.copy()
    for k in range(1, len(places)):
        places[k] = 2.0 * edges[k] - places[k - 1]
    halfway = np.allclose(places[-1], middle[-1], rtol=1e-6, atol=1e-6 * np.ptp(edges))
    return places if halfway else middle


def _columns(x: Any, y: Any, colour: Any = None) -> FloatArray:
    x, y = (np.ma.filled(np.ma.asarray(v, float), np.nan) for v in (x, y))
    shade = np.full(len(x), np.nan) if colour is None else np.ma.filled(colour.astype(float), np.nan)
    return np.column_stack([x, y, shade])


def _cell(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.6g}"
