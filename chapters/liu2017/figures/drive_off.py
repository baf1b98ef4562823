"""Surge, speed, angles and stroke of a drive-off over time."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from chapters.liu2017.figures.shared import (
    BEGINNING,
    HEADINGS,
    OF_HEADING,
    STROKE_OUT,
    SURGE,
    TIME,
    UFJ_LIMIT,
    draw_limits,
    mark_both,
    mark_stroke_out,
    name_limits,
    set_title,
    viridis,
)
from chapters.liu2017.limits import LIMITS, reached, shares
from riserstudy.dataset.crossing import first_crossing, first_limit
from riserstudy.figures.direct import label_ends, label_line, legible, named
from riserstudy.figures.style import COLOURS, GREY, PRINTED, legend_below, panel_title, panels

SETS = {"ref": "unlimited thrust", "sat": "thrust limited to 4.5 MN"}
EARLY = 20.0  # s, one of `TIMES`: the top has moved, the bottom hardly
HARDLY = 0.02  # share of the displacement of the top
TIMES = (10.0, 20.0, 30.0, 40.0, 50.0, 60.0)  # s, of Fig 5
PIPE = "riser, 386 MPa\n(assumed)"
LOW = 218.0  # m above the conductor's foot, a tenth up the riser
FORCE_AT_LIMIT = -3.02 * np.sin(np.deg2rad(UFJ_LIMIT))  # MN, which Fig 6 implies


def fig04(driveoff: xr.Dataset) -> Figure:
    """Surge and speed over time, with and without riser, for both sets of inputs."""
    figure, axes = panels(2, 2, 3.2, sharex=True)
    beginning = driveoff.sel(time=slice(0.0, BEGINNING))
    for column, (kind, title) in enumerate(SETS.items()):
        for heading, label in HEADINGS.items():
            for ending, line, word in (("", "-", "with"), ("_no_riser", "--", "without")):
                run = beginning.sel(case=f"{kind}_{heading}{ending}")
                for ax, name in ((axes[column], "platform_surge"), (axes[2 + column], "platform_speed_x")):
                    style: dict[str, Any] = {"linestyle": line, "color": OF_HEADING[label]}
                    before = _until_the_stop(ax, run, name, 1.0)
                    text = f"{label}, {word} riser"
                    ax.plot(before["time"], before[name], label=text, **style)
                    after = run.sel(time=slice(float(before["time"][-1]), None))
                    ax.plot(after["time"], after[name], linewidth=0.8, label="_", **style)
        axes[column].axhline(100.0, color=GREY, linewidth=0.9)
        axes[column].annotate(
            "false position,\n100 m (printed)", (0.0, 100.0), xytext=(0, -3), fontsize="small",
            textcoords="offset points", color="0.3", va="top",
        )  # fmt: skip
        panel_title(axes[column], f"surge, {title}")
        panel_title(axes[2 + column], f"speed, {title}")
        axes[2 + column].set_xlabel(TIME)
    later = [_mark_arrivals(ax, driveoff, kind) for ax, kind in zip(axes, SETS, strict=False)]
    set_title(figure, _who_arrives_later(later))
    for row in (axes[:2], axes[2:]):
        ends = [end for ax in row for end in ax.get_ylim()]
        for ax in row:
            ax.set_ylim(min(ends), max(ends))
    axes[0].set_ylabel(SURGE)
    axes[2].set_ylabel("speed of the platform (m/s)")
    names = [f"{way}, {riser} riser" for way in ("along", "against") for riser in ("with", "no")]
    out = [line for line in axes[0].lines if line.get_label() == STROKE_OUT]
    if out:
        legend_below(figure, out, [f"{STROKE_OUT}; lines are thin afterwards"], 1)
    lines = [line for line in named(axes[1]) if line.get_label() != STROKE_OUT]
    label_ends(axes[1], lines, names=names)
    return figure


def _mark_arrivals(ax: Axes, driveoff: xr.Dataset, kind: str) -> float:
    """Mark arrival of the platform with riser at the false position; return the delay (s) of "against"."""
    times = []
    for (heading, label), across in zip(HEADINGS.items(), ("right", "left"), strict=True):
        surge = driveoff["platform_surge"].sel(case=f"{kind}_{heading}")
        times.append(float(first_crossing(surge, 100.0)))
        if not np.isfinite(times[-1]):
            continue
        colour = OF_HEADING[label]
        ax.plot([times[-1]], [100.0], "o", color=colour, mec="white", ms=6, zorder=5, label="_")
        ax.annotate(
            f"{times[-1]:.1f} s", (times[-1], 100.0), ha=across, va="bottom" if across == "right" else "top",
            xytext=(-4.0, 3.0) if across == "right" else (4.0, -3.0), textcoords="offset points",
            fontsize="small", color=legible(colour),
        )  # fmt: skip
    return times[1] - times[0]


def _who_arrives_later(later: list[float]) -> str:
    """Title: delays (s) of the platform against the environment; not finite if it never arrives somewhere."""
    if not np.isfinite(later).all():
        return "The platform does not reach the false position in every drive-off"
    if min(later) <= 0.0:
        return "Against the environment the platform does not always reach the false position later"
    return f"Against the environment the platform reaches the false position {_range(later)} s later"


def _range(values: list[float]) -> str:
    """Format the range of values in whole numbers."""
    low, high = round(min(values)), round(max(values))
    return f"{low}" if low == high else f"{low} to {high}"


def fig05(ref_0: xr.Dataset, ref_180: xr.Dataset) -> Figure:
    """Shapes of the riser; the panel against the environment is mirrored, so that both have one x scale."""
    figure, axes = panels(1, 2, 4.2, sharey=True)
    farthest = max(float(run["x"].sel(time=list(TIMES)).max()) for run in (ref_0, ref_180))
    for ax, run, sign, label in zip(axes, (ref_0, ref_180), (1.0, -1.0), HEADINGS.values(), strict=True):
        rest = run.isel(time=0)
        (still,) = ax.plot(sign * rest["x"], rest["z"], "--", color=GREY, label="0 s")
        label_line(ax, still, 1.0, (-6.0 * sign, 3.0))
        for colour, time in zip(viridis(np.linspace(0.0, 0.9, len(TIMES))), TIMES, strict=True):
            shape = run.sel(time=time)
            (line,) = ax.plot(sign * shape["x"], shape["z"], color=colour, label=f"{time:g} s")
            label_line(ax, line, 1.0, (0.0, 3.0))
        ax.set_xlim(*sorted((-0.12 * sign * farthest, 1.08 * sign * farthest)))  # one scale
        ax.set_ylim(top=1.07 * float(rest["z"].max()))  # room for the times
        ax.set_xlabel("lateral displacement (m)")
        panel_title(ax, label)
    early = ref_0.sel(time=EARLY)
    after = abs(early["x"] - ref_0["x"].isel(time=0))
    ends = [after.sel(s=LOW, method="nearest"), after.isel(s=-1)]
    then = next(line for line in axes[0].lines if line.get_label() == f"{EARLY:g} s")
    for moved in ends:
        there = early.sel(s=moved["s"])
        axes[0].plot(
            there["x"], there["z"], "o", color=then.get_color(), mfc="white", ms=6, zorder=4, label="_"
        )
        up = moved is ends[1]
        axes[0].annotate(
            f"{float(moved):.0f} m" if up else f"{float(moved):.1f} m", (there["x"], there["z"]),
            xytext=(-2.0, -17.0) if up else (-5.0, 0.0), textcoords="offset points",
            ha="left" if up else "right", va="center", fontsize="x-small",
        )  # fmt: skip
    low, high = (float(moved) for moved in ends)
    axes[0].annotate(
        f"circles: after {EARLY:g} s,\nwith the distance moved,\n"
        "at the top and a tenth\nof the length from the bottom",
        (0.97, 0.04), ha="right", xycoords="axes fraction", va="bottom", fontsize="small",
    )  # fmt: skip
    below = "hardly" if low < HARDLY * high else f"{low:.1f} m"
    far = f"the top has moved {high:.0f} m, the bottom {below}"
    set_title(figure, f"After {EARLY:g} s along the environment, {far}")
    axes[0].set_ylabel("elevation above the wellhead (m)")
    return figure


def fig06(driveoff: xr.Dataset, deadline: float) -> Figure:
    """Force of the riser on the platform; ``deadline`` is the published time (s)."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    beginning = driveoff.sel(time=slice(0.0, BEGINNING))
    for ax, (kind, title) in zip(axes, SETS.items(), strict=True):
        for heading, label in HEADINGS.items():
            colour = OF_HEADING[label]
            run = beginning.sel(case=f"{kind}_{heading}")
            run = _until_the_stop(ax, run, "riser_force_x", 1e-6)
            printed, exact = run["riser_force_x"] / 1e6, run["riser_reaction_x"] / 1e6
            ax.plot(run["time"], printed, color=colour, label=label)
            ax.plot(run["time"], exact, ":", color=colour)
        ax.plot(
            [deadline],
            [FORCE_AT_LIMIT],
            "o",
            color="black",
            label=f"implied by the printed angle, at 0° (fitted): T sin 12° at {deadline:g} s",
        )
        ax.axhline(0.0, color=GREY, linewidth=0.9)
        ax.set_xlabel(TIME)
        panel_title(ax, title)
    set_title(figure, _when_it_drives(beginning["riser_force_x"]))
    axes[0].set_ylabel("force on the platform, positive\nin drive-off direction (MN)")
    axes[0].plot([], [], color=GREY, label="T sin θ as printed")
    axes[0].plot([], [], ":", color=GREY, label="exact reaction")
    rest = zip(*axes[0].get_legend_handles_labels(), strict=True)
    key = [(handle, label) for handle, label in rest if label not in HEADINGS.values()]
    legend_below(figure, [handle for handle, _ in key], [label for _, label in key], 4)
    label_ends(axes[1], [line for line in axes[1].lines if line.get_label() in HEADINGS.values()])
    axes[1].margins(x=0.05)  # as in the other panel
    return figure


