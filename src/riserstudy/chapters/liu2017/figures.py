"""Figures of Liu et al. 2017: the printed ones by number, others by what they show.

Axis ranges are not printed: the first 100 s are shown, up to the largest surge of about 150 m.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.liu2017.limits import BOTTOM, LIMITS, reached, shares, starts
from riserstudy.dataset.crossing import first_crossing, first_limit
from riserstudy.design.watch_circles import TOO_LATE
from riserstudy.figures.style import COLOURS, GREY, PRINTED, key_below, panel_title, panels

SETS = {"ref": "unlimited thrust", "sat": "thrust limited to 4.5 MN"}
HEADINGS = {"0": "0° (along)", "180": "180° (against)"}
TIMES = (10.0, 20.0, 30.0, 40.0, 50.0, 60.0)  # s, of Fig 5
TIME, SURGE = "time (s)", "surge of the platform (m)"
SHOWN = 100.0  # s
LOW = 218.0  # m above the conductor's foot, a tenth up the riser
DEGREES = 180.0 / np.pi
PASSED = 0.03  # deg, by which an angle is past its largest: half a second after it
AS_ONE = "as one"  # of platform and riser
UFJ_LIMIT = 12.0  # degrees, of Table 4
viridis = colormaps["viridis"]
FORCE_AT_LIMIT = -3.02 * np.sin(np.deg2rad(UFJ_LIMIT))  # MN, which Fig 6 implies


def set_title(figure: Figure, title: str) -> None:
    """What a figure shows, above it."""
    figure.suptitle(title, fontsize="medium")


def fig04(driveoff: xr.Dataset) -> Figure:
    """Surge and speed over time, with and without riser, for both sets of inputs."""
    figure, axes = panels(2, 2, 3.2, sharex=True)
    beginning = driveoff.sel(time=slice(0.0, SHOWN))
    for column, (kind, title) in enumerate(SETS.items()):
        for colour, (heading, label) in zip(COLOURS, HEADINGS.items(), strict=False):
            for ending, line, word in (("", "-", "with"), ("_no_riser", "--", "without")):
                run = beginning.sel(case=f"{kind}_{heading}{ending}")
                text = f"{label}, {word} riser"
                axes[column].plot(
                    run["time"], run["platform_surge"], line, color=colour, label=text
                )
                axes[2 + column].plot(run["time"], run["platform_speed_x"], line, color=colour)
        axes[column].axhline(100.0, color=GREY, linewidth=0.9, label="printed: false position")
        panel_title(axes[column], title)
        axes[2 + column].set_xlabel(TIME)
    later = [
        float(first_crossing(driveoff["platform_surge"].sel(case=f"{kind}_180"), 100.0))
        - float(first_crossing(driveoff["platform_surge"].sel(case=f"{kind}_0"), 100.0))
        for kind in SETS
    ]
    set_title(figure, f"Against the environment the platform arrives {_range(later)} s later")
    axes[0].set_ylabel(SURGE)
    axes[2].set_ylabel("speed of the platform (m/s)")
    key_below(figure, axes[0], 4)
    return figure


def _range(values: list[float]) -> str:
    """Whole numbers, from the least to the largest."""
    low, high = round(min(values)), round(max(values))
    return f"{low}" if low == high else f"{low} to {high}"


def fig05(ref_0: xr.Dataset, ref_180: xr.Dataset) -> Figure:
    """Shapes of the riser; against the environment mirrored, so that x is the same in both panels."""
    figure, axes = panels(1, 2, 4.2, sharey=True)
    for ax, run, sign, label in zip(
        axes, (ref_0, ref_180), (1.0, -1.0), HEADINGS.values(), strict=True
    ):
        rest = run.isel(time=0)
        ax.plot(sign * rest["x"], rest["z"], "--", color=GREY, label="at rest")
        for colour, time in zip(viridis(np.linspace(0.0, 0.9, len(TIMES))), TIMES, strict=True):
            shape = run.sel(time=time)
            ax.plot(sign * shape["x"], shape["z"], color=colour, label=f"{time:g} s")
        ax.set_xlabel("lateral displacement (m)")
        panel_title(ax, label)
    after = abs(ref_0["x"].sel(time=20.0) - ref_0["x"].isel(time=0))
    low = float(after.sel(s=LOW, method="nearest"))
    set_title(
        figure,
        f"Low on the riser motion is {low:.1f} m when the top has moved {float(after.isel(s=-1)):.0f} m",
    )
    axes[0].set_ylabel("elevation above the wellhead (m)")
    axes[1].legend(fontsize="small", loc="lower left")
    return figure


def fig06(driveoff: xr.Dataset, deadline: float) -> Figure:
    """Force of the riser on the platform; ``deadline`` is the printed time (s)."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    beginning = driveoff.sel(time=slice(0.0, SHOWN))
    for ax, (kind, title) in zip(axes, SETS.items(), strict=True):
        for colour, (heading, label) in zip(COLOURS, HEADINGS.items(), strict=False):
            run = beginning.sel(case=f"{kind}_{heading}")
            run = _until_the_stop(ax, run, "riser_force_x", 1e-6)
            printed, exact = run["riser_force_x"] / 1e6, run["riser_reaction_x"] / 1e6
            ax.plot(run["time"], printed, color=colour, label=f"{label}, T sin θ as printed")
            ax.plot(run["time"], exact, ":", color=colour, label=f"{label}, exact reaction")
        ax.plot(
            [deadline],
            [FORCE_AT_LIMIT],
            "o",
            color="black",
            label=f"implied by print, at 0°: T sin 12° at {deadline:g} s",
        )
        ax.axhline(0.0, color=GREY, linewidth=0.9)
        ax.set_xlabel(TIME)
        panel_title(ax, title)
    drives = driveoff["riser_force_x"].sel(case="ref_0")
    until = float(first_crossing(-drives, 0.0))
    against = (
        float(driveoff["riser_force_x"].sel(case="ref_180", time=slice(0.0, SHOWN)).max()) / 1e6
    )
    inhibits = "always inhibits" if against < 0.0 else "does not always inhibit"
    set_title(
        figure, f"Along, the riser drives the platform for {until:.0f} s; against, it {inhibits}"
    )
    axes[0].set_ylabel("force of the riser on the platform (MN)")
    key_below(figure, axes[0], 3)
    return figure


