"""Figures of Mao, Zeng, Liu on what speed, current, track and length change for a riser that is towed."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.mao_hangoff.figures.towed_shared import (
    AGAINST,
    ASTERN,
    MOMENT,
    NESTED,
    RISE,
    TIME,
    changes,
    down,
    three_panels,
)
from riserstudy.chapters.mao_hangoff.runs import STATED, as_drawn
from riserstudy.chapters.mao_hangoff.towed import displacement
from riserstudy.figures.direct import label_line
from riserstudy.figures.names import in_words
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    headline,
    key_below,
    panel_title,
    panels,
)

TRACKS = {0.0: "track at 0° (along)", 45.0: "track at 45°", 90.0: "track at 90° (across)"}
ALIKE = 1.0  # %, by which curves may differ that are drawn in each other
#: of lines that coincide with another in a panel of trends (points): the later is drawn on the earlier
WIDTHS = {"lmrp_mass": 3.0, "current_speed": 1.2}
ONE_PROFILE = ("0 deg, 3 m/s", "45 deg, 3 m/s", "90 deg")  # tracks of Fig 13


def fig11(current_speed: xr.Dataset) -> Figure:
    """The same for three speeds of the current, in two profiles."""
    held = "current along, platform 1.289 m/s"
    label = "current {:.1f} m/s"
    figure = _two_profiles(current_speed, "current_speed", (1.0, 1.1, 1.2), label, held)
    headline(figure, _by_profile("current", current_speed, "current_speed", 1.0, 1.2))
    return figure


def fig12(platform_speed: xr.Dataset) -> Figure:
    """The same for three speeds of the platform, in two profiles."""
    held = "current 1.2 m/s, along"
    label = "platform {:g} kn"
    figure = _two_profiles(platform_speed, "platform_speed", (2.4, 2.5, 2.6), label, held)
    headline(figure, _by_profile("platform", platform_speed, "platform_speed", 2.4, 2.6))
    return figure


def _two_profiles(
    runs: xr.Dataset, axis: str, values: tuple[float, ...], label: str, held: str
) -> Figure:
    """Panels in the profile that is drawn first; dashed, shapes and moments in the other.

    ``held``: speed and direction that panel (a) states.
    """
    names = [str(name) for name in runs["current_profile"].values]
    figure = three_panels(
        as_drawn(runs), axis, values, label, held, f"axial motion, {names[0]} only"
    )
    axes = figure.axes
    other = runs.isel(current_profile=-1, drop=True)
    change = changes(other, axis, values[0], values[-1])["displacement"]
    alike = abs(change) < ALIKE
    widths = NESTED if alike else (1.2, 1.2, 1.2)
    for colour, value, width in zip(COLOURS, values, widths, strict=False):
        dashes = (0, (4.0 / width, 2.0 / width))  # as long whatever the width, which scales them
        run = other.sel({axis: value}, method="nearest")
        shape = run["displacement_along"].sel(time=STATED).dropna("s")
        moment = run["bending_moment_size"].dropna("s") / 1e3
        for ax, curve in zip(axes, (-shape, moment), strict=False):
            depth = float(curve["s"][-1]) - curve["s"]
            ax.plot(curve, depth, color=colour, lw=width, ls=dashes)
    if alike:
        axes[0].annotate(
            f"the three dashed\ndiffer by {abs(change):.1g} %", (0.97, 0.93), xycoords="axes fraction",
            ha="right", va="top", fontsize="small",
        )  # fmt: skip
    axes[0].plot([], [], color=GREY, label=f"current: {names[0]} (assumed)")
    axes[0].plot([], [], "--", color=GREY, label=f"current: {names[-1]} (assumed)")
    key_below(figure, axes[0], 5)
    return figure


def fig13(track_angle: xr.Dataset, track_one_profile: xr.Dataset) -> Figure:
    """The same for three angles of the track, both speeds in one profile; dash-dotted, separate speeds."""
    figure, axes = panels(1, 3, 3.7)
    shapes = displacement(track_one_profile).sel(time=STATED)
    moments = abs(track_one_profile["bending_moment"].sel(time=STATED)) / 1e3
    z = track_one_profile["z"].isel(s=0)
    depth = float(shapes["s"][-1]) - shapes["s"]
    widths = (1.0, *NESTED[1:])  # two of the three nearly coincide in (c)
    tracks = zip(COLOURS, ONE_PROFILE, (0.0, 45.0, 90.0), widths, strict=False)
    for colour, track, angle, width in tracks:
        axes[0].plot(-shapes.sel(track=track), depth, color=colour, label=TRACKS[angle])
        axes[1].plot(moments.sel(track=track), depth, color=colour)
        risen = z.sel(track=track) - z.sel(track=track).isel(time=0)
        axes[2].plot(risen["time"], risen, color=colour, lw=width)
        apart = track_angle.sel(track_angle=angle)
        shape = apart["displacement_along"].sel(time=STATED)
        own = float(shape["s"][-1]) - shape["s"]
        axes[0].plot(-shape, own, "-.", color=colour, lw=0.8)
        axes[1].plot(apart["bending_moment_size"] / 1e3, own, "-.", color=colour, lw=0.8)
    axes[0].plot([], [], color=GREY, label="both speeds in one profile")
    axes[0].plot(
        [], [], "-.", color=GREY, lw=0.8, label="(a, b) separate speeds of water and platform"
    )
    axes[0].axvline(0.0, color=GREY, lw=0.6)
    for side, word, to in ((-0.03, "ahead ←", "right"), (0.03, "→ astern", "left")):
        axes[0].annotate(
            word, (0.0, 1.0), xycoords=("data", "axes fraction"), xytext=(100.0 * side, -3.0),
            textcoords="offset points", ha=to, va="top", fontsize="x-small",
        )  # fmt: skip
    panel_title(axes[0], "current 3 m/s, power 1/4 (assumed)")
    panel_title(axes[1], "size of the moment")
    panel_title(axes[2], "axial motion, one profile")
    down(axes[0], ASTERN)
    down(axes[1], MOMENT)
    axes[2].set_xlabel(TIME)
    axes[2].set_ylabel(RISE)
    key_below(figure, axes[0], 5)
    otherwise = -track_angle["lmrp_displacement"].sel(time=STATED)
    along, across = (
        _trails(float(-shapes.sel(track=track).isel(s=0)), float(otherwise.sel(track_angle=angle)))
        for track, angle in ((ONE_PROFILE[0], 0.0), (ONE_PROFILE[-1], 90.0))
    )
    headline(figure, f"The LMRP {along} the platform along the current and {across} it across")
    return figure


def _trails(*astern: float) -> str:
    """What the LMRP does that is so far astern (m), in one word where both interpretations agree."""
    return " or ".join(sorted({"trails" if one > 0.0 else "leads" for one in astern}))


def fig14(riser_length: xr.Dataset) -> Figure:
    """The same for three lengths of riser."""
    lengths = (1800.0, 1500.0, 1200.0)  # the base case first, as in Figs 9 and 10
    figure = three_panels(riser_length, "riser_length", lengths, "riser {:g} m", AGAINST)
    for line in figure.axes[0].lines:
        label_line(figure.axes[0], line, 0.0, (-5.0, 0.0))
    change = changes(riser_length, "riser_length", 1200.0, 1800.0)
    least = min(change, key=lambda name: change[name])
    verb = "decreases" if change[least] < 0.0 else "increases"
    headline(
        figure,
        f"A longer riser {verb} the {least} by {abs(change[least]):.0f} %; published: an increase",
    )
    return figure


def _by_profile(quantity: str, runs: xr.Dataset, axis: str, first: float, last: float) -> str:
    """How the displacement changes along an axis in the two profiles that are drawn, in words."""
    profiles = [runs.isel(current_profile=k, drop=True) for k in (0, -1)]
    low, high = sorted(round(changes(run, axis, first, last)["displacement"]) for run in profiles)
    if low < 0 < high:
        return f"A faster {quantity} changes the displacement by {low} or {high:+} %, depending on profile"
    verb = "increases" if high > 0 else "decreases"
    least, most = sorted((abs(low), abs(high)))
    between = f"{least} or {most}" if least < most else f"{most}"
    return f"A faster {quantity} {verb} the displacement by {between} %, depending on profile"


def trends(
    lmrp_mass: xr.Dataset,
    current_speed: xr.Dataset,
    platform_speed: xr.Dataset,
    riser_length: xr.Dataset,
    track_angle: xr.Dataset,
) -> Figure:
    """Change of displacement, moment and joint angle at 130 s over the change of each input, both in %.

    Solid and dashed as in Figs 11 and 12: the profile of the current.
    """
    figure, axes = panels(1, 4, 3.7)
    spans = {
        "lmrp_mass": (lmrp_mass, "LMRP {:.0f} to {:.0f} t, current against"),
        "current_speed": (current_speed, "current {:.1f} to {:.1f} m/s, along"),
        "platform_speed": (platform_speed, "platform {:.1f} to {:.1f} kn, current along"),
        "riser_length": (riser_length, "riser {:.0f} to {:.0f} m, current against"),
    }
    first, other = (str(name) for name in current_speed["current_profile"].values)
    by_profile: list[dict[str, float]] = [{}, {}]
    for colour, (axis, (runs, label)) in zip(COLOURS, spans.items(), strict=False):
        values = runs[axis].values
        name = label.format(values[0], values[-1])
        varied = "current_profile" in runs.dims
        for k, style in enumerate(("-", "--")):
            if not varied and k == 0:  # these are in the other profile only
                continue
            one = runs.isel(current_profile=-k, drop=True) if varied else runs
            ends = _changes_over_input(
                axes[:3], one, axis, {"ls": style, "color": colour, "lw": WIDTHS.get(axis, 1.5)}
            )
            by_profile[k][in_words(axis)] = ends
        axes[0].plot(
            [], [], color=colour, ls="-" if varied else "--", label=name, lw=WIDTHS.get(axis, 1.5)
        )
    for ax, title in zip(
        axes, ("displacement astern", "largest moment", "joint angle"), strict=False
    ):
        panel_title(ax, title)
        ax.set_xlabel("change of input (%)")
        ax.axhline(0.0, color=GREY, linewidth=0.8)
    axes[0].set_ylabel("change of result (%)")
    _positions(axes[3], track_angle)
    axes[0].plot([], [], color=GREY, label=f"current: {first} (assumed)")
    axes[0].plot([], [], "--", color=GREY, label=f"current: {other} (assumed)")
    headline(figure, _matters_most(by_profile))
    key_below(figure, axes[0], 3)
    return figure


def _changes_over_input(
    axes: list[Axes], runs: xr.Dataset, axis: str, style: dict[str, Any]
) -> float:
    """Draw changes of the results over that of an input, and return the largest quotient at its end."""
    values = runs[axis].values
    along = 100.0 * (values / values[0] - 1.0)
    quotients: list[float] = []
    for ax, curve in zip(axes, _at_the_stated_time(runs), strict=True):
        change = 100.0 * (curve / curve.isel({axis: 0}) - 1.0)
        ax.plot(along, change, **style)
        quotients.append(abs(float(change[-1]) / along[-1]))
    return max(quotients)


def _positions(ax: Axes, track_angle: xr.Dataset) -> None:
    """Displacement of the LMRP along and across the track over its angle."""
    at = track_angle.sel(time=STATED)
    for values, colour, label, share, offset in (
        (-at["lmrp_displacement"], COLOURS[4], "astern", 0.95, (-6.0, 0.0)),
        (at["lmrp_displacement_cross"], COLOURS[6], "across", 0.45, (-5.0, 2.0)),
    ):
        (line,) = ax.plot(track_angle["track_angle"], values, "-.", color=colour, label=label)
        label_line(ax, line, share, offset)
    ax.set_xlabel("track angle (°)")
    ax.set_ylabel("LMRP displacement (m)")
    ax.set_xticks([0, 90, 180])
    panel_title(ax, "power 1/4, 3 m/s,\nseparate speeds")


def _matters_most(by_profile: list[dict[str, float]]) -> str:
    """Which input changes a result most in each profile, per cent of result for per cent of input."""
    most = list(dict.fromkeys(max(ends, key=lambda name: ends[name]) for ends in by_profile))
    condition = " in either profile" if len(most) == 1 else ", depending on profile"
    return f"The results are most sensitive to the {' or the '.join(most)}{condition}"


def _at_the_stated_time(runs: xr.Dataset) -> list[xr.DataArray]:
    """Displacement of the LMRP, largest moment and angle of the joint."""
    at = runs.sel(time=STATED)
    moment = runs["bending_moment_size"].max("s")
    return [abs(at["lmrp_displacement"]), moment, abs(at["ufj_angle"])]
