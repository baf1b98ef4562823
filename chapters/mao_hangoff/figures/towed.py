"""Figures of Mao, Zeng, Liu on a towed riser, with the numbers of the printed figures.

Displacements are distances behind the platform, along its track; depths are below the upper flex joint.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from chapters.mao_hangoff.figures.colours import (
    FINE_MESH,
    MESH_OF_PAPER,
    OF_COORDINATE,
    OF_INPUT,
    OF_MESH,
    PROFILE,
    ordered,
)
from chapters.mao_hangoff.figures.towed_shared import (
    AGAINST,
    ASTERN,
    NESTED,
    TIME,
    down,
    name_upright,
    sign_of_largest,
)
from chapters.mao_hangoff.runs import STATED, at_nodes_of_paper
from chapters.mao_hangoff.towed import displacement
from riserstudy.figures.direct import label_ends, label_line, legible
from riserstudy.figures.insets import enlarge, name_axes
from riserstudy.figures.style import GREY, PRINTED, headline, legend_below, panel_title, panels

TIMES = (10.0, 40.0, 70.0, 100.0, 130.0)  # s, of Fig 9c
START = (4.0, 8.0, 12.0)  # s, of Fig 4; it ends at the last
DEPTHS = (0.0, 1000.0, 1500.0)  # m, of Fig 9d
#: families of current profiles: part of their names, and titles of their panels
FAMILIES = {
    "none below": "uniform to 100 m,\nzero below the depth shown",
    "exponential": "exponential,\ndecay length",
    "": "power of height",
}
MIDDLE, DEEPEST = 700.0, 1800.0  # m, in Fig 8: depth of line names, and last depth
#: of lines that are close: name in the figure, its depth (m), and its offset (points)
PLACES = {
    "uniform to 100 m, none below 300 m": ("300 m (Figs\n9 to 12, 14)", 170.0, (-3.0, 3.0)),
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
HEAVE = 10.0  # s, period of the base case's heave
UPPER = (-20.0, 180.0)  # m, enlarged range of depth in Fig 9
AROUND = 130.0  # m, of depth above and below the largest difference of Fig 4


def fig04(hangoff_ref_start: xr.Dataset) -> Figure:
    """Shape and moment in the first 12 s of the case without unspecified inputs, by both integrators."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    runs = hangoff_ref_start
    shapes, moments = -displacement(runs), runs["bending_moment"] / 1e3
    depth = float(runs["s"][-1]) - runs["s"]
    for ax, curves in zip(axes, (shapes, moments), strict=True):
        for colour, time in zip(ordered(OF_COORDINATE["time"], START), START, strict=True):
            at = curves.sel(time=time)
            (line,) = ax.plot(at.sel(integrator="implicit"), depth, color=colour, lw=1.2, label=f"{time:g} s")
            ax.plot(at.sel(integrator="explicit"), depth, ".", color=colour, ms=4)
            largest = float(at.sel(integrator="implicit").argmax("s")) / (depth.size - 1.0)
            share, offset = (0.1, (4.0, 0.0)) if ax is axes[0] else (largest, (0.0, 3.0))
            label_line(ax, line, share, offset)
    implicit = axes[1].plot([], [], color=GREY, label="implicit")
    explicit = axes[1].plot([], [], ".", color=GREY, ms=4, label="explicit")
    down(axes[0], ASTERN)
    axes[0].margins(x=0.14)  # room for the label of the last time
    axes[0].set_ylim(top=-0.1 * float(depth.max()))  # and for labels above the moments
    _enlarge_largest_difference(axes[1], moments.sel(time=list(START)), depth)
    axes[1].set_xlabel("bending moment (kN m)")
    axes[1].legend(handles=[*implicit, *explicit], fontsize="small", loc="lower right")
    shares = []
    for curves in (shapes, moments):
        at = curves.sel(time=list(START))
        apart = abs(at.sel(integrator="explicit") - at.sel(integrator="implicit")).max()
        shares.append(100.0 * float(apart / abs(at).max()))
    for ax, title, share in zip(axes, ("shape", "bending moment"), shares, strict=True):
        panel_title(ax, f"{title}: differences up to {share:.1g} %")
    differ = " %, moments by ".join(f"{share:.1g}" for share in shares)
    headline(figure, f"Implicit and explicit shapes differ by {differ} %")
    return figure


