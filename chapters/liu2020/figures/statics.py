"""Figures of Liu et al. 2020 on statics: printed figures have numbers, further figures have names."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from chapters.liu2020.figures.colours import ALL, OF_CALIBRATION, OF_PROFILE, ONE
from chapters.liu2020.figures.motion_shared import DEPTH
from riserstudy.figures.direct import label_line
from riserstudy.figures.style import GREY, PRINTED, headline, key_below, legend_below, panel_title, panels

NAMED = 0.45  # share of the riser's length, from its top, at which curves of Fig 10 are labelled
SPEEDS = (0.2, 0.6, 1.0)  # m/s, at the surface
#: depth scale and drag coefficient that give 8765 N; config/studies/liu2020.yaml, statics_calibrated
CALIBRATED = {
    ALL: "depth scale 50 m, drag coefficient 0.7, all cylinders",
    ONE: "depth scale 200 m, drag coefficient 1.11, one cylinder",
}


# current and check riser


def fig09(current_profiles: xr.Dataset) -> Figure:
    """Current profiles over depth: printed surface speeds, assumed and calibrated shapes."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    share = current_profiles["current_share"]
    for speed in SPEEDS:
        curve = speed * share.sel(current_profile=f"calibrated: {ALL}")
        (drawn,) = axes[0].plot(curve, curve["depth"], color=OF_CALIBRATION[ALL], label=f"{speed:g} m/s")
        label_line(axes[0], drawn, 0.0, (0.0, 4.0))
    for shape, colour in OF_PROFILE.items():
        curve = share.sel(current_profile=shape)
        axes[1].plot(curve, curve["depth"], color=colour, label=f"{shape} (assumed)")
    for calibration, colour in OF_CALIBRATION.items():
        curve = share.sel(current_profile=f"calibrated: {calibration}")
        axes[1].plot(curve, curve["depth"], "o", color=colour, mfc="none", ms=5, markevery=0.09,
                     label=f"calibrated: {calibration}")  # fmt: skip
    titles = ("calibrated to 8765 N by all cylinders", "1 m/s at the surface")
    for ax, title in zip(axes, titles, strict=True):
        ax.set_xlabel("current speed (m/s)")
        panel_title(ax, title)
    axes[0].margins(x=0.08, y=0.12)
    axes[0].set_ylabel("depth below the water surface (m)")
    axes[0].invert_yaxis()
    two = [share.sel(current_profile=f"calibrated: {name}") for name in OF_CALIBRATION]
    shallow, deep = sorted(float(of["depth"][of >= 0.5].max()) for of in two)
    apart = ": a shallow and a deep one" if deep > 2.0 * shallow else ""
    headline(figure, f"Two currents give the printed force{apart}")
    key_below(figure, axes[1], 3)
    return figure


def fig10(codes: xr.Dataset) -> Figure:
    """Displacement of the check riser by three methods."""
    figure, axes = panels(1, 2, 4.2, sharey=True)
    lines = {"lumped masses": "-", "Hermite elements": "--", "collocation": "o"}
    largest = abs(codes["displacement"]).max(("code", "current_profile", "depth"))
    times = float(largest.sel(contents="air") / largest.sel(contents="water"))
    titles = {
        "water": "filled with water",
        "air": f"filled with air: {times:.1f} times the largest displacement of (a)",
    }
    for ax, contents in zip(axes, titles, strict=True):
        moved = codes["displacement"].sel(contents=contents)
        ours_only = abs(moved.sel(code="lumped masses"))
        least = float(ours_only.max("depth").min())
        for shape in map(str, codes["current_profile"].values):
            for (code, line), width in zip(lines.items(), (3.0, 1.6, 1.6), strict=True):
                curve = moved.sel(code=code, current_profile=shape)
                ours = code == "lumped masses"
                (drawn,) = ax.plot(
                    curve,
                    curve["depth"],
                    line,
                    color=OF_PROFILE[shape] if ours else "black",
                    alpha=0.6 if ours else 1.0,
                    linewidth=width,
                    markersize=4,
                    markevery=0.12,
                    markerfacecolor="none",
                    label=shape if ours else None,
                )
                if ours:
                    side = -5.0 if float(abs(curve).max()) == least else 5.0
                    label_line(ax, drawn, NAMED, (side, 0.0), name=_on_two_rows(shape),
                               size="x-small")  # fmt: skip
        panel_title(ax, titles[contents])
        ax.margins(x=0.16)
        ax.set_xlim(left=-0.25 * float(abs(moved).max()))  # room for a label
        ax.set_xlabel("lateral displacement (m)")
    key = axes[0].plot([], [], color=GREY, alpha=0.6, linewidth=3.0, label="lumped masses (riserstudy)")
    for code in ("Hermite elements", "collocation"):
        key += axes[0].plot(
            [], [], lines[code], color="black", linewidth=1.6, markersize=4, markerfacecolor="none",
            label=code,
        )  # fmt: skip
    axes[0].set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    apart = 100.0 * float(codes["codes_apart"].max())
    headline(figure, f"Three methods agree to {apart:.1f} % of the displacement")
    legend_below(figure, key, [str(line.get_label()) for line in key], 3)
    return figure


