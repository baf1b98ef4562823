"""Times at which limits are reached, and the offsets at which a disconnect must start."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from chapters.liu2017.figures.shared import (
    REFERENCE,
    draw_limits,
    mark_both,
    mark_stroke_out,
    name_limits,
    plasma,
    set_title,
)
from chapters.liu2017.limits import LIMITS
from riserstudy.dataset.crossing import first_limit
from riserstudy.design.watch_circles import TOO_LATE
from riserstudy.figures.direct import label_ends, label_line, named
from riserstudy.figures.insets import enlarge, name_axes
from riserstudy.figures.style import COLOURS, legend_below, panel_title, panels

DRIFT_OFF = "all thrust lost"  # the scenario that is no drive-off
#: what the platform does in a scenario, and the condition in words
TITLES = {
    "unlimited thrust": ("drive-off", "unlimited thrust"),
    "thrust of 4.5 MN": ("drive-off", "thrust limited to 4.5 MN"),
    DRIFT_OFF: ("drift-off", DRIFT_OFF),
}
FIRST = {"telescopic joint": "stroke-out"}  # other name of a limit
CLOSE = 6.0  # s, to both sides of the enlarged part around stroke-out in a drift-off
LOSSES = {"drive-off": "unlimited thrust", "drift-off": DRIFT_OFF}


def losses(losses: xr.Dataset) -> Figure:
    """Used shares of the limits in a drive-off and in a drift-off."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    for ax, (loss, thrust) in zip(axes, LOSSES.items(), strict=True):
        run = losses.sel(loss=loss).dropna("time", how="all")
        draw_limits(ax, run["limit_share"])
        end = float(run["limit_time"].sel(limit="telescopic joint"))
        if np.isfinite(end):
            mark_stroke_out(ax, end, 1.0)
        panel_title(ax, f"{loss}, {thrust}")
    lost = losses["limit_time"].sel(loss="drift-off")
    end, stress = (float(lost.sel(limit=name)) for name in ("telescopic joint", "conductor"))
    set_title(figure, _first_limits(losses["limit_time"]))
    mark_both(axes[1], end, stress, "s", (-14.0, -4.0))  # away from the enlarged part
    axes[0].set_ylabel("utilisation of the limit")
    axes[0].set_ylim(bottom=-0.05)
    name_limits(figure, axes)
    around = 0.5 * (end + stress)
    inset = enlarge(
        axes[1], (0.29, 0.62, 0.43, 0.22), (around - CLOSE, around + CLOSE), (0.9, 1.1), widest=1.5
    )
    name_axes(inset, "time (s)", "utilisation")
    return figure


def _first_limits(times: xr.DataArray) -> str:
    """Title: the limit that is reached first, by loss; infinite times: never."""
    found = [first_limit(times.sel(loss=loss)).item() for loss in LOSSES]
    if {"none", "unknown"} & set(map(str, found)):
        return "Utilisation of each limit in a drive-off and in a drift-off"
    one, other = (FIRST.get(str(name), f"the {name} limit") for name in found)
    if one == other:
        return f"Drive-off and drift-off both reach {one} first"
    return f"A drive-off reaches {one} first, a drift-off {other}"


def disconnect(disconnect: xr.Dataset, station: float) -> Figure:
    """Times at which limits are reached, and radius of the alarm, over the angle to the environment.

    ``station``: radius within which the platform keeps its station (m); a smaller red circle is too late.
    """
    scenarios = disconnect["scenario"].values
    figure, axes = panels(2, len(scenarios), 3.2, sharex=True)
    above, below = axes[: len(scenarios)], axes[len(scenarios) :]
    for times, circles, scenario in zip(above, below, scenarios, strict=True):
        run = disconnect.sel(scenario=scenario)
        _limit_times(times, run)
        by_time = _circles(circles, run, station)
        circles.axhline(station, label=_station(station), **REFERENCE)
        title = TITLES.get(str(scenario), (str(scenario),))
        panel_title(times, ", ".join(title))
        panel_title(circles, f"red circle, {title[-1]}")
        circles.set_xlabel("angle between hull and\nenvironment (°)")
        circles.set_xticks(range(0, 181, 45))
    drifting = [str(scenario) == DRIFT_OFF for scenario in scenarios]
    for row, label in ((above, "time to reach the limit (s)"), (below, "radius of the red circle (m)")):
        for drift in (False, True):  # drive-offs have one scale, the drift-off a separate scale
            alike = [ax for ax, other in zip(row, drifting, strict=True) if other == drift]
            top = max((ax.get_ylim()[1] for ax in alike), default=1.0)
            for ax in alike:
                ax.set_ylim(-0.04 * top, 1.2 * top)  # values near zero stay visible
                ax.tick_params(labelleft=ax is alike[0])
        row[0].set_ylabel(label)
    set_title(figure, _slowest_in_time(disconnect, station))
    line = below[0].lines[-1]
    legend_below(figure, [line], [str(line.get_label())], 1)
    _name_lines(above, below[-1], by_time)
    return figure