def _enlarge_largest_difference(ax: Axes, moments: xr.DataArray, depth: xr.DataArray) -> None:
    """Enlarge the surroundings of the largest difference between the integrators' moments (kN m)."""
    implicit, explicit = (moments.sel(integrator=name) for name in ("implicit", "explicit"))
    apart = abs(explicit - implicit)
    at = apart.argmax(...)
    there = apart.isel(at)
    x, level = float(explicit.isel(at)), float(depth.isel(s=at["s"]))
    near = (x - 1.0, x + 1.2), (level - AROUND, level + AROUND)
    inset = enlarge(ax, (0.47, 0.26, 0.38, 0.38), *near)
    colours = dict(zip(START, ordered(OF_COORDINATE["time"], START), strict=True))
    for line in list(inset.lines):  # only the time of this difference
        if line.get_color() != colours[float(there["time"])]:
            line.remove()
    inset.plot(x, level, "o", color="black", ms=11, mfc="none", mec="black", mew=0.9)
    inset.set_title(
        f"largest difference (circle):\n{float(there):.1g} kN m at {float(there['time']):g} s",
        fontsize="x-small", pad=3.0,
    )  # fmt: skip
    name_axes(inset, "moment (kN m)", "depth (m)")


def fig07(pe_pipe: xr.Dataset) -> Figure:
    """Shape of the PE pipe at several speeds."""
    figure, (ax,) = panels(height=3.8)
    below = float(pe_pipe["s"][-1]) - pe_pipe["s"]
    speeds = pe_pipe["current_speed"].values
    tip = pe_pipe["x"].isel(s=0).sel(filling="flooded")
    for colour, speed in zip(ordered(OF_INPUT["current_speed"], speeds), speeds, strict=True):
        for line, filling in (("-", "flooded"), (":", "closed")):
            shape = pe_pipe["x"].sel(current_speed=speed, filling=filling)
            moved = f"{1e3 * float(tip.sel(current_speed=speed)):#.3g}".removesuffix(".")
            label = f"{speed:g} m/s:\n{moved} mm" if filling == "flooded" else None
            (drawn,) = ax.plot(1e3 * shape, 1e3 * below, line, color=colour, label=label)
            if label:
                label_line(ax, drawn, 0.0, (0.0, -3.0))
    keys = [
        *ax.plot([], [], "-", color=GREY, label="flooded"),
        *ax.plot([], [], ":", color=GREY, label="closed"),
    ]
    ax.set_xlabel("deflection (mm)")
    ax.set_ylabel("length along the pipe from the clamp (mm)")
    ax.set_ylim(1.15e3 * float(below.max()), -0.04e3 * float(below.max()))
    ax.legend(handles=keys, fontsize="small")
    panel_title(ax, "numbers: speed, and deflection of the flooded pipe's tip")
    power = np.log(float(tip[-1] / tip[0])) / np.log(float(speeds[-1] / speeds[0]))
    headline(figure, f"The tip deflection increases with speed to the power {power:.1f} (speeds assumed)")
    return figure


