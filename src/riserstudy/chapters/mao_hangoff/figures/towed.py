"""Figures of Mao, Zeng, Liu on a riser that is towed: the printed ones by number.

Displacements are distances behind the platform, along its track; depths count from the upper flex joint.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from riserstudy.chapters.mao_hangoff.figures.towed_shared import (
    AGAINST,
    ASTERN,
    NESTED,
    TIME,
    changes,
    down,
    three_panels,
)
from riserstudy.chapters.mao_hangoff.runs import STATED
from riserstudy.chapters.mao_hangoff.towed import displacement
from riserstudy.figures.direct import label_ends, label_line
from riserstudy.figures.insets import enlarge
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    PRINTED,
    headline,
    legend_below,
    panel_title,
    panels,
)

TIMES = (10.0, 40.0, 70.0, 100.0, 130.0)  # s, of Fig 9c
START = (4.0, 8.0, 12.0)  # s, up to where Fig 4 ends
DEPTHS = (0.0, 1000.0, 1500.0)  # m, of Fig 9d
#: shapes of the current by what their names contain, with the titles of their panels
FAMILIES = {
    "none below": "uniform to 100 m,\nzero below the depth shown",
    "exponential": "exponential,\ndecay length",
    "": "power of height",
}
MIDDLE, DEEPEST = 700.0, 1800.0  # m, depths of Fig 8: where lines are named, and its last
#: of lines that are close: name in the figure, its depth (m), and how far away it is (points)
PLACES = {
    "uniform to 100 m, none below 300 m": ("300 m", 190.0, (-2.0, 3.0)),
    "uniform to 100 m, none below 500 m": ("500 m", 340.0, (3.0, -4.0)),
    "exponential 100 m": ("100 m", 290.0, (5.0, 0.0)),
    "exponential 300 m": ("300 m", 420.0, (5.0, 0.0)),
    "exponential 700 m": ("700 m", 1100.0, (5.0, 0.0)),
    "uniform": ("0 (uniform)", DEEPEST, (-0.5, -4.0)),
    "power 1/7": ("1/7", 1500.0, (4.0, 0.0)),
    "power 1/4": ("1/4 (Figs\n11 to 13)", 1500.0, (-4.0, 1.0)),
    "linear to the seabed": ("1 (linear)", 700.0, (-5.0, 0.0)),
}
SIGNED = "bending moment at 130 s, signed (kN m)"
OWN_MESH = "computed, 50 elements and\n0.00163 s as the paper"
HEAVE = 10.0  # s, period of the base case's heave
plasma, viridis = colormaps["plasma"], colormaps["viridis"]


def fig04(hangoff_ref_start: xr.Dataset) -> Figure:
    """Shape and moment in the first 12 s of the case without open inputs, by both integrators."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    runs = hangoff_ref_start
    shapes, moments = -displacement(runs), runs["bending_moment"] / 1e3
    depth = float(runs["s"][-1]) - runs["s"]
    for ax, curves in zip(axes, (shapes, moments), strict=True):
        for colour, time in zip(viridis(np.linspace(0.0, 0.8, len(START))), START, strict=True):
            at = curves.sel(time=time)
            (line,) = ax.plot(
                at.sel(integrator="implicit"), depth, color=colour, lw=1.2, label=f"{time:g} s"
            )
            ax.plot(at.sel(integrator="explicit"), depth, ".", color=colour, ms=4)
            if ax is axes[0]:
                label_line(ax, line, 0.1)
    _name_largest_difference(axes[1], moments.sel(time=list(START)), depth)
    for ax, title in zip(axes, ("shape", "bending moment"), strict=True):
        panel_title(ax, title)
    implicit = axes[1].plot([], [], color=GREY, label="implicit")
    explicit = axes[1].plot([], [], ".", color=GREY, ms=4, label="explicit")
    down(axes[0], ASTERN)
    axes[0].margins(x=0.14)  # room for the last time
    axes[1].set_xlabel("bending moment (kN m)")
    axes[1].legend(handles=[*implicit, *explicit], fontsize="small", loc="lower right")
    shares = []
    for curves in (shapes, moments):
        at = curves.sel(time=list(START))
        apart = abs(at.sel(integrator="explicit") - at.sel(integrator="implicit")).max()
        shares.append(100.0 * float(apart / abs(at).max()))
    headline(
        figure,
        f"Shapes by implicit and explicit integration agree to {shares[0]:.1g} %, "
        f"moments to {shares[1]:.1g} %",
    )
    return figure


