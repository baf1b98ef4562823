"""Drawings of the theory and conventions pages: segments, flow across a pipe, a tensioner, signs."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Rectangle

from riserstudy.figures.style import COLOURS, GREY

BLUE, ORANGE, GREEN = COLOURS[:3]
Point = tuple[float, float]


def drawings() -> dict[str, Figure]:
    """Return every drawing by the name of its file."""
    return {
        "theory_segments": segments(),
        "theory_flow": flow(),
        "theory_tensioner": tensioner(),
        "conventions": conventions(),
    }


def _empty(figure: Figure, width: float, height: float, places: int = 1) -> list[Axes]:
    """Make panels without axes, with equal scales in both directions."""
    axes = list(figure.subplots(1, places, squeeze=False).flat)
    for ax in axes:
        ax.set(xlim=(0.0, width), ylim=(-0.2, height + 0.5), aspect="equal")
        ax.axis("off")
    return axes


def _arrow(ax: Axes, start: Point, end: Point, colour: str, label: str = "") -> None:
    ax.annotate(
        "", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.6, "shrinkA": 0,
        "shrinkB": 0},
    )  # fmt: skip
    if label:
        ax.annotate(label, end, (5, 3), textcoords="offset points", color=colour)


def conventions() -> Figure:
    """A riser whose top is displaced along +x, with axes, arclength, angles and end forces."""
    figure = Figure((6.4, 4.9), layout="constrained")
    (ax,) = _empty(figure, 9.0, 6.6)
    z = np.linspace(0.0, 5.0, 60)
    x = 2.2 + 2.6 * (0.62 * z / 5.0 + 0.38 * np.sin(0.5 * np.pi * z / 5.0))
    ax.plot(x, z + 0.5, color="black", lw=3)
    ax.add_patch(Rectangle((1.75, -0.1), 0.9, 0.6, color="0.7"))
    ax.plot([0.3, 8.6], [0.5, 0.5], color=GREY, lw=0.8)
    ax.plot([0.3, 8.6], [5.3, 5.3], color=BLUE, lw=0.8)
    ax.text(8.6, 5.36, "surface", color=BLUE, ha="right", fontsize="small")
    ax.text(8.6, 0.56, "seabed", color="0.4", ha="right", fontsize="small")
    for k, name in ((0, "LFJ"), (-1, "UFJ")):
        at = (float(x[k]), float(z[k] + 0.5))
        up = 1.3 if k == 0 else -1.3
        ax.plot([at[0], at[0]], [at[1], at[1] + up], ":", color=GREY)
        ax.annotate(
            f"{name} angle > 0", at, (14, 8 if k == 0 else -22), textcoords="offset points", color=ORANGE
        )
    along = np.array((x[-1] - x[-4], z[-1] - z[-4]))
    along /= np.hypot(*along)
    top = np.array((x[-1], z[-1] + 0.5))
    _arrow(ax, tuple(top), tuple(top + 0.95 * along), GREEN, "$T_e > 0$")
    middle = (float(x[25]), float(z[25] + 0.5))
    ax.annotate("$s$, from the lower end", middle, (-128, 0), textcoords="offset points")
    ax.annotate(
        "$M < 0$: leans less\nwith increasing $s$", middle, (22, -16), textcoords="offset points",
        color=BLUE, fontsize="small",
    )  # fmt: skip
    _arrow(ax, (6.4, 1.4), (7.6, 1.4), "black", "$+x$")
    _arrow(ax, (6.4, 1.4), (6.4, 2.6), "black", "$+z$")
    _arrow(ax, (2.2, 5.75), (4.7, 5.75), "black")
    ax.text(2.2, 5.9, "offset > 0")
    return figure


def segments() -> Figure:
    """Nodes and segments with angles and moments, and the free-body diagram of a segment."""
    figure = Figure((8.4, 4.9), layout="constrained")
    left, right = _empty(figure, 6.0, 6.4, 2)
    nodes = np.array([(1.6, 0.5), (2.1, 2.4), (3.1, 4.2), (4.6, 5.7)])
    left.plot(*nodes.T, "-o", color="black", lw=2.2, ms=7)
    for k, name in enumerate(("i-1", "i", "i+1", "i+2")):
        left.annotate(f"$r_{{{name}}},\\ M_{{{name}}}$", nodes[k], (14, -6), textcoords="offset points")
    for k, name in enumerate(("i-1", "i")):
        low, up = nodes[k], nodes[k + 1]
        lean = np.degrees(np.arctan2(*(up - low)))
        left.plot([low[0], low[0]], [low[1], low[1] + 1.5], ":", color=GREY)
        left.add_patch(Arc(tuple(low), 2.2, 2.2, theta1=90 - lean, theta2=90, color=BLUE, lw=1.5))
        side = low + np.array((-0.15, 1.2))
        left.text(side[0], side[1], f"$\\alpha_{{{name}}}$", color=BLUE, ha="right")
        left.annotate(f"$\\ell_{{{name}}}$", (low + 3 * up) / 4, (7, -8), textcoords="offset points")
    left.text(3.0, 6.5, "(a) nodes, segments, angles from the vertical", ha="center")

    low, up = np.array((1.8, 1.3)), np.array((3.6, 4.6))
    along = (up - low) / np.hypot(*(up - low))
    across = np.array((along[1], -along[0]))
    right.plot(*np.array((low, up)).T, "-", color="black", lw=4)
    _arrow(right, tuple(up), tuple(up + 1.1 * along), GREEN, "$T_e$")
    _arrow(right, tuple(low), tuple(low - 1.1 * along), GREEN, "$T_e$")
    _arrow(right, tuple(up), tuple(up + 1.1 * across), ORANGE, "$Q_e$")
    _arrow(right, tuple(low), tuple(low - 1.1 * across), ORANGE, "$Q_e$")
    for place, name, turn in ((up, "e+1", 1), (low, "e", -1)):
        _moment(right, place, turn)
        away = (-62, 4) if turn > 0 else (-40, -22)
        point = (place[0], place[1])
        right.annotate(f"$M_{{{name}}}$", point, away, textcoords="offset points", color=BLUE)
    right.text(3.0, 6.5, "(b) a segment cut free", ha="center")
    return figure


def _moment(ax: Axes, place: np.ndarray, turn: int) -> None:
    angle = np.radians(np.linspace(130, 230, 40))
    x, y = place[0] + 0.55 * np.cos(angle), place[1] + 0.55 * np.sin(angle)
    ax.plot(x, y, color=BLUE, lw=1.6)
    ends = ((x[-2], y[-2]), (x[-1], y[-1])) if turn < 0 else ((x[1], y[1]), (x[0], y[0]))
    ax.annotate("", ends[1], ends[0], arrowprops={"arrowstyle": "-|>", "color": BLUE, "lw": 1.6})


def flow() -> Figure:
    """Relative velocity of the water, split along and across an inclined segment."""
    figure = Figure((5.6, 3.6), layout="constrained")
    (ax,) = _empty(figure, 8.6, 5.4)
    low, up = np.array((1.4, 0.3)), np.array((3.8, 5.1))
    along = (up - low) / np.hypot(*(up - low))
    ax.plot(*np.array((low, up)).T, color="0.75", lw=14, solid_capstyle="butt")
    _arrow(ax, tuple(low + 0.3 * along), tuple(low + 1.4 * along), "black", "$t$")
    middle = (low + up) / 2
    flow = np.array((4.4, 0.0))
    part = float(flow @ along) * along
    _arrow(ax, tuple(middle), tuple(middle + flow), BLUE, "$u - \\dot r$")
    _arrow(ax, tuple(middle), tuple(middle + part), GREEN, "$u_t$: drag on the circumference")
    normal = flow - part
    _arrow(ax, tuple(middle), tuple(middle + normal), ORANGE, "$u_n$: Morison's drag")
    ax.plot(*np.array((middle + part, middle + flow, middle + normal)).T, ":", color=GREY)
    return figure


def tensioner() -> Figure:
    """A gas cylinder: its dimensions, and its pull compared with the tangent, and with an end stop."""
    figure = Figure((8.4, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.6))
    left.set(xlim=(0.0, 4.4), ylim=(0.0, 6.6), aspect="equal")
    left.axis("off")
    left.add_patch(Rectangle((0.3, 5.8), 3.4, 0.5, color="0.8"))
    left.text(2.0, 6.05, "platform", ha="center", va="center", fontsize="small")
    left.add_patch(Rectangle((1.5, 2.9), 1.0, 2.9, fill=False, lw=1.6, zorder=3))
    left.add_patch(Rectangle((1.5, 2.9), 1.0, 1.3, color="#cfe3f2"))
    left.text(2.65, 3.5, "gas: $P_0,\\ V_0$\nat mid-stroke", color=BLUE, va="center", fontsize="small")
    left.plot([1.5, 2.5], [4.25, 4.25], color="black", lw=5)
    left.text(2.65, 4.3, "piston, area $A$", va="center", fontsize="small")
    left.plot([2.0, 2.0], [4.25, 0.9], color="black", lw=2.2)
    left.plot([1.0, 3.0], [0.9, 0.9], color="black", lw=5)
    left.text(3.1, 0.9, "tension ring", va="center", fontsize="small")
    _arrow(left, (0.8, 2.4), (0.8, 1.2), ORANGE)
    left.text(0.65, 1.8, "$x$", color=ORANGE, ha="right", va="center")
    left.set_title("(a) one cylinder", fontsize="medium")

    x = np.linspace(-6.0, 6.0, 200)
    pull = (1.0 / (1.0 - 0.06 * x)) ** 1.1  # A / V0 = 0.06 1/m, k = 1.1: for the drawing only
    right.plot(x, pull, color=BLUE, label="gas law (12)")
    right.plot(x, 1.0 + 1.1 * 0.06 * x, "--", color=ORANGE, label="its tangent at mid-stroke")
    right.axvspan(5.0, 6.0, color="0.88")
    right.text(5.5, 0.62, "end stop", ha="center", rotation=90, va="bottom", fontsize="small")
    right.set(xlabel="extension from mid-stroke $x$ (m)", ylabel="pull over pull at mid-stroke (-)")
    right.legend(fontsize="small")
    right.grid(True, color="0.9", linewidth=0.6)
    right.set_title("(b) its pull: stiffer the longer it is", fontsize="medium")
    return figure