def _when_it_drives(force: xr.DataArray) -> str:
    """Title: time for which the riser drives the platform along, and whether it ever drives it against."""
    until = [float(first_crossing(-force.sel(case=f"{kind}_0"), 0.0)) for kind in SETS]
    against = max(float(force.sel(case=f"{kind}_180").max()) for kind in SETS)
    ever = "never" if against < 0.0 else "sometimes"
    time = f" for {_range(until)} s" if np.isfinite(until).all() else ""
    return f"The riser drives the platform{time} along the environment, {ever} against"


def _until_the_stop(ax: Axes, run: xr.Dataset, name: str, scale: float) -> xr.Dataset:
    """Return a run until stroke-out of the telescopic joint; mark a quantity there with a cross."""
    if not bool(run["stroke"].notnull().any()):
        return run  # no riser
    end = float(first_crossing(run["stroke"], LIMITS["telescopic joint"].most))
    if not np.isfinite(end):
        return run
    kept = run.sel(time=slice(0.0, end))
    mark_stroke_out(ax, end, scale * float(kept[name].isel(time=-1)))
    return kept


def fig07(driveoff: xr.Dataset, deadline: float) -> Figure:
    """Used shares of the limits, along the environment; ``deadline`` is the published time (s)."""
    figure, axes = panels(1, 2, 3.8, sharex=True, sharey=True)
    beginning = driveoff.sel(time=slice(0.0, BEGINNING))
    for ax, (kind, title) in zip(axes, SETS.items(), strict=True):
        run = beginning.sel(case=f"{kind}_0")
        used = shares(run)
        stress = run["riser_stress"] / LIMITS["conductor"].most
        run = _until_the_stop(
            ax, run.assign(share=used.sel(limit="telescopic joint", drop=True)), "share", 1.0
        )
        used, stress = (part.sel(time=run["time"]) for part in (used, stress))
        draw_limits(ax, used)
        ax.plot(stress["time"], stress, color=COLOURS[5], label=PIPE)
        ax.plot([deadline], [1.0], "o", color="black", label=f"printed: 12° at {deadline:g} s")
        panel_title(ax, title)
    set_title(figure, _which_is_first(reached(driveoff.sel(case="ref_0"))))
    axes[0].set_ylabel("utilisation of the limit")
    for line in axes[0].lines:
        if line.get_label() == "limit (printed)":
            line.set_label("limit (printed; of the riser assumed)")
    name_limits(figure, axes, PIPE)
    return figure


