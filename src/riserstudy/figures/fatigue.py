"""Fatigue over years: damage along the riser, and the contributions of sea states."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.fatigue.years import Years
from riserstudy.figures.names import in_words
from riserstudy.figures.style import COLOURS, as_written, headline, key_below, panel_title, panels

LEAST = 1e-6  # share of the largest damage below which a line is not drawn


def fatigue(years: Years) -> Figure:
    """Factored damage per year along the riser, with the fatigue life, and shares of the sea states."""
    with as_written():
        figure, axes = panels(1, 2, 4.2)
        _along(axes[0], years)
        _by_sea(figure, axes[1], years)
        worst = years.worst[years.governing]
        headline(figure, f"Factored life of {worst.detail} is {worst.life:.2g} years")
        key_below(figure, axes[0], 3)
    return figure


def _along(ax: Axes, years: Years) -> None:
    most = max(worst.factored for worst in years.worst)
    for k, (worst, rates) in enumerate(zip(years.worst, years.rates, strict=True)):
        damage = worst.safety_factor * np.fmax.reduce(rates, axis=0)
        here = np.isfinite(damage)
        colour = COLOURS[k % len(COLOURS)]
        chosen = here & (damage > LEAST * most)
        mark = {"marker": "o", "linestyle": ""} if here.sum() == 1 else {"linewidth": 1.2}
        ax.plot(
            np.where(chosen, damage, np.nan)[here], years.s[here], color=colour, label=worst.detail, **mark
        )
        ax.plot([worst.factored], [worst.s], "o", color=colour, markersize=4)
    if most > 0.0:
        ax.set_xscale("log")
        ax.set_xlim(right=3.0 * most)
    ax.set_xlabel("factored damage a year (1/year)")
    ax.set_ylabel("arclength from the bottom (m)")
    panel_title(ax, "damage along the riser, largest around the wall")


def _by_sea(figure: Figure, ax: Axes, years: Years) -> None:
    """Share of the damage over the first two axes, summed over others."""
    total = sum(sea.damage for sea in years.seas) or 1.0
    panel_title(ax, f"damage by sea state, of {years.worst[years.governing].detail}")
    places = [sorted({sea.values[k] for sea in years.seas}) for k in range(len(years.axes))]
    if len(places) < 2:
        of_each = [
            sum(sea.damage for sea in years.seas if sea.values[:1] == (value,)) / total
            for value in (places[0] if places else [0.0])
        ]
        ax.bar([f"{value:g}" for value in (places[0] if places else [0.0])], 100.0 * np.array(of_each))
        ax.set_xlabel(_named(years, 0) if places else "sea state")
        ax.set_ylabel("share of the damage (%)")
        return
    shares = np.zeros((len(places[0]), len(places[1])))
    for sea in years.seas:
        shares[places[0].index(sea.values[0]), places[1].index(sea.values[1])] += sea.damage / total
    image = ax.pcolormesh(
        range(len(places[1])), range(len(places[0])), 100.0 * shares, shading="nearest", cmap="viridis"
    )
    for ticks, of in ((ax.set_xticks, places[1]), (ax.set_yticks, places[0])):
        ticks(range(len(of)), [f"{value:g}" for value in of])
    half = {sea.values[:2] for sea in years.half}
    for value, other in half:
        ax.plot(places[1].index(other), places[0].index(value), "o", color="white", markersize=4)
    ax.set_xlabel(_named(years, 1))
    ax.set_ylabel(_named(years, 0))
    ax.grid(False)
    figure.colorbar(image, ax=ax, label="share of the damage (%), dots mark half of it")


def _named(years: Years, k: int) -> str:
    axis, unit = years.axes[k]
    return f"{in_words(axis)} ({unit})" if unit else in_words(axis)
