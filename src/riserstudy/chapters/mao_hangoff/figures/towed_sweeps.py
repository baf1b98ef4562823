"""Figures of Mao, Zeng, Liu on what speed, current, track and length change for a riser that is towed."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import NDArray

from riserstudy.chapters.mao_hangoff.figures.towed_shared import (
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
ONE_PROFILE = ("0 deg, 3 m/s", "45 deg, 3 m/s", "90 deg")  # tracks of Fig 13


def fig11(current_speed: xr.Dataset) -> Figure:
    """The same for three speeds of the current, in two profiles."""
    figure = _two_profiles(current_speed, "current_speed", (1.0, 1.1, 1.2), "current {:g} m/s")
    headline(figure, _by_profile("current", current_speed, "current_speed", 1.0, 1.2))
    return figure


def fig12(platform_speed: xr.Dataset) -> Figure:
    """The same for three speeds of the platform, in two profiles."""
    figure = _two_profiles(platform_speed, "platform_speed", (2.4, 2.5, 2.6), "platform {:g} kn")
    headline(figure, _by_profile("platform", platform_speed, "platform_speed", 2.4, 2.6))
    return figure


def _two_profiles(runs: xr.Dataset, axis: str, values: tuple[float, ...], label: str) -> Figure:
    """Panels in the profile that is drawn first; dashed, shapes and moments in the other."""
    figure = three_panels(as_drawn(runs), axis, values, label, key=False)
    axes = figure.axes
    names = [str(name) for name in runs["current_profile"].values]
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
    """The same for three angles of the track, both speeds in one profile; dashed, speeds apart."""
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
        axes[0].plot(-shape, own, "--", color=colour, lw=0.8)
        axes[1].plot(apart["bending_moment_size"] / 1e3, own, "--", color=colour, lw=0.8)
    axes[0].plot([], [], color=GREY, label="both speeds in one profile")
    axes[0].plot([], [], "--", color=GREY, lw=0.8, label="water and platform apart")
    axes[0].axvline(0.0, color=GREY, lw=0.6)
    for side, word, to in ((-0.03, "ahead ←", "right"), (0.03, "→ astern", "left")):
        axes[0].annotate(
            word, (0.0, 1.0), xycoords=("data", "axes fraction"), xytext=(100.0 * side, -3.0),
            textcoords="offset points", ha=to, va="top", fontsize="x-small",
        )  # fmt: skip
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
    lengths = (1200.0, 1500.0, 1800.0)
    figure = three_panels(riser_length, "riser_length", lengths, "riser {:g} m", key=False)
    for line in figure.axes[0].lines:
        label_line(figure.axes[0], line, 0.0, (-5.0, 0.0))
    change = changes(riser_length, "riser_length", 1200.0, 1800.0)
    least = min(change, key=lambda name: change[name])
    verb = "lowers" if change[least] < 0.0 else "raises"
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
    between = f"{least} to {most}" if least < most else f"{most}"
    return f"A faster {quantity} {verb} the displacement by {between} %, depending on profile"


def trends(
    lmrp_mass: xr.Dataset,
    current_speed: xr.Dataset,
    platform_speed: xr.Dataset,
    riser_length: xr.Dataset,
    track_angle: xr.Dataset,
) -> Figure:
    """Change of displacement, moment and joint angle at 130 s over the change of each input, both in %."""
    figure, axes = panels(1, 4, 3.4)
    spans = {
        "lmrp_mass": (lmrp_mass, "LMRP {:.0f} to {:.0f} t"),
        "current_speed": (current_speed, "current {:.1f} to {:.1f} m/s"),
        "platform_speed": (platform_speed, "platform {:.1f} to {:.1f} kn"),
        "riser_length": (riser_length, "riser {:.0f} to {:.0f} m"),
    }
    ends: dict[str, NDArray[np.float64]] = {}
    for colour, (axis, (full, label)) in zip(COLOURS, spans.items(), strict=False):
        curves = _at_the_stated_time(as_drawn(full))
        values = curves[0][axis].values
        along = 100.0 * (values / values[0] - 1.0)
        changes = [100.0 * (curve / curve.isel({axis: 0}) - 1.0) for curve in curves]
        name = label.format(values[0], values[-1])
        for ax, change in zip(axes, changes, strict=False):
            ax.plot(along, change, color=colour, label=name)
        words = axis.replace("_", " ").replace("lmrp", "LMRP")
        ends[words] = np.array([float(change[-1]) / along[-1] for change in changes])
    titles = ("LMRP astern", "largest moment", "joint angle")
    for ax, title in zip(axes, titles, strict=False):
        panel_title(ax, title)
        ax.set_xlabel("change of input (%)")
        ax.axhline(0.0, color=GREY, linewidth=0.8)
    axes[0].set_ylabel("change of result (%)")
    at = as_drawn(track_angle).sel(time=STATED)
    angle = track_angle["track_angle"]
    for values, style, label in (
        (-at["lmrp_displacement"], "-", "astern"),
        (at["lmrp_displacement_cross"], "--", "across"),
    ):
        axes[3].plot(angle, values, style, color=COLOURS[4], label=label)
    axes[3].set_xlabel("track angle (°)")
    axes[3].set_ylabel("place of the LMRP (m)")
    axes[3].set_xticks([0, 90, 180])
    panel_title(axes[3], "tracks in 3 m/s")
    for line, share, offset in zip(
        axes[3].lines, (0.95, 0.45), ((-6.0, 0.0), (-5.0, 2.0)), strict=True
    ):
        label_line(axes[3], line, share, offset)
    most = max(ends, key=lambda name: float(abs(ends[name]).max()))
    least = min(ends, key=lambda name: float(abs(ends[name]).max()))
    headline(
        figure,
        f"Per cent for per cent the {most} matters most, the {least} least",
    )
    key_below(figure, axes[0], 4)
    return figure


def _at_the_stated_time(runs: xr.Dataset) -> list[xr.DataArray]:
    """Displacement of the LMRP, largest moment and angle of the joint."""
    at = runs.sel(time=STATED)
    moment = runs["bending_moment_size"].max("s")
    return [abs(at["lmrp_displacement"]), moment, abs(at["ufj_angle"])]
