"""What length, tension ratio and buoyant factor change."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.fem_riser.along import (
    amplitude_at,
    angles,
    drift_rate,
    measures,
    period_of,
    stress_factor,
    without_drift,
)
from riserstudy.chapters.fem_riser.claims import (
    BEAM,
    LUMPED,
    SETTLED,
)
from riserstudy.chapters.fem_riser.figures.shared import (
    ANGLE,
    BLACK,
    BLUE,
    DEFLECTION,
    HEIGHT,
    RED,
    STRESS,
)
from riserstudy.figures.direct import label_line, named
from riserstudy.figures.style import (
    GREY,
    headline,
    legend_below,
    panel_title,
    panels,
)

APART = "vibration, drift (m)"
SEEN = 1e-3  # m, of vibration and drift: below it lines show what the mesh leaves


def fig06(length_500: xr.Dataset, length_1000: xr.Dataset, length_1500: xr.Dataset) -> Figure:
    """Three lengths; colours as the text has them, where it says."""
    cases = {"500 m": length_500, "1000 m": length_1000, "1500 m": length_1500}
    figure = envelopes(cases, (BLUE, BLACK, RED), "by length")
    changed = _ratios(length_500, length_1500)
    headline(
        figure,
        f"Tripling the length gives {changed['deflection']:.1f} times the deflection, "
        f"{changed['vibration']:.1f} times the vibration{_still_drifting(cases)}",
    )
    return figure


def fig07(tension_ratio: xr.Dataset) -> Figure:
    """Three top tension ratios; colours as the text has them, where it says."""
    cases = _each(tension_ratio, "tension_ratio", "ratio")
    figure = envelopes(cases, (BLUE, BLACK, RED), "by top tension ratio")
    headline(
        figure,
        f"More top tension lowers deflection, stress, angle and vibration{_still_drifting(cases)}",
    )
    return figure


def fig08(buoyant_factor: xr.Dataset) -> Figure:
    """Three buoyant factors; colours as the text has them, where it says."""
    cases = _each(buoyant_factor, "buoyant_factor", "factor")
    figure = envelopes(cases, (RED, BLUE, BLACK), "by buoyant factor")
    headline(
        figure,
        f"A higher buoyant factor raises deflection, stress and angle{_still_drifting(cases)}",
    )
    return figure


def _ratios(first: xr.Dataset, last: xr.Dataset) -> dict[str, float]:
    """What a case has of deflection and vibration over another, by the paper's beam."""
    old, new = (measures(runs.sel(solver=BEAM)) for runs in (first, last))
    return {name: float(new[name] / old[name]) for name in ("deflection", "vibration")}


def _still_drifting(cases: Mapping[str, xr.Dataset]) -> str:
    """The case that drifts most in the window, with its drift; "" where all are at rest."""
    shares = {}
    for name, runs in cases.items():
        x = runs["x"].sel(solver=BEAM).dropna("s", how="all")
        period = period_of(runs)
        way = float(abs(drift_rate(x, period)).max()) * float(x["time"][-1] - x["time"][0])
        shares[name] = way / float(abs(without_drift(x, period)).max())
    worst = max(shares, key=lambda name: shares[name])
    return f"; {worst} drifts by {100 * shares[worst]:.1f} %" if shares[worst] > SETTLED else ""


def _each(runs: xr.Dataset, axis: str, word: str) -> dict[str, xr.Dataset]:
    return {f"{word} {value:g}": runs.sel({axis: value}) for value in runs[axis].values}


def envelopes(cases: Mapping[str, xr.Dataset], colours: tuple[str, ...], by: str = "") -> Figure:
    """Panels (a) to (c) of Figs 5 to 8; (d) vibration, and drift, which (a) is freed of.

    ``by``: what cases differ in; where there is one case, its name is in the key.
    """
    figure, axes = panels(1, 4, 4.2, sharey=True)
    for colour, (name, runs) in zip(colours, cases.items(), strict=True):
        factor = stress_factor(runs) / 1e6
        period = period_of(runs)
        for solver in (BEAM, LUMPED):
            run = runs.sel(solver=solver)
            x = run["x"].dropna("s", how="all")
            angle: xr.DataArray = xr.apply_ufunc(np.rad2deg, angles(run))
            nodes, length = run["s_node"], float(run["s_node"][-1])
            still = without_drift(x, period)
            low, high = (factor * run[f"bending_moment_{side}"] for side in ("min", "max"))
            fields = (
                (still.min("time"), still.max("time"), x["s"]),
                (low, high, nodes),
                (angle.min("time"), angle.max("time"), length * angle["middle"]),
            )
            for ax, (least, most, s) in zip(axes, fields, strict=False):
                _envelope(ax, least, most, s, colour, name if solver == BEAM else None)
            line = "-" if solver == BEAM else "--"
            vibration = amplitude_at(x, period)
            axes[3].plot(vibration, x["s"], line, color=colour, linewidth=0.9)
            if solver == BEAM:
                span = float(x["time"][-1] - x["time"][0])
                drift = span * abs(drift_rate(x, period))
                if (
                    float(drift.max()) > 10.0 * SEEN
                ):  # where it is less, the dots of a changing sign
                    axes[3].plot(drift, x["s"], ":", color=colour, linewidth=1.2)
    for ax, label in zip(axes, (DEFLECTION, STRESS, ANGLE, APART), strict=True):
        ax.set_xlabel(label)
    axes[3].set_xscale("log")
    axes[3].set_xlim(left=SEEN)
    axes[0].set_ylabel(HEIGHT)
    axes[0].set_ylim(bottom=0.0)
    axes[0].plot([], [], color=GREY, linewidth=0.8, linestyle="--", label="lumped masses")
    axes[0].plot(
        [],
        [],
        color=GREY,
        linewidth=1.2,
        linestyle=":",
        label="drift in 261 to 300 s, removed from (a)",
    )
    if by:
        panel_title(axes[0], by)
        _name_cases(axes[0], cases)
    key = [
        (handle, label)
        for handle, label in zip(*axes[0].get_legend_handles_labels(), strict=True)
        if not by or label not in cases
    ]
    legend_below(figure, [handle for handle, _ in key], [label for _, label in key], 3)
    return figure


def _name_cases(ax: Axes, cases: Mapping[str, xr.Dataset]) -> None:
    """Write the value of each case inside its curve, where that is farthest out."""
    for line in named(ax):
        if line.get_label() in cases:
            out = np.abs(np.asarray(line.get_xdata(), dtype=float))
            value = str(line.get_label()).removeprefix("ratio ").removeprefix("factor ")
            share = int(np.nanargmax(out)) / max(1, out.size - 1)
            label_line(ax, line, share, (-4.0, 0.0), name=value)


def _envelope(
    ax: Axes, low: xr.DataArray, high: xr.DataArray, s: xr.DataArray, colour: str, label: str | None
) -> None:
    if label is None:
        for side in (low, high):
            ax.plot(side, s, color=colour, linewidth=0.8, linestyle="--")
        return
    ax.fill_betweenx(s, low, high, color=colour, alpha=0.35, linewidth=0)
    ax.plot(low, s, color=colour, linewidth=0.6)
    ax.plot(high, s, color=colour, linewidth=0.6, label=label)
