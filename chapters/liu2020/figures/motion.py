"""Figures of Liu et al. 2020 on surge and roll."""

from __future__ import annotations

import textwrap
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.signal import find_peaks, peak_prominences

from chapters.liu2020.below_ring import RING, first_at
from chapters.liu2020.derived.motion import ARRIVED
from chapters.liu2020.figures.colours import CARRIED, NAMES, OF_TOP, ON_PLATFORM, ON_TENSIONERS, WITHOUT
from chapters.liu2020.figures.motion_shared import DEPTH, TIME, by_depth
from riserstudy.figures.direct import label_ends, label_line
from riserstudy.figures.style import GREY, PRINTED, field, headline, key_below, panel_title, panels, shades
from riserstudy.grading.verdict import ALMOST_ALWAYS

DEPTHS = (100.0, 200.0, 300.0, 400.0)  # m below the riser's top, as in Fig 18
LETTERS = 20  # most letters per line of a name next to a panel
ROOM = 0.34  # share of the width of a panel of samples, kept free at the right for text
COUNTS = {1: "one", 2: "two", 3: "three", 4: "four", 5: "five", 6: "six"}
FINE = 400  # points of a smooth curve through the nodes
PEAK = 0.1  # least prominence of a resonance peak, as a share of its height
DISPLACEMENT = "lateral displacement (m)"
WAVE_SPEED = 31.9  # m/s, of lateral waves: sqrt(tension / (mass + added mass))


def fig16(surge_case: xr.Dataset) -> Figure:
    """Displacement over depth and time, with the riser's top on the platform."""
    return _surged(surge_case, ON_PLATFORM, "whose top is on the platform")


def fig17(surge_case: xr.Dataset) -> Figure:
    """Displacement over depth and time, on the tensioners."""
    return _surged(surge_case, "gas law", "on tensioners")


def _surged(surge_case: xr.Dataset, model: str, title: str) -> Figure:
    """First minute, in which surge motion begins, and last minute; both figures share one colour scale."""
    figure, axes = panels(1, 2, 3.8, sharey=True)
    both = surge_case["x"].sel(tensioner_model=[ON_PLATFORM, "gas law"])
    size = float(abs(both).max())
    x = by_depth(surge_case["x"].sel(tensioner_model=model)).dropna("depth", how="all")
    x = x.sel(depth=slice(0.0, None))
    end = float(x["time"][-1])
    for ax, times, name in zip(
        axes, (slice(0.0, 60.0), slice(end - 60.0, None)), ("transient", "steady state"), strict=True
    ):
        label = DISPLACEMENT if ax is axes[-1] else ""
        field(figure, ax, x.sel(time=times), "time", "depth", label, signed=size)
        ax.set_xlabel(TIME)
        panel_title(ax, name)
    begun = np.array([5.0, 5.0 + RING / WAVE_SPEED])
    (speed,) = axes[0].plot(begun, [0.0, RING], "k:", label=f"taut string:\n{WAVE_SPEED} m/s")
    label_line(axes[0], speed, 1.0, (-12.0, 6.0))
    axes[0].set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.set(wspace=0.1)  # type: ignore[call-arg]  # separates the end labels of the two time axes
    finding = "Surge waves travel down" if _travels_down(x) else "Displacement under surge of"
    headline(figure, f"{finding} a riser {title}")
    return figure


def _travels_down(x: xr.DataArray) -> bool:
    """Whether the motion begins later at each greater depth, as in claim Q7; ``x`` over time and depth."""
    begun = first_at(x.interp(depth=list(DEPTHS)), ARRIVED)
    return bool((begun.diff("depth") > 0.0).all())


def fig18(surge_case: xr.Dataset, surge: xr.Dataset) -> Figure:
    """Displacement at four depths, with and without tensioners."""
    figure, axes = panels(2, 2, 2.7, sharex=True, sharey=True)
    x = by_depth(surge_case["x"]).sel(time=slice(105.0, None))
    lines = {
        "gas law": ("-", 3.0),
        ON_PLATFORM: ("-", 1.2),
        "constant": ((0, (3, 3)), 1.4),
        CARRIED: ((3, (1, 5)), 1.8),
    }
    for ax, depth in zip(axes, DEPTHS, strict=True):
        for model, label in NAMES.items():
            curve = x.sel(tensioner_model=model).dropna("depth", how="all").interp(depth=depth)
            line, width = lines.get(model, ("--", 1.2))
            style: dict[str, Any] = {
                "linestyle": line,
                "color": OF_TOP[model],
                "linewidth": width,
                "label": label,
            }
            ax.plot(curve["time"], curve, **style)
    amplitude = surge["displacement_amplitude"]
    ratio = amplitude.sel(tensioner_model="gas law") / amplitude.sel(tensioner_model=ON_PLATFORM)
    lag = surge["displacement_lag"]
    phase_lag = lag.sel(tensioner_model="gas law") - lag.sel(tensioner_model=ON_PLATFORM)
    phase_lag = 180.0 / np.pi * ((phase_lag + np.pi) % (2.0 * np.pi) - np.pi)
    for ax, depth in zip(axes, DEPTHS, strict=True):
        change = 100.0 * (float(ratio.sel(depth=depth)) - 1.0)
        later = float(phase_lag.sel(depth=depth))
        moved = f"{change:+.0f} %".replace("-", "−")
        panel_title(ax, f"{depth:.0f} m; tensioners: displacement {moved}, {later:.0f}° later")
    for ax in axes[2:]:
        ax.set_xlabel(TIME)
    for ax in axes[::2]:
        ax.set_ylabel(DISPLACEMENT)
    effects = [
        word
        for word, always in (("less", ratio.max() < 1.0), ("later", phase_lag.min() > 0.0))
        if bool(always)
    ]
    if effects:
        headline(figure, f"On tensioners, the riser moves {' and '.join(effects)} than on the platform")
    else:
        headline(figure, "Tensioners hardly change the motion of the riser")
    key_below(figure, axes[0], 3)
    return figure


