"""Figures of Chang et al. 2020: the printed ones by number, others by what they show.

x is the rise of the ring above the unstretched riser, a that of the platform, X = x - a the piston's.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.interpolate import CubicSpline

from riserstudy.figures.style import (
    COLOURS,
    GREY,
    PRINTED,
    headline,
    key_below,
    panel_title,
    panels,
)

MODELS = {"gas law": "-", "linear": "--"}
FITTED = (-8.0, 8.0)  # m, of the line in Fig 9
READINGS = {
    "steady": "settled",
    "from_rest": "first 100 s from rest",
    "quasi_static": "quasi-static",
}
FOUR = (1.0, 3.0, 5.0, 10.0)  # m, amplitudes of Figs 11 and 12
NAMED = (3.0, 10.0)  # of them, those that the text names
SHOWN = 60.0  # s, of runs from rest: three periods of the platform
LEAST = "least squares over -8 to 8 m"
STARTS = {"unstretched": "unstretched at rest", "equilibrium": "in equilibrium"}
PISTON = "piston displacement X = x − a (m)"
HEAVE, TENSION = "riser heave x (m)", "riser tension (MN)"
AMPLITUDE, TIME = "heave amplitude of the platform (m)", "time (s)"
viridis = colormaps["viridis"]


# the tensioner's law


def fig05(quasi_static: xr.Dataset) -> Figure:
    """Tensioner force over piston displacement."""
    figure, (ax,) = panels()
    law = _law(quasi_static, "gas law")
    law = law.interp(X=np.linspace(*FITTED, 201), method="cubic")
    ax.plot(law["X"], law / 1e6, color=COLOURS[0])
    ax.set_xlabel(PISTON)
    ax.set_ylabel("force of four cylinders (MN)")
    _per_cylinder(ax, "force of one cylinder (MN)")
    headline(figure, "The tensioner's force falls along a convex curve")
    return figure


def fig06(quasi_static: xr.Dataset) -> Figure:
    """Secant and tangent stiffness over piston displacement."""
    figure, (ax,) = panels()
    law = _law(quasi_static, "gas law")
    curve = CubicSpline(law["X"].values, law.values)
    at = np.linspace(*FITTED, 401)
    at = at[np.abs(at) > 1e-6]
    ax.plot(at, np.abs(curve(at, 1)) / 1e6, color=GREY, label="tangent |dF/dX|")
    secant = np.abs((curve(at) - curve(0.0)) / at)
    ax.plot(
        at,
        secant / 1e6,
        color=COLOURS[0],
        label="secant |F(X) − F(0)| / |X|; Eq. 5, of one cylinder: right axis",
    )
    ax.set_xlabel(PISTON)
    ax.set_ylabel("stiffness of four cylinders (MN/m)")
    ax.legend(fontsize="small")
    _per_cylinder(ax, "stiffness of one cylinder (MN/m)")
    headline(figure, "Stiffness falls with the displacement; what Eq. 5 prints is the secant")
    return figure


def fig09(quasi_static: xr.Dataset) -> Figure:
    """Gas law and its least-squares line."""
    figure, (ax,) = panels()
    for colour, (model, line) in zip(COLOURS, MODELS.items(), strict=False):
        law = _law(quasi_static, model).interp(X=np.linspace(*FITTED, 161), method="cubic")
        label = {"gas law": "gas law", "linear": "least-squares line"}[model]
        ax.plot(law["X"], law / 1e6, line, color=colour, label=label)
    ax.set_xlabel(PISTON)
    ax.set_ylabel("force of four cylinders (MN)")
    ax.legend(fontsize="small")
    _per_cylinder(ax, "force of one cylinder (MN)")
    headline(figure, "The least-squares line deviates most from the gas law at its ends")
    return figure


def _law(quasi_static: xr.Dataset, model: str) -> xr.DataArray:
    """Force of all cylinders (N) over X (m), from equilibria with the platform held at many heights."""
    rest = quasi_static.sel(tensioner_model=model)
    force = rest["tensioner_force_static"].sum("cylinder")
    displacement = -rest["tensioner_stroke_static"].isel(cylinder=0)
    order = np.argsort(displacement.values)
    return xr.DataArray(
        force.values[order], dims="X", coords={"X": displacement.values[order]}, name="force"
    )


def _per_cylinder(ax: Axes, label: str) -> None:
    def one(force: Any) -> Any:
        return force / 4

    def four(force: Any) -> Any:
        return 4 * force

    right = ax.secondary_yaxis("right", functions=(one, four))
    right.set_ylabel(label)


# the response


def fig08(
    from_rest: xr.Dataset, steady: xr.Dataset, rigid: xr.Dataset, tension: float, heave: float
) -> Figure:
    """Riser tension and heave with and without tensioner, H = 5 m read in two ways.

    ``tension``, ``heave``: the printed reductions (-).
    """
    reduced = {"tension": tension, "heave": heave}
    figure, axes = panels(2, 2, 3.0, sharex=True)
    for column, (amplitude, meant) in enumerate(
        ((5.0, "H = 5 m is the amplitude"), (2.5, "H = 5 m is twice the amplitude"))
    ):
        runs = {
            "without tensioner": (_histories(rigid).sel(heave_amplitude=amplitude), GREY, 1.4),
            "with tensioner, from rest": (
                _gas(from_rest).sel(heave_amplitude=amplitude),
                COLOURS[0],
                1.2,
            ),
            "with tensioner, settled": (
                _repeated(_gas(steady).sel(heave_amplitude=amplitude), from_rest["time"]),
                COLOURS[1],
                1.2,
            ),
        }
        for ax, quantity, label in zip(
            axes[column::2], ("tension", "heave"), (TENSION, HEAVE), strict=True
        ):
            for name, (run, colour, width) in runs.items():
                ax.plot(run["time"], run[quantity], color=colour, linewidth=width, label=name)
            swing = {name: float(np.ptp(run[quantity].values)) for name, (run, *_) in runs.items()}
            bare = swing.pop("without tensioner")
            panel_title(ax, meant)
            ax.set_ylabel(label)
            reductions = [
                f"{name[16:]} {100.0 * (1.0 - part / bare):.0f} %" for name, part in swing.items()
            ]
            ax.annotate(
                f"swing less by: {', '.join(reductions)}; printed about {100.0 * reduced[quantity]:.0f} %",
                (0.5, 0.97),
                xycoords="axes fraction",
                ha="center",
                va="top",
                fontsize="x-small",
                bbox={"facecolor": "white", "edgecolor": GREY, "linewidth": 0.5},
            )
            ax.margins(y=0.18)
            _printed_swing(ax, runs["without tensioner"][0][quantity], reduced[quantity])
    for ax in axes[2:]:
        ax.set_xlabel(TIME)
    axes[-1].set_xlim(0, 104)
    headline(
        figure,
        "No interpretation gives both reductions: tension and heave decrease in proportion",
    )
    key_below(figure, axes[0], 2)
    return figure


def _printed_swing(ax: Axes, bare: xr.DataArray, reduction: float) -> None:
    """The swing that a printed reduction (-) leaves of one without tensioner, beside the histories."""
    low, high = float(bare.min()), float(bare.max())
    ax.errorbar(
        101.5,
        0.5 * (high + low),
        yerr=0.5 * (1.0 - reduction) * (high - low),
        color="black",
        capsize=3,
        clip_on=False,
        label="swing that the printed reduction leaves",
    )


def fig10(from_rest: xr.Dataset, steady: xr.Dataset, lines_settled: xr.Dataset) -> Figure:
    """Heave and tension at 3 and 10 m, gas law and lines; (a) to (d) from rest as printed, then settled."""
    figure, axes = panels(4, 2, 2.2)
    started, settled = _histories(from_rest), _histories(steady)
    straight = _histories(lines_settled)
    start = float(steady["time"][0])
    cases = [(a, q) for a in NAMED for q in ("heave", "tension")]
    for (amplitude, quantity), early, late in zip(cases, axes[:4], axes[4:], strict=True):
        for colour, (model, line) in zip(COLOURS, MODELS.items(), strict=False):
            run = started.sel(tensioner_model=model, heave_amplitude=amplitude)
            label = {"gas law": "gas law", "linear": LEAST}[model]
            early.plot(run["time"], run[quantity], line, color=colour, lw=1.1, label=label)
        law = settled.sel(tensioner_model="gas law", heave_amplitude=amplitude)
        late.plot(law["time"] - start, law[quantity], color=COLOURS[0], lw=2.2, label="gas law")
        for colour, line in zip(COLOURS[1:], straight["line"].values, strict=False):
            run = straight.sel(line=line, heave_amplitude=amplitude)
            late.plot(run["time"] - start, run[quantity], "--", color=colour, lw=1.1, label=line)
        for ax, when, end in ((early, "from rest", SHOWN), (late, "settled", 20.0)):
            ax.set_ylabel({"heave": HEAVE, "tension": TENSION}[quantity])
            ax.set_xlim(0.0, end)
            panel_title(ax, f"platform {amplitude:g} m, {when}")
    for ax in axes[2:4]:
        ax.set_xlabel(TIME)
    for ax in axes[6:]:
        ax.set_xlabel("time in the settled period (s)")
    curved = settled.sel(tensioner_model="gas law")["heave"].reset_coords(drop=True)
    apart = abs(straight["heave"].reset_coords(drop=True) - curved).max("time")
    share = 100.0 * apart / (curved.max("time") - curved.min("time"))
    far = share.sel(heave_amplitude=NAMED[1])
    headline(
        figure,
        f"At {NAMED[1]:g} m every linearised tensioner deviates from the gas law by "
        f"{float(far.min()):.0f} % or more",
    )
    key_below(figure, axes[4], 3)
    return figure


def fig11(from_rest: xr.Dataset, steady: xr.Dataset) -> Figure:
    """Heave of the riser for four amplitudes."""
    return _four(from_rest, steady, "heave", HEAVE)


def fig12(from_rest: xr.Dataset, steady: xr.Dataset) -> Figure:
    """Tension of the riser for four amplitudes."""
    return _four(from_rest, steady, "tension", TENSION)


def settled_response(steady: xr.Dataset) -> Figure:
    """Figs 10 to 12 without start-up ringing, over one period."""
    figure, axes = panels(3, 2, 2.7, sharex=True)
    _models_compared(axes, steady)
    axes[0].legend(fontsize="small", loc="upper right")
    for ax, quantity, label in zip(axes[4:], ("heave", "tension"), (HEAVE, TENSION), strict=True):
        _amplitudes(ax, steady, quantity)
        panel_title(ax, "gas law, by amplitude")
        ax.set_ylabel(label)
        ax.set_xlabel("time in the settled period (s)")
    axes[4].legend(
        fontsize="x-small", loc="upper right", title="amplitude", title_fontsize="x-small"
    )
    axes[0].set_xlim(0, 20)
    headline(
        figure,
        "The gas law gives high crests and flat troughs, a line neither",
    )
    return figure


def _models_compared(axes: list[Axes], runs: xr.Dataset) -> None:
    """Panels (a) to (d) of Fig 10."""
    histories = _histories(runs)
    start = float(runs["time"][0])
    for k, amplitude in enumerate((3.0, 10.0)):
        for ax, quantity, label in zip(
            axes[2 * k :], ("heave", "tension"), (HEAVE, TENSION), strict=False
        ):
            for colour, (model, line) in zip(COLOURS, MODELS.items(), strict=False):
                run = histories.sel(tensioner_model=model, heave_amplitude=amplitude)
                ax.plot(run["time"] - start, run[quantity], line, color=colour, lw=1.2, label=model)
            ax.set_ylabel(label)
            panel_title(ax, f"platform {amplitude:g} m")


def _four(runs: xr.Dataset, steady: xr.Dataset, quantity: str, label: str) -> Figure:
    """A panel an amplitude: from rest, and the settled motion to which the ringing decays."""
    figure, axes = panels(4, 1, 1.75, sharex=True, sharey=True)
    rest = _histories(runs, "static")[quantity].sel(tensioner_model="gas law")
    for ax, amplitude in zip(axes, FOUR, strict=False):
        run = _gas(runs).sel(heave_amplitude=amplitude)
        settled = _repeated(_gas(steady).sel(heave_amplitude=amplitude), run["time"])
        ax.axhline(float(rest.isel(heave_amplitude=0)), color=GREY, lw=0.8, label="equilibrium")
        ax.plot(run["time"], run[quantity], color=COLOURS[0], lw=1.0, label="from rest")
        ax.plot(settled["time"], settled[quantity], color=COLOURS[1], lw=2.0, label="settled")
        status = "named in the text" if amplitude in NAMED else "assumed"
        panel_title(ax, f"platform {amplitude:g} m, {status}")
        ax.locator_params(axis="y", nbins=5)
    figure.supylabel(label, fontsize="medium")
    axes[-1].set_xlabel(TIME)
    axes[-1].set_xlim(0, SHOWN)
    index = _settled_index(steady)
    low, high = (float(index.sel(heave_amplitude=a)) for a in (FOUR[0], FOUR[-1]))
    headline(
        figure,
        f"Settled {quantity}: upper over lower displacement grows from {low:.2f} to {high:.2f}",
    )
    key_below(figure, axes[0], 3)
    return figure


def _settled_index(steady: xr.Dataset) -> xr.DataArray:
    """Settled displacement above over that below the equilibrium; alike of heave and of tension."""
    top = steady.isel(s_node=-1).sel(tensioner_model="gas law")
    index: xr.DataArray = (top["z_max"] - top["z_static"]) / (top["z_static"] - top["z_min"])
    return index


def _amplitudes(ax: Axes, runs: xr.Dataset, quantity: str) -> None:
    for colour, amplitude in zip(viridis(np.linspace(0.0, 0.85, len(FOUR))), FOUR, strict=True):
        run = _gas(runs).sel(heave_amplitude=amplitude)
        start = float(run["time"][0])
        ax.plot(run["time"] - start, run[quantity], color=colour, label=f"{amplitude:g} m")


def _histories(runs: xr.Dataset, when: str = "") -> xr.Dataset:
    """Heave (m) and riser tension (MN) at the ring over time, or at rest."""
    if when == "static":
        top = runs.isel(s_node=-1)
        z, tension, zero = (
            top["z_static"],
            top["effective_tension_static"],
            float(runs["s_node"][-1]),
        )
    else:
        top = runs.isel(s=-1)
        z, tension, zero = top["z"], top["effective_tension"], float(runs["s"][-1])
    return xr.Dataset({"heave": z - zero, "tension": tension / 1e6})


def _gas(runs: xr.Dataset) -> xr.Dataset:
    return _histories(runs).sel(tensioner_model="gas law")


def _repeated(period: xr.Dataset, time: xr.DataArray) -> xr.Dataset:
    """A settled period laid end to end over other times; both start at the same phase."""
    start, end = float(period["time"][0]), float(period["time"][-1])
    within = start + np.mod(time.values - start, end - start)
    return period.interp(time=within).assign_coords(time=time.values)


# asymmetry


def fig13(asymmetry: xr.Dataset) -> Figure:
    """Displacement above and below equilibrium over amplitude."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    sides = {"displacement_up": "above, $x_p$", "displacement_down": "below, $x_n$"}
    for ax, model in zip(axes, MODELS, strict=True):
        for colour, (side, word) in zip(COLOURS, sides.items(), strict=False):
            for line, (reading, label) in zip(("-", "--", ":"), READINGS.items(), strict=True):
                curve = asymmetry[side].sel(reading=reading, tensioner_model=model)
                ax.plot(
                    curve["heave_amplitude"], curve, line, color=colour, label=f"{word}: {label}"
                )
        ax.set_xlabel(AMPLITUDE)
        panel_title(ax, model)
    axes[0].set_ylabel("displacement from equilibrium (m)")
    key_below(figure, axes[0], 2)
    far = asymmetry.sel(reading="steady").isel(heave_amplitude=-1)
    up, down = (
        float(far[f"displacement_{way}"].sel(tensioner_model="gas law")) for way in ("up", "down")
    )
    headline(
        figure,
        f"In the largest heave the gas law moves the riser {up:.1f} m up, {down:.1f} m down",
    )
    return figure


