"""Figures of Liu et al. 2020: the printed ones by number, others by what they show."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.liu2020_motion import (
    baselines,
    fig16,
    fig17,
    fig18,
    fig19,
    fig20,
    fig21,
    fig22,
    fig23,
    fig24,
    sea,
    waves,
)
from riserstudy.figures.style import COLOURS, GREY, field, key_below, panels

__all__ = [
    "baselines",
    "dat_force",
    "fig09",
    "fig10",
    "fig11",
    "fig12",
    "fig13",
    "fig14",
    "fig15",
    "fig16",
    "fig17",
    "fig18",
    "fig19",
    "fig20",
    "fig21",
    "fig22",
    "fig23",
    "fig24",
    "heave_limit",
    "sea",
    "waves",
]

MODELS = {"gas law": "-", "linear": "--"}
DEPTHS = (100.0, 200.0, 300.0, 400.0)  # m below the riser's top, as in Fig 18
SPEEDS = (0.2, 0.6, 1.0)  # m/s, at the surface
#: pulls along cylinders, and their lines
ALONG = {"gas law": "-", "linear": "--", "constant": ":"}
CONSTANT = ("vertical force at the ring", "riser's top on the platform")
#: N that the text gives at these speeds; config/published/liu2020.yaml, N2a to N2c
PUSHED = (337.0, 3166.0, 8765.0)
STROKE = 7.5  # m, either way
DEPTH, TIME = "depth below the riser's top (m)", "time (s)"
TENSION = "effective tension (kN)"
AMPLITUDE, PERIOD = "heave amplitude of the platform (m)", "heave period of the platform (s)"


# current and check riser


def fig09(current_profiles: xr.Dataset) -> Figure:
    """Current profiles over depth: printed surface speeds, assumed shapes."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    share = current_profiles["current_share"]
    for colour, speed in zip(COLOURS, SPEEDS, strict=False):
        curve = speed * share.sel(current_profile="linear")
        axes[0].plot(curve, curve["depth"], color=colour, label=f"{speed:g} m/s")
    for colour, shape in zip(COLOURS, share["current_profile"].values, strict=False):
        curve = share.sel(current_profile=shape)
        axes[1].plot(curve, curve["depth"], color=colour, label=shape)
    for ax, title in zip(axes, ("linear", "1 m/s at the surface"), strict=True):
        ax.set_xlabel("current speed (m/s)")
        ax.set_title(title, loc="right", fontsize="small")
    axes[0].legend(fontsize="small", loc="lower right")
    axes[0].set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    key_below(figure, axes[1], 6)
    return figure


def fig10(codes: xr.Dataset) -> Figure:
    """Displacement of the check riser by three methods."""
    figure, axes = panels(1, 2, 4.2, sharey=True)
    lines = {"lumped masses": "-", "Hermite elements": "--", "collocation": "o"}
    titles = {"water": "filled with water", "air": "filled with air"}
    for ax, contents in zip(axes, titles, strict=True):
        moved = codes["displacement"].sel(contents=contents)
        for colour, shape in zip(COLOURS, codes["current_profile"].values, strict=False):
            for (code, line), width in zip(lines.items(), (3.0, 1.6, 1.6), strict=True):
                curve = moved.sel(code=code, current_profile=shape)
                ours = code == "lumped masses"
                ax.plot(
                    curve,
                    curve["depth"],
                    line,
                    color=colour if ours else "black",
                    alpha=0.45 if ours else 1.0,
                    linewidth=width,
                    markersize=4,
                    markevery=0.12,
                    markerfacecolor="none",
                    label=shape if ours else None,
                )
        ax.set_title(f"{titles[contents]}; colours: this engine", loc="right", fontsize="small")
        ax.set_xlabel("lateral displacement (m)")
    for code in ("Hermite elements", "collocation"):
        axes[0].plot(
            [], [], lines[code], color="black", linewidth=1.6, markersize=4, markerfacecolor="none",
            label=code,
        )  # fmt: skip
    axes[0].set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    key_below(figure, axes[0], 4)
    return figure


# statics of the system


def fig11(statics: xr.Dataset) -> Figure:
    """Displacement in currents, on the tensioners and on a constant tension."""
    return _at_rest(statics, "x_static", 1.0, "lateral displacement (m)")


def fig12(statics: xr.Dataset) -> Figure:
    """Bending moment in currents, on the tensioners and on a constant tension."""
    figure = _at_rest(statics, "bending_moment_static", 1e-3, "bending moment (kN m)")
    _enlarged(figure.axes[0], figure.axes[1].get_xlim())
    return figure


