"""Figures of Mao, Zeng, Liu on the effects of mass, speeds, track and length on a towed riser."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from chapters.mao_hangoff.figures.colours import OF_INPUT, ordered
from chapters.mao_hangoff.figures.towed_shared import (
    AGAINST,
    ASTERN,
    MOMENT,
    NESTED,
    RISE,
    TIME,
    Label,
    changes,
    down,
    name_upright,
    rise_and_differences,
    sign_of_largest,
    towed_panels,
)
from chapters.mao_hangoff.runs import STATED, as_drawn, track_name
from chapters.mao_hangoff.towed import displacement
from riserstudy.figures.direct import label_line
from riserstudy.figures.insets import enlarge, name_axes
from riserstudy.figures.style import (
    GREY,
    PRINTED,
    headline,
    key_below,
    legend_below,
    mosaic,
    panel_title,
    panels,
)

MASSES = (140.0, 130.0, 120.0)  # t, of the LMRP
UPPER = ((0.0, 9.0), (-10.0, 290.0))  # enlarged ranges of |moment| (kN m) and depth (m) in Figs 11 and 12
SIGNED = "moment at 130 s (kN m)"
TRACKS = {0.0: "track at 0° (along)", 45.0: "track at 45°", 90.0: "track at 90° (across)"}
TOP = 30.0  # m, depth of the enlarged part of Fig 13b
THICK, THIN = 2.0, 0.8  # points, widths of lines of the first and the other profile
ALIKE = 1.0  # %, largest difference of curves that are drawn inside each other
#: tracks in one profile by angle (deg), in a current of 3 m/s, which has no effect across the track
IN_ONE_PROFILE = {a: track_name(a, None if a == 90.0 else 3.0) for a in (0.0, 45.0, 90.0, 135.0, 180.0)}
ONE_PROFILE = [IN_ONE_PROFILE[angle] for angle in TRACKS]  # tracks of Fig 13
#: interpretations of the speeds in Fig 13
ONE = "interpretation 1: current minus platform speed varies with height (power 1/4)"
TWO = "interpretation 2: only the current varies with height (power 1/4)"


def fig10(
    lmrp_mass: xr.Dataset, lmrp_mass_runs: xr.Dataset, heavy: float, light: float, moment: float
) -> Figure:
    """Shapes, moments and axial motions with three LMRPs, and the differences from the heaviest.

    ``heavy``, ``light``: printed distances with 140 and 120 t (m); ``moment``: printed largest moment (kN m).
    """
    figure, axes = mosaic(["a b c", "d e f"], (3.3, 2.6))
    colours = ordered(OF_INPUT["lmrp_mass"], MASSES)
    curves = {
        AGAINST: (-lmrp_mass["displacement_along"].sel(time=STATED), "m"),
        "moment, signed": (_signed_moment(lmrp_mass_runs), "kN m"),
    }
    depth = float(lmrp_mass["s"][-1]) - lmrp_mass["s"]
    for ax, below, (title, (values, unit)) in zip(axes[:2], axes[3:5], curves.items(), strict=True):
        first = values.sel(lmrp_mass=MASSES[0])
        for colour, mass, width in zip(colours, MASSES, NESTED, strict=True):
            of = values.sel(lmrp_mass=mass)
            ax.plot(of, depth, color=colour, lw=width, label=f"LMRP {mass:g} t")
            if mass != MASSES[0]:
                below.plot(of - first, depth, color=colour)
        panel_title(ax, title)
        panel_title(below, f"differences from {MASSES[0]:g} t")
        down(below, f"difference ({unit})")
    for ax, label, value, unit in zip(axes, (ASTERN, SIGNED), (heavy, moment), ("m", "kN m"), strict=False):
        down(ax, label)
        ax.axvline(value, **PRINTED)
        name_upright(ax, value, 0.72, f"{MASSES[0]:g} t, printed:\n{value:g} {unit}")
    rise_and_differences(axes[2], axes[5], lmrp_mass, "lmrp_mass", MASSES, Label("LMRP", "{:g} t"))
    axes[3].axvline(light - heavy, **PRINTED)
    axes[3].set_xlim(right=1.08 * (light - heavy))
    name_upright(axes[3], light - heavy, 0.5, f"120 t, printed:\n{light - heavy:.1f} m")
    lightest = axes[3].lines[1]
    farther = float(np.asarray(lightest.get_xdata())[0])
    label_line(axes[3], lightest, 0.0, (5.0, 2.0), name=f"120 t: {farther:.1f} m")
    lines = axes[0].lines[:4]
    names = [str(line.get_label()) for line in lines[:3]]
    legend_below(figure, lines, [*names, "printed"], 4)
    change = changes(lmrp_mass, "lmrp_mass", 140.0, 120.0)["displacement"]
    headline(
        figure,
        f"A lighter LMRP trails {abs(change):.0f} % {'farther' if change > 0.0 else 'less far'}; "
        f"published: {100.0 * (light / heavy - 1.0):.0f} % farther",
    )
    return figure


def _signed_moment(runs: xr.Dataset) -> xr.DataArray:
    """Bending moment at 130 s (kN m) over mass and s; the largest one with the heaviest LMRP is positive."""
    moment = runs["bending_moment"].sel(time=STATED)
    return sign_of_largest(moment.sel(lmrp_mass=MASSES[0])) * moment / 1e3


def fig11(current_speed: xr.Dataset) -> Figure:
    """Shapes, moments and axial motions for three speeds of the current, in two profiles."""
    held = "current along, platform 2.5 kn"
    label = Label("current", "{:.1f} m/s")
    figure = _two_profiles(current_speed, "current_speed", (1.0, 1.1, 1.2), label, held)
    headline(figure, _by_profile("current", current_speed, "current_speed", 1.0, 1.2))
    return figure


def fig12(platform_speed: xr.Dataset) -> Figure:
    """Shapes, moments and axial motions for three speeds of the platform, in two profiles."""
    held = "current along, 1.2 m/s"
    label = Label("platform", "{:g} kn")
    figure = _two_profiles(platform_speed, "platform_speed", (2.4, 2.5, 2.6), label, held)
    headline(figure, _by_profile("platform", platform_speed, "platform_speed", 2.4, 2.6))
    return figure


def _two_profiles(runs: xr.Dataset, axis: str, values: tuple[float, ...], label: Label, held: str) -> Figure:
    """Panels in the first profile; thin lines are shapes and moments in the other profile.

    ``held``: speed and direction that panel (a) states.
    """
    names = [str(name) for name in runs["current_profile"].values]
    figure = towed_panels(as_drawn(runs), axis, values, label, held)
    axes = figure.axes
    other = runs.isel(current_profile=-1, drop=True)
    change = changes(other, axis, values[0], values[-1])["displacement"]
    for ax in axes:
        for line in ax.lines:
            line.set_linewidth(THICK)
    for colour, value in zip(ordered(OF_INPUT[axis], values), values, strict=True):
        run = other.sel({axis: value}, method="nearest")
        shape = run["displacement_along"].sel(time=STATED).dropna("s")
        moment = run["bending_moment_size"].dropna("s") / 1e3
        for ax, curve in zip(axes, (-shape, moment), strict=False):
            depth = float(curve["s"][-1]) - curve["s"]
            ax.plot(curve, depth, color=colour, lw=THIN)
    if abs(change) < ALIKE:
        axes[0].annotate(
            f"the three thin lines\ndiffer by {abs(change):.1g} %", (0.97, 0.93), xycoords="axes fraction",
            ha="right", va="top", fontsize="small",
        )  # fmt: skip
    inset = enlarge(axes[1], (0.42, 0.44, 0.36, 0.46), *UPPER, widest=THICK)
    name_axes(inset, "|moment| (kN m)", "depth (m)")
    axes[0].plot([], [], color=GREY, lw=THICK, label=f"(a–d) {names[0]} (assumed)")
    axes[0].plot([], [], color=GREY, lw=THIN, label=f"(a, b) {names[-1]} (assumed)")
    key_below(figure, axes[0], 5)
    return figure


def fig13(track_angle: xr.Dataset, track_one_profile: xr.Dataset) -> Figure:
    """Shapes, moments, axial motions for three track angles: one profile, or separate speeds (dash-dotted).

    In addition, the displacement along and across the track over the track angle.
    """
    figure, axes = panels(2, 2, 3.6)
    shapes = displacement(track_one_profile).sel(time=STATED)
    moments = abs(track_one_profile["bending_moment"].sel(time=STATED)) / 1e3
    z = track_one_profile["z"].isel(s=0)
    depth = float(shapes["s"][-1]) - shapes["s"]
    colours = ordered(OF_INPUT["track_angle"], [*TRACKS])
    for colour, track, angle in zip(colours, ONE_PROFILE, TRACKS, strict=True):
        axes[0].plot(-shapes.sel(track=track), depth, color=colour, label=TRACKS[angle])
        axes[1].plot(moments.sel(track=track), depth, color=colour)
        risen = z.sel(track=track) - z.sel(track=track).isel(time=0)
        axes[2].plot(risen["time"], risen, color=colour, lw=1.0)
        apart = track_angle.sel(track_angle=angle)
        shape = apart["displacement_along"].sel(time=STATED)
        own = float(shape["s"][-1]) - shape["s"]
        axes[0].plot(-shape, own, "-.", color=colour, lw=0.8)
        axes[1].plot(apart["bending_moment_size"] / 1e3, own, "-.", color=colour, lw=0.8)
        for of in (shape, shapes.sel(track=track)):
            axes[3].plot(angle, float(-of.isel(s=0)), "o", color=colour, ms=5, zorder=3)
    for line, width, name in (("-", 1.5, ONE), ("-.", 0.8, TWO)):
        axes[0].plot([], [], line, color=GREY, lw=width, label=name)
    axes[0].axvline(0.0, color=GREY, lw=0.6)
    _ahead_and_astern(axes[0])
    titles = (
        "shape at 130 s, current 3 m/s (assumed)",
        "magnitude of the moment",
        "axial motion, interpretation 1",
        "LMRP at 130 s, displacement positive astern",
    )
    for ax, title in zip(axes, titles, strict=True):
        panel_title(ax, title)
    down(axes[0], ASTERN)
    down(axes[1], MOMENT)
    _top(axes[1])
    axes[2].set_xlabel(TIME)
    axes[2].set_ylabel(RISE)
    _along_and_across(axes[3], track_angle, -shapes.isel(s=0))
    key_below(figure, axes[0], 2)
    astern = {
        angle: (float(-shapes.sel(track=track).isel(s=0)),
                float(-track_angle["lmrp_displacement"].sel(time=STATED, track_angle=angle)))
        for angle, track in zip(TRACKS, ONE_PROFILE, strict=True)
    }  # fmt: skip
    headline(figure, _where_astern(astern))
    return figure


def _top(ax: Axes) -> None:
    """Show the top of a panel again in its free corner: the largest moments are within some metres."""
    inset = ax.inset_axes((0.52, 0.2, 0.45, 0.38))
    for line in list(ax.lines):
        inset.plot(
            *line.get_data(), linestyle=line.get_linestyle(), color=line.get_color(), lw=line.get_linewidth()
        )
    inset.set_ylim(TOP, -0.04 * TOP)
    inset.tick_params(labelsize="x-small")
    inset.grid(True, color="0.9", linewidth=0.6)
    inset.set_title(f"upper {TOP:g} m", fontsize="x-small", pad=3.0)
    name_axes(inset, "|moment| (kN m)", "depth (m)")


def _ahead_and_astern(ax: Axes) -> None:
    """Name both sides of the vertical line at zero."""
    for side, word, to in ((-0.03, "ahead ←", "right"), (0.03, "→ astern", "left")):
        ax.annotate(
            word, (0.0, 1.0), xycoords=("data", "axes fraction"), xytext=(100.0 * side, -3.0),
            textcoords="offset points", ha=to, va="top", fontsize="x-small",
        )  # fmt: skip


def _along_and_across(ax: Axes, track_angle: xr.Dataset, astern: xr.DataArray) -> None:
    """Displacement of the LMRP along and across the track, over the track angle.

    ``astern``: along the track in the first interpretation (m), over ``track``; across it there is none.
    """
    at = track_angle.sel(time=STATED)
    across = abs(at["lmrp_displacement_cross"])
    angles = at["track_angle"]
    of_track = {angle: float(astern.sel(track=name)) for angle, name in IN_ONE_PROFILE.items()}
    for x, values, line, label, share, offset in (
        ([*of_track], [*of_track.values()], ".-", "along, 1", 0.8, (6.0, -3.0)),
        (angles, -at["lmrp_displacement"], "-.", "along, 2", 0.85, (-6.0, 2.0)),
        (angles, across, ":", "across, 2", 0.3, (-5.0, 2.0)),
    ):
        (drawn,) = ax.plot(x, values, line, color="black", lw=1.0, label=f"_{label}")
        label_line(ax, drawn, share, offset, name=label)
    most = across.isel(track_angle=int(across.argmax("track_angle")))
    ax.annotate(
        f"{float(most):.0f} m", (float(most["track_angle"]), float(most)), xytext=(0.0, 4.0),
        textcoords="offset points", ha="center", va="bottom", fontsize="small",
    )  # fmt: skip
    ax.axhline(0.0, color=GREY, lw=0.6)
    ax.set_xlabel("track angle (°)")
    ax.set_ylabel("LMRP displacement (m)")
    ax.set_xticks(np.arange(0.0, 181.0, 45.0))


def _where_astern(astern: dict[float, tuple[float, float]]) -> str:
    """Title: tracks on which the LMRP is ahead or astern (m, by both interpretations) of the platform."""
    ahead = [angle for angle, found in astern.items() if max(found) < 0.0]
    trailing = [angle for angle, found in astern.items() if min(found) > 0.0]
    if len(ahead) + len(trailing) < len(astern) or (ahead and trailing and max(ahead) > min(trailing)):
        return "Whether the LMRP is ahead of the platform depends on interpretation and track"
    if not (ahead and trailing):
        return f"The LMRP is {'ahead' if ahead else 'astern'} of the platform on all three tracks"
    return f"Up to {max(ahead):g}° the LMRP leads the platform; at {min(trailing):g}° it trails"


def fig14(riser_length: xr.Dataset) -> Figure:
    """Shapes, moments and axial motions for three riser lengths."""
    lengths = (1800.0, 1500.0, 1200.0)  # the base case first, as in Figs 9 and 10
    label = Label("riser", "{:g} m")
    figure = towed_panels(riser_length, "riser_length", lengths, label, AGAINST)
    shapes, moments = figure.axes[:2]
    for length, of_shape, of_moment in zip(lengths, shapes.lines, moments.lines, strict=True):
        label_line(shapes, of_shape, 0.0, (-5.0, 0.0))
        x = np.asarray(of_moment.get_xdata(), dtype=float)
        share = float(np.argmax(x[: len(x) // 2])) / (len(x) - 1)  # of the LMRP peak
        label_line(moments, of_moment, share, (5.0, 0.0), name=label.short(length))
    change = changes(riser_length, "riser_length", 1200.0, 1800.0)
    least = min(change, key=lambda name: change[name])
    verb = "decreases" if change[least] < 0.0 else "increases"
    headline(
        figure, f"A longer riser {verb} the {least} by {abs(change[least]):.0f} %; published: an increase"
    )
    return figure


def _by_profile(quantity: str, runs: xr.Dataset, axis: str, first: float, last: float) -> str:
    """Title: change of the displacement along an axis in both plotted profiles."""
    profiles = [runs.isel(current_profile=k, drop=True) for k in (0, -1)]
    found = sorted(changes(run, axis, first, last)["displacement"] for run in profiles)
    low, high = (f"{abs(change):{'.0f' if round(change) else '.1g'}}" for change in found)
    if found[0] < 0.0 < found[1]:
        return f"A faster {quantity} changes the displacement by −{low} or +{high} %, depending on profile"
    if min(map(abs, found)) < ALIKE:
        verb, most = ("increases", high) if sum(found) > 0.0 else ("decreases", low)
        return f"A faster {quantity} {verb} the displacement by up to {most} %"
    verb, least, most = ("increases", low, high) if found[1] > 0.0 else ("decreases", high, low)
    between = f"{least} or {most}" if least != most else most
    return f"A faster {quantity} {verb} the displacement by {between} %, depending on profile"