def baselines(
    statics_readings: xr.Dataset, surge_readings: xr.Dataset, smaller: float, later: float
) -> Figure:
    """Share of samples in which a riser on tensioners moves less and lags, by model without tensioners.

    ``smaller`` (share), ``later`` (rad): the least differences that count.
    """
    figure, axes = panels(1, 3, 3.4, sharey=True)
    at_rest = statics_readings["largest_displacement"].sel(surface_speed=1.0)
    surging = surge_readings["displacement_amplitude"]
    lag = surge_readings["displacement_lag"]
    phase_lag = lag.sel(tensioner_model="gas law", drop=True) - lag
    compared = (
        at_rest / at_rest.sel(tensioner_model="gas law"),
        (surging / surging.sel(tensioner_model="gas law")).min("depth"),
        (180.0 / np.pi * ((phase_lag + np.pi) % (2.0 * np.pi) - np.pi)).min("depth"),
    )
    titles = (
        "claim: tensioners reduce the\ndisplacement in a 1 m/s current",
        "claim: tensioners reduce the\ndisplacement under surge",
        "claim: the riser on tensioners\nlags under surge",
    )
    over, less = "displacement,\nwithout / with tensioners", (1.0 - smaller, 1.0 / (1.0 - smaller))
    least_of = "smallest value of 4 depths"
    labels = (over, f"{over},\n{least_of}", f"lag of the riser\non tensioners (°),\n{least_of}")
    turn = float(np.rad2deg(later))
    same = (less, less, (-turn, turn))
    for ax, values, title, x, even in zip(axes, compared, titles, labels, same, strict=True):
        _samples(ax, values.sel(tensioner_model=list(WITHOUT)), even)
        if ax is axes[0]:
            ax.set_xticks(np.arange(1.0, np.floor(ax.get_xlim()[1]) + 0.5))  # 1: no difference
        ax.axvline(0.0 if ax is axes[-1] else 1.0, color=GREY, lw=0.8, zorder=0.5)
        ax.set_xlabel(x)
        panel_title(ax, title)
    names = [textwrap.fill(name, LETTERS) for name in WITHOUT.values()]
    axes[0].set_yticks(range(len(WITHOUT)), names)
    axes[0].set_ylim(len(WITHOUT) - 0.5, -0.9)  # room for the head of the percentages
    axes[-1].yaxis.set_label_position("right")
    axes[-1].set_ylabel(f"share of {at_rest.sizes['sample']} samples (%)", fontsize="small")
    shares = [
        (values.sel(tensioner_model=list(WITHOUT)) > even[1]).mean("sample").values
        for values, even in zip(compared, same, strict=True)
    ]
    least = np.min(shares, axis=0)
    true = int((least >= ALMOST_ALWAYS).sum())
    headline(
        figure,
        f"{true or 'No'} interpretation{'s' * (true > 1)} of “without tensioners” "
        f"make{'s' * (true < 2)} all three claims true",
    )
    key_below(figure, axes[0], 3)
    return figure


def _samples(ax: Axes, values: xr.DataArray, even: tuple[float, float]) -> None:
    """One row per baseline: samples, their middle 90 %, and median; shaded where the claim holds.

    ``even``: values between these two limits count as no difference.
    """
    written: dict[str, Any] = {"ha": "right", "va": "center", "fontsize": "small"}
    written["xycoords"] = ("axes fraction", "data")
    for row, model in enumerate(map(str, values["tensioner_model"].values)):
        colour = OF_TOP[model]
        of = values.sel(tensioner_model=model).values
        low, middle, high = np.quantile(of, (0.05, 0.5, 0.95))
        ax.plot(of, np.full(of.size, row + 0.12), "o", color=colour, ms=4, alpha=0.3)
        ax.plot([low, high], [row - 0.12] * 2, color=colour, lw=2.5)
        ax.plot(middle, row - 0.12, "|", color="black", ms=9, mew=2.0)
        true = float(np.mean(of > even[1]))
        holds = true >= ALMOST_ALWAYS
        ax.annotate(
            f"{100.0 * true:.0f} %", (0.98, row), fontweight="bold" if holds else "normal",
            color="black" if holds else "0.4", **written,
        )  # fmt: skip
    ax.plot([], [], "o", color=GREY, ms=4, alpha=0.5, label="one sample")
    ax.plot([], [], color=GREY, lw=2.5, label="90 % of the samples")
    ax.plot([], [], "|", color="black", ms=9, mew=2.0, ls="none", label="median")
    right = ax.get_xlim()[1] + ROOM * float(np.ptp(ax.get_xlim()))
    ax.axvspan(even[1], right, color="0.93", zorder=0)
    ax.annotate("claim true", (0.98, -0.6), style="italic", **written)
    ax.set_xlim(right=right)