def _on_two_rows(shape: object) -> str:
    """Name of a current profile on two rows, narrow enough to fit between two curves."""
    return str(shape).replace(" ", "\n", 1)


def dat_force(
    dat_force: xr.Dataset, dat_force_calibrated: xr.Dataset, slow: float, middle: float, fast: float
) -> Figure:
    """Horizontal force of the tensioners / printed force; ``slow``, ``middle``, ``fast``: printed (N)."""
    printed = xr.DataArray([slow, middle, fast], dims="surface_speed", coords={"surface_speed": list(SPEEDS)})
    figure, (wide, close) = panels(1, 2, 3.8)
    assumed = dat_force["horizontal_force"] / printed
    _profiles(wide, assumed)
    calibrated = dat_force_calibrated["horizontal_force"] / printed
    for calibration, colour in OF_CALIBRATION.items():
        over = calibrated.sel(calibration=calibration)
        filled: dict[str, Any] = {"ms": 5} if calibration == ALL else {"ms": 11, "mfc": "none", "mew": 1.8}
        close.plot(over["surface_speed"], 100.0 * (over - 1.0), "o", color=colour,
                   label=CALIBRATED[calibration], **filled)  # fmt: skip
    close.axhline(0.0, label="printed", **PRINTED)
    forces = (slow, middle, fast)
    names = [f"{speed:g}\n({force:g} N)" for speed, force in zip(SPEEDS, forces, strict=True)]
    close.set_xticks(SPEEDS, names)
    close.set_xlabel("surface speed (m/s), printed force (N)")
    close.set_ylabel("force / printed force − 1 (%)")
    close.margins(0.15)
    panel_title(close, "by surface speed; calibrated at 1 m/s")
    key = {
        name if name == "printed" else f"({letter}) {name}": line
        for letter, ax in zip("ab", (wide, close), strict=True)
        for line, name in zip(*ax.get_legend_handles_labels(), strict=True)
    }
    legend_below(figure, [*key.values()], [*key], 2)
    miss = math.floor(100.0 * float(abs(assumed - 1.0).max("surface_speed").min()))
    off = 100.0 * float(abs(calibrated - 1.0).max())
    headline(
        figure,
        f"Uncalibrated currents miss a printed force by {miss} % or more, calibrated ones by {off:.0f} %",
    )
    return figure


def _profiles(ax: Axes, over: xr.DataArray) -> None:
    """One row per assumed profile: least and largest ratio of force to printed force over all speeds."""
    profiles = [str(shape) for shape in over["current_profile"].values]
    for counted, away in (("all cylinders", -0.12), ("one cylinder", 0.12)):
        of = over.sel(counted=counted)
        low, high = of.min("surface_speed"), of.max("surface_speed")
        for row, shape in enumerate(profiles):
            ends = [float(end.sel(current_profile=shape)) for end in (low, high)]
            colour = OF_PROFILE[shape]
            filled = colour if counted == "all cylinders" else "white"
            ax.plot(ends, [row + away] * 2, "o-", color=colour, mfc=filled, lw=2.0, ms=6)
        ax.plot([], [], "o", color=GREY, mfc=filled if filled == "white" else GREY, ms=6,
                label=f"force of {counted}")  # fmt: skip
    ax.axvline(1.0, label="printed", **PRINTED)
    ax.set_xscale("log")
    ax.set_xticks([0.3, 1.0, 3.0, 10.0])
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_yticks(range(len(profiles)), profiles)
    ax.set_ylim(len(profiles) - 0.5, -0.5)
    ax.set_xlabel("force / printed force,\nleast and largest of three speeds")
    panel_title(ax, "by assumed current profile, drag coefficient 1.0")
