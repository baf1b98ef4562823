"""Figures that support the verdicts: interpretations, regions, other solvers, meshes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullLocator

from chapters.fem_riser.claims import (
    BEAM,
    DURATION,
    LUMPED,
    PAPER_STEP,
    TOGETHER,
    claims,
    differences,
    grid_error,
)
from chapters.fem_riser.figures.shared import BLACK, HEIGHT, TIME
from riserstudy.figures.direct import label_ends, label_line, legible, spread
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    headline,
    key_below,
    legend_below,
    log_ticks,
    panel_title,
    panels,
)

viridis = colormaps["viridis"]
#: lines of the beam, and of lumped masses in front of it
WIDE: dict[str, Any] = {"color": COLOURS[5], "linewidth": 3.2}
DASHED: dict[str, Any] = {"color": "#003a5d", "linewidth": 1.2, "linestyle": (0, (4, 3))}
HEIGHT_OF_TEXT = 12.0  # points
GRID_TIME = 80.0  # s, duration of the runs of the grid test
#: possible meanings of the buoyant factor
READINGS = {
    "R1": "the share of the weight in air that the blocks carry",
    "R2": "the share of the weight in air that is left",
    "R3": "the share that is left; tension ratio of the weight without blocks",
    "R4": "the share that the blocks carry; tension ratio of the weight without blocks",
}


#: short statements of the claims of the region
STATED = (
    "B5: deflection is largest mid-riser",
    "B6: stress and angle peak near the ends",
    "B7: vibration is largest at 500 m",
    "B8: stress is largest at 500 m",
    "B9: deflection increases with length",
    "B10: angle increases with length",
)


def readings(reading_trends: xr.Dataset) -> Figure:
    """Deflection, stress and angle over the buoyant factor in its four interpretations."""
    figure, axes = panels(1, 3, 3.4)
    fields = (("deflection", 1.0, "largest deflection (m)"), ("stress", 1e-6, "largest stress (MPa)"),
              ("angle", np.rad2deg(1.0), "largest angle (°)"))  # fmt: skip
    for ax, (name, scale, quantity) in zip(axes, fields, strict=True):
        # Curves begin together in pairs: hollow marks of different shapes remain visible.
        for colour, reading, mark in zip(COLOURS, READINGS, "osD^", strict=False):
            curve = scale * reading_trends[f"{name}_by_factor"].sel(reading=reading)
            label = f"{reading}: {READINGS[reading]}"
            style: dict[str, Any] = {"color": colour, "lw": 1.2, "ms": 7.0, "mfc": "none", "mew": 1.3}
            ax.plot(curve["buoyant_factor"], curve, f"{mark}-", label=label, **style)
        panel_title(ax, name)
        ax.set_xlabel("buoyant factor")
        ax.set_ylabel(quantity)
        ax.set_yscale("log")  # makes small changes visible
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 1.5, 2.0, 3.0, 5.0, 7.0)))
        ax.yaxis.set_major_formatter("{x:g}")
        ax.yaxis.set_minor_locator(NullLocator())
    key_below(figure, axes[0], 1)
    raised = [
        reading
        for reading in READINGS
        if all(
            bool((reading_trends[f"{name}_by_factor"].sel(reading=reading).diff("buoyant_factor") > 0).all())
            for name, *_ in fields
        )
    ]
    all_three = "all three results increase, as claimed"
    headline(
        figure,
        f"Only with interpretation {raised[0]} do {all_three}"
        if len(raised) == 1
        else f"Interpretations with which {all_three}: {', '.join(raised) or 'none'}",
    )
    for ax in axes:
        label_ends(ax, names=list(READINGS))
        ax.margins(x=0.06)  # room for whole marks
        ax.set_xticks(reading_trends["buoyant_factor"].values)
    return figure


def region(map_trends: xr.Dataset, open_trends: xr.Dataset, change: float) -> Figure:
    """Where B5 to B10 hold together; ``change``: least relative change that is an increase or decrease."""
    figure, axes = panels(2, 2, 3.6)
    held = claims(map_trends, change)
    for ax, joints in zip(axes, map_trends["joints"].values, strict=False):
        here = held.sel(joints=joints)
        for tide in here["tide"].values:
            for wave in here["wave_height"].values:
                true = here.sel(tide=tide, wave_height=wave)
                every = bool(true.all())
                missed = [str(c) for c in TOGETHER if not bool(true.sel(claim=c))]
                ax.plot(tide, wave, "o" if every else "s", ms=17, mfc=COLOURS[2] if every else "0.9",
                        mec="none")  # fmt: skip
                ax.annotate("all" if every else "\n".join(missed), (tide, wave), ha="center",
                            va="center", fontsize="x-small", color="white" if every else "black")  # fmt: skip
        ax.margins(0.15)
        ax.set_xticks(here["tide"].values, [f"{tide:g}" for tide in here["tide"].values])
        ax.set_yticks(here["wave_height"].values)
        panel_title(ax, f"joint stiffness: {joints}")
        ax.set_xlabel("surface speed of the tide (m/s)")
        ax.set_ylabel("wave height (m)")
    shares = _shares(axes[3], claims(open_trends, change))
    marks: dict[str, Any] = {"ls": "none", "mec": "none", "ms": 9}
    key = {text: Line2D([], [], ls="none") for text in STATED}
    key["all six claims are true"] = Line2D([], [], marker="o", mfc=COLOURS[2], **marks)
    key["false claims"] = Line2D([], [], marker="s", mfc="0.9", **marks)
    legend_below(figure, [*key.values()], [*key], 3)
    headline(
        figure,
        f"The six claims are all true at {100 * float(held.all('claim').mean()):.0f} % of grid points, "
        f"{100 * shares['all six']:.0f} % of samples",
    )
    return figure


def _shares(ax: Axes, held: xr.DataArray) -> dict[str, float]:
    """Draw and return the share of the samples in which each claim and all six are true."""
    shares = {str(c): float(held.sel(claim=c).mean()) for c in TOGETHER}
    shares["all six"] = float(held.all("claim").mean())
    for k, (name, share) in enumerate(shares.items()):
        bar = ax.barh(k, 100.0 * share, color=COLOURS[2] if name == "all six" else COLOURS[0])
        ax.bar_label(bar, fmt="%.0f", fontsize="x-small", padding=2)
    ax.set_yticks(range(len(shares)), list(shares))
    ax.invert_yaxis()
    panel_title(ax, "samples of the unspecified inputs")
    ax.set_xlim(0, 112)
    ax.set_xlabel(f"share of {held.sizes['sample']} samples (%)")
    return shares


def solvers(small_deflection: xr.Dataset) -> Figure:
    """Difference of the two solvers over the deflection."""
    figure, (ax,) = panels()
    largest = abs(small_deflection["x"].sel(solver=BEAM)).max(("time", "s"))
    apart = differences(small_deflection)
    for colour, (name, label) in zip(
        COLOURS[1:], (("bending_moment", "bending moment"), ("x", "deflection")), strict=False
    ):
        ax.loglog(largest, 100.0 * apart[name], "o-", color=colour, label=label)
    ax.loglog(largest, 100.0 * float(apart["x"][-1]) * (largest / largest[-1]) ** 2, ":", color=GREY,
              label="square of the deflection")  # fmt: skip
    ax.set_xticks(largest.values, [f"{value:.2g}" for value in largest.values])
    ax.minorticks_off()
    panel_title(ax, "riser of the paper, 2000 m; one mark per tide")
    ax.set_xlabel("largest deflection (m)")
    ax.set_ylabel("difference / largest value (%)")
    ax.yaxis.set_major_formatter("{x:g}")
    few = largest.size == 2
    ax.margins(y=0.15 if few else 0.05)
    for line, side, end in zip(ax.lines, (5.0, 5.0, -5.0), (1.0, 1.0, 0.0), strict=True):
        label_line(ax, line, end if few else 0.5, (-side, side))
    far = {name: 100.0 * float(apart[name].max()) for name in ("x", "bending_moment")}
    headline(
        figure,
        f"Lumped masses and beam differ by up to {far['x']:.2g} % in deflection, "
        f"{far['bending_moment']:.0f} % in moment",
    )
    return figure


def grid_test(grid_test: xr.Dataset, own_setting: xr.Dataset) -> Figure:
    """Error over element length, and elapsed time of each run, by time step; the paper's own setting."""
    figure, (left, right) = panels(1, 2, 3.6)
    error = 100.0 * grid_error(grid_test)
    lengths = [float(str(element).split()[0]) for element in grid_test["element"].values]
    step = float(own_setting["time_step"].min())  # the paper's time step, or the nearest to it at this tier
    whole = float(own_setting["solve_seconds"].sel(time_step=step))
    length = float(own_setting["s_node"][1] - own_setting["s_node"][0])
    alike = f"{length:g} m"  # elements as long as the paper's
    steps = grid_test["time_step"].values
    least = float(error.sel(element=alike, time_step=steps.min()))  # the error that shorter steps leave
    _errors(left, error, lengths)
    left.annotate(
        f"paper's elements,\n{alike}: {least:.1f} %", (length, least), xytext=(24, -42), fontsize="small",
        textcoords="offset points", arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 6.0},
    )  # fmt: skip
    seconds = grid_test["solve_seconds"]
    _times(right, seconds, lengths)
    own = GRID_TIME / DURATION * whole
    row = lengths.index(length)
    right.plot([own], [row], color=BLACK, marker="*", ms=12, ls="none", label="the paper's time step")
    longer = own / float(seconds.sel(element=alike).max())
    words = f"time step {step:g} s\n(paper: {PAPER_STEP:g} s)"
    if np.isclose(step, PAPER_STEP):
        words = f"paper's time step, {step:g} s"
        words += f":\n{longer:.0f} times the longest\nother run of {alike}" if longer > 2.0 else ""
    right.annotate(words, (own, row), xytext=(4, 9), textcoords="offset points", ha="right", va="bottom",
                   fontsize="small")  # fmt: skip
    panel_title(left, "error of the beam, by time step")
    panel_title(right, "elapsed time on one computer, colours as in (a)")
    headline(figure, f"Elements of {alike}, as in the paper, have an error of {least:.1f} %")
    _name_starts(figure, left)
    return figure


