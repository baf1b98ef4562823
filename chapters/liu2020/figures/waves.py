"""Figures of Liu et al. 2020 on response in waves."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from chapters.liu2020.figures.colours import OF_MOTION, ON_TENSIONERS, WITH_WAVES
from chapters.liu2020.figures.motion_shared import TIME
from riserstudy.dataset.statistics import peaks
from riserstudy.figures.direct import label_ends, label_line
from riserstudy.figures.style import GREY, headline, key_below, legend_below, panel_title, panels
from riserstudy.records.numerals import SPACED, spaced

UNITS = {"small": "-", "medium": "--", "large": ":"}
WAVE = "wave period (s)"
GENERIC = "generic semi-submersible"  # the paper does not print the responses of its platform
#: short name, place, unit and factor from SI
RESPONSES = {
    "bending_moment": ("moment", " at the ring", "kN m", 1e-3),
    "effective_tension": ("tension", " at the ring", "kN", 1e-3),
    "stroke": ("stroke", "", "m", 1.0),
}
CALM = 14.0  # s, wave periods above which waves on the riser reduce its stress
SEA = "irregular sea of three hours, significant wave height 4 m, peak period 10 s"
WINDOW = 300.0  # s, length of the plotted part of a sea-state history
NEARLY_ALL, ROUND = 0.998, 0.1  # share of the variance in a plotted spectrum; rounding (Hz)
ALONE, STRETCHED = "on the platform alone", "stretched to the surface"


def fig21(rao_table: xr.Dataset) -> Figure:
    """Heave and surge over wave period."""
    figure, (ax,) = panels(height=3.6)
    for name in ("heave", "surge"):
        for unit, line in UNITS.items():
            curve = rao_table[f"rao_{name}"].sel(platform_unit=unit)
            label = f"{name}, {unit} {GENERIC}"
            (drawn,) = ax.plot(curve["wave_period"], curve, line, color=OF_MOTION[name], label=label)
            if unit == "large":
                offset = (-8.0, 0.0) if name == "heave" else (0.0, 5.0)
                share = 0.71 if name == "heave" else 0.9
                label_line(ax, drawn, share, offset, name=name, size="medium")
    ax.set_xlabel(WAVE)
    ax.set_ylabel("motion / wave amplitude (m/m)")
    key = [Line2D([], [], ls=line, color=GREY, label=f"{unit} {GENERIC}") for unit, line in UNITS.items()]
    ax.legend(handles=key, fontsize="small", loc="upper left")
    most = rao_table["rao_heave"].idxmax("wave_period")
    low, high = float(most.min()), float(most.max())
    headline(figure, f"Generic semi-submersibles heave most in waves of {low:.1f} to {high:.1f} s")
    return figure


def fig22(rao_table: xr.Dataset) -> Figure:
    """Pitch over wave period."""
    figure, (ax,) = panels(height=3.6)
    for unit, line in UNITS.items():
        curve = np.rad2deg(rao_table["rao_pitch"].sel(platform_unit=unit))
        ax.plot(curve["wave_period"], curve, line, color=OF_MOTION["pitch"], label=f"{unit} {GENERIC}")
    ax.set_xlabel(WAVE)
    ax.set_ylabel("pitch / wave amplitude (°/m)")
    ax.legend(fontsize="small")
    most = rao_table["rao_pitch"].idxmax("wave_period")
    low, high = float(most.min()), float(most.max())
    headline(figure, f"Generic semi-submersibles pitch most in waves of {low:.1f} to {high:.1f} s")
    return figure


def fig23(rao: xr.Dataset, elevations: dict[str, float]) -> Figure:
    """Stress amplitude by each motion; ``elevations`` (m) of the centres of rotation."""
    stress = rao["stress_amplitude"] / 1e6
    figure = _by_motion(stress, "stress amplitude (MPa)", elevations)
    medium = stress.sel(platform_unit="medium")
    most = {str(dim): int(at) for dim, at in medium.argmax(...).items()}
    where = medium.isel(most)
    headline(
        figure,
        f"{str(where['motion'].item()).capitalize()} causes the largest stress, {float(where):.0f} MPa "
        f"in waves of {float(where['wave_period']):g} s",
    )
    return figure


def fig24(rao: xr.Dataset, elevations: dict[str, float]) -> Figure:
    """Share of each motion in the stress amplitude; ``elevations`` (m) of the centres of rotation."""
    share = 100.0 * rao["stress_share"]
    figure = _by_motion(share, "share of the sum of the\nthree stress amplitudes (%)", elevations)
    headline(figure, _largest_share(share.sel(platform_unit="medium")))
    return figure


def _largest_share(share: xr.DataArray) -> str:
    """Title: motion with the largest share over most wave periods, and where another motion has it."""
    leads = share.argmax("motion") == xr.DataArray(range(share.sizes["motion"]), dims="leader")
    span = float(share["wave_period"].max() - share["wave_period"].min())
    of_span = leads.astype(float).integrate("wave_period") / span  # share of periods
    first = int(of_span.min("reference").argmax("leader"))
    if not bool((of_span.isel(leader=first) > 0.5).all()):
        return "No motion has the largest share over most wave periods"
    name = str(share["motion"].values[first]).capitalize()
    not_first = ~leads.isel(leader=first).all("reference").values
    edges = np.flatnonzero(np.diff([False, *not_first, False]))  # first period of a range, first after it
    ranges = [share["wave_period"].values[a:b] for a, b in edges.reshape(-1, 2)]
    around = [f"{round(0.5 * (of[0] + of[-1]))}" for of in ranges]
    if len(around) in (1, 2):
        return f"{name} has the largest share, except at wave periods around {' and '.join(around)} s"
    return f"{name} has the largest share over most wave periods in both panels"


def _by_motion(values: xr.DataArray, label: str, elevations: dict[str, float]) -> Figure:
    """One line per motion for the medium unit, marks at simulated periods, bands over the three units."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    for ax, reference in zip(axes, values["reference"].values, strict=True):
        for motion in map(str, values["motion"].values):
            colour = OF_MOTION[motion]
            curve = values.sel(reference=reference, motion=motion)
            low, high = curve.min("platform_unit"), curve.max("platform_unit")
            ax.fill_between(low["wave_period"], low, high, color=colour, alpha=0.25, linewidth=0.0)
            ax.plot(curve["wave_period"], curve.sel(platform_unit="medium"), ".-", ms=4, lw=1.2,
                    color=colour, label=motion, clip_on=False)  # fmt: skip
        ax.set_xlabel(WAVE)
        height = elevations[str(reference)]
        panel_title(ax, f"centre of rotation {reference},\n{height:g} m above the lower flex joint")
    axes[0].set_ylabel(label)
    medium = Line2D([], [], color=GREY, marker=".", ms=4, lw=1.2)
    band = Patch(color=GREY, alpha=0.25, linewidth=0.0)
    legend_below(figure, [medium, band], [f"medium {GENERIC}", f"range of three {GENERIC}s"], 2)
    axes[0].margins(x=0.0)
    label_ends(axes[1])
    return figure