def _enlarged(ax: Axes, limits: tuple[float, float]) -> None:
    """The curves of a panel once more within limits that a few of them leave by far."""
    inset = ax.inset_axes((0.13, 0.12, 0.62, 0.62))
    for line in ax.get_lines():
        inset.plot(*line.get_data(), line.get_linestyle(), color=line.get_color(), linewidth=1.1)
    inset.set_xlim(*limits)
    inset.set_ylim(*ax.get_ylim())
    inset.set_title("enlarged", loc="right", fontsize="small")
    inset.tick_params(labelsize="small")


def _at_rest(statics: xr.Dataset, name: str, scale: float, label: str) -> Figure:
    figure, axes = panels(2, 2, 4.2, sharey=True)
    lines = ("-", "--")
    for ax, other in zip(axes, CONSTANT, strict=False):
        for line, model in zip(lines, ("gas law", other), strict=True):
            for colour, speed in zip(COLOURS, SPEEDS, strict=False):
                run = statics[name].sel(
                    current_profile="linear", tensioner_model=model, surface_speed=speed
                )
                curve = scale * run.where(run["s_node"] < 533.1, drop=True)
                name_of = "tensioners" if model == "gas law" else "232 t"
                ax.plot(
                    curve,
                    533.0 - curve["s_node"],
                    line,
                    color=colour,
                    label=f"{speed:g} m/s, {name_of}",
                )
        ax.set_title(
            f"232 t as a {other}" if "force" in other else other, loc="right", fontsize="small"
        )
    fast = scale * statics[name].sel(surface_speed=1.0).where(statics["s_node"] < 533.1, drop=True)
    depth = 533.0 - fast["s_node"]
    for colour, profile in zip(COLOURS, fast["current_profile"].values, strict=False):
        for line, model in zip(lines, ("gas law", CONSTANT[1]), strict=True):
            curve = fast.sel(current_profile=profile, tensioner_model=model)
            shown = profile if model == "gas law" else None
            axes[2].plot(curve, depth, line, color=colour, label=shown)
    for (model, line), colour in zip(ALONG.items(), COLOURS, strict=False):
        curve = fast.sel(current_profile="linear", tensioner_model=model)
        axes[3].plot(curve, depth, line, color=colour, label=model)
    axes[2].set_title(f"1 m/s; dashed: {CONSTANT[1]}", loc="right", fontsize="small")
    axes[3].set_title("1 m/s, linear profile, along cylinders", loc="right", fontsize="small")
    for ax in axes[2:]:
        ax.legend(fontsize="x-small")
    for ax in axes:
        ax.set_xlabel(label)
    for ax in axes[::2]:
        ax.set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    key_below(figure, axes[0], 3)
    return figure


def dat_force(dat_force: xr.Dataset, dat_force_calibrated: xr.Dataset) -> Figure:
    """Horizontal force of the tensioners over surface speed."""
    figure, (ax,) = panels(height=4.2)
    for colour, shape in zip(COLOURS, dat_force["current_profile"].values, strict=False):
        for line, counted in (("-", "all cylinders"), (":", "one cylinder")):
            force = dat_force["horizontal_force"].sel(current_profile=shape, counted=counted) / 1e3
            label = shape if counted == "all cylinders" else None
            ax.plot(force["surface_speed"], force, line, color=colour, marker=".", label=label)
    tuned = dat_force_calibrated["horizontal_force"] / 1e3
    ax.plot(tuned["surface_speed"], tuned, color="black", label="exponential, calibrated")
    ax.plot(SPEEDS, [f / 1e3 for f in PUSHED], "kx", markersize=8, label="printed")
    ax.set_yscale("log")
    ax.set_xlabel("surface speed of the current (m/s)")
    ax.set_ylabel("horizontal force of the tensioners (kN)")
    ax.set_title("solid: all cylinders; dotted: one", loc="right", fontsize="small")
    key_below(figure, ax, 4)
    return figure


# heave


def fig13(heave_case: xr.Dataset) -> Figure:
    """Effective tension over depth and time."""
    figure, (ax,) = panels(height=3.8)
    tension = _by_depth(heave_case.sel(tensioner_model="gas law"))["effective_tension"] / 1e3
    field(figure, ax, tension, "time", "depth", TENSION)
    ax.set_xlabel(TIME)
    ax.set_ylabel(DEPTH)
    ax.invert_yaxis()
    return figure


