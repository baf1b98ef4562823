"""Effects of amplitude, period, mass and unspecified inputs."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from chapters.chang2020.figures.shared import (
    AMPLITUDE,
    AWAY,
    MODELS,
    NAMES,
    OF_MASS,
    OF_MODEL,
    OF_START,
    OF_STATE,
    STATES,
    TIME,
    of_amplitude,
)
from riserstudy.figures.direct import label_ends, legible
from riserstudy.figures.style import (
    GREY,
    PRINTED,
    WIDE,
    WIDTH,
    headline,
    key_below,
    log_ticks,
    panel_title,
    panels,
    shades,
)

READINGS = STATES | {"from_rest": f"{STATES['from_rest']}, first 100 s"}
STARTS = {"unstretched": "from rest, unstretched", "equilibrium": "from equilibrium"}
LOW = 2.0  # m, amplitude up to which start-up transients hide the asymmetry


def fig13(asymmetry: xr.Dataset) -> Figure:
    """Displacement above and below equilibrium over amplitude."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    sides = {"displacement_up": ("above, $x_p$", "-", "."), "displacement_down": ("below, $x_n$", "--", "x")}
    for ax, model in zip(axes, MODELS, strict=True):
        for reading, label in READINGS.items():
            for side, (word, line, mark) in sides.items():
                curve = asymmetry[side].sel(reading=reading, tensioner_model=model)
                held = reading == "quasi_static"
                ax.plot(
                    curve["heave_amplitude"],
                    curve,
                    linestyle="none" if held else line,
                    marker=mark if held else None,
                    markersize=5,
                    color=shades(OF_STATE[reading], 3)[1 if side.endswith("up") else 2],
                    label=f"{word}: {label}",
                )
        ax.set_xlabel(AMPLITUDE)
        panel_title(ax, NAMES[model])
    axes[0].set_ylabel(AWAY)
    key_below(figure, axes[0], 3)  # one column per state, with both sides
    steady = asymmetry.sel(reading="steady", tensioner_model="gas law")
    up, down = (steady[f"displacement_{way}"] for way in ("up", "down"))
    for away in (up, down):
        _name_end(axes[0], away.isel(heave_amplitude=-1))
    always = "" if bool((up > down).all()) else "not always "
    headline(figure, f"With the gas law, steady-state motion reaches {always}further up than down")
    return figure


def _name_end(ax: Axes, last: xr.DataArray) -> None:
    """Write a displacement in steady state (m) above the end of its curve."""
    ax.annotate(
        f"{float(last):.2f} m", (float(last["heave_amplitude"]), float(last)), xytext=(0, 4),
        textcoords="offset points", ha="right", va="bottom", fontsize="small",
        color=legible(OF_STATE["steady"]), path_effects=[withStroke(linewidth=2.0, foreground="white")],
    )  # fmt: skip


def fig14(asymmetry: xr.Dataset) -> Figure:
    """Asymmetry index over heave amplitude."""
    figure, (ax,) = panels()
    figure.set_figwidth(WIDE * WIDTH)  # room for names at the right
    index = asymmetry["asymmetry_index"]
    for reading in READINGS:
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
                color=OF_STATE[reading],
                label=f"{STATES[reading]}, {NAMES[model]}",
            )
    ax.set_xlabel(AMPLITUDE)
    ax.set_ylabel("asymmetry index $S = x_p / x_n$")
    far = index.sel(tensioner_model="gas law").isel(heave_amplitude=-1)
    settled = float(far.sel(reading="steady"))
    largest = f"{float(far['heave_amplitude']):g} m"
    headline(figure, f"At {largest} amplitude, the riser rises {settled:.2f} times as far as it falls")
    ax.set_ylim(bottom=0.85)
    label_ends(ax)
    ax.margins(x=0.03)  # prevents that marks are cut
    return figure