def _until_the_stop(ax: Axes, run: xr.Dataset, name: str, scale: float) -> xr.Dataset:
    """A run until the telescopic joint meets its end, where a cross is drawn at a quantity.

    The paper does not mention a stop; behind it the curves are those of an assumption.
    """
    end = float(first_crossing(run["stroke"], LIMITS["telescopic joint"].most))
    if not np.isfinite(end):
        return run
    kept = run.sel(time=slice(0.0, end))
    last = scale * float(kept[name].isel(time=-1))
    key = "stroke ends (assumed stop)" if not _has_key(ax, "stroke ends (assumed stop)") else None
    ax.plot([end], [last], "x", color="black", markersize=8, label=key)
    return kept


def _has_key(ax: Axes, label: str) -> bool:
    return label in ax.get_legend_handles_labels()[1]


def fig07(driveoff: xr.Dataset, deadline: float) -> Figure:
    """Shares of the limits that are used, along the environment; ``deadline`` is the printed time (s)."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    beginning = driveoff.sel(time=slice(0.0, SHOWN))
    for ax, (kind, title) in zip(axes, SETS.items(), strict=True):
        run = beginning.sel(case=f"{kind}_0")
        used = shares(run)
        stress = run["riser_stress"] / LIMITS["conductor"].most
        run = _until_the_stop(
            ax, run.assign(share=used.sel(limit="telescopic joint", drop=True)), "share", 1.0
        )
        used, stress = (part.sel(time=run["time"]) for part in (used, stress))
        _limits(ax, used)
        ax.plot(stress["time"], stress, color=COLOURS[5], label="riser, 386 MPa too (assumed)")
        ax.plot([deadline], [1.0], "o", color="black", label=f"printed: 12° at {deadline:g} s")
        panel_title(ax, title)
    run = driveoff.sel(case="ref_0")
    times, begins = reached(run), starts(run)
    late = begins.sel(limit=list(BOTTOM)).min("limit") - begins.sel(limit="upper flex joint")
    set_title(
        figure,
        f"The {first_limit(times).item()!s} is first, at {float(times.min()):.0f} s; "
        f"the bottom lags by {float(late):.0f} s",
    )
    axes[0].set_ylabel("utilisation of the limit")
    key_below(figure, axes[0], 3)
    return figure


# beyond the paper


def losses(losses: xr.Dataset) -> Figure:
    """Shares of the limits in a drive-off and in a drift-off."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    for ax, loss in zip(axes, ("drive-off", "drift-off"), strict=True):
        run = losses.sel(loss=loss).dropna("time", how="all")
        _limits(ax, run["limit_share"])
        end = float(run["limit_time"].sel(limit="telescopic joint"))
        ax.axvline(end, color=GREY, linestyle=":", label="telescopic joint at its end")
        panel_title(ax, loss)
    lost = losses["limit_time"].sel(loss="drift-off")
    end, stress = (float(lost.sel(limit=name)) for name in ("telescopic joint", "conductor"))
    set_title(
        figure,
        f"In a drift-off stroke-out occurs at {end:.0f} s, the conductor limit {stress - end:.0f} s later",
    )
    axes[0].set_ylabel("utilisation of the limit")
    axes[0].set_ylim(bottom=0.0)
    key_below(figure, axes[0], 3)
    return figure