def _name_largest_difference(ax: Axes, moments: xr.DataArray, depth: xr.DataArray) -> None:
    """Point to where moments (kN m) by both integrators differ most."""
    implicit, explicit = (moments.sel(integrator=name) for name in ("implicit", "explicit"))
    apart = abs(explicit - implicit)
    at = apart.argmax(...)
    there = apart.isel(at)
    ax.annotate(
        f"largest difference,\n{float(there):.1g} kN m at {float(there['time']):g} s",
        (float(explicit.isel(at)), float(depth.isel(s=at["s"]))), xytext=(0.97, 0.5),
        textcoords="axes fraction", ha="right", va="top", fontsize="small",
        arrowprops={"arrowstyle": "-", "color": GREY, "shrinkB": 3.0},
    )  # fmt: skip


def fig07(pe_pipe: xr.Dataset) -> Figure:
    """Shape of the PE pipe at several speeds."""
    figure, (ax,) = panels(height=3.8)
    below = float(pe_pipe["s"][-1]) - pe_pipe["s"]
    speeds = pe_pipe["current_speed"].values
    for colour, speed in zip(viridis(np.linspace(0.0, 0.85, len(speeds))), speeds, strict=True):
        for line, filling in (("-", "flooded"), (":", "closed")):
            shape = pe_pipe["x"].sel(current_speed=speed, filling=filling)
            label = f"{speed:g} m/s" if filling == "flooded" else None
            (drawn,) = ax.plot(1e3 * shape, 1e3 * below, line, color=colour, label=label)
            if label:
                label_line(ax, drawn, 0.0, (0.0, -3.0))
    keys = [
        *ax.plot([], [], "-", color=GREY, label="flooded"),
        *ax.plot([], [], ":", color=GREY, label="closed"),
    ]
    ax.set_xlabel("deflection (mm)")
    ax.set_ylabel("distance from the clamp (mm)")
    ax.set_ylim(1.09e3 * float(below.max()), -0.04e3 * float(below.max()))
    ax.legend(handles=keys, fontsize="small")
    tip = pe_pipe["x"].isel(s=0).sel(filling="flooded")
    power = np.log(float(tip[-1] / tip[0])) / np.log(float(speeds[-1] / speeds[0]))
    headline(
        figure, f"The tip deflection increases with speed to the power {power:.1f} (speeds assumed)"
    )
    return figure


def fig08(current_profiles: xr.Dataset) -> Figure:
    """Current over depth: the surface speeds of Fig 11, and the shapes that the text leaves open."""
    figure, axes = panels(1, 4, 3.7, sharey=True)
    share = current_profiles["current_share"]
    depth, shapes = share["below_surface"], [str(one) for one in share["current_profile"].values]
    for colour, speed in zip(COLOURS, (1.0, 1.1, 1.2), strict=False):
        axes[0].plot(
            _while_it_flows(speed * share[0]), depth, color=colour, label=f"{speed:.1f} m/s"
        )
    axes[0].legend(
        fontsize="small", loc="lower right", title="at the surface", title_fontsize="small"
    )
    axes[0].set_xlabel("current speed (m/s)")
    panel_title(axes[0], "shape of Figs 9 and 10")
    for ax, family in zip(axes[1:], FAMILIES, strict=True):
        of_family = [shape for shape in shapes if _family(shape) == family]
        layer = family == "none below"
        widths = (
            (2.8, 1.4) if layer else (1.5,) * len(of_family)
        )  # where they coincide both are seen
        colours = COLOURS[4:] if layer else COLOURS[3:]  # a colour a depth of 300 m
        for colour, width, shape in zip(colours, widths, of_family, strict=False):
            curve = _while_it_flows(share.sel(current_profile=shape))
            (line,) = ax.plot(curve, depth, color=colour, lw=width, label=shape)
            name, level, away = PLACES.get(shape, (shape, MIDDLE, (5.0, 0.0)))
            label_line(ax, line, level / float(depth.max()), away, name=name, size="x-small")
        ax.set_xlabel("speed / surface speed")
        panel_title(ax, FAMILIES[family])
    axes[0].set_ylabel("depth below the surface (m)")
    axes[0].set_ylim(1.12 * float(depth.max()), -0.05 * float(depth.max()))  # room for a name
    headline(figure, "Current over depth: surface speeds as printed, shapes assumed")
    return figure


