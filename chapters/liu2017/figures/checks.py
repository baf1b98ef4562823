"""Basis of the verdicts: calibration, coupling, unspecified inputs."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties

from chapters.liu2017.figures.shared import (
    BEGINNING,
    OF_HEADING,
    REFERENCE,
    TIME,
    UFJ_LIMIT,
    set_title,
    viridis,
)
from riserstudy.figures.direct import label_line, legible
from riserstudy.figures.style import PRINTED, legend_below, panel_title, panels

DEGREES = 180.0 / np.pi
PASSED = 0.03  # °: a larger drop means that an angle is past its maximum, by half a second
ITERATED = "iterated"  # exchange until platform and riser agree
AS_ONE = "as one"  # platform and riser are solved together


def calibration(calibration: xr.Dataset, deadline: float) -> Figure:
    """Gains and hull drags that give the published number, for three weights of the riser.

    If the angle still increases at the published time, it reaches its largest value so far for the first
    time. If it has passed its largest value, 12° are reached earlier or never, and no line is drawn.
    """
    figure, (ax,) = panels(height=3.8)
    upper: list[tuple[float, float]] = []  # ends of lines: gain, hull drag
    pairs = 0  # points on the lines
    weights = sorted(calibration["riser_weight"].values, key=lambda name: float(_first(name)))
    for colour, weight in zip(viridis(np.linspace(0.0, 0.8, len(weights))), weights, strict=True):
        run = calibration.sel(riser_weight=weight).transpose("hull_drag", "gain") * DEGREES
        largest = run["ufj_angle_absmax"]
        style: dict[str, Any] = {"levels": [UFJ_LIMIT], "colors": [colour]}
        still_rising = largest - run["ufj_angle"].values < PASSED
        met = ax.contour(run["gain"], run["hull_drag"], largest.where(still_rising), **style)
        met.set_label(f"riser's weight in water: {weight}")
        gain, drag = max((tuple(end) for line in met.allsegs[0] for end in line), default=(0.0, 0.0))
        pairs += sum(len(line) for line in met.allsegs[0])
        ax.annotate(
            str(weight), (gain, drag), xytext=(5, 0), textcoords="offset points", va="center",
            color=legible(colour), fontsize="small",
        )  # fmt: skip
        if drag > 0.0:
            upper.append((gain, drag))
    fit = [calibration.attrs["gain"]], [calibration.attrs["hull_drag"]]
    name = f"fit that is used: {calibration.attrs['riser_weight']:g} N/m, in the wave (lines: calm sea)"
    (used,) = ax.plot(*fit, "*", color="black", ms=12, label=name)
    ax.legend(handles=[used], loc="lower right", fontsize="small")
    if upper:
        gains = [gain for gain, _ in upper]
        last = " to ".join(dict.fromkeys(f"{gain:.0f}" for gain in (min(gains), max(gains))))
        ax.annotate(
            f"the lines end at {last} kN/m: for larger\n"
            f"gains the angle passes its largest value before {deadline:g} s", (0.02, 0.97),
            xycoords="axes fraction", va="top", fontsize="small",
        )  # fmt: skip
        ax.annotate(
            "riser's weight\nin water:", max(upper, key=lambda end: end[1]), xytext=(5, 12),
            textcoords="offset points", fontsize="small",
        )  # fmt: skip
        ax.set_xlim(float(calibration["gain"].min()), 1.1 * max(gains))
        ax.set_ylim(float(calibration["hull_drag"].min()), 1.2 * max(drag for _, drag in upper))
    ax.set_xlabel("thrusters' gain (kN/m)")
    ax.set_ylabel("hull drag (kN s²/m²)")
    set_title(figure, f"{_how_many(pairs)} of gain and hull drag give the printed 12° at {deadline:g} s")
    return figure


def _how_many(pairs: int) -> str:
    """Number of pairs in words; a line has two points or more, and a pair at each place along it."""
    return "Many pairs" if pairs > 1 else "No simulated pair"


def _first(weight: str) -> str:
    """Return the number of a weight as text; "none" is zero."""
    return "0" if weight == "none" else weight.split()[0]


def coupling(coupling: xr.Dataset) -> Figure:
    """Effect of solving platform and riser alternately, and the number of iterations of the riser."""
    figure, axes = panels(1, 3, 3.8)
    one, turns = coupling.sel(exchange=AS_ONE), coupling.drop_sel(exchange=AS_ONE)
    ways = [str(way) for way in turns["exchange"].values]
    staggered = [way for way in ways if not way.startswith(ITERATED)]
    shade = dict(zip(staggered, viridis(np.linspace(0.2, 0.85, len(staggered))), strict=True))
    shades = [shade.get(way, "black") for way in ways]
    off = abs(turns[["platform_surge", "ufj_angle"]] - one)
    for ax, name, factor, least, title in (
        (axes[0], "platform_surge", 1e3, 1e-3, "surge (mm)"),
        (axes[1], "ufj_angle", DEGREES, 1e-6, "angle (°)"),
    ):
        for colour, way in zip(shades, ways, strict=True):
            so_far = np.maximum.accumulate(factor * off[name].sel(exchange=way).values)
            rises = np.where(so_far > 0.0, so_far, np.nan)  # a logarithmic axis has no zero
            ax.semilogy(off["time"], rises, color=colour, label=way)
        ax.set_ylim(bottom=least)
        ax.set_xlabel(TIME)
        ax.set_ylabel(f"difference in {title}")
    panel_title(axes[0], "surge, largest difference so far")
    panel_title(axes[1], "upper flex joint angle, largest so far")
    panel_title(axes[2], "Newton iterations")
    iterations = turns["newton_iterations"] / one["newton_iterations"]
    rows = [way.replace(", ", ",\n") for way in ways]
    bars = axes[2].barh(rows, iterations, color=shades)
    axes[2].bar_label(bars, fmt="%.2f", padding=3, fontsize="small")
    axes[2].set_xlim(right=1.3 * float(iterations.max()))  # room for the numbers
    same = axes[2].axvline(1.0, zorder=3, **REFERENCE)
    axes[2].invert_yaxis()
    axes[2].set_xlabel("ratio of iterations\nto one system")
    key: dict[str, Any] = {str(line.get_label()): line for line in axes[0].lines}
    key["(c) one system"] = same
    apart = off["platform_surge"].max("time")
    ends = [
        f"{_millimetres(float(end))} ({str(end['exchange'].item()).partition(',')[0]})"
        for end in (apart[apart.argmin("exchange")], apart[apart.argmax("exchange")])
    ]
    set_title(figure, f"Solving alternately shifts the platform by {ends[0]} to {ends[1]}")
    legend_below(figure, [*key.values()], [*key], 3)
    (legend,) = figure.legends
    legend.set_title("(a–c) scheme, exchange interval", FontProperties(size="small"))
    return figure


def _millimetres(length: float) -> str:
    """Format a length (m) in mm, with two digits if small, and without a power of ten."""
    return f"{1e3 * length:.2g} mm" if length < 0.01 else f"{1e3 * length:.0f} mm"


def open_choices(open_drive_off: xr.Dataset, deadline: float) -> Figure:
    """Upper flex joint angle over samples of unspecified inputs, and times at which it reaches its limit."""
    figure, axes = panels(1, 2, 3.6)
    parts: list[str] = []
    angle = abs(open_drive_off["ufj_angle"]).sel(time=slice(0.0, BEGINNING)) * DEGREES
    limits = open_drive_off["limit_time"].sel(limit="upper flex joint")
    # The histogram ends at the last time at which a sample reaches the limit, or at the published time.
    latest = max(deadline, *limits.values[np.isfinite(limits.values)].tolist())
    bins = np.arange(20.0, latest + 5.0, 5.0).tolist()
    key: dict[str, Any] = {}
    for (label, colour), heading in zip(OF_HEADING.items(), ("along", "against"), strict=True):
        run = angle.sel(heading=heading)
        low, middle, high = (run.quantile(q, "sample") for q in (0.05, 0.5, 0.95))
        style: dict[str, Any] = {"color": colour, "alpha": 0.2, "linewidth": 0.0}
        band = axes[0].fill_between(run["time"], low, high, **style)
        for edge in (low, high):
            axes[0].plot(run["time"], edge, color=colour, linewidth=0.8, label="_")
        (line,) = axes[0].plot(run["time"], middle, color=colour)
        key[label] = (band, line)
        times = limits.sel(heading=heading).where(run.notnull().any("time"))  # "never" is known
        parts.append(_share_reached(times, heading))
        reached = times.values[np.isfinite(times.values)]
        width = 3.0 if heading == "along" else 1.3  # equal counts stay visible
        axes[1].hist(reached, bins, color=colour, histtype="step", linewidth=width)
    (dot,) = axes[0].plot([deadline], [UFJ_LIMIT], "o", color="black")
    for ax in axes:
        upright = ax.axvline(deadline, **PRINTED)
    key[f"printed for 0° (along): {UFJ_LIMIT:g}° at {deadline:g} s"] = (upright, dot)
    then = angle.sel(heading="along").interp(time=deadline)
    least, most = (float(then.quantile(q)) for q in (0.05, 0.95))
    for end in (least, most):
        colour = OF_HEADING["0° (along)"]
        (tick,) = axes[0].plot([deadline], [end], "_", color=colour, ms=14, mew=2.0, label="_")
        label_line(axes[0], tick, 0.0, (8.0, 0.0), name=f"{end:.0f}°")
    set_title(
        figure, f"At the printed time, most samples along the environment give {least:.0f}° to {most:.0f}°"
    )
    panel_title(axes[0], "median and band of 90 % of the samples")
    axes[0].set_xlabel(TIME)
    axes[0].set_ylabel("upper flex joint angle (°)")
    axes[1].set_xlabel("time to an angle of 12° (s)")
    axes[1].set_ylabel(f"number of samples (of {limits.sizes['sample']})")
    panel_title(axes[1], f"12° reached in {', '.join(parts)}")
    legend_below(figure, [*key.values()], [*key], 3)
    return figure


def _share_reached(times: xr.DataArray, label: str) -> str:
    """Share of samples that reach a limit (infinite time: never); missing values are counted separately."""
    unknown = int(times.isnull().sum())
    share = f"{100.0 * float(np.isfinite(times).sum()) / times.size:.0f} %"
    return f"{share} ({label}{f', {unknown} without a value' if unknown else ''})"