def open_choices(open_choices: xr.Dataset) -> Figure:
    """Asymmetry index for each sample of the unspecified inputs."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    runs = open_choices.isel(s_node=-1)
    rest = runs["z_static"].sel(heave_amplitude=0.0)
    moving = runs.sel(heave_amplitude=runs["heave_amplitude"] > 0)
    index = (moving["z_max"] - rest) / (rest - moving["z_min"])
    grows = (index.diff("heave_amplitude") > 0.0).all("heave_amplitude")
    ramps = (("None", "platform motion without a ramp"), ("40 s", "platform motion with a ramp of 40 s"))
    for ax, (ramp, title) in zip(axes, ramps, strict=True):
        for start, colour in OF_START.items():
            chosen = (runs["assumed_platform_heave_ramp"] == ramp) & (runs["assumed_analysis_start"] == start)
            lines = index.sel(sample=chosen).transpose("heave_amplitude", "sample")
            ax.plot(lines["heave_amplitude"], lines, color=colour, lw=0.7, alpha=0.55)
            _decreases(ax, lines, shades(colour, 3)[2])
        of_ramp = runs["assumed_platform_heave_ramp"] == ramp
        ax.annotate(
            _counted(index.sel(sample=of_ramp), grows.sel(sample=of_ramp)),
            (0.03, 0.96), xycoords="axes fraction", va="top", fontsize="small",
        )  # fmt: skip
        _near_one(ax)
        ax.axhline(1.0, color=GREY, linewidth=0.8)
        panel_title(ax, title)
        ax.set_xlabel(AMPLITUDE)
    for start, colour in OF_START.items():
        axes[0].plot([], [], color=colour, label=f"one sample, {STARTS[start]}")
    axes[0].plot([], [], color=GREY, lw=2.4, label="thick and dark: $S$ decreases")
    axes[0].plot([], [], color=GREY, lw=0.8, label="$S = 1$")
    axes[0].set_ylabel("asymmetry index $S$")
    key_below(figure, axes[0], 2)
    headline(
        figure, f"Asymmetry increases with every amplitude step in {int(grows.sum())} of {grows.size} samples"
    )
    return figure


def _near_one(ax: Axes) -> None:
    """Enlarge the small amplitudes, where most decreases occur, in the empty part of the panel."""
    inset = ax.inset_axes((0.12, 0.52, 0.36, 0.22), xlim=(0.4, 1.05 * LOW), ylim=(0.975, 1.035))
    inset.axhline(1.0, color=GREY, linewidth=0.8)
    for line in ax.lines:
        inset.plot(*line.get_data(), color=line.get_color(), lw=line.get_linewidth())
    inset.tick_params(labelsize="x-small")
    inset.set_title("enlarged: $S$ over amplitude (m)", fontsize="x-small", pad=2.0)
    marked = ax.indicate_inset_zoom(inset, edgecolor="black", alpha=0.8)
    for connector in marked.connectors or ():
        connector.set_visible(False)


def _counted(index: xr.DataArray, grows: xr.DataArray) -> str:
    """State how many samples increase throughout, and at which amplitudes the others decrease."""
    ends = index["heave_amplitude"].values[1:]
    dips = (index.diff("heave_amplitude") <= 0.0).assign_coords(heave_amplitude=ends)
    above = int(dips.sel(heave_amplitude=ends > LOW).any("heave_amplitude").sum())
    rest = int((~grows).sum())
    where = f"all below {LOW:g} m amplitude" if above == 0 else f"{above} above {LOW:g} m amplitude"
    text = f"$S$ increases throughout in {int(grows.sum())} of {grows.size} samples"
    return f"{text}\n$S$ decreases in {rest}" + (f", {where}" if rest else "")


def _decreases(ax: Axes, lines: xr.DataArray, colour: str) -> None:
    """Draw the amplitude steps over which an index does not increase."""
    amplitude = lines["heave_amplitude"].values
    for k in range(amplitude.size - 1):
        low, high = lines.isel(heave_amplitude=k), lines.isel(heave_amplitude=k + 1)
        for before, after in zip(low.values, high.values, strict=True):
            if after <= before:
                ax.plot(amplitude[k : k + 2], [before, after], color=colour, lw=2.4)


def percentages(reductions: xr.Dataset, tension: float, heave: float) -> Figure:
    """Both reductions in every interpretation; ``tension``, ``heave``: published reductions (fractions)."""
    reduced = {"tension": tension, "heave": heave}
    figure, (ax,) = panels(height=4.3)
    table = 100.0 * reductions["reduction"].sel(quantity="heave")
    places: list[float] = []
    names: list[str] = []
    words = {
        "peak-to-peak range": "peak-to-\npeak\nrange",
        "standard deviation": "standard\ndeviation",
        "peak": "peak",
    }
    for j, height in enumerate(("H is the amplitude", "H is twice the amplitude")):
        for k, measure in enumerate(words):
            at = j * 3.6 + k
            for n, (reading, colour) in enumerate(OF_STATE.items()):
                value = float(table.sel(height=height, measure=measure, reading=reading))
                label = READINGS[reading] if not places else None
                bar = ax.bar(at + 0.27 * (n - 1), value, 0.25, color=colour, label=label)
                written = ax.bar_label(bar, fmt=_whole, fontsize="x-small", padding=2)
                written[0].set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.5})
            places.append(at)
            names.append(words[measure])
    for name, value in reduced.items():
        ax.axhline(100.0 * value, zorder=0.5, **PRINTED)
        ax.annotate(
            f"printed: about\n{100.0 * value:g} % ({name})",
            (1.0, 100.0 * value),
            xycoords=("axes fraction", "data"),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize="small",
        )
    ax.axhline(0.0, color="black", linewidth=0.8)
    ax.set_xticks(places, names)
    for middle, text in ((1.0, "$H$ = 5 m is the amplitude"), (4.6, "$H$ = 5 m is twice the amplitude")):
        ax.annotate(
            text,
            (middle, 0),
            xycoords=("data", "axes fraction"),
            xytext=(0, -46),
            textcoords="offset points",
            ha="center",
            va="top",
            fontsize="small",
        )
    ways = reductions["reduction"]
    apart = float(np.abs(ways.sel(quantity="heave") - ways.sel(quantity="tension")).max())
    ax.set_ylabel(f"reduction{', equal in heave and tension' if apart < 5e-4 else ' of heave'} (%)")
    ax.margins(y=0.12)
    key_below(figure, ax, 3)
    met = [np.isclose(ways.sel(quantity=name), value, atol=0.05) for name, value in reduced.items()]
    count = int(np.all(met, axis=0).sum())
    both = f"by {100.0 * tension:g} % in tension and {100.0 * heave:g} % in heave"
    who = "No single measure decreases" if count == 0 else "Some measures decrease"
    headline(figure, f"{who} {both}")
    return figure


def _whole(value: float) -> str:
    """Format a number without decimals, with a true minus sign."""
    return f"{value:.0f}".replace("-", "−")


def period_sweep(period_sweep: xr.Dataset) -> Figure:
    """Steady state over the platform's period, one row per amplitude; periods of peaks by the gas law."""
    amplitudes = period_sweep["heave_amplitude"].values
    figure, axes = panels(len(amplitudes), 2, 2.6, sharex=True)
    top = period_sweep.isel(s_node=-1)
    up, down = top["z_max"] - top["z_static"], top["z_static"] - top["z_min"]
    curves = {
        "riser / platform amplitude": 0.5 * (up + down) / top["heave_amplitude"],
        "asymmetry index $S$": up / down,
    }
    for k, amplitude in enumerate(amplitudes):
        for ax, (label, values) in zip(axes[2 * k :], curves.items(), strict=False):
            for model, line in MODELS.items():
                curve = values.sel(heave_amplitude=amplitude, tensioner_model=model)
                ax.plot(curve["heave_period"], curve, line, color=OF_MODEL[model], marker=".", ms=4,
                        lw=1.2, label=NAMES[model])  # fmt: skip
            ax.set_ylabel(label)
            ax.margins(y=0.2)
            panel_title(ax, of_amplitude(amplitude))
    for ax in axes[-2:]:
        ax.set_xlabel("heave period of the platform (s)")
        ax.set_xscale("log")
        log_ticks(ax.xaxis)
        ax.xaxis.set_major_formatter("{x:g}")
    for ax in axes[::2]:
        ax.set_yscale("log")
        log_ticks(ax.yaxis)
    for k, amplitude in enumerate(amplitudes):  # the title states periods of the last, largest one
        law = {"heave_amplitude": amplitude, "tensioner_model": "gas law"}
        response, index = (values.sel(law) for values in curves.values())
        resonance = _name_peak(axes[2 * k], response, "ratio")
        far = index.where(index["heave_period"] > 1.5 * resonance, drop=True)
        period = _name_peak(axes[2 * k + 1], far, "$S$")
        reverses = bool(far.min() < 1.0 < far.max())
        if reverses:
            period = _name_peak(axes[2 * k + 1], far, "$S$", lowest=True)
    twice = abs(period / resonance - 2.0) < 0.02
    at = "at about twice the resonance period" if twice else f"near {period:g} s"
    headline(figure, f"Asymmetry {'reverses' if reverses else 'is largest'} {at}")
    key_below(figure, axes[0], 2)
    return figure


