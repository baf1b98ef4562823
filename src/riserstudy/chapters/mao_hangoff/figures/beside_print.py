"""The unspecified inputs, beside the three numbers that it prints."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.mao_hangoff.runs import STATED
from riserstudy.chapters.mao_hangoff.towed import displacement
from riserstudy.figures.style import COLOURS, GREY, PRINTED, headline, key_below, panels

MARKS = ("o", "s", "^", "D", "v", "P")


def readings(readings: xr.Dataset, heavy: float, light: float, moment: float) -> Figure:
    """Every reading of riser weight, flow and profile beside the printed numbers.

    ``heavy``, ``light``: printed distances with 140 and 120 t (m); ``moment``: printed largest moment (kN m).
    """
    numbers = _numbers(readings)
    figure, axes = _beside_print(heavy, light, moment)
    flows = list(numbers["flow"].values)
    for weight, colour in _coloured(numbers["riser_weight"]).items():
        for mark, flow in zip(MARKS, flows, strict=False):
            one = numbers.sel(riser_weight=weight, flow=flow)
            style: dict[str, Any] = {"color": colour, "marker": mark, "ls": "none", "ms": 4}
            axes[0].plot(one["x"], one["moment"], **style)
            axes[1].plot(one["x"], one["ratio"], **style)
        axes[0].plot([], [], "o", color=colour, ms=4, label=str(weight))
    for mark, flow in zip(MARKS, flows, strict=False):
        axes[0].plot([], [], ls="none", marker=mark, color=GREY, ms=4, label=str(flow))
    key_below(figure, axes[0], 3)
    headline(
        figure,
        "Readings of weight, flow and profile, all assumed, beside the printed numbers (dashed)",
    )
    return figure


def open_choices(open_lmrp_mass: xr.Dataset, heavy: float, light: float, moment: float) -> Figure:
    """Samples of the unspecified inputs beside the printed numbers, as ``readings`` has them."""
    numbers = _numbers(open_lmrp_mass)
    figure, axes = _beside_print(heavy, light, moment)
    weights = open_lmrp_mass["assumed_riser_weight"]
    for weight, colour in _coloured(weights).items():
        one = numbers.sel(sample=weights == weight)
        axes[0].plot(one["x"], one["moment"], "o", color=colour, ms=3, label=str(weight))
        axes[1].plot(one["x"], one["ratio"], "o", color=colour, ms=3)
    _around_print(axes, numbers, heavy, moment)
    key_below(figure, axes[0], 2)
    headline(figure, "Samples of the unspecified inputs, beside the printed numbers (dashed)")
    return figure


def _around_print(axes: list[Axes], found: xr.Dataset, heavy: float, moment: float) -> None:
    """Show what is near the printed numbers; samples beyond are counted."""
    bounds = ((axes[0], "moment", 4.0 * moment), (axes[1], "ratio", 1.5))
    for ax, name, top in bounds:
        ax.set_xlim(0.0, 4.0 * heavy)
        ax.set_ylim(0.0 if name == "moment" else 0.9, top)
        beyond = int(((found["x"] > 4.0 * heavy) | (found[name] > top)).sum())
        ax.set_title(
            f"{beyond} of {found.sizes['sample']} beyond the frame", loc="right", fontsize="small"
        )


def _coloured(readings: xr.DataArray) -> dict[str, str]:
    """One colour a reading, the same in every figure that has the same readings."""
    return dict(zip(sorted(set(map(str, readings.values))), COLOURS, strict=False))


def _beside_print(heavy: float, light: float, moment: float) -> tuple[Figure, list[Axes]]:
    figure, axes = panels(1, 2, 4.2, sharex=True)
    axes[0].axhline(moment, label="printed", **PRINTED)
    axes[1].axhline(light / heavy, **PRINTED)
    labels = ("largest moment at 130 s (kN m)", "displacement, 120 t over 140 t (-)")
    for ax, label in zip(axes, labels, strict=True):
        ax.axvline(heavy, **PRINTED)
        ax.set_xlabel("LMRP astern at 130 s, 140 t (m)")
        ax.set_ylabel(label)
    return figure, axes


def _numbers(runs: xr.Dataset) -> xr.Dataset:
    """Distance x (m) and M (kN m) with 140 t, and x with 120 t over that."""
    x = abs(displacement(runs).sel(time=STATED, drop=True).isel(s=0, drop=True))
    moment = abs(runs["bending_moment"].sel(time=STATED, drop=True)).max("s") / 1e3
    heavy = x.sel(lmrp_mass=140.0, drop=True)
    return xr.Dataset(
        {
            "x": heavy,
            "moment": moment.sel(lmrp_mass=140.0, drop=True),
            "ratio": x.sel(lmrp_mass=120.0, drop=True) / heavy,
        }
    )
