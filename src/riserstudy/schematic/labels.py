"""Labels in a column next to a drawing, each joined to its part by a line, without overlaps."""

from __future__ import annotations

import re
import textwrap
from dataclasses import dataclass, field
from typing import NamedTuple

from matplotlib.axes import Axes

from riserstudy.figures.style import COLOURS

PART, WATER, LOAD, FREEDOM = "black", COLOURS[0], COLOURS[1], "#007a58"
#: meaning of the colours of labels
KEY = {"parts": PART, "water": WATER, "loads": LOAD, "freedoms and motions": FREEDOM}
SIZE = 8.2  # of the letters (points); above 6 when printed 180 mm wide, the width of a journal page
LINE = 1.3 * SIZE / 72.0  # height of a line (inches)
GAP = 0.4 * LINE  # between labels
CHARACTERS = 31  # most characters of a line
UNBROKEN = "\u00a0"  # space without a line break
REACH = 0.16  # distance from the drawing to its labels (inches)
# above or below an end, so that no leader lies on the water or the ground (inches)
AWAY = 0.8 * LINE


class Label(NamedTuple):
    """A text, the point that it names, its colour, and its height above the point (inches)."""

    text: str
    x: float
    z: float
    colour: str
    lift: float


@dataclass
class Labels:
    """The labels of one drawing."""

    rows: list[Label] = field(default_factory=list)

    def add(self, text: str, point: tuple[float, float], colour: str = PART, lift: float = 0.0) -> None:
        """Add a label for a point; if there is room, it is ``lift`` inches above the point."""
        wrapped = "\n".join(textwrap.wrap(tied(text), CHARACTERS, break_long_words=False))
        self.rows.append(Label(wrapped, *point, colour, lift))

    def heights(self) -> list[float]:
        """Return the heights of the labels, from the top (inches)."""
        return [(row.text.count("\n") + 1) * LINE for row in self._falling]

    def wanted(self, ax: Axes) -> list[float]:
        """Return the heights of the labels' points above the bottom of the axes, falling (inches)."""
        (low, high), (_, height) = ax.get_ylim(), _inches(ax)
        return [(row.z - low) / (high - low) * height + row.lift for row in self._falling]

    def place(self, ax: Axes, middles: list[float], size: float = SIZE) -> None:
        """Write all labels to the right of the axes; ``middles`` are inches above the bottom of the axes."""
        (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
        width, height = _inches(ax)
        for row, y in zip(self._falling, middles, strict=True):
            corner = (min(max(row.x, left), right), min(max(row.z, low), high))
            ax.annotate(
                row.text,
                corner,
                (1.0 + REACH / width, y / height),
                xycoords="data",
                textcoords="axes fraction",
                va="center",
                fontsize=size,
                color=row.colour,
                arrowprops={
                    "arrowstyle": "-",
                    "color": row.colour,
                    "linewidth": 0.5,
                    "alpha": 0.7,
                    "shrinkA": 1.0,
                    "shrinkB": 0.0,
                    "relpos": (0.0, 0.5),
                },
                annotation_clip=False,
            )

    @property
    def _falling(self) -> list[Label]:
        return sorted(self.rows, key=lambda row: -row.z)


def place_in_column(panels: list[tuple[Labels, Axes]]) -> None:
    """Write the labels of panels that are one above the other, next to their panels if they fit there.

    If the labels of one panel do not fit, the labels of all panels share the height of the column. The
    letters become smaller only if that is not enough.
    """
    rooms = [_inches(ax)[1] for _, ax in panels]
    if all(_needed(labels.heights()) <= room for (labels, _), room in zip(panels, rooms, strict=True)):
        for (labels, ax), room in zip(panels, rooms, strict=True):
            labels.place(ax, spread(labels.wanted(ax), labels.heights(), room))
        return
    floors = [_floor(ax) - _floor(panels[-1][1]) for _, ax in panels]
    heights = [height for labels, _ in panels for height in labels.heights()]
    wanted = [
        floor + y for (labels, ax), floor in zip(panels, floors, strict=True) for y in labels.wanted(ax)
    ]
    room = floors[0] + rooms[0]
    smaller = min(1.0, room / _needed(heights))
    places = spread([y / smaller for y in wanted], heights, room / smaller)
    middles = iter(smaller * y for y in places)
    for (labels, ax), floor in zip(panels, floors, strict=True):
        labels.place(ax, [next(middles) - floor for _ in labels.rows], SIZE * smaller)


def _needed(heights: list[float]) -> float:
    return sum(heights) + GAP * max(len(heights) - 1, 0)


def tied(text: str) -> str:
    """Return a text whose numbers stay on one line with their units and with the names of the quantities."""
    text = re.sub(r"(?<=\d) (?=[^\W\d]{1,2}\b)(?!in\b|to\b|of\b)", UNBROKEN, text)
    text = text.replace(" = ", f"{UNBROKEN}={UNBROKEN}")
    return re.sub(r"\b(EA|EI) (?=\d)", rf"\1{UNBROKEN}", text)


def spread(wanted: list[float], heights: list[float], room: float) -> list[float]:
    """Return the middles of labels, top first, as near to the wanted places as possible without overlap.

    Parameters
    ----------
    wanted : wanted places of the middles, falling.
    heights : heights of the labels.
    room : height that the labels may occupy, if they fit.
    """
    places: list[float] = []
    for k, (place, height) in enumerate(zip(wanted, heights, strict=True)):
        most = room - 0.5 * height
        if places:
            most = places[-1] - 0.5 * (heights[k - 1] + height) - GAP
        places.append(min(place, most))
    least = 0.0
    for k in range(len(places) - 1, -1, -1):
        places[k] = max(places[k], least + 0.5 * heights[k])
        least = places[k] + 0.5 * heights[k] + GAP
    return places


def _floor(ax: Axes) -> float:
    return float(ax.get_position().y0 * ax.get_figure(root=True).get_size_inches()[1])  # type: ignore[union-attr]


def _inches(ax: Axes) -> tuple[float, float]:
    box = ax.get_position()
    width, height = ax.get_figure(root=True).get_size_inches()  # type: ignore[union-attr]
    return box.width * width, box.height * height