def _family(shape: str) -> str:
    """Panel of Fig 8 in which a shape of the current is drawn."""
    return next((family for family in FAMILIES if family in shape), "")


def _while_it_flows(speed: xr.DataArray) -> xr.DataArray:
    """A current down to where less than a hundredth of it is left, so that no line lies on the axis."""
    return speed.where(speed > 0.01 * float(speed.max()))


def fig09(
    base: xr.Dataset, base_runs: xr.Dataset, variants: xr.Dataset, heavy: float, moment: float
) -> Figure:
    """The evacuation of Table 2: shape, moment, shapes in time, axial motion; the paper's own setting.

    ``heavy``: printed distance (m); ``moment``: printed largest moment (kN m).
    """
    figure, axes = panels(2, 2, 3.6)
    depth = float(base["s"][-1]) - base["s"]
    axes[0].plot(-base["displacement_along"].sel(time=STATED), depth, color=COLOURS[0])
    axes[0].axvline(heavy, **PRINTED)
    _number(axes[0], heavy, 1.0, f"{heavy:g} m")
    at_130 = base_runs["bending_moment"].sel(time=STATED) / 1e3
    turn = _sign_of_largest(at_130)
    ours = turn * at_130
    at_joint = float(ours.isel(s=-1))
    axes[1].plot(ours, depth, color=COLOURS[0])
    style: dict[str, Any] = {"color": COLOURS[0], "ms": 4, "clip_on": False}
    cycle = turn * base_runs["bending_moment"].sel(time=slice(STATED - HEAVE, STATED)) / 1e3
    least, most = cycle.min("time"), cycle.max("time")
    band = axes[1].fill_betweenx(depth, least, most, color="0.8", linewidth=0.0)
    minus = f"{at_joint:.1f}".replace("-", "−")
    axes[1].plot(at_joint, 0.0, "o", **style)
    axes[1].annotate(
        f"at the joint:\n{minus} kN m", (at_joint, 0.0), xytext=(4.0, -8.0), fontsize="small",
        textcoords="offset points", va="top", color=COLOURS[0],
    )  # fmt: skip
    axes[1].axvline(moment, **PRINTED)
    _number(axes[1], moment, 0.0, f"{moment:g} kN m")
    own = variants.sel(variant="mesh and step of the paper")
    shape = -displacement(own).sel(time=STATED).dropna("s")
    theirs = own["bending_moment"].sel(time=STATED).dropna("s") / 1e3
    theirs = _sign_of_largest(theirs) * theirs
    for ax, curve in zip(axes, (shape, theirs), strict=False):
        ax.plot(curve, float(curve["s"][-1]) - curve["s"], ":", color=COLOURS[1])
    _peak(axes[1], theirs)
    axes[1].set_xlim(right=1.36 * float(theirs.max()))  # room for its number
    titles = (
        f"shape at 130 s, {AGAINST}",
        "moment at 130 s",
        "shapes in time",
        "axial motion, by depth below the joint",
    )
    for ax, title in zip(axes, titles, strict=True):
        panel_title(ax, title)
    for colour, time in zip(viridis(np.linspace(0.0, 0.85, len(TIMES))), TIMES, strict=True):
        shape = -base["displacement_along"].sel(time=time)
        (drawn,) = axes[2].plot(shape, depth, color=colour, label=f"{time:g} s")
        label_line(axes[2], drawn, 0.0, (0.0, -3.0), size="x-small")
    _axial_motion(axes[3], base_runs["z"])
    for ax, label in zip(axes, (ASTERN, SIGNED, ASTERN), strict=False):
        down(ax, label)
    axes[2].set_ylim(bottom=1.09 * float(depth.max()))  # room for the times
    axes[2].margins(x=0.09)
    known = (
        (Line2D([], [], color=COLOURS[0]), "computed, fine mesh"),
        (Line2D([], [], color=COLOURS[1], ls=":"), OWN_MESH),
        (Line2D([], [], **PRINTED), "printed"),
        (band, f"(b) range in {HEAVE:g} s of heave"),
    )
    legend_below(figure, [handle for handle, _ in known], [label for _, label in known], 4)
    away = float(-base["displacement_along"].sel(time=STATED).isel(s=0))
    headline(
        figure,
        f"The LMRP trails by {away:.1f} m (calibrated), the moment reaches {float(ours.max()):.1f} kN m",
    )
    label_ends(axes[3])
    return figure