def fig14(asymmetry: xr.Dataset) -> Figure:
    """Asymmetry index over heave amplitude."""
    figure, (ax,) = panels()
    index = asymmetry["asymmetry_index"]
    for colour, (reading, label) in zip(COLOURS, READINGS.items(), strict=False):
        for model, line in MODELS.items():
            curve = index.sel(reading=reading, tensioner_model=model)
            mark = {"gas law": ".", "linear": "x"}[model] if reading == "quasi_static" else None
            style = "none" if mark else line
            ax.plot(
                curve["heave_amplitude"],
                curve,
                linestyle=style,
                marker=mark,
                markersize=5,
                color=colour,
                label=f"{label}, {model}",
            )
    ax.set_xlabel(AMPLITUDE)
    ax.set_ylabel("asymmetry index $S = x_p / x_n$")
    ax.legend(fontsize="small")
    far = index.sel(reading="steady").isel(heave_amplitude=-1)
    curved, straight = (float(far.sel(tensioner_model=model)) for model in MODELS)
    headline(
        figure,
        f"The asymmetry index reaches {curved:.2f} with the gas law, {straight:.2f} with a line",
    )
    return figure


def open_choices(open_choices: xr.Dataset) -> Figure:
    """Asymmetry index for each sample of the unspecified inputs."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    runs = open_choices.isel(s_node=-1)
    rest = runs["z_static"].sel(heave_amplitude=0.0)
    moving = runs.sel(heave_amplitude=runs["heave_amplitude"] > 0)
    index = (moving["z_max"] - rest) / (rest - moving["z_min"])
    ramps = (("None", "platform moves at once"), ("40 s", "motion grows over 40 s"))
    starts = dict(zip(("unstretched", "equilibrium"), COLOURS, strict=False))
    for ax, (ramp, title) in zip(axes, ramps, strict=True):
        for start, colour in starts.items():
            chosen = (runs["assumed_platform_heave_ramp"] == ramp) & (
                runs["assumed_analysis_start"] == start
            )
            lines = index.sel(sample=chosen).transpose("heave_amplitude", "sample")
            ax.plot(lines["heave_amplitude"], lines, color=colour, lw=0.7, alpha=0.55)
        ax.axhline(1.0, color="black", linewidth=0.8)
        panel_title(ax, title)
        ax.set_xlabel(AMPLITUDE)
    for start, colour in starts.items():
        axes[0].plot([], [], color=colour, label=f"one sample, riser starts {STARTS[start]}")
    axes[0].set_ylabel("asymmetry index $S$")
    key_below(figure, axes[0], 2)
    grows = (index.diff("heave_amplitude") > 0.0).all("heave_amplitude")
    headline(
        figure,
        f"Asymmetry increases with every amplitude step in {int(grows.sum())} of {grows.size} samples",
    )
    return figure


# beside the paper


def percentages(reductions: xr.Dataset, tension: float, heave: float) -> Figure:
    """Every reading of the two percentages; ``tension``, ``heave``: the printed reductions (-)."""
    reduced = {"tension": tension, "heave": heave}
    figure, (ax,) = panels(height=4.0)
    table = 100.0 * reductions["reduction"].sel(quantity="heave")
    places: list[float] = []
    names: list[str] = []
    words = {"swing": "swing", "deviation": "standard\ndeviation", "peak": "peak"}
    for j, height in enumerate(("amplitude", "height")):
        for k, measure in enumerate(words):
            at = j * 3.6 + k
            for n, (colour, reading) in enumerate(zip(COLOURS, READINGS, strict=False)):
                value = float(table.sel(height=height, measure=measure, reading=reading))
                label = READINGS[reading] if not places else None
                bar = ax.bar(at + 0.27 * (n - 1), value, 0.25, color=colour, label=label)
                written = ax.bar_label(bar, fmt="%.0f", fontsize="x-small", padding=2)
                written[0].set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.5})
            places.append(at)
            names.append(words[measure])
    for name, value in reduced.items():
        ax.axhline(100.0 * value, zorder=0.5, **PRINTED)
        ax.annotate(
            f"printed: {name}",
            (1.0, 100.0 * value),
            xycoords=("axes fraction", "data"),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize="small",
        )
    ax.axhline(0.0, color="black", linewidth=0.8)
    ax.set_xticks(places, names)
    for middle, text in (
        (1.0, "H = 5 m is the amplitude"),
        (4.6, "H = 5 m is twice the amplitude"),
    ):
        ax.annotate(
            text,
            (middle, 0),
            xycoords=("data", "axes fraction"),
            xytext=(0, -34),
            textcoords="offset points",
            ha="center",
            va="top",
            fontsize="small",
        )
    ax.set_ylabel("reduction of heave, and of tension (%)")
    ax.margins(y=0.12)
    key_below(figure, ax, 3)
    headline(
        figure,
        f"No single measure decreases by {100.0 * tension:g} % in tension and {100.0 * heave:g} % in heave",
    )
    return figure


def period_sweep(period_sweep: xr.Dataset) -> Figure:
    """Settled motion over the platform's period, a row an amplitude; periods of the peaks by the gas law."""
    amplitudes = period_sweep["heave_amplitude"].values
    figure, axes = panels(len(amplitudes), 2, 2.6, sharex=True)
    top = period_sweep.isel(s_node=-1)
    up, down = top["z_max"] - top["z_static"], top["z_static"] - top["z_min"]
    curves = {
        "half range / heave amplitude": 0.5 * (up + down) / top["heave_amplitude"],
        "asymmetry index $S$": up / down,
    }
    for k, amplitude in enumerate(amplitudes):
        for ax, (label, values) in zip(axes[2 * k :], curves.items(), strict=False):
            for colour, (model, line) in zip(COLOURS, MODELS.items(), strict=False):
                curve = values.sel(heave_amplitude=amplitude, tensioner_model=model)
                ax.plot(curve["heave_period"], curve, line, color=colour, marker=".", ms=4, lw=1.2,
                        label=model)  # fmt: skip
            ax.set_ylabel(label)
            ax.margins(y=0.2)
            panel_title(ax, f"platform {amplitude:g} m")
    for ax in axes[-2:]:
        ax.set_xlabel("heave period of the platform (s)")
    for ax in axes[::2]:
        ax.set_yscale("log")
    largest = {"heave_amplitude": amplitudes[-1], "tensioner_model": "gas law"}
    response, index = (values.sel(largest) for values in curves.values())
    resonance = _name_peak(axes[-2], response)
    far = index.where(index["heave_period"] > 1.5 * resonance, drop=True)
    _name_peak(axes[-1], far)
    low = _name_peak(axes[-1], far, lowest=True)
    headline(
        figure,
        f"Resonance is at {resonance:g} s; asymmetry reverses at twice that period, {low:g} s",
    )
    key_below(figure, axes[0], 2)
    return figure