def _limits(ax: Axes, used: xr.DataArray) -> None:
    for colour, name in zip(COLOURS, LIMITS, strict=False):
        ax.plot(used["time"], used.sel(limit=name), color=colour, label=name)
    ax.axhline(1.0, label="limit (printed)", **PRINTED)
    ax.set_xlabel(TIME)


def disconnect(disconnect: xr.Dataset, station: float) -> Figure:
    """When limits are reached, and where the alarm must be, by angle to the environment.

    ``station``: radius within which the platform keeps its station (m); a smaller red circle is too late.
    """
    scenarios = disconnect["scenario"].values
    figure, axes = panels(2, len(scenarios), 3.2, sharex=True)
    above, below = axes[: len(scenarios)], axes[len(scenarios) :]
    for times, circles, scenario in zip(above, below, scenarios, strict=True):
        run = disconnect.sel(scenario=scenario)
        _limit_times(times, run)
        _circles(circles, run)
        circles.axhline(station, label=f"station keeping within {station:g} m (assumed)", **PRINTED)
        panel_title(times, str(scenario))
        circles.set_xlabel("environment to hull (deg)")
        circles.set_xticks(range(0, 181, 45))
    for row, label in ((above, "limit reached after (s)"), (below, "radius of the red circle (m)")):
        top = max(ax.get_ylim()[1] for ax in row)
        for ax in row:
            ax.set_ylim(0.0, top)
            ax.tick_params(labelleft=ax is row[0])
        row[0].set_ylabel(label)
    seen = {
        label: line
        for ax in above
        for line, label in zip(*ax.get_legend_handles_labels(), strict=True)
    }
    above[0].legend(seen.values(), seen.keys(), loc="upper right", fontsize="small")
    key_below(figure, below[-1], 3)
    set_title(figure, _slowest_in_time(disconnect, station))
    return figure


def _limit_times(ax: Axes, run: xr.Dataset) -> None:
    for colour, name in zip(COLOURS, LIMITS, strict=False):
        times = run["limit_time"].sel(limit=name)
        beginning = times.where(np.isfinite(times))
        if bool(beginning.notnull().any()):
            ax.plot(run["environment_heading"], beginning, ".-", color=colour, label=name)


def _circles(ax: Axes, run: xr.Dataset) -> None:
    """Radius over the environment's angle to the hull; where every alarm is too late, a note instead."""
    times = run["eds_time"].values
    for colour, eds in zip(viridis(np.linspace(0.0, 0.9, len(times))), times, strict=True):
        circle = run.sel(eds_time=eds)
        radius = circle["red_circle_radius"].where(circle["red_circle_outcome"] != TOO_LATE)
        label = f"disconnect takes {eds:g} s"
        ax.plot(run["environment_heading"], radius, ".-", color=colour, label=label)
    late = (run["red_circle_outcome"] == TOO_LATE).all("environment_heading")
    if bool(late.any()):
        words = f"too late: {', '.join(f'{eds:g}' for eds in times[late.values])} s"
        ax.text(0.5, 0.95, words, transform=ax.transAxes, ha="center", va="top", fontsize="small")


def _slowest_in_time(disconnect: xr.Dataset, station: float) -> str:
    """Of each scenario the longest disconnect that is in time whatever the direction.

    In time is one whose red circle exceeds the radius (m) within which the platform keeps its station.
    """
    in_time = (disconnect["red_circle_radius"] >= station).all("environment_heading")
    longest = disconnect["eds_time"].where(in_time).max("eds_time")
    if bool(longest.isnull().any()):
        never = longest["scenario"].values[np.isnan(longest.values)]
        return f"No tested disconnect is in time in every direction ({', '.join(map(str, never))})"
    least = float(longest.min())
    shortest = longest["scenario"].values[longest.values == least]
    return f"The disconnect must take at most {least:g} s ({', '.join(map(str, shortest))})"


def envelope(envelope: xr.Dataset) -> Figure:
    """Utilisation of the limits over the static offset; bands: over the currents."""
    figure, (ax,) = panels(height=3.8)
    used = envelope["limit_share"]
    for colour, name in zip(COLOURS, LIMITS, strict=False):
        one = used.sel(limit=name)
        low, high = one.min("surface_speed"), one.max("surface_speed")
        ax.fill_between(one["offset"], low, high, color=colour, alpha=0.25, linewidth=0.0)
        ax.plot(one["offset"], one.sel(surface_speed=0.0), color=colour, label=name)
    ax.axhline(1.0, label="limit (printed)", **PRINTED)
    still = envelope["limit_offset"].sel(surface_speed=0.0)
    end, then = (float(still.sel(limit=name)) for name in ("telescopic joint", "conductor"))
    ax.set_xlim(0.0, 1.5 * end)
    ax.set_ylim(0.0, 1.6)
    ax.set_xlabel("static offset of the platform (m)")
    ax.set_ylabel("utilisation of the limit")
    set_title(
        figure,
        f"Stroke-out occurs at {end:.0f} m of static offset, the conductor limit at {then:.0f} m",
    )
    key_below(figure, ax, 3)
    return figure