def _axial_motion(ax: Axes, z: xr.DataArray) -> None:
    """Heights over time at several depths; below the joint they nearly coincide, the deeper drawn inside."""
    shades = plasma(np.linspace(0.0, 0.85, len(DEPTHS)))
    for colour, width, below in zip(shades, (1.0, *NESTED[:2]), DEPTHS, strict=True):
        at = z.sel(s=float(z["s"][-1]) - below, method="nearest")
        name = f"{below:g} m" if below else "joint"
        ax.plot(at["time"], at - at[0], color=colour, lw=width, label=name)
    ax.set_xlabel(TIME)
    ax.set_ylabel("axial motion (m)")


def _number(ax: Axes, x: float, up: float, text: str) -> None:
    """Write the number of an upright line at its left, at its upper (1) or lower end (0)."""
    ax.annotate(
        text, (x, up), xycoords=("data", "axes fraction"), xytext=(-3.0, 4.0 - 8.0 * up),
        textcoords="offset points", ha="right", va="top" if up else "bottom", fontsize="small",
    )  # fmt: skip


def _peak(ax: Axes, moment: xr.DataArray) -> None:
    """Write the largest moment of the paper's mesh beside its peak."""
    most = moment.isel(s=int(moment.argmax("s")))
    ax.annotate(
        f"{float(most):.1f} kN m", (float(most), float(moment["s"][-1] - most["s"])), xytext=(4.0, 0.0),
        textcoords="offset points", ha="left", va="center", fontsize="x-small", color=COLOURS[1],
    )  # fmt: skip


def _sign_of_largest(moment: xr.DataArray) -> float:
    """Sign of a moment over s where it is largest: times it, the largest is positive."""
    return float(np.sign(moment.isel(s=int(abs(moment).argmax("s")))))


def fig10(lmrp_mass: xr.Dataset, heavy: float, light: float, moment: float) -> Figure:
    """Shape, moment and axial motion for three LMRP masses.

    ``heavy``, ``light``: printed distances with 140 and 120 t (m); ``moment``: printed largest moment (kN m).
    """
    masses = (140.0, 130.0, 120.0)
    figure = three_panels(lmrp_mass, "lmrp_mass", masses, "LMRP {:g} t", AGAINST)
    shapes, moments = figure.axes[:2]
    for ax in (shapes, moments):  # masses change little
        for line, width in zip(ax.lines, NESTED, strict=True):
            line.set_linewidth(width)
    blue, _, green = (line.get_color() for line in shapes.lines)
    far = (heavy, light)
    printed = [
        shapes.axvline(
            value, label=f"printed, {mass} t: {value:g} m", **(PRINTED | {"color": colour})
        )
        for value, mass, colour in zip(far, (140, 120), (blue, green), strict=True)
    ]
    name = f"printed, 140 t: {moment:g} kN m"
    printed.append(moments.axvline(moment, label=name, **(PRINTED | {"color": blue})))
    shapes.set_xlim(right=1.05 * light)
    length = float(lmrp_mass["s"][-1])
    near = (0.9 * heavy, 1.02 * light)
    enlarge(shapes, (0.2, 0.1, 0.42, 0.36), near, (0.87 * length, 1.01 * length))
    size = lmrp_mass["bending_moment_size"] / 1e3
    top = float(size.max())
    deep = length - float(size["s"][int(size.max("lmrp_mass").argmax("s"))])
    enlarge(moments, (0.36, 0.28, 0.58, 0.36), (0.9 * top, 1.05 * top), (deep - 60, deep + 40))
    key = [line for pair in zip(shapes.lines[:3], printed, strict=True) for line in pair]
    legend_below(figure, key, [str(line.get_label()) for line in key], 3)
    change = changes(lmrp_mass, "lmrp_mass", 140.0, 120.0)["displacement"]
    headline(
        figure,
        f"A lighter LMRP trails {change:.0f} % farther; published: {100.0 * (light / heavy - 1.0):.0f} %",
    )
    return figure