def _which_is_first(times: xr.DataArray) -> str:
    """Title: the limit that is reached first, and when (s); times are infinite for limits never reached."""
    first = str(first_limit(times).item())
    if first in ("none", "unknown"):
        return "No limit is known to be reached in the drive-off along the environment"
    return f"The {first} reaches its limit first, at {float(times.min()):.0f} s (calibrated)"


def envelope(envelope: xr.Dataset) -> Figure:
    """Utilisation of the limits over the static offset; bands: range over the currents."""
    figure, (ax,) = panels(height=4.4)
    used = envelope["limit_share"]
    for colour, name in zip(COLOURS, LIMITS, strict=False):
        one = used.sel(limit=name)
        low, high = one.min("surface_speed"), one.max("surface_speed")
        ax.fill_between(one["offset"], low, high, color=colour, alpha=0.25, linewidth=0.0)
        ax.plot(one["offset"], one.sel(surface_speed=0.0), color=colour, label=name)
    ax.axhline(1.0, label="limit (printed)", **PRINTED)
    still = envelope["limit_offset"].sel(surface_speed=0.0)
    end, then = (float(still.sel(limit=name)) for name in ("telescopic joint", "conductor"))
    mark_both(ax, end, then, "m")
    far = 1.5 * end
    seen = [float(part.max()) for part in (used.sel(offset=slice(0.0, far)), used.interp(offset=far))]
    ax.set_xlim(0.0, far)
    ax.set_ylim(0.0, 1.03 * max(seen))
    ax.set_xlabel("static offset of the platform (m)")
    ax.set_ylabel("utilisation of the limit")
    set_title(
        figure,
        f"Stroke-out occurs at {end:.0f} m of static offset; the conductor reaches its limit at {then:.0f} m",
    )
    lines = {str(line.get_label()): line for line in named(ax)}
    speeds = [float(speed) for speed in used["surface_speed"].values]
    band = f"surface currents of {min(speeds):g} to {max(speeds):g} m/s".replace("-", "−")
    key = {
        "still water": Line2D([], [], color=GREY),
        band: Patch(color=GREY, alpha=0.25, linewidth=0.0),
        "limit (printed)": lines["limit (printed)"],
        STROKE_OUT: lines[STROKE_OUT],
    }
    legend_below(figure, [*key.values()], [*key], 2)
    label_ends(ax, [lines[name] for name in LIMITS])
    return figure
