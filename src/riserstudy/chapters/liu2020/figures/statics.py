"""Figures of Liu et al. 2020: the printed ones by number, others by what they show."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, key_below, panels

SPEEDS = (0.2, 0.6, 1.0)  # m/s, at the surface
#: pulls along cylinders, and their lines
ALONG = {"gas law": "-", "linear": "--", "constant": ":"}
CONSTANT = ("vertical force at the ring", "riser's top on the platform")
#: N that the text gives at these speeds; config/published/liu2020.yaml, N2a to N2c
PUSHED = (337.0, 3166.0, 8765.0)
DEPTH, TIME = "depth below the riser's top (m)", "time (s)"


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