def _station(station: float) -> str:
    return f"station keeping within {station:g} m (assumed); a red circle below this line: too late"


def _name_lines(above: list[Axes], last: Axes, by_time: dict[float, Line2D]) -> None:
    """Name the limits in each panel; write the times (s) of disconnects of the last panel at the right."""
    places = {"upper flex joint": (0.0, -16.0, "left"), "conductor": (0.5, 4.0, "center")}
    beneath = (0.5, -15.0, "center")  # below the peak of a line, because another line is just above
    for ax in above:
        names = [str(line.get_label()) for line in named(ax)]
        for line, name in zip(named(ax), names, strict=True):
            other = beneath if "conductor" in names else (0.0, 8.0, "left")
            share, up, across = places.get(name, other)
            label_line(ax, line, share, (0.0, up), ha=across)
    first, *others = (f"in {time:g} s" for time in by_time)
    label_ends(last, [*by_time.values()], names=[f"disconnect\n{first}", *others])


def _limit_times(ax: Axes, run: xr.Dataset) -> None:
    for colour, name in zip(COLOURS, LIMITS, strict=False):
        times = run["limit_time"].sel(limit=name)
        beginning = times.where(np.isfinite(times))
        if bool(beginning.notnull().any()):
            ax.plot(run["environment_heading"], beginning, ".-", color=colour, label=name)


def _circles(ax: Axes, run: xr.Dataset, station: float) -> dict[float, Line2D]:
    """Draw the radius over the environment's angle to the hull; a note names too late disconnects.

    Returns the line of each time of the disconnect (s).
    """
    times = run["eds_time"].values
    lines: dict[float, Line2D] = {}
    for colour, eds in zip(plasma(np.linspace(0.0, 0.85, len(times))), times, strict=True):
        circle = run.sel(eds_time=eds)
        radius = circle["red_circle_radius"].where(circle["red_circle_outcome"] != TOO_LATE)
        label = f"disconnect in {eds:g} s"
        (lines[float(eds)],) = ax.plot(run["environment_heading"], radius, ".-", color=colour, label=label)
    late = ~_in_time(run, station)
    if bool(late.any()):
        *first, last = [f"{eds:g}" for eds in times[late.values]]
        longer = f"{', '.join(first)} or {last}" if first else last
        words = f"too late:\ndisconnect in {longer} s"
        ax.text(0.5, 0.95, words, transform=ax.transAxes, ha="center", va="top", fontsize="small")
    return lines


def _in_time(disconnect: xr.Dataset, station: float) -> xr.DataArray:
    """Return whether the red circle exceeds the radius (m) of station keeping in every direction."""
    return (disconnect["red_circle_radius"] >= station).all("environment_heading")


def _slowest_in_time(disconnect: xr.Dataset, station: float) -> str:
    """Title: by scenario, the longest tested disconnect that is in time in every direction, and the next."""
    tested = disconnect["eds_time"]
    longest = tested.where(_in_time(disconnect, station)).max("eds_time")
    if bool(longest.isnull().any()):
        never = longest["scenario"].values[np.isnan(longest.values)]
        return f"No tested disconnect is in time in every direction ({', '.join(map(str, never))})"
    least = float(longest.min())
    shortest = longest["scenario"].values[longest.values == least]
    longer = tested.values[tested.values > least]
    late = f"; {longer.min():g} s is too late" if longer.size else ""
    where = f"Under {', '.join(map(str, shortest))}"
    if set(shortest) == set(longest["scenario"].values) - {DRIFT_OFF}:
        where = "In a drive-off"
    return f"{where}, a {least:g} s disconnect is in time{late}"
