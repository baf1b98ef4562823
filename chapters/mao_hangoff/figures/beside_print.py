"""The unspecified inputs, compared with the three numbers that the paper prints."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from chapters.mao_hangoff.figures.colours import OF_WEIGHT
from chapters.mao_hangoff.runs import PRINTED as NUMBERS
from chapters.mao_hangoff.runs import distance, largest, misses_of_print
from riserstudy.figures.style import GREY, PRINTED, headline, key_below, panel_title, panels

MARKS = ("o", "s", "^", "D", "v", "P")
NEAREST = "closest to all three values"
HOLLOW: dict[str, Any] = {"ls": "none", "ms": 4.5, "mfc": "none", "mew": 0.9}
STAR: dict[str, Any] = {"marker": "*", "ms": 10, "mec": "white", "mew": 0.8}  # the printed numbers
RING: dict[str, Any] = {"color": "black", "marker": "o", "ms": 13, "mfc": "none", "ls": "none"}


def readings(readings: xr.Dataset, heavy: float, light: float, moment: float, within: float) -> Figure:
    """Every interpretation of riser weight, flow and profile, compared with the printed numbers.

    ``heavy``, ``light``: printed distances with 140 and 120 t (m); ``moment``: printed largest moment
    (kN m); ``within``: share of a number that counts as near.
    """
    numbers = _numbers(readings)
    figure, axes = _compare_with_print(heavy, light, moment)
    flows = [str(flow) for flow in numbers["flow"].values]
    weights = _coloured(numbers["riser_weight"])
    for weight, colour in weights.items():
        for mark, flow in zip(MARKS, flows, strict=False):
            one = numbers.sel(riser_weight=weight, flow=flow)
            style: dict[str, Any] = {"color": colour, "marker": mark} | HOLLOW
            axes[0].plot(one["x"], one["moment"], label=f"{weight}; {flow}", **style)
            axes[1].plot(one["x"], one["ratio"], label=f"{weight}; {flow}", **style)
    _around_print(axes, numbers, heavy, light, moment, "points")
    misses = misses_of_print(readings, heavy, light, moment)
    nearest = _nearest(numbers, misses)
    _two_way_key(figure, weights, flows, _printed(heavy, light, moment), _name_of(nearest))
    colour = weights[str(nearest["riser_weight"].item())]
    _ring(axes, nearest, MARKS[flows.index(str(nearest["flow"].item()))], colour)
    _name_nearest(axes, nearest)
    headline(figure, _how_near(misses, within, "interpretations"))
    return figure


def _name_of(nearest: xr.Dataset) -> list[str]:
    """Rows with the name of the nearest interpretation: weight, flow and current profile."""
    return [str(nearest[axis].item()) for axis in ("riser_weight", "flow", "current_profile")]


def _nearest(numbers: xr.Dataset, misses: xr.Dataset) -> xr.Dataset:
    """Numbers of the result whose largest error in the three printed numbers is the least."""
    worst = misses[list(NUMBERS)].to_dataarray("number").max("number")
    return numbers.isel(worst.argmin(...))


def _ring(axes: list[Axes], nearest: xr.Dataset, mark: str, colour: str) -> None:
    """Draw a ring around the nearest in both panels, and redraw it in front of its neighbours."""
    on_top: dict[str, Any] = {"marker": mark, "color": colour, "ms": 8, "zorder": 3, "ls": "none"}
    for ax, name in zip(axes, ("moment", "ratio"), strict=True):
        ax.plot(nearest["x"], nearest[name], label=NEAREST, **RING)
        ax.plot(nearest["x"], nearest[name], **on_top)


def _name_nearest(axes: list[Axes], nearest: xr.Dataset) -> None:
    """Write the numbers of the nearest in the empty part of each panel."""
    x, moment, ratio = (float(nearest[name]) for name in ("x", "moment", "ratio"))
    texts = (
        (f"closest: {x:.1f} m, {moment:.0f} kN m", moment, (0.97, 0.05)),
        (f"closest: {x:.1f} m, ratio {ratio:.3f}", ratio, (0.97, 0.07)),
    )
    for ax, (text, y, place) in zip(axes, texts, strict=True):
        ax.annotate(
            text, (x, y), xytext=place, textcoords="axes fraction", ha="right", va="center", fontsize="small",
            arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 8.0, "relpos": (0.0, 0.5)}, zorder=4,
        )  # fmt: skip


def _how_near(misses: xr.Dataset, within: float, label: str) -> str:
    """Title: the count that is within a share of all three numbers, or else the error of the nearest."""
    three = misses[list(NUMBERS)].to_dataarray("number")
    worst = three.max("number")
    every = int((worst <= within).sum())
    if every:
        return f"{every} of {worst.size} {label} meet all three published values"
    off = 100 * float(worst.min())
    return f"No {label[:-1]} meets all three published values; the best misses by {off:.0f} %"


def _printed(heavy: float, light: float, moment: float) -> str:
    """Name of the lines of the three printed numbers."""
    return f"published: {heavy:g} m, {moment:g} kN m, ratio {light / heavy:.3f}"


def _two_way_key(
    figure: Figure, weights: dict[str, str], flows: list[str], printed: str, nearest: list[str]
) -> None:
    """Key of colours, marks and lines, one column each, below the panels."""
    colours = [_legend_line(weight, "o", colour) for weight, colour in weights.items()]
    marks = [_legend_line(flow, mark, GREY) for mark, flow in zip(MARKS, flows, strict=False)]
    others = [
        Line2D([], [], label=printed, **PRINTED, **STAR),
        Line2D([], [], label=f"{NEAREST}:", **RING),
        *map(_legend_line, nearest),
    ]
    columns = [
        [_legend_line("weight in water"), *colours],
        [_legend_line("current direction"), *marks],
        [_legend_line("compared values"), *others],
    ]
    rows = max(len(column) for column in columns)
    handles = [one for column in columns for one in column + [_legend_line("")] * (rows - len(column))]
    key = figure.legend(handles=handles, loc="outside lower center", ncols=len(columns), fontsize="small")
    for number in range(len(columns)):
        key.get_texts()[number * rows].set_fontweight("bold")


def _legend_line(label: str, mark: str = "", colour: str = "none") -> Line2D:
    return Line2D([], [], marker=mark, color=colour, label=label, **HOLLOW)


def open_choices(
    open_lmrp_mass: xr.Dataset, heavy: float, light: float, moment: float, within: float
) -> Figure:
    """Samples of the unspecified inputs, compared with the printed numbers; arguments as in ``readings``."""
    numbers = _numbers(open_lmrp_mass)
    figure, axes = _compare_with_print(heavy, light, moment)
    weights = open_lmrp_mass["assumed_riser_weight"]
    colours = _coloured(weights)
    for weight, colour in colours.items():
        one = numbers.sel(sample=weights == weight)
        outside = all(bool(_beyond(one, *of).all()) for of in _frames(heavy, light, moment))
        label = f"weight: {weight}" + (" (outside the frame)" if outside else "")
        axes[0].plot(one["x"], one["moment"], "o", color=colour, ms=4, label=label)
        axes[1].plot(one["x"], one["ratio"], "o", color=colour, ms=4)
    _around_print(axes, numbers, heavy, light, moment, "samples")
    misses = misses_of_print(open_lmrp_mass, heavy, light, moment)
    nearest = _nearest(numbers, misses)
    _ring(axes, nearest, "o", colours[str(weights.sel(sample=nearest["sample"]).item())])
    key_below(figure, axes[0], 3)
    headline(figure, _how_near(misses, within, "samples"))
    return figure


def _around_print(
    axes: list[Axes], found: xr.Dataset, heavy: float, light: float, moment: float, label: str
) -> None:
    """Limit panels to the surroundings of the printed numbers; titles count the results within them."""
    for ax, (name, right, bottom, top) in zip(axes, _frames(heavy, light, moment), strict=True):
        ax.set_xlim(-0.1 * heavy, right)
        ax.set_ylim(bottom, top)
        ax.yaxis.set_major_locator(MaxNLocator(10, steps=[1, 2, 5, 10]))
        outside = _beyond(found, name, right, bottom, top)
        beyond = int(outside.sum())
        seen = f"{outside.size - beyond} of {outside.size}" if beyond else f"all {outside.size}"
        panel_title(ax, f"{name}, {seen} {label} in the frame")


def _frames(heavy: float, light: float, moment: float) -> tuple[tuple[str, float, float, float], ...]:
    """For each panel: quantity of the vertical axis, and the right end, bottom and top of the frame."""
    growth = light / heavy - 1.0
    return (
        ("moment", 4.1 * heavy, 0.0, 4.2 * moment),
        ("ratio", 4.1 * heavy, 1.0 - 0.35 * growth, 1.0 + 2.0 * growth),
    )


def _beyond(found: xr.Dataset, name: str, right: float, bottom: float, top: float) -> xr.DataArray:
    """Flags of the results outside a panel's frame."""
    return (found["x"] > right) | (found[name] > top) | (found[name] < bottom)