def calibration(calibration: xr.Dataset, deadline: float) -> Figure:
    """Gains and hull drags that meet the printed number, for three weights of the riser.

    While the angle still rises then, its largest value so far is reached for the first time; where it has
    passed its largest value, 12 degrees are reached before or never, and no line is drawn.
    """
    figure, (ax,) = panels(height=3.8)
    handles = []
    for colour, weight in zip(COLOURS, calibration["riser_weight"].values, strict=False):
        run = calibration.sel(riser_weight=weight).transpose("hull_drag", "gain") * DEGREES
        largest = run["ufj_angle_absmax"]
        style: dict[str, Any] = {"levels": [UFJ_LIMIT], "colors": [colour]}
        still_rising = largest - run["ufj_angle"].values < PASSED
        ax.contour(run["gain"], run["hull_drag"], largest.where(still_rising), **style)
        handles += ax.plot([], [], color=colour, label=f"riser's weight in water: {weight}")
    fit = [calibration.attrs["gain"]], [calibration.attrs["hull_drag"]]
    handles += ax.plot(*fit, "o", color="black", label="fit that is used, with the wave")
    ax.annotate(
        "beyond the lines' upper ends\n12° are reached earlier, or never", (0.98, 0.96),
        xycoords="axes fraction", ha="right", va="top", fontsize="small",
    )  # fmt: skip
    ax.set_xlabel("thrusters' gain (kN/m)")
    ax.set_ylabel("hull drag (kN s²/m²)")
    ax.set_xlim(float(calibration["gain"].min()), 90.0)
    ax.set_ylim(float(calibration["hull_drag"].min()), 600.0)
    set_title(
        figure,
        f"Many pairs of gain and hull drag give the printed 12° at {deadline:g} s",
    )
    ax.legend(handles=handles, fontsize="small", loc="upper left")
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
    for ax, title in zip(axes, ("surge (m)", "upper flex joint (deg)"), strict=False):
        ax.set_ylim(bottom=-0.03 * ax.get_ylim()[1])  # so that what is zero is seen
        ax.set_xlabel(TIME)
        ax.set_ylabel(f"difference in {title}")
    cost = turns[["newton_iterations", "solve_seconds"]] / one
    axes[2].barh(ways, cost["newton_iterations"], color=COLOURS[: len(ways)], alpha=0.6)
    axes[2].plot(cost["solve_seconds"], ways, "o", color="black")
    axes[2].axvline(1.0, **PRINTED)
    axes[2].invert_yaxis()
    axes[2].set_xlabel("cost in turns / cost as one")
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
    angle = abs(open_drive_off["ufj_angle"]).sel(time=slice(0.0, SHOWN)) * DEGREES
    bins = list(range(20, 151, 5))
    for colour, (heading, label) in zip(
        COLOURS, (("along", "0°"), ("against", "180°")), strict=False
    ):
        run = angle.sel(heading=heading)
        low, middle, high = (run.quantile(q, "sample") for q in (0.05, 0.5, 0.95))
        axes[0].fill_between(run["time"], low, high, color=colour, alpha=0.2, linewidth=0.0)
        axes[0].plot(run["time"], middle, color=colour, label=f"{label}, median and 90 %")
        times = open_drive_off["limit_time"].sel(heading=heading, limit="upper flex joint")
        reached = times.values[np.isfinite(times.values)]
        text = f"{label}, reached in {100 * len(reached) / times.size:.0f} %"
        axes[1].hist(reached, bins, color=colour, histtype="step", linewidth=1.8, label=text)
    axes[0].plot([deadline], [UFJ_LIMIT], "o", color="black", label="printed, at 0°")
    axes[1].axvline(deadline, label="printed, at 0°", **PRINTED)
    then = angle.sel(heading="along").interp(time=deadline)
    least, most = (float(then.quantile(q)) for q in (0.05, 0.95))
    set_title(
        figure,
        f"At the published time samples have UFJ angles of {least:.0f}° to {most:.0f}°",
    )
    axes[0].set_xlabel(TIME)
    axes[0].set_ylabel("upper flex joint (deg)")
    axes[1].set_xlabel("upper flex joint at 12° after (s)")
    axes[1].set_ylabel("number of samples")
    for ax in axes:
        ax.legend(fontsize="small")
    return figure
