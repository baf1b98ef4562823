"""Figures of Mao, Zeng, Liu: the printed ones by number, others by what they show.

Displacements are distances behind the platform, along its track; depths count from the upper flex joint.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from riserstudy.chapters.mao_hangoff.runs import STATED, as_drawn
from riserstudy.chapters.mao_hangoff.towed import displacement
from riserstudy.figures.insets import close_up, enlarge
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    PRINTED,
    headline,
    key_below,
    panel_title,
    panels,
)

ASTERN, DEPTH = "displacement astern (m)", "depth below the joint (m)"
MOMENT = "bending moment at 130 s (kN m)"
RISE = "rise of the LMRP (m)"
TIME = "time (s)"
TIMES = (10.0, 40.0, 70.0, 100.0, 130.0)  # s, of Fig 9c
START = (4.0, 8.0, 12.0)  # s, up to where Fig 4 ends
DEPTHS = (0.0, 1000.0, 1500.0, 1800.0)  # m, of Fig 9d, and the LMRP
ONE_PROFILE = ("0 deg, 3 m/s", "45 deg, 3 m/s", "90 deg")  # tracks of Fig 13
SIGNED = "bending moment at 130 s, signed (kN m)"
HEAVE = 10.0  # s, period of the base case's heave
viridis = colormaps["viridis"]


# printed figures


def fig04(hangoff_ref_start: xr.Dataset) -> Figure:
    """Shape and moment in the first 12 s of the case without open inputs, by both integrators."""
    figure, axes = panels(1, 2, 3.8)
    runs = hangoff_ref_start
    shapes, moments = -displacement(runs), runs["bending_moment"] / 1e3
    depth = float(runs["s"][-1]) - runs["s"]
    for ax, curves in zip(axes, (shapes, moments), strict=True):
        for colour, time in zip(viridis(np.linspace(0.0, 0.8, len(START))), START, strict=True):
            at = curves.sel(time=time)
            ax.plot(at.sel(integrator="implicit"), depth, color=colour, label=f"{time:g} s")
            ax.plot(at.sel(integrator="explicit"), depth, ".", color=colour, ms=4)
    axes[1].plot([], [], color=GREY, label="implicit")
    axes[1].plot([], [], ".", color=GREY, ms=4, label="explicit")
    _down(axes[0], ASTERN)
    _down(axes[1], "bending moment (kN m)")
    axes[1].legend(fontsize="small", loc="lower right")
    shares = []
    for curves in (shapes, moments):
        at = curves.sel(time=list(START))
        apart = abs(at.sel(integrator="explicit") - at.sel(integrator="implicit")).max()
        shares.append(100.0 * float(apart / abs(at).max()))
    headline(
        figure,
        f"Shapes by implicit and explicit stepping agree to {shares[0]:.1g} %, moments to {shares[1]:.1g} %",
    )
    return figure


def fig07(pe_pipe: xr.Dataset) -> Figure:
    """Shape of the PE pipe at several speeds."""
    figure, (ax,) = panels(height=3.8)
    below = float(pe_pipe["s"][-1]) - pe_pipe["s"]
    speeds = pe_pipe["current_speed"].values
    for colour, speed in zip(viridis(np.linspace(0.0, 0.85, len(speeds))), speeds, strict=True):
        for line, filling in (("-", "flooded"), (":", "closed")):
            shape = pe_pipe["x"].sel(current_speed=speed, filling=filling)
            label = f"{speed:g} m/s" if filling == "flooded" else None
            ax.plot(1e3 * shape, 1e3 * below, line, color=colour, label=label)
    ax.plot([], [], "-", color=GREY, label="flooded")
    ax.plot([], [], ":", color=GREY, label="closed")
    ax.set_xlabel("deflection (mm)")
    ax.set_ylabel("distance from the clamp (mm)")
    ax.invert_yaxis()
    ax.legend(fontsize="small")
    tip = pe_pipe["x"].isel(s=0).sel(filling="flooded")
    power = np.log(float(tip[-1] / tip[0])) / np.log(float(speeds[-1] / speeds[0]))
    headline(figure, f"The tip deflects with the power {power:.1f} of the speed (speeds assumed)")
    return figure


def fig08(current_profiles: xr.Dataset) -> Figure:
    """Current over depth: the surface speeds of Fig 11, and the shapes that the text leaves open."""
    figure, axes = panels(1, 2, 3.7, sharey=True)
    share = current_profiles["current_share"]
    depth, shapes = share["below_surface"], list(share["current_profile"].values)
    for colour, speed in zip(COLOURS, (1.0, 1.1, 1.2), strict=False):
        axes[0].plot(speed * share[0], depth, color=colour, label=f"{speed:g} m/s")
    for k, shape in enumerate(shapes):
        line, colour = ("-", "--")[k // len(COLOURS)], COLOURS[k % len(COLOURS)]
        axes[1].plot(share.sel(current_profile=shape), depth, line, color=colour, label=str(shape))
    for ax, title in zip(axes, (str(shapes[0]), "1 m/s at the surface"), strict=True):
        ax.set_xlabel("current speed (m/s)")
        panel_title(ax, title)
    axes[0].set_ylabel("depth below the surface (m)")
    axes[0].invert_yaxis()
    axes[0].legend(fontsize="small")
    key_below(figure, axes[1], 4)
    headline(figure, "Current over depth: surface speeds as printed, shapes assumed")
    return figure


def fig09(
    base: xr.Dataset, base_runs: xr.Dataset, variants: xr.Dataset, heavy: float, moment: float
) -> Figure:
    """The evacuation of Table 2: shape, moment, shapes in time, axial motion; the paper's own setting.

    ``heavy``: printed distance (m); ``moment``: printed largest moment (kN m).
    """
    figure, axes = panels(2, 2, 3.6)
    depth = float(base["s"][-1]) - base["s"]
    axes[0].plot(-base["displacement_along"].sel(time=STATED), depth, color=COLOURS[0])
    axes[0].axvline(heavy, label=f"printed at the LMRP: {heavy:g} m", **PRINTED)
    at_130 = base_runs["bending_moment"].sel(time=STATED) / 1e3
    turn = _sign_of_largest(at_130)
    ours = turn * at_130
    at_joint = float(ours.isel(s=-1))
    axes[1].plot(ours, depth, color=COLOURS[0])
    style: dict[str, Any] = {"color": COLOURS[0], "ms": 4, "clip_on": False}
    cycle = turn * base_runs["bending_moment"].sel(time=slice(STATED - HEAVE, STATED)) / 1e3
    least, most = cycle.min("time"), cycle.max("time")
    axes[1].fill_betweenx(
        depth, least, most, color="0.8", linewidth=0.0, label=f"last {HEAVE:g} s, a heave cycle"
    )
    minus = f"{at_joint:.1f}".replace("-", "−")
    axes[1].plot(at_joint, 0.0, "o", label=f"at the joint: {minus} kN m", **style)
    axes[1].axvline(moment, label=f"printed: {moment:g} kN m", **PRINTED)
    own = variants.sel(variant="mesh and step of the paper")
    shape = -displacement(own).sel(time=STATED).dropna("s")
    theirs = own["bending_moment"].sel(time=STATED).dropna("s") / 1e3
    theirs = _sign_of_largest(theirs) * theirs
    for ax, curve in zip(axes, (shape, theirs), strict=False):
        ax.plot(
            curve,
            float(curve["s"][-1]) - curve["s"],
            ":",
            color=COLOURS[1],
            label="mesh and step of the paper" if ax is axes[0] else None,
        )
    panel_title(axes[0], "130 s")
    for colour, time in zip(viridis(np.linspace(0.0, 0.85, len(TIMES))), TIMES, strict=True):
        shape = -base["displacement_along"].sel(time=time)
        axes[2].plot(shape, depth, color=colour, label=f"{time:g} s")
    z = base_runs["z"]
    for colour, line, below in zip(COLOURS, ("-", "-", "-", "--"), DEPTHS, strict=False):
        at = z.sel(s=float(z["s"][-1]) - below, method="nearest")
        axes[3].plot(at["time"], at - at[0], line, color=colour, lw=1.1, label=f"{below:g} m")
    for ax, label in zip(axes, (ASTERN, SIGNED, ASTERN), strict=False):
        _down(ax, label)
    axes[3].set_xlabel(TIME)
    axes[3].set_ylabel("axial motion (m)")
    for ax in axes:
        ax.legend(fontsize="small")
    axes[1].legend(fontsize="x-small", loc=(0.36, 0.3))  # clear of the curves
    away = float(-base["displacement_along"].sel(time=STATED).isel(s=0))
    headline(
        figure,
        f"The LMRP trails by {away:.1f} m, the moment reaches {float(ours.max()):.1f} kN m (calibrated)",
    )
    return figure


def _sign_of_largest(moment: xr.DataArray) -> float:
    """Sign of a moment over s where it is largest: times it, the largest is positive."""
    return float(np.sign(moment.isel(s=int(abs(moment).argmax("s")))))


def fig10(lmrp_mass: xr.Dataset, heavy: float, light: float, moment: float) -> Figure:
    """Shape, moment and axial motion for three LMRP masses.

    ``heavy``, ``light``: printed distances with 140 and 120 t (m); ``moment``: printed largest moment (kN m).
    """
    figure = _three(lmrp_mass, "lmrp_mass", (140.0, 130.0, 120.0), "LMRP {:g} t")
    shapes, moments = figure.axes[:2]
    blue, _, green = (line.get_color() for line in shapes.lines)
    far = (heavy, light)
    for value, colour in zip(far, (blue, green), strict=True):
        shapes.axvline(value, label=f"printed: {value:g} m", **(PRINTED | {"color": colour}))
    moments.axvline(moment, label=f"printed: {moment:g} kN m", **(PRINTED | {"color": blue}))
    shapes.set_xlim(right=1.05 * light)
    length = float(lmrp_mass["s"][-1])
    near = (0.9 * heavy, 1.02 * light)
    enlarge(shapes, (0.2, 0.1, 0.42, 0.36), near, (0.87 * length, 1.01 * length))
    size = lmrp_mass["bending_moment_size"] / 1e3
    top = float(size.max())
    deep = length - float(size["s"][int(size.max("lmrp_mass").argmax("s"))])
    enlarge(moments, (0.36, 0.28, 0.58, 0.36), (0.9 * top, 1.05 * top), (deep - 60, deep + 40))
    small: dict[str, Any] = {"fontsize": "x-small", "framealpha": 1.0}
    shapes.legend(handles=shapes.lines[-len(far) :], loc="upper right", **small)
    moments.legend(handles=moments.lines[-1:], loc=(0.38, 0.12), **small)  # clear of the curves
    change = _changes(lmrp_mass, "lmrp_mass", 140.0, 120.0)["displacement"]
    headline(
        figure,
        f"A lighter LMRP trails {change:.0f} % farther; published: {100.0 * (light / heavy - 1.0):.0f} %",
    )
    return figure


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
    """Panels in the profile that is drawn first; dotted, shapes and moments in the other."""
    figure = _three(as_drawn(runs), axis, values, label, key=False)
    axes = figure.axes
    names = [str(name) for name in runs["current_profile"].values]
    other = runs.isel(current_profile=-1, drop=True)
    for colour, value in zip(COLOURS, values, strict=False):
        run = other.sel({axis: value}, method="nearest")
        shape = run["displacement_along"].sel(time=STATED).dropna("s")
        moment = run["bending_moment_size"].dropna("s") / 1e3
        for ax, curve in zip(axes, (-shape, moment), strict=False):
            ax.plot(curve, float(curve["s"][-1]) - curve["s"], ":", color=colour, lw=1.2)
    axes[0].plot([], [], color=GREY, label=f"current: {names[0]} (assumed)")
    axes[0].plot([], [], ":", color=GREY, label=f"current: {names[-1]} (assumed)")
    key_below(figure, axes[0], 5)
    return figure


def fig13(track_angle: xr.Dataset, track_one_profile: xr.Dataset) -> Figure:
    """The same for three angles of the track, both speeds in one profile; dashed, speeds apart."""
    figure, axes = panels(1, 3, 3.7)
    shapes = displacement(track_one_profile).sel(time=STATED)
    moments = abs(track_one_profile["bending_moment"].sel(time=STATED)) / 1e3
    z = track_one_profile["z"].isel(s=0)
    depth = float(shapes["s"][-1]) - shapes["s"]
    for colour, track, angle in zip(COLOURS, ONE_PROFILE, (0.0, 45.0, 90.0), strict=False):
        axes[0].plot(-shapes.sel(track=track), depth, color=colour, label=f"track at {angle:g}°")
        axes[1].plot(moments.sel(track=track), depth, color=colour)
        risen = z.sel(track=track) - z.sel(track=track).isel(time=0)
        axes[2].plot(risen["time"], risen, color=colour, lw=1.0)
        apart = track_angle.sel(track_angle=angle)
        shape = apart["displacement_along"].sel(time=STATED)
        own = float(shape["s"][-1]) - shape["s"]
        axes[0].plot(-shape, own, "--", color=colour, lw=0.8)
        axes[1].plot(apart["bending_moment_size"] / 1e3, own, "--", color=colour, lw=0.8)
    axes[0].plot([], [], color=GREY, label="both speeds in one profile")
    axes[0].plot([], [], "--", color=GREY, lw=0.8, label="water and platform apart")
    axes[0].axvline(0.0, color=GREY, lw=0.6)
    _down(axes[0], ASTERN)
    _down(axes[1], MOMENT)
    axes[2].set_xlabel(TIME)
    axes[2].set_ylabel(RISE)
    key_below(figure, axes[0], 5)
    places = [float(-shapes.sel(track=track).isel(s=0)) for track in ONE_PROFILE]
    headline(
        figure,
        f"The LMRP {_trails(places[0])} along the current, {_trails(places[-1])} across it",
    )
    return figure


def _trails(astern: float) -> str:
    """Where the LMRP is along the track (m), in words."""
    return f"{'trails' if astern > 0.0 else 'leads'} by {abs(astern):.0f} m"


def fig14(riser_length: xr.Dataset) -> Figure:
    """The same for three lengths of riser."""
    figure = _three(riser_length, "riser_length", (1200.0, 1500.0, 1800.0), "riser {:g} m")
    change = _changes(riser_length, "riser_length", 1200.0, 1800.0)
    least = min(change, key=lambda name: change[name])
    verb = "lowers" if change[least] < 0.0 else "raises"
    headline(
        figure,
        f"A longer riser {verb} the {least} by {abs(change[least]):.0f} %; published: an increase",
    )
    return figure


def _by_profile(what: str, runs: xr.Dataset, axis: str, first: float, last: float) -> str:
    """How the displacement changes along an axis in the two profiles that are drawn, in words."""
    profiles = [runs.isel(current_profile=k, drop=True) for k in (0, -1)]
    low, high = sorted(round(_changes(run, axis, first, last)["displacement"]) for run in profiles)
    if low < 0 < high:
        return f"By profile, a faster {what} changes the displacement by {low} or {high:+} %"
    verb = "increases" if high > 0 else "decreases"
    least, most = sorted((abs(low), abs(high)))
    return f"By profile, a faster {what} {verb} the displacement by {least} or {most} %"


def _changes(runs: xr.Dataset, axis: str, first: float, last: float) -> dict[str, float]:
    """Change (%) of displacement, largest moment and largest rise of the LMRP along an axis."""
    ends = [runs.sel({axis: value}, method="nearest") for value in (first, last)]
    ratios = {
        "displacement": [abs(run["lmrp_displacement"].sel(time=STATED)) for run in ends],
        "largest moment": [run["bending_moment_size"].max("s") for run in ends],
        "largest rise": [run["lmrp_rise"].max("time") for run in ends],
    }
    return {name: 100.0 * (float(new) / float(old) - 1.0) for name, (old, new) in ratios.items()}


def _three(
    runs: xr.Dataset, axis: str, values: tuple[float, ...], label: str, key: bool = True
) -> Figure:
    """Panels (a) to (c) of Figs 10 to 14, with their key unless more is to come."""
    figure, axes = panels(1, 3, 3.7)
    for colour, value in zip(COLOURS, values, strict=False):
        run = runs.sel({axis: value}, method="nearest")
        shape = run["displacement_along"].sel(time=STATED).dropna("s")
        moment = run["bending_moment_size"].dropna("s")
        name = label.format(value)
        top = float(shape["s"][-1])
        axes[0].plot(-shape, top - shape["s"], color=colour, label=name)
        axes[1].plot(moment / 1e3, top - moment["s"], color=colour)
        axes[2].plot(run["time"], run["lmrp_rise"], color=colour, lw=1.0)
    _down(axes[0], ASTERN)
    _down(axes[1], MOMENT)
    axes[2].set_xlabel(TIME)
    axes[2].set_ylabel(RISE)
    close_up(axes[2])
    if key:
        key_below(figure, axes[0], 3)
    return figure


def _down(ax: Axes, label: str) -> None:
    ax.set_xlabel(label)
    ax.set_ylabel(DEPTH)
    ax.invert_yaxis()


# beside the paper


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
    axes[3].set_xlabel("track angle (deg)")
    axes[3].set_ylabel("place of the LMRP (m)")
    panel_title(axes[3], "in 3 m/s")
    axes[3].legend(fontsize="small")
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