def waves(waves: xr.Dataset) -> Figure:
    """Stress amplitude with and without waves on the riser."""
    figure, (ax,) = panels(height=3.8)
    stress = waves["stress_amplitude"] / 1e6
    alone = stress.sel(waves=ALONE)
    (without,) = ax.plot(alone["wave_period"], alone, ".-", color=ON_TENSIONERS, label=ALONE)
    on_it = stress.drop_sel(waves=ALONE)
    low, high = on_it.min("waves"), on_it.max("waves")
    names = "none, constant or stretched above the mean level"
    ax.fill_between(low["wave_period"], low, high, color=WITH_WAVES, alpha=0.6, label=f"range: {names}")
    stretched = stress.sel(waves=STRETCHED)
    (on,) = ax.plot(
        stretched["wave_period"], stretched, ".-", color=WITH_WAVES, label=f"on the riser, {STRETCHED}"
    )
    calm = alone.where(alone["wave_period"] > CALM, 0.0)
    crest = float(np.argmax(calm.values)) / max(1, alone.size - 1)
    label_line(ax, without, crest, (6.0, 5.0), name="waves on the platform alone")
    place = (0.45, (10.0, 6.0)) if stretched.size > 2 else (1.0, (-10.0, -6.0))
    label_line(ax, on, *place, name="waves on platform and riser")
    ax.set_xlabel(WAVE)
    ax.set_ylabel("stress amplitude (MPa)")
    panel_title(ax, "surge, heave and pitch together")
    ratio = stretched / alone
    most = ratio.idxmax("wave_period")
    ax.annotate(
        "", (float(most), float(stretched.sel(wave_period=most))),
        (float(most), float(alone.sel(wave_period=most))),
        arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 0.9, "shrinkA": 3.0, "shrinkB": 3.0},
    )  # fmt: skip
    ax.annotate(
        f"ratio: {float(ratio.max()):.0f}",
        (float(most), 0.64 * float(stretched.sel(wave_period=most))),
        xytext=(5, 0), textcoords="offset points", va="center", fontsize="small",
    )  # fmt: skip
    raised = ratio["wave_period"].where(ratio > 1.0)
    lowered = ratio["wave_period"].where(ratio <= 1.0)
    headline(
        figure,
        f"Waves on the riser increase its stress at periods up to {float(raised.max()):g} s"
        if float(raised.max()) < float(lowered.min())
        else f"Waves on the riser multiply its stress by up to {float(ratio.max()):.0f}",
    )
    return figure