def _of_steps(steps: np.ndarray) -> Iterator[tuple[float, dict[str, Any]]]:
    """Each time step with its style: nested marks, since time steps have little effect on the error."""
    colours, sizes = viridis(np.linspace(0.0, 0.75, len(steps))), np.linspace(10.0, 4.0, len(steps))
    for colour, size, step in zip(colours, sizes, steps, strict=True):
        yield float(step), {"color": colour, "ms": size, "mfc": "none", "mew": 1.3, "label": f"{step:g} s"}


def _errors(ax: Axes, error: xr.DataArray, lengths: list[float]) -> None:
    """Error over element length, one line per time step."""
    for step, style in _of_steps(error["time_step"].values):
        curve = error.sel(time_step=step)
        ax.loglog(lengths, curve.where(curve > 0.0), "o-", lw=0.3 * style["ms"], **style)
    ax.set_xlim(left=0.55 * min(lengths))  # room for names
    ax.set_xticks(lengths, [f"{length:g}" for length in lengths])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter("{x:g}")
    ax.set_xlabel("length of the elements (m)")
    ax.set_ylabel("error of deflection or moment,\nthe larger (%)")


def _times(ax: Axes, seconds: xr.DataArray, lengths: list[float]) -> None:
    """Elapsed time of each run, one row per element length; times scatter."""
    rows = range(len(lengths))
    for row, low, high in zip(rows, seconds.min("time_step"), seconds.max("time_step"), strict=True):
        ax.plot([low, high], [row, row], color="0.8", linewidth=1.5, zorder=1)
    for step, style in _of_steps(seconds["time_step"].values):
        ax.plot(seconds.sel(time_step=step), rows, ls="none", marker="o", **style)
    ax.set_yticks(rows, [f"{length:g}" for length in lengths])
    ax.set_ylabel("length of the elements (m)")
    ax.set_ylim(len(lengths) - 0.5, -0.5)
    ax.set_xscale("log")
    log_ticks(ax.xaxis)
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_xlabel(f"elapsed time of {GRID_TIME:g} simulated seconds (s)")


