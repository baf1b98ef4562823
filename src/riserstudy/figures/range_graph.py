"""Extremes along the riser in one run, with the static state and the limits."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.dataset.unit_systems import read_in
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.figures.grid import ENDINGS, SIZE, absent, key, label, present, read
from riserstudy.figures.limited_spans import limited_spans
from riserstudy.figures.style import COLOURS, headline, panels
from riserstudy.scene.limits import SIGNED

QUANTITIES = ("effective_tension", "bending_moment", "von_mises_stress", "x", "y")
PANELS = 4
RED = "#c00000"


def range_graph(run: xr.Dataset, title: str, of: list[str] | None = None) -> Figure:
    """One panel per quantity over arclength: largest and smallest value over time, and static value.

    Raises InputError when the run has none of the quantities along the riser.
    """
    along = [name for name in of or present(run, QUANTITIES) if _has(run, name)]
    if missing := [name for name in of or () if name not in along]:
        raise absent(run, missing[0])
    if not along:
        found = "the study stores no extremes along the riser"
        raise InputError(title, "keep", found, "add an output such as bending_moment_max to `keep`")
    if of and len(of) > PANELS:
        found = f"{len(of)} quantities are more than the {PANELS} that a figure shows"
        raise InputError("--of", of[-1], found, "draw the others in a second figure")
    names = along[:PANELS]
    figure, axes = panels(1, len(names), 4.6, sharey=True)
    for ax, name in zip(axes, names, strict=True):
        _panel(ax, run, name)
    axes[0].set_ylabel(label(xr.DataArray(0.0, name="s")))
    moving = any(name + end in run for name in names for end in (*ENDINGS, SIZE))
    headline(figure, f"{title}: {'ranges over time' if moving else 'at rest'}, along the riser")
    _key(figure, axes)
    return figure


def _has(run: xr.Dataset, name: str) -> bool:
    """Whether a run has extremes of a quantity along the riser, or its static state."""
    there = [name + end for end in ("_static", *ENDINGS, SIZE) if name + end in run]
    there += [name] if name in run and "time" not in run[name].dims else []
    return any({"s", "s_node"}.intersection(run[one].dims) for one in there)


def _panel(ax: Axes, run: xr.Dataset, name: str) -> None:
    if (
        name == "effective_tension" and "joint_stroke_static" in run
    ):  # without the value of a telescopic joint
        run = run.isel({dim: slice(-1) for dim in ("s_node", "s") if dim in run.dims})
    static = run.get(name + "_static", run.get(name) if "time" not in run else None)
    sides = [run[name + end] for end in ENDINGS if name + end in run]
    if len(sides) == 2:
        high, low = (_selected(side) for side in sides)
        s = _along(high)
        ax.fill_betweenx(s, low, high, color=COLOURS[0], alpha=0.2, linewidth=0.0)
        ax.plot(high, s, color=COLOURS[0], label="largest and smallest over time")
        ax.plot(low, s, color=COLOURS[0])
    if static is not None:
        rest = _selected(static)
        ax.plot(rest, _along(rest), color="black", linewidth=0.9, label="at rest")
    _draw_limits(ax, run, name)
    ax.set_xlabel(label(xr.DataArray(0.0, name=name)))
    ax.locator_params(axis="x", nbins=4)
    if not sides and name + SIZE in run:
        sides = [run[name + SIZE]]
        largest = _selected(sides[0])
        ax.plot(largest, _along(largest), color=COLOURS[0], label="largest magnitude over time")
    ax.set_title(_largest(sides or [static], name), fontsize="small")


def _along(values: xr.DataArray) -> xr.DataArray:
    """Arclength of values, in the reader's unit."""
    return read(values[values.dims[-1]])


def _selected(values: xr.DataArray) -> xr.DataArray:
    return read(values.dropna(values.dims[-1]))


def _largest(sides: list[Any], name: str) -> str:
    """The largest value and its place; for signed quantities, the largest magnitude."""
    values = max((_selected(side) for side in sides), key=lambda v: float(_size(v, name).max()))
    k = int(_size(values, name).argmax())
    unit = read_in(attributes(name).get("units", "")).unit
    place = float(_along(values)[k])
    return f"largest {float(values[k]):.4g} {unit},\nat s = {place:.4g} {read_in('m').unit}"


def _size(values: xr.DataArray, name: str) -> Any:
    return np.abs(values.values) if name in SIGNED else values.values


def _draw_limits(ax: Axes, run: xr.Dataset, name: str) -> None:
    """Draw each allowable where its limit applies: a line along sections, or a mark at the end of one."""
    factor, along = read_in(attributes(name).get("units", "")).factor, read_in("m").factor
    for span in limited_spans(run, name):
        for sign in (1.0, -1.0) if name in SIGNED else (1.0,):
            value, ends = sign * factor * span.allowable, (along * span.low, along * span.high)
            dash, until = (":", " until the disconnect") if span.until_disconnect else ("--", "")
            if math.isinf(span.low):
                ax.axvline(value, color=RED, linestyle=dash, linewidth=1.0, label="limit")
            elif span.low == span.high:
                mark = "+" if until else "x"
                ax.plot(value, ends[0], mark, color=RED, label=f"limit at one place{until}")
            else:
                ax.plot([value, value], ends, color=RED, linestyle=dash, linewidth=1.0, label=f"limit{until}")


def _key(figure: Figure, axes: list[Axes]) -> None:
    """One legend for all panels, with each entry once."""
    known: set[str] = set()
    for ax in axes:
        for line in ax.get_lines():
            word = str(line.get_label())
            if word in known:
                line.set_label("_")
            elif ax is not axes[0] and not word.startswith("_"):
                (shown,) = axes[0].plot([], [], color=line.get_color(), ls=line.get_linestyle(), label=word)
                shown.set_marker(line.get_marker())
                line.set_label("_")
            known.add(word)
    key(figure, axes[0])