def sea(storm: xr.Dataset) -> Figure:
    """Five minutes around the largest response, the spectra, and exceedance of peak sizes."""
    figure, axes = panels(3, 3, 2.4)
    worst = {}
    for row, (name, (short, place, unit, scale)) in enumerate(RESPONSES.items()):
        history, density = (_at_ring(storm[key]) for key in (name, f"{name}_spectrum"))
        swing = scale * (history - history.mean())
        left, middle, right = axes[3 * row : 3 * row + 3]
        _about_largest(left, scale * history, abs(swing))
        left.set_ylabel(f"{short}{place} ({unit})")
        low = density["frequency"] <= _highest(density)
        middle.plot(density["frequency"][low], scale**2 * density[low], color=ON_TENSIONERS)
        middle.set_ylabel(f"density (({unit})²/Hz)" if " " in unit else f"density ({unit}²/Hz)")
        if middle.get_ylim()[1] >= SPACED:
            middle.yaxis.set_major_formatter(lambda value, _: spaced(value))
        _exceeded(right, swing)
        right.set_ylabel("share of larger peaks")
        right.set_xlabel(f"|{short} − mean| ({unit})")
        worst[short] = float(abs(swing).max() / swing.std())
        panel_title(left, f"{short} around its largest peak")
        panel_title(middle, f"{short}, spectrum")
        left.set_xlabel(TIME)
        middle.set_xlabel("frequency (Hz)")
        panel_title(right, f"{short}, peaks up to {worst[short]:.1f} σ")
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.set(wspace=0.08)  # type: ignore[call-arg]
    key_below(figure, axes[2], 3)
    (key,) = figure.legends
    key.set_title(SEA, FontProperties(size="small"))
    least, most = min(worst.values()), max(worst.values())
    headline(figure, f"Moment, tension and stroke peak at {least:.1f} to {most:.1f} standard deviations")
    return figure


def _highest(density: xr.DataArray) -> float:
    """Frequency (Hz) below which a spectrum has nearly all of its variance, rounded up."""
    below = density.cumsum("frequency") / density.sum("frequency")
    reached = float(density["frequency"][int(np.argmax(below.values >= NEARLY_ALL))])
    return ROUND * float(np.ceil(reached / ROUND))


def _at_ring(values: xr.DataArray) -> xr.DataArray:
    """Values at the riser's top; unchanged if they do not vary along the riser."""
    return values.isel(s=-1, drop=True) if "s" in values.dims else values


def _about_largest(ax: Axes, history: xr.DataArray, size: xr.DataArray) -> None:
    middle = float(size.idxmax("time"))
    part = history.sel(time=slice(middle - WINDOW / 2.0, middle + WINDOW / 2.0))
    ax.plot(part["time"], part, color=ON_TENSIONERS, linewidth=0.9)
    ax.axhline(float(history.mean()), color=GREY, linewidth=0.9)


def _exceeded(ax: Axes, swing: xr.DataArray) -> None:
    """Share of peaks above and below the mean that exceed a size, and the Rayleigh distribution."""
    largest = 0.0
    for line, sign, label in (("-", 1.0, "above"), ("--", -1.0, "below")):
        sizes = np.sort(peaks(sign * swing.values))
        ax.step(
            sizes, 1.0 - np.arange(len(sizes)) / len(sizes), line, color=ON_TENSIONERS,
            label=f"peaks {label} the mean",
        )  # fmt: skip
        largest = max(largest, float(sizes[-1]))
    over = np.linspace(0.0, largest, 100)
    rayleigh = np.exp(-0.5 * (over / float(swing.std())) ** 2)
    ax.plot(over, rayleigh, ":", color="black", label="Rayleigh distribution")
    ax.set_yscale("log")
    ax.set_ylim(bottom=0.5 / len(sizes), top=1.5)