def _name_starts(figure: Figure, ax: Axes) -> None:
    """Write the time steps to the left of the first points of their lines, in the order of these points."""
    figure.draw_without_rendering()  # computes the layout of the panels
    starts = np.array([_at_least_x(line) for line in ax.lines])
    shortest = float(starts[:, 0].min())
    levels = 72.0 / figure.dpi * ax.transData.transform(starts)[:, 1]
    named = starts[:, 0] == shortest  # the finest run of all is the reference, without an error
    moved = np.copy(levels)
    moved[named] = spread(levels[named], np.full(int(named.sum()), HEIGHT_OF_TEXT))
    style: dict[str, Any] = {"textcoords": "offset points", "ha": "right", "fontsize": "small"}
    for line, start, place, level, away in zip(ax.lines, starts, moved, levels, ~named, strict=True):
        style["color"] = legible(line.get_color())
        if away:
            ax.annotate(f"{line.get_label()}: reference at {shortest:g} m", (1.0, 0.0), xytext=(-6.0, 6.0),
                        xycoords="axes fraction", **style)  # fmt: skip
        else:
            ax.annotate(str(line.get_label()), start, xytext=(-10.0, place - level), va="center", **style)


def _at_least_x(line: Line2D) -> tuple[float, float]:
    """The point of a line with the least x that it shows."""
    points = np.asarray(line.get_xydata(), float)
    x, y = min(points[np.isfinite(points).all(axis=1)].tolist())
    return x, y


