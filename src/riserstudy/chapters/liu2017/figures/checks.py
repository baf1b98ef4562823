"""What the verdicts rest on: calibration, coupling, unspecified inputs."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from riserstudy.chapters.liu2017.figures.shared import SHOWN, TIME, UFJ_LIMIT, set_title
from riserstudy.figures.direct import legible
from riserstudy.figures.style import COLOURS, PRINTED, key_below, panel_title, panels

DEGREES = 180.0 / np.pi
PASSED = 0.03  # deg, by which an angle is past its largest: half a second after it
AS_ONE = "as one"  # of platform and riser


def calibration(calibration: xr.Dataset, deadline: float) -> Figure:
    """Gains and hull drags that meet the printed number, for three weights of the riser.

    While the angle still rises then, its largest value so far is reached for the first time; where it has
    passed its largest value, 12 degrees are reached before or never, and no line is drawn.
    """
    figure, (ax,) = panels(height=3.8)
    top = 0.0
    for colour, weight in zip(COLOURS, calibration["riser_weight"].values, strict=False):
        run = calibration.sel(riser_weight=weight).transpose("hull_drag", "gain") * DEGREES
        largest = run["ufj_angle_absmax"]
        style: dict[str, Any] = {"levels": [UFJ_LIMIT], "colors": [colour]}
        still_rising = largest - run["ufj_angle"].values < PASSED
        met = ax.contour(run["gain"], run["hull_drag"], largest.where(still_rising), **style)
        gain, drag = max(
            (tuple(end) for line in met.allsegs[0] for end in line), default=(0.0, 0.0)
        )
        ax.annotate(
            str(weight), (gain, drag), xytext=(5, 0), textcoords="offset points", va="center",
            color=legible(colour), fontsize="small",
        )  # fmt: skip
        top = max(top, drag)
    fit = [calibration.attrs["gain"]], [calibration.attrs["hull_drag"]]
    (used,) = ax.plot(*fit, "o", color="black", label="fit that is used, with the wave")
    ax.legend(handles=[used], loc="lower right", fontsize="small")
    ax.annotate(
        "beyond the lines' upper ends\n12° are reached earlier, or never", (0.02, 0.97),
        xycoords="axes fraction", va="top", fontsize="small",
    )  # fmt: skip
    ax.annotate(
        "by the riser's weight\nin water", (0.99, 0.97), xycoords="axes fraction", ha="right", va="top",
        fontsize="small",
    )  # fmt: skip
    ax.set_xlabel("thrusters' gain (kN/m)")
    ax.set_ylabel("hull drag (kN s²/m²)")
    ax.set_xlim(float(calibration["gain"].min()), 85.0)
    ax.set_ylim(float(calibration["hull_drag"].min()), 1.2 * top if top else None)
    set_title(
        figure,
        f"Many pairs of gain and hull drag give the printed 12° at {deadline:g} s",
    )
    return figure


def coupling(coupling: xr.Dataset) -> Figure:
    """What solving platform and riser in turns changes, and the riser's iterations and time that it takes."""
    figure, axes = panels(1, 3, 3.6)
    one, turns = coupling.sel(exchange=AS_ONE), coupling.drop_sel(exchange=AS_ONE)
    ways = [str(way) for way in turns["exchange"].values]
    off = abs(turns[["platform_surge", "ufj_angle"]] - one)
    for colour, way in zip(COLOURS, ways, strict=False):
        here = off.sel(exchange=way)
        most = float(here["platform_surge"].max())
        label = f"{way} (surge: at most {_millimetres(most)})"
        axes[0].plot(here["time"], here["platform_surge"], color=colour, label=label)
        axes[1].plot(here["time"], here["ufj_angle"] * DEGREES, color=colour)
    for ax, title in zip(axes, ("surge (m)", "UFJ angle (°)"), strict=False):
        ax.set_ylim(bottom=-0.03 * ax.get_ylim()[1])  # so that what is zero is seen
        ax.set_xlabel(TIME)
        ax.set_ylabel(f"difference in {title}")
    cost = turns[["newton_iterations", "solve_seconds"]] / one
    axes[2].barh(ways, cost["newton_iterations"], color=COLOURS[: len(ways)], alpha=0.6)
    axes[2].plot(cost["solve_seconds"], ways, "o", color="black")
    axes[2].axvline(1.0, **PRINTED)
    axes[2].invert_yaxis()
    axes[2].set_xlabel("cost / cost as one")
    panel_title(axes[2], "bars: iterations, dots: time")
    apart = off["platform_surge"].max("time")
    ends = [
        f"{_millimetres(float(end))} ({str(end['exchange'].item()).partition(',')[0]})"
        for end in (apart[apart.argmin("exchange")], apart[apart.argmax("exchange")])
    ]
    set_title(figure, f"Solving in turns shifts the platform by {ends[0]} to {ends[1]}")
    key_below(figure, axes[0], 2)
    return figure


def _millimetres(length: float) -> str:
    """A length (m) in mm, to two digits and without a power of ten."""
    return f"{1e3 * length:.2g} mm" if length < 0.01 else f"{1e3 * length:.0f} mm"


def open_choices(open_drive_off: xr.Dataset, deadline: float) -> Figure:
    """Upper flex joint over what is open, and when the first limits are reached."""
    figure, axes = panels(1, 2, 3.6)
    parts: list[str] = []
    angle = abs(open_drive_off["ufj_angle"]).sel(time=slice(0.0, SHOWN)) * DEGREES
    limits = open_drive_off["limit_time"].sel(limit="upper flex joint")
    latest = float(limits.where(np.isfinite(limits)).max().fillna(deadline))
    bins = np.arange(20.0, max(latest, deadline) + 5.0, 5.0).tolist()
    for colour, (heading, label) in zip(
        COLOURS, (("along", "0°"), ("against", "180°")), strict=False
    ):
        run = angle.sel(heading=heading)
        low, middle, high = (run.quantile(q, "sample") for q in (0.05, 0.5, 0.95))
        axes[0].fill_between(run["time"], low, high, color=colour, alpha=0.2, linewidth=0.0)
        axes[0].plot(run["time"], middle, color=colour, label=f"{label}: median, 90 % of samples")
        times = open_drive_off["limit_time"].sel(heading=heading, limit="upper flex joint")
        reached = times.values[np.isfinite(times.values)]
        parts.append(f"{100 * len(reached) / times.size:.0f} % ({label})")
        axes[1].hist(reached, bins, color=colour, histtype="step", linewidth=1.8, label=label)
    axes[0].plot([deadline], [UFJ_LIMIT], "o", color="black", label="printed, at 0°")
    axes[1].axvline(deadline, label="printed, at 0°", **PRINTED)
    then = angle.sel(heading="along").interp(time=deadline)
    least, most = (float(then.quantile(q)) for q in (0.05, 0.95))
    set_title(
        figure,
        f"At the published time UFJ angles in the blue band are {least:.0f}° to {most:.0f}°",
    )
    axes[0].set_xlabel(TIME)
    axes[0].set_ylabel("upper flex joint angle (°)")
    axes[1].set_xlabel("time to an angle of 12° (s)")
    axes[1].set_ylabel("number of samples")
    panel_title(axes[1], f"12° reached in {', '.join(parts)}")
    key_below(figure, axes[0], 3)
    return figure
