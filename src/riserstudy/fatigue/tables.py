"""Tables of damage over years: at details, along the riser, by sea state."""

from __future__ import annotations

import math

import numpy as np

from riserstudy.dataset.table import Cell, Table
from riserstudy.fatigue.years import Years


def of_details(years: Years) -> Table:
    """Each detail at its largest damage: unfactored and factored damage per year, life, errors."""
    columns = ["detail", "s", "angle", "damage", "safety factor", "factored damage", "life"]
    columns += ["error between seas", "chance of seeds"]
    units = ["", "m", "degree", "1/year", "", "1/year", "year", "%", "%"]
    rows: list[list[Cell]] = [
        [
            of.detail, of.s, of.angle, of.rate, of.safety_factor, of.factored,
            of.life if math.isfinite(of.life) else None,
            *(100.0 * share if math.isfinite(share) else None for share in (of.error_between, of.chance)),
        ]
        for of in years.worst
    ]  # fmt: skip
    return Table(columns, units, rows)


def along(years: Years) -> Table:
    """Largest damage per year around the wall along the riser, unfactored and factored, of every detail."""
    columns, units, values = ["s"], ["m"], [years.s]
    for worst, rates in zip(years.worst, years.rates, strict=True):
        most = np.fmax.reduce(rates, axis=0)  # NaN at places without the detail
        columns += [f"damage of {worst.detail}", f"factored damage of {worst.detail}"]
        units += ["1/year", "1/year"]
        values += [most, most * worst.safety_factor]
    rows: list[list[Cell]] = [
        [float(v) if np.isfinite(v) else None for v in row] for row in zip(*values, strict=True)
    ]
    return Table(columns, units, rows)


def by_sea(years: Years, all_of_them: bool = True) -> Table:
    """Sea states by their share of the governing detail's damage: all, or those that cause half of it."""
    total = sum(sea.damage for sea in years.seas)
    columns = [*(axis for axis, _ in years.axes), "time", "damage", "share", "together"]
    units = [*(unit for _, unit in years.axes), "%", "1/year", "%", "%"]
    rows: list[list[Cell]] = []
    together = 0.0
    for sea in years.seas if all_of_them else years.half:
        share = 100.0 * sea.damage / total if total > 0.0 else 0.0
        together += share
        rows.append([*sea.values, 100.0 * sea.share, sea.damage, share, together])
    return Table(columns, units, rows)
