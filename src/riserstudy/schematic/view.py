"""One panel of a schematic: axes with the same scale in both directions, and labels next to them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from riserstudy.schematic.geometry import Point
from riserstudy.schematic.labels import FREEDOM, LOAD, PART, Labels

SYMBOL: dict[str, Any] = {"linestyle": (0, (4, 2)), "linewidth": 0.9, "edgecolor": PART}
SMALL = 0.45  # size of symbols in the whole view relative to the other views
THIN = 1.0  # narrowest line of a part (points)


@dataclass
class View:
    """Axes that show a window of the scene."""

    ax: Axes
    # whether this is the whole view, which labels the long parts; other views label their end
    whole: bool
    inch: float  # metres of the scene per inch of the figure
    labels: Labels = field(default_factory=Labels)
    # for the whole view: the views that show its ends magnified
    ends: list[View] = field(default_factory=list)

    @property
    def symbol(self) -> float:
        """Metres per inch of symbols, whose size is not in the scene; smaller in the whole view."""
        return SMALL * self.inch if self.whole else self.inch

    @property
    def symbol_of_ends(self) -> float:
        """Metres per inch of symbols at the upper end, also in the whole view."""
        return self.ends[0].symbol if self.ends else self.symbol

    @property
    def window(self) -> tuple[float, float, float, float]:
        """Left, right, lower and upper limit (m)."""
        return *self.ax.get_xlim(), *self.ax.get_ylim()

    def shows(self, point: Point) -> bool:
        """Return whether a point is in the window."""
        left, right, low, high = self.window
        return left <= point[0] <= right and low <= point[1] <= high

    def name(
        self, text: str, point: Point, colour: str = PART, whole: bool = False, lift: float = 0.0
    ) -> None:
        """Label a point if it belongs to this view and is visible; ``lift``: inches above the point."""
        if whole == self.whole and self.shows(point):
            self.labels.add(text, point, colour, lift)

    def name_anywhere(self, text: str, point: Point) -> None:
        """Label a point in a view of an end that shows it, else in the whole view."""
        self.name(text, point, whole=self.whole and not any(end.shows(point) for end in self.ends))

    def line(self, x: Sequence[float], z: Sequence[float], **style: Any) -> None:
        """Draw a line through points."""
        about: dict[str, Any] = {"color": PART, "linewidth": THIN, "solid_capstyle": "butt"}
        self.ax.plot(x, z, **about | style)

    def box(self, low: Point, width: float, height: float, **style: Any) -> None:
        """Draw an upright box above its lower middle point, dashed unless styled otherwise."""
        from matplotlib.patches import Rectangle

        about = {"facecolor": "0.93", **SYMBOL, "zorder": 3.0} | style
        self.ax.add_patch(Rectangle((low[0] - 0.5 * width, low[1]), width, height, **about))

    def arrow(self, tail: Point, head: Point, colour: str = LOAD, ends: str = "-|>") -> None:
        """Draw an arrow of a load, or of a motion if it has two heads."""
        self.ax.annotate(
            "",
            head,
            tail,
            arrowprops={
                "arrowstyle": ends,
                "color": colour,
                "linewidth": 1.3,
                "mutation_scale": 9,
                "shrinkA": 0.0,
                "shrinkB": 0.0,
            },
            zorder=6.0,
        )

    def motion(self, middle: Point, away: Point) -> None:
        """Draw a double arrow for a motion back and forth."""
        (x, z), (dx, dz) = middle, away
        self.arrow((x - dx, z - dz), (x + dx, z + dz), FREEDOM, "<|-|>")

    def turning(self, middle: Point, radius: float) -> None:
        """Draw an arc with two heads for a rotation."""
        self.ax.annotate(
            "",
            (middle[0] + radius, middle[1]),
            (middle[0] - radius, middle[1]),
            arrowprops={
                "arrowstyle": "<|-|>",
                "color": FREEDOM,
                "linewidth": 1.3,
                "mutation_scale": 9,
                "connectionstyle": "arc3,rad=-0.6",
            },
            zorder=6.0,
        )

    def spring(self, start: Point, end: Point, width: float, **style: Any) -> None:
        """Draw a zigzag between two points."""
        share = np.linspace(0.0, 1.0, 18)
        away = np.array([0.0, 0.0, *np.tile([1.0, -1.0], 7), 0.0, 0.0]) * 0.5 * width
        across = np.array([end[1] - start[1], start[0] - end[0]])
        across = across / max(float(np.hypot(*across)), 1e-30)
        x = start[0] + share * (end[0] - start[0]) + away * across[0]
        z = start[1] + share * (end[1] - start[1]) + away * across[1]
        self.line(list(x), list(z), **style)