def api2j(api2j: xr.Dataset, api2j_surge: xr.Dataset) -> Figure:
    """Envelopes of the API riser by both solvers, and over its surge; difference between the solvers."""
    figure, axes = panels(1, 3, 4.0)
    for ax, name, scale, label in (
        (axes[0], "x", 1.0, "displacement x (m)"),
        (axes[1], "bending_moment", 1e-3, "bending moment (kN m)"),
    ):
        over = ("surge_amplitude", "surge_phase")
        low, high = (
            scale * api2j_surge[f"{name}_min"].min(over),
            scale * api2j_surge[f"{name}_max"].max(over),
        )
        ax.fill_betweenx(
            api2j_surge["s_node"], low, high, color="0.88", linewidth=0,
            label="range over all assumed surges",
        )  # fmt: skip
        for solver, style in ((BEAM, WIDE), (LUMPED, DASHED)):
            run = api2j.sel(solver=solver)
            for side in ("min", "max"):
                word = f"smallest and largest, {solver}" if side == "min" else None
                ax.plot(scale * run[f"{name}_{side}"], run["s_node"], label=word, **style)
        ax.set_xlabel(label)
        ax.set_ylabel(HEIGHT)
    for ax, title in zip(axes, ("displacement", "bending moment", "largest difference"), strict=True):
        panel_title(ax, title)
    both = api2j[["x", "bending_moment"]]
    apart = abs(both.sel(solver=LUMPED) - both.sel(solver=BEAM)).max("s")
    largest = abs(both.sel(solver=BEAM)).max(("time", "s"))
    for colour, (name, label) in zip(
        COLOURS[1:], (("bending_moment", "moment"), ("x", "displacement")), strict=False
    ):
        axes[2].plot(apart["time"], 100.0 * apart[name] / largest[name], color=colour, label=label)
    axes[2].set_xlabel(TIME)
    axes[2].set_ylabel("difference / largest value (%)")
    axes[2].set_ylim(0.0, 1.15 * axes[2].get_ylim()[1])
    key_below(figure, axes[0], 3)
    headline(
        figure,
        "Lumped masses and beam agree to "
        f"{float((apart['bending_moment'] / largest['bending_moment']).max()):.2%} of the moment, "
        f"{float((apart['x'] / largest['x']).max()):.2%} of the displacement".replace("%", " %"),
    )
    for line in axes[2].lines:
        values = np.asarray(line.get_ydata())
        label_line(axes[2], line, float(values.argmax()) / (values.size - 1), (4.0, 3.0))
    return figure