def fig19(roll_case: xr.Dataset, largest: float) -> Figure:
    """Bending moment over depth and time under roll; ``largest``: the printed maximum (kN m)."""
    figure, axes = panels(1, 3, 4.6, sharey=True)
    run = roll_case.sel(tensioner_model="gas law")
    moment = by_depth(run["bending_moment"]).sel(depth=slice(0.0, None)) / 1e3
    end = float(moment["time"][-1])
    size = float(abs(moment).max())
    fine = np.linspace(0.0, float(moment["depth"].max()), FINE)
    parts = {"first 40 s": (slice(0.0, 40.0), 2.0), "steady state, last 40 s": (slice(end - 40.0, None), 1.6)}
    for ax, shade, (name, (times, width)) in zip(axes, (ON_TENSIONERS, GREY), parts.items(), strict=False):
        part = moment.sel(time=times)
        field(figure, ax, part, "time", "depth", "", signed=size)
        ax.set_xlabel(TIME)
        panel_title(ax, name)
        along = part.dropna("depth", how="all").sortby("depth")
        most = abs(along.interp(depth=fine, method="cubic")).max("time")
        axes[2].plot(most, fine, color=shade, linewidth=width, label=name)
    axes[0].set_xticks(range(0, 31, 10))  # 40 would be beside the first label of the next panel
    figure.colorbar(
        axes[0].collections[0], ax=axes[:2], location="bottom", aspect=40, label="bending moment (kN m)"
    )
    label = f"printed: {largest:g} kN m, to which the centre of rotation is calibrated"
    axes[2].axvline(largest, label=label, **PRINTED)
    axes[2].set_xlabel("largest bending moment (kN m)")
    panel_title(axes[2], "largest over time")
    key_below(figure, axes[2], 3)
    axes[0].set_ylabel(DEPTH)
    axes[0].invert_yaxis()
    first, last = (float(abs(moment.sel(time=times)).max()) for times, _ in parts.values())
    compared = "larger" if first > last else "smaller"
    headline(figure, f"The bending moment is {compared} in the first 40 s than in steady state")
    return figure


def fig20(roll: xr.Dataset, largest: float) -> Figure:
    """Largest moment over roll amplitude and period; ``largest``: printed for 4 deg and 10 s (kN m)."""
    figure, (ax,) = panels(height=3.8)
    amplitudes = roll["roll_amplitude"].values
    for colour, amplitude in zip(shades(ON_TENSIONERS, len(amplitudes)), amplitudes, strict=True):
        curve = roll["largest_bending_moment"].sel(roll_amplitude=amplitude) / 1e3
        ax.plot(curve["roll_period"], curve, ".-", color=colour, ms=4, label=f"{amplitude:g}° roll")
    ax.plot([10.0], [largest], "kx", markersize=8)
    ax.annotate(
        f"{largest:g} kN m, printed for 4° (calibrated)", (10.0, largest), xytext=(3, 85), fontsize="small",
        textcoords="offset points",
        arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 5.0, "relpos": (0.0, 0.0)},
    )  # fmt: skip
    top = roll["largest_bending_moment"].sel(roll_amplitude=amplitudes[-1]) / 1e3
    peaks = [
        k for k in find_peaks(top.values)[0]
        if peak_prominences(top.values, [k])[0][0] >= PEAK * float(top[k])
    ]  # fmt: skip
    for k in peaks:
        ax.annotate(
            f"{float(top['roll_period'][k]):g} s", (float(top["roll_period"][k]), float(top[k])),
            xytext=(0, 4), textcoords="offset points", ha="center", fontsize="small",
        )  # fmt: skip
    ax.set_xlabel("roll period of the platform (s)")
    ax.set_ylabel("largest bending moment (kN m)")
    ax.set_ylim(bottom=0.0)
    ax.set_ylim(top=1.08 * float(top.max()))
    periods = top["roll_period"]
    ax.set_xlim(float(periods.min()) - 0.5, float(periods.max()) + 0.5)  # room for whole marks
    falls = bool((np.diff(top.values[peaks]) < 0.0).all())
    count = f"{COUNTS.get(len(peaks), str(len(peaks)))} resonance{'' if len(peaks) == 1 else 's'}"
    headline(
        figure,
        f"The moment decreases with roll period, except at {count}"
        if falls
        else f"The moment has {count} over roll period",
    )
    label_ends(ax)
    return figure