def fig08(current_profiles: xr.Dataset) -> Figure:
    """Current over depth: the surface speeds of Fig 11, and profiles, which the text does not specify."""
    figure, axes = panels(1, 4, 3.7, sharey=True)
    share = current_profiles["current_share"]
    depth, shapes = share["below_surface"], [str(one) for one in share["current_profile"].values]
    speeds = (1.0, 1.1, 1.2)
    for colour, speed in zip(ordered(OF_INPUT["current_speed"], speeds), speeds, strict=True):
        axes[0].plot(speed * share[0], depth, color=colour, label=f"{speed:.1f} m/s")
    axes[0].legend(fontsize="small", loc="lower right", title="at the surface", title_fontsize="small")
    axes[0].set_xlabel("current speed (m/s)")
    panel_title(axes[0], "uniform to 100 m,\nzero below 300 m")
    for ax, family in zip(axes[1:], FAMILIES, strict=True):
        of_family = [shape for shape in shapes if _family(shape) == family]
        flowing = [float(share.sel(current_profile=shape).mean()) for shape in of_family]
        for colour, shape in zip(ordered(PROFILE, flowing), of_family, strict=True):
            (line,) = ax.plot(share.sel(current_profile=shape), depth, color=colour, label=shape)
            name, level, away = PLACES.get(shape, (shape, MIDDLE, (5.0, 0.0)))
            label_line(ax, line, level / float(depth.max()), away, name=name, size="x-small")
        ax.set_xlabel("speed / surface speed")
        panel_title(ax, FAMILIES[family])
    axes[0].set_ylabel("depth below the surface (m)")
    axes[0].set_ylim(1.12 * float(depth.max()), -0.05 * float(depth.max()))  # room for a label
    headline(figure, "Current over depth: surface speeds as printed, shapes assumed")
    return figure


def _family(shape: str) -> str:
    """Key in ``FAMILIES`` of a current profile, and so its panel of Fig 8."""
    return next((family for family in FAMILIES if family in shape), "")


def fig09(
    base: xr.Dataset, base_runs: xr.Dataset, variants: xr.Dataset, heavy: float, moment: float
) -> Figure:
    """The evacuation of Table 2: shape, moment, shapes in time, axial motion; also with the paper's mesh.

    ``heavy``: printed distance (m); ``moment``: printed largest moment (kN m).
    """
    figure, axes = panels(2, 2, 3.6)
    depth = float(base["s"][-1]) - base["s"]
    fine, of_paper = OF_MESH[FINE_MESH], OF_MESH[MESH_OF_PAPER]
    axes[0].plot(-base["displacement_along"].sel(time=STATED), depth, color=fine)
    axes[0].axvline(heavy, **PRINTED)
    own = variants.sel(variant="mesh and step of the paper")
    shape = -displacement(own).sel(time=STATED).dropna("s")
    axes[0].plot(shape, float(shape["s"][-1]) - shape["s"], ":", color=of_paper)
    for colour, time in zip(ordered(OF_COORDINATE["time"], TIMES), TIMES, strict=True):
        shape = -base["displacement_along"].sel(time=time)
        (drawn,) = axes[2].plot(shape, depth, color=colour, label=f"{time:g} s")
        side = "left" if time == TIMES[-1] else "right"  # the last two shapes end close together
        label_line(axes[2], drawn, 0.0, (0.0, -3.0), size="x-small", ha=side, va="top")
    _axial_motion(axes[3], base_runs["z"])
    titles = (
        f"shape at 130 s, {AGAINST}",
        "moment at 130 s",
        "shapes in time",
        "axial motion, by depth below the joint",
    )
    for ax, title in zip(axes, titles, strict=True):
        panel_title(ax, title)
    for ax, label in zip(axes, (ASTERN, SIGNED, ASTERN), strict=False):
        down(ax, label)
    largest, band = _moment_of_base(axes[1], base_runs, own, moment)
    axes[2].set_ylim(bottom=1.09 * float(depth.max()))  # room for the labels of times
    axes[2].margins(x=0.12)
    known = (
        (Line2D([], [], color=fine), FINE_MESH),
        (Line2D([], [], ls=":", color=of_paper), MESH_OF_PAPER),
        (Line2D([], [], **PRINTED), "printed"),
        (band, f"(b) range of the fine mesh\nin one heave cycle ({HEAVE:g} s)"),
    )
    legend_below(figure, [handle for handle, _ in known], [label for _, label in known], 4)
    away = float(-base["displacement_along"].sel(time=STATED).isel(s=0))
    name_upright(axes[0], heavy, 1.0, f"printed: {heavy:g} m\ncalibrated: {away:.1f} m")
    headline(
        figure,
        f"The paper's mesh gives a largest moment of {largest[MESH_OF_PAPER]:.0f} kN m, "
        f"a fine mesh {largest[FINE_MESH]:.0f}",
    )
    label_ends(axes[3])
    return figure