def _name_peak(ax: Axes, curve: xr.DataArray, name: str, lowest: bool = False) -> float:
    """Write a curve's largest (or smallest) value and its period at this point; return the period (s)."""
    extreme = curve.min() if lowest else curve.max()
    period = float(curve["heave_period"][int((curve == extreme).argmax("heave_period"))])
    ax.annotate(
        f"{name} = {float(extreme):.3g} at {period:g} s", (period, float(extreme)),
        xytext=(8, -3 if lowest else 3), textcoords="offset points", fontsize="small",
        color=OF_MODEL["gas law"],
    )  # fmt: skip
    return period


def riser_mass(riser_mass: xr.Dataset, riser_mass_start: xr.Dataset) -> Figure:
    """Response with the riser's mass at the ring, and distributed along the riser."""
    figure, axes = panels(1, 2, 3.6)
    for place in map(str, riser_mass["mass_place"].values):
        colour = OF_MASS[place]
        start = riser_mass_start.sel(mass_place=place)
        away = start["z"].isel(s=-1) - start["z_static"].isel(s_node=-1)
        axes[0].plot(start["time"], away, color=colour, linewidth=1.2, label=f"mass {place}")
        top = riser_mass.sel(mass_place=place).isel(s_node=-1)
        for line, word, side in (
            ("-", "above, $x_p$", top["z_max"] - top["z_static"]),
            ("--", "below, $x_n$", top["z_static"] - top["z_min"]),
        ):
            axes[1].plot(side["heave_amplitude"], side, line, color=colour)
            if place == "at the ring":
                axes[1].plot([], [], line, color=GREY, label=word)
    axes[0].set_xlabel(TIME)
    axes[0].set_xlim(0, float(riser_mass_start["time"][-1]))
    axes[0].set_ylabel(AWAY)
    panel_title(axes[0], f"{of_amplitude(5.0)}, without a ramp")
    axes[1].set_xlabel(AMPLITUDE)
    axes[1].set_ylabel(AWAY)
    panel_title(axes[1], STATES["steady"])
    axes[1].legend(fontsize="small")
    key_below(figure, axes[0], 2)
    top = riser_mass.isel(s_node=-1)
    ring, along = ((top["z_max"] - top["z_min"]).sel(mass_place=place) for place in OF_MASS)
    further = "further" if bool((ring > along).all()) else "not always further"
    headline(figure, f"The riser moves {further} with its mass at the ring")
    return figure