def fig14(heave_case: xr.Dataset) -> Figure:
    """Effective tension over time at four depths."""
    figure, (ax,) = panels(height=3.8)
    tension = _by_depth(heave_case)["effective_tension"] / 1e3
    for colour, depth in zip(COLOURS, DEPTHS, strict=False):
        for model, line in MODELS.items():
            curve = tension.sel(tensioner_model=model).interp(depth=depth)
            label = f"{depth:.0f} m, {model}"
            ax.plot(curve["time"], curve, line, color=colour, linewidth=1.1, label=label)
    ax.set_xlabel(TIME)
    ax.set_ylabel(TENSION)
    key_below(figure, ax, 4)
    return figure


def fig15(heave: xr.Dataset) -> Figure:
    """Amplitude of the axial force over heave amplitude and period."""
    figure, axes = panels(1, 3, 3.8)
    kinds = {"gas law": "axial_force_amplitude", "linear": "axial_force_amplitude_linear"}
    periods = [p for p in (5.0, 15.0, 30.0) if p in heave["heave_period"]]
    for model, name in kinds.items():
        force = heave[name] / 1e3
        for colour, period in zip(COLOURS, periods, strict=False):
            curve = force.sel(heave_period=period)
            label = f"{period:g} s, {model}"
            axes[0].plot(
                curve["heave_amplitude"],
                curve,
                MODELS[model],
                color=colour,
                label=label,
                marker=".",
            )
        for colour, amplitude in zip(COLOURS, heave["heave_amplitude"].values, strict=False):
            curve = force.sel(heave_amplitude=amplitude)
            axes[1].plot(curve["heave_period"], curve, MODELS[model], color=colour)
            if model == "gas law":
                end = (float(curve["heave_period"][-1]), float(curve[-1]))
                axes[1].annotate(
                    f"{amplitude:g} m",
                    end,
                    xytext=(4, 0),
                    textcoords="offset points",
                    va="center",
                    fontsize="small",
                )
    axes[0].set_xlabel(AMPLITUDE)
    axes[0].set_ylabel("amplitude of the axial force (kN)")
    axes[0].legend(fontsize="small")
    axes[1].set_xlabel(PERIOD)
    axes[1].set_ylabel("amplitude of the axial force (kN)")
    axes[1].margins(x=0.16)
    axes[1].set_title("heave amplitudes; dashed: linear", loc="right", fontsize="small")
    for colour, amplitude in zip(COLOURS, heave["heave_amplitude"].values, strict=False):
        change = 100.0 * heave["settling"].sel(heave_amplitude=amplitude)
        axes[2].plot(change["heave_period"], change, color=colour, label=f"{amplitude:g} m")
    axes[2].set_yscale("log")
    axes[2].set_xlabel(PERIOD)
    axes[2].set_ylabel("change in the last period (%)")
    axes[2].set_title("how settled, by heave amplitude", loc="right", fontsize="small")
    axes[2].legend(fontsize="small", ncols=2)
    return figure


def heave_limit(heave_limit: xr.Dataset) -> Figure:
    """Stroke and tension up to and beyond the end stops."""
    figure, axes = panels(1, 2, 3.6)
    reach = heave_limit["tensioner_stroke"].isel(cylinder=0)
    tension = heave_limit["effective_tension"].isel(s=0) / 1e6
    for colour, stiffness in zip(COLOURS, heave_limit["stop_stiffness"].values, strict=False):
        for quantity, ax in ((reach, axes[0]), (tension, axes[1])):
            curve = quantity.sel(stop_stiffness=stiffness)
            for side in ("max", "min"):
                ends = getattr(curve, side)("time")
                label = f"stops of {stiffness:g} MN/m" if side == "max" else None
                ax.plot(ends["heave_amplitude"], ends, color=colour, marker=".", label=label)
    for limit in (-STROKE, STROKE):
        axes[0].axhline(limit, color=GREY, linewidth=0.9)
    axes[1].axhline(0.0, color=GREY, linewidth=0.9)
    axes[0].set_ylabel("reach of a cylinder, extremes (m)")
    axes[1].set_ylabel("tension at the bottom, extremes (MN)")
    axes[1].set_title("below zero: slack", loc="right", fontsize="small")
    for ax in axes:
        ax.set_xlabel(AMPLITUDE)
    key_below(figure, axes[0], 3)
    return figure


def _by_depth(runs: xr.Dataset) -> xr.Dataset:
    """Over depth below the riser's top instead of arclength from its bottom."""
    length = float(np.max(runs["s"]))
    return runs.assign_coords(depth=length - runs["s"]).swap_dims(s="depth").sortby("depth")