def _coloured(readings: xr.DataArray) -> dict[str, str]:
    """Colour of each interpretation of the weight that occurs."""
    there = set(map(str, readings.values))
    return {weight: colour for weight, colour in OF_WEIGHT.items() if weight in there}


def _compare_with_print(heavy: float, light: float, moment: float) -> tuple[Figure, list[Axes]]:
    figure, axes = panels(1, 2, 4.6, sharex=True)
    labels = ("largest moment at 130 s (kN m)", "displacement astern, 120 t / 140 t")
    names = (f"published: {moment:g} kN m", f"published: {light / heavy:.3f}")
    for ax, label, printed, name in zip(axes, labels, (moment, light / heavy), names, strict=True):
        ax.annotate(
            name, (0.98, printed), xycoords=("axes fraction", "data"), xytext=(0, 2), ha="right", va="bottom",
            textcoords="offset points", fontsize="small",
        )  # fmt: skip
        ax.axhline(printed, **PRINTED)
        ax.axvline(heavy, **PRINTED)
        ax.plot(heavy, printed, label=_printed(heavy, light, moment), zorder=4, **PRINTED, **STAR)
        ax.set_xlabel("displacement astern at 130 s, 140 t (m)")
        ax.set_ylabel(label)
    return figure, axes


def _numbers(runs: xr.Dataset) -> xr.Dataset:
    """Distance x (m) and M (kN m) with 140 t, and the ratio of x with 120 t to x with 140 t."""
    x, moment = distance(runs), largest(runs) / 1e3
    heavy = x.sel(lmrp_mass=140.0, drop=True)
    return xr.Dataset(
        {
            "x": heavy,
            "moment": moment.sel(lmrp_mass=140.0, drop=True),
            "ratio": x.sel(lmrp_mass=120.0, drop=True) / heavy,
        }
    )