def _moment_of_base(
    ax: Axes, base_runs: xr.Dataset, own: xr.Dataset, moment: float
) -> tuple[dict[str, float], PolyCollection]:
    """Moment at 130 s on a fine mesh and on the mesh of the paper; peaks and range are enlarged.

    Returns the largest moment on each mesh (kN m), and the band of the range in a heave cycle.
    """
    at_130 = base_runs["bending_moment"].sel(time=STATED) / 1e3
    turn = sign_of_largest(at_130)
    ours, depth = turn * at_130, float(base_runs["s"][-1]) - base_runs["s"]
    theirs = at_nodes_of_paper(own["bending_moment"].sel(time=STATED).dropna("s")) / 1e3
    theirs = sign_of_largest(theirs) * theirs
    ax.plot(ours, depth, color=OF_MESH[FINE_MESH])
    ax.axvline(moment, **PRINTED)
    ax.plot(theirs, float(theirs["s"][-1]) - theirs["s"], ":", color=OF_MESH[MESH_OF_PAPER])
    most, at_joint = float(theirs.max()), float(ours.isel(s=-1))
    ax.set_xlim(at_joint - 0.1 * most, 1.75 * most)  # room for the enlarged part
    ax.annotate(
        f"at the joint:\n{at_joint:.1f} kN m".replace("-", "−"), (at_joint, 0.0), xytext=(2.0, -8.0),
        fontsize="small", textcoords="offset points", va="top", color=OF_MESH[FINE_MESH],
    )  # fmt: skip
    inset = enlarge(ax, (0.39, 0.29, 0.42, 0.42), (0.45 * most, 1.15 * most), UPPER, 1.5)
    inset.yaxis.tick_right()  # at the left, the curve would cross the tick labels
    name_axes(inset, "moment (kN m)", "depth (m)")
    cycle = turn * base_runs["bending_moment"].sel(time=slice(STATED - HEAVE, STATED)) / 1e3
    band = inset.fill_betweenx(depth, cycle.min("time"), cycle.max("time"), color="0.8", lw=0.0)
    for values, of, place in (
        (ours, FINE_MESH, (0.03, 0.62)), (theirs, MESH_OF_PAPER, (0.585, 0.94)),
    ):  # fmt: skip
        largest = values.isel(s=int(values.argmax("s")))
        inset.annotate(
            f"{float(largest):.1f} kN m", (float(largest), float(values["s"][-1] - largest["s"])),
            xytext=place, textcoords="axes fraction", fontsize="x-small", color=legible(OF_MESH[of]),
            va="center", arrowprops={"arrowstyle": "-", "lw": 0.6, "color": legible(OF_MESH[of])},
        )  # fmt: skip
    ax.annotate(
        f"printed: {moment:g} kN m", (moment, 0.04), xycoords=("data", "axes fraction"), xytext=(4.0, 0.0),
        textcoords="offset points", fontsize="small", va="bottom",
    )  # fmt: skip
    return {FINE_MESH: float(ours.max()), MESH_OF_PAPER: float(theirs.max())}, band


def _axial_motion(ax: Axes, z: xr.DataArray) -> None:
    """Axial motion over time by depth; below the joint curves nearly coincide, the deeper is thinner."""
    colours = ordered(OF_COORDINATE["depth"], DEPTHS)
    for colour, width, below in zip(colours, (1.0, *NESTED[:2]), DEPTHS, strict=True):
        at = z.sel(s=float(z["s"][-1]) - below, method="nearest")
        name = f"{below:g} m" if below else "joint"
        ax.plot(at["time"], at - at[0], color=colour, lw=width, label=name)
    ax.set_xlabel(TIME)
    ax.set_ylabel("axial motion (m)")
