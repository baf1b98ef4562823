"""Figures about the engine itself: which method survives which hard case."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch, Rectangle

from riserstudy.figures.style import COLOURS, key_below, panels

#: outcome by colour, worst last
OUTCOMES = {
    "accurate": "#8fc8a8",
    "stable but inaccurate": "#f3d58a",
    "refused: physically unstable": "#a9cbe8",
    "refused": "#cfd4d8",
    "refused: longer than the study allows": "#eceff1",
    "not run": "#ffffff",
    "finished, but no reference": "#d9c2e2",
    "finished, but cannot stand": "#e08a7c",
    "finished with values beyond reason": "#c96a5b",
}
ROW = 0.235  # inches
ROUNDING = 1e-9  # relative change that is none


def stability(stability: xr.Dataset) -> Figure:
    """Cases by methods, coloured by outcome, with the largest accurate and the largest stable step."""
    cases, methods = list(stability["case"].values), list(stability["method"].values)
    figure = Figure((11.2, 1.7 + ROW * len(cases)), dpi=150, layout="constrained")
    ax = figure.add_subplot()
    for row, case in enumerate(cases):
        of = stability.sel({"case": case})
        _written(ax, row, of)
        for column, method in enumerate(methods):
            one = of.sel({"method": method})
            steps = (float(one["largest_accurate_step"]), float(one["largest_stable_step"]))
            text = " | ".join(_number(step) for step in steps)
            _cell(ax, row, column + 1, str(one["outcome"].values), text)
    ax.set_xlim(-0.5, len(methods) + 0.5)
    ax.set_ylim(len(cases) - 0.5, -0.5)
    ax.xaxis.tick_top()
    ax.set_xticks(range(len(methods) + 1), ["scene as written", *methods], fontsize="small")
    ax.set_yticks(range(len(cases)), _labels(stability), fontsize="x-small")
    for label, met in zip(ax.get_yticklabels(), stability["as_expected"].values, strict=True):
        label.set_color("black" if met else "#94251c")
        label.set_fontweight("normal" if met else "bold")
    ax.tick_params(length=0)
    for side in ax.spines.values():
        side.set_visible(False)
    found = [*stability["outcome"].values.flat, *stability["written_outcome"].values]
    shown = [name for name in OUTCOMES if name in found]
    figure.legend(
        handles=[Patch(facecolor=OUTCOMES[n], edgecolor="0.7", label=n) for n in shown],
        loc="outside lower center",
        ncols=3,
        fontsize="small",
        title="Methods: largest step accurate to 1 % | largest that survives (s). "
        "As written: true error / estimated. Red: not as expected.",
        title_fontsize="small",
    )
    return figure


def _labels(stability: xr.Dataset) -> list[str]:
    return [f"{'' if met else '✗ '}{name}" for name, met in _met(stability)]


def _met(stability: xr.Dataset) -> list[tuple[str, bool]]:
    names = [str(name) for name in stability["case"].values]
    return list(zip(names, map(bool, stability["as_expected"].values), strict=True))


def _written(ax: Axes, row: int, of: xr.Dataset) -> None:
    error, estimate = float(of["written_error"]), float(of["written_estimate"])
    text = f"{_share(error)} / {_share(estimate)}" if not math.isnan(estimate) else ""
    _cell(ax, row, 0, str(of["written_outcome"].values), text)


def _cell(ax: Axes, row: int, column: int, outcome: str, text: str) -> None:
    ax.add_patch(
        Rectangle(
            (column - 0.48, row - 0.45), 0.96, 0.9, facecolor=OUTCOMES[outcome], edgecolor="0.85"
        )
    )
    shown = "" if set(text) <= set("– |") else text
    ax.text(column, row, shown, ha="center", va="center", fontsize="x-small")


def _number(value: float) -> str:
    return (
        "–"
        if math.isnan(value)
        else np.format_float_positional(value, 2, unique=False, fractional=False, trim="-")
    )


def _share(value: float) -> str:
    if math.isnan(value):
        return "–"
    return f"{100 * value:.0f} %" if value >= 0.1 else f"{100 * value:.2g} %"


def effects(effects: xr.Dataset) -> Figure:
    """Consequence of each change, and cost of each effect, in every kind of scene."""
    names = ("displacement_change", "moment_change", "tension_change")
    size = xr.concat([abs(effects[name]) for name in names], "quantity").max("quantity")
    tried = (size.notnull() | (effects["message"] != "")).any("scene")
    size, said = size.isel(change=tried.values), effects["message"].isel(change=tried.values)
    scenes = [str(name) for name in effects["scene"].values]
    share = effects["time_share"].isel(effect=_ordered(effects))
    figure = Figure((13.2, 2.6 + 0.25 * len(scenes)), dpi=150, layout="constrained")
    ratio = [size.sizes["change"], share.sizes["effect"]]
    left, right = figure.subplots(1, 2, width_ratios=ratio, sharey=True)
    consequence = _table(left, size, "change", LogNorm(1e-4, 1.0), "viridis_r")
    for row, column in np.argwhere(said.values != ""):
        left.text(column, row, "×", ha="center", va="center", fontsize="small", color="#94251c")
    left.set_yticks(range(len(scenes)), scenes, fontsize="x-small")
    left.set_title("(a) × cannot be done without", loc="left", fontsize="small")
    cost = _table(right, share, "effect", Normalize(0.0, 0.3), "Oranges")
    right.set_title("(b)", loc="left", fontsize="small")
    for bar, ax, label in (
        (consequence, left, "largest relative change of displacement, moment or tension (-)"),
        (cost, right, "share of run time (-)"),
    ):
        figure.colorbar(
            bar,
            ax=ax,
            location="bottom",
            label=label,
            extend="both",
            shrink=0.8,
            aspect=40,
            pad=0.01,
        )
    return figure


def _ordered(effects: xr.Dataset) -> list[int]:
    """Effects by their largest share, the solver first."""
    return list(np.argsort(-effects["time_share"].max("scene").values))


def _table(ax: Axes, values: xr.DataArray, across: str, norm: Normalize, colours: str) -> AxesImage:
    """Values of scenes as coloured squares, with the numbers of those that are not small."""
    shown = values.transpose("scene", across)
    image = ax.imshow(shown, norm=norm, cmap=colours, aspect="auto", interpolation="none")
    ax.set_xticks(range(shown.sizes[across]), shown[across].values, rotation=90, fontsize="x-small")
    ax.tick_params(length=0)
    for row, column in np.argwhere(shown.values < ROUNDING):
        ax.text(column, row, "0", ha="center", va="center", fontsize=5, color="0.6")
    for row, column in np.argwhere(shown.values >= 0.005):
        value = float(shown[row, column])
        ax.text(
            column,
            row,
            f"{100 * value:.0f}" if value < 9.995 else ">999",
            ha="center",
            va="center",
            fontsize=5,
            color="white" if norm(value) > 0.6 else "black",
        )
    return image


def stable_step(stable_step: xr.Dataset) -> Figure:
    """Measured beside predicted stable step, by variant and mesh."""
    figure, axes = panels(1, 1, height=4.6)
    ax = axes[0]
    ends = np.array([stable_step["predicted"].min() / 1.5, stable_step["predicted"].max() * 1.5])
    ax.fill_between(ends, ends, 1.1 * ends, color="0.9", linewidth=0.0)
    ax.plot(ends, ends, color="0.4", linewidth=0.8)
    for row, variant in enumerate(stable_step["variant"].values):
        of = stable_step.sel(variant=variant)
        ax.plot(
            of["predicted"],
            of["measured"],
            "osD^v<>pPX*h"[row % 12],
            markersize=9 - 0.5 * row,
            markerfacecolor="none",
            color=COLOURS[row % len(COLOURS)],
            label=str(variant),
        )
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("predicted stable step (s)")
    ax.set_ylabel("measured stable step (s)")
    key_below(figure, ax, 4)
    return figure