def _name_peak(ax: Axes, curve: xr.DataArray, lowest: bool = False) -> float:
    """Write the period at which a curve is largest (or smallest) there; it (s)."""
    extreme = curve.min() if lowest else curve.max()
    period = float(curve["heave_period"][int((curve == extreme).argmax("heave_period"))])
    ax.annotate(
        f"{period:g} s: {float(extreme):.3g}", (period, float(extreme)),
        xytext=(8, -3 if lowest else 3), textcoords="offset points", fontsize="small",
    )  # fmt: skip
    return period


def riser_mass(riser_mass: xr.Dataset, riser_mass_start: xr.Dataset) -> Figure:
    """The riser's mass at the ring and along the riser."""
    figure, axes = panels(1, 2, 3.6)
    for colour, place in zip(COLOURS, riser_mass["mass_place"].values, strict=False):
        start = riser_mass_start.sel(mass_place=place)
        away = start["z"].isel(s=-1) - start["z_static"].isel(s_node=-1)
        axes[0].plot(start["time"], away, color=colour, linewidth=1.2, label=f"mass {place}")
        top = riser_mass.sel(mass_place=place).isel(s_node=-1)
        for line, word, side in (
            ("-", "above, $x_p$", top["z_max"] - top["z_static"]),
            ("--", "below, $x_n$", top["z_static"] - top["z_min"]),
        ):
            label = word if colour == COLOURS[0] else None
            axes[1].plot(side["heave_amplitude"], side, line, color=colour, label=label)
    axes[0].set_xlabel(TIME)
    axes[0].set_xlim(0, float(riser_mass_start["time"][-1]))
    axes[0].set_ylabel("heave from equilibrium (m)")
    panel_title(axes[0], "platform 5 m, starts at once")
    axes[1].set_xlabel(AMPLITUDE)
    axes[1].set_ylabel("displacement from equilibrium (m)")
    panel_title(axes[1], "settled")
    axes[1].legend(fontsize="small")
    key_below(figure, axes[0], 2)
    far = riser_mass.isel(s_node=-1).sel(heave_amplitude=5.0)
    swing = far["z_max"] - far["z_min"]
    ranges = " or ".join(
        f"{float(swing.sel(mass_place=place)):.2f} m ({place})"
        for place in swing["mass_place"].values
    )
    headline(figure, f"The place of the mass sets the range: {ranges}")
    return figure
