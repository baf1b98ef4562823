"""A specification curve: the margins of all cases in order, and below each margin the options of its case.

References
----------
Simonsohn, Simmons, Nelson (2020), Specification curve analysis, Nature Human Behaviour 4.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.grading.names import option_name
from riserstudy.grading.sensitivity import correlation_ratio
from riserstudy.report.formats import counted

# most cases that are drawn; of more cases only every second, third and so on is drawn
MOST_COLUMNS = 240
MOST_INPUTS, MOST_OPTIONS = 4, 9
FEW = 12  # number of cases that is too small to show which input explains the margin
SEEN = 0.02  # least share of the margin's variance that an input must explain to be shown
PARTS = 3  # parts of a range, with equal numbers of cases
#: pixels: left and right end of the columns, total width, heights of the margins, of a row, of the head
LEFT, RIGHT, WIDE, HIGH, ROW, ABOVE = 285, 585, 640, 90, 17, 18
VARY = ("with less effect is left out of the figure", "with less effect are left out of the figure")
SCALES = (0.05, 0.1, 0.2, 0.5, 1.0)


class Cases(NamedTuple):
    """Judged cases: margin, finding and assumed inputs of each."""

    margin: NDArray[np.float64]  # (n,), -1 to 1
    met: NDArray[np.bool_]  # (n,), whether the claim is met
    same: NDArray[np.bool_]  # (n,), whether the compared values do not differ
    # (n,) texts or numbers, by the name of the input in words; the most important input first
    inputs: Mapping[str, NDArray[np.generic]]
    base: float | None  # margin of the base case; None if unknown
    hidden: int = 0  # number of further inputs that vary


class Option(NamedTuple):
    """A row of the matrix: an option or a part of a range, and the cases that have it."""

    name: str
    has: NDArray[np.bool_]


class Curve(NamedTuple):
    """A curve as SVG, and its caption."""

    svg: str
    caption: str


def ordered(cases: Cases, first: Sequence[str]) -> Cases:
    """Select and order the inputs to show: first the given ones, then those that explain most of the margin.

    Inputs that are equal in all cases are left out; others that explain almost nothing are only counted.
    """
    varied = {n: v for n, v in cases.inputs.items() if len(set(v.tolist())) > 1}
    rank = {name: float(correlation_ratio(cases.margin, _groups(values))) for name, values in varied.items()}
    names = sorted(varied, key=lambda name: (name not in first, -rank[name]))
    few = len(cases.margin) <= FEW
    chosen = [n for n in names if few or n in first or rank[n] >= SEEN][:MOST_INPUTS]
    inputs = {name: varied[name] for name in chosen}
    return cases._replace(inputs=inputs, hidden=len(varied) - len(chosen))


def curve(cases: Cases) -> Curve:
    """Draw the curve of cases."""
    order = np.argsort(cases.margin, kind="stable")
    step = -(-len(order) // MOST_COLUMNS)
    drawn = order[step // 2 :: step]
    matrix = [(name, options_of(values)) for name, values in cases.inputs.items()]
    lines = [*_margins(cases, drawn)]
    top = ABOVE + HIGH + 16.0
    for name, options in matrix:
        lines.append(_text(0, top + 11, name, "name"))
        top += ROW
        for option in options:
            share = f"{100.0 * cases.met[option.has].mean():.0f}\N{NO-BREAK SPACE}%"
            lines.append(_text(LEFT - 8, top + 11, option.name, "end"))
            lines.append(f'<path class="has" d="{_runs(option.has[drawn], top + 0.5 * ROW)}"/>')
            lines.append(_text(RIGHT + 8, top + 11, share, ""))
            top += ROW
        top += 5.0
    names = "".join(lines)
    svg = (
        f'<svg class="curve" viewBox="0 0 {WIDE} {top:.0f}" role="img" '
        f'aria-label="Margins of {len(order)} cases in order, and the options of each">{names}</svg>'
    )
    return Curve(svg, _caption(cases, step))


def _caption(cases: Cases, step: int) -> str:
    count, left = len(cases.margin), cases.hidden
    every = {1: "", 2: " Only every second case is drawn."}.get(
        step, f" Only one of every {step} cases is drawn."
    )
    more = f" Another {counted(left, 'input')} {VARY[left > 1]}." if left > 1 else ""
    if left == 1:
        more = f" Another input {VARY[0]}."
    return (
        "A case is one combination of all inputs. The margin of a case is the distance of its result from "
        f"the value at which agreement with the paper begins. The top panel plots the margins of {count} "
        f"cases, in ascending order.{every} "
        "Cases with a positive margin agree with the paper; the triangle marks the base case. Each row below "
        "the top panel stands for one option of an input; its marks show the cases with this option. The "
        "number at the right of a row is the percentage of the cases with this option that agree with the "
        "paper. If the percentages of all options of an input are 0 % or 100 %, this input alone decides "
        f"whether a case agrees with the paper.{more}"
    )


def options_of(values: NDArray[np.generic]) -> list[Option]:
    """Return the options of an input, or thirds of its range.

    Of too many options it returns the most frequent ones, and one row for all others. ``values``: value of
    the input in each case.
    """
    texts = np.array([str(value) for value in values.tolist()])
    names, counts = np.unique(texts, return_counts=True)
    numbers = _numbers(texts)
    if numbers is not None and len(names) > PARTS:
        return [*_parts(numbers, str(texts[0]).partition(" ")[2])]
    if numbers is not None:
        names = np.array(sorted(names, key=lambda text: float(text.split()[0])))
    elif len(names) > MOST_OPTIONS:
        often = names[np.argsort(-counts, kind="stable")][: MOST_OPTIONS - 1]
        rest = Option(f"{len(names) - len(often)} others", ~np.isin(texts, often))
        return [*(Option(option_name(str(n)), texts == n) for n in often), rest]
    return [Option(option_name(str(name)), texts == name) for name in names]


def _parts(numbers: NDArray[np.float64], unit: str) -> Iterator[Option]:
    """Yield the parts of a range, which have equal numbers of cases, the largest first as on an axis."""
    group = _groups(numbers)
    for k in range(group.max(), -1, -1):
        inside = group == k
        low, high = numbers[inside].min(), numbers[inside].max()
        ends = [f"{end:.0f}" if abs(end) >= 1e4 else f"{end:.4g}" for end in (low, high)]
        yield Option(f"{' to '.join(dict.fromkeys(ends))} {_plain(unit)}".strip(), inside)


def _plain(unit: str) -> str:
    """Return a unit of a scene in its printed form."""
    return unit.replace("*", " ").replace("^2", "²").replace("^3", "³").replace("^4", "⁴")


def _groups(values: NDArray[np.generic]) -> NDArray[np.int64]:
    """Return the group of each value: the option itself, or for many numbers one of three equal parts."""
    numbers = _numbers(np.array([str(value) for value in values.tolist()]))
    unique, group = np.unique(values if numbers is None else numbers, return_inverse=True)
    if numbers is not None and len(unique) > PARTS:
        group = group * PARTS // len(unique)
    groups: NDArray[np.int64] = group.astype(np.int64)
    return groups


def _numbers(texts: NDArray[np.str_]) -> NDArray[np.float64] | None:
    """Return the numbers at the start of texts; None for options."""
    try:
        return np.array([float(text.split()[0]) for text in texts.tolist()])
    except (ValueError, IndexError):
        return None


def _margins(cases: Cases, drawn: NDArray[np.int64]) -> Iterator[str]:
    """Yield the panel of margins: one bar per case, coloured by its finding."""
    margin = cases.margin[drawn]
    most = float(np.abs([*margin, cases.base or 0.0]).max())
    scale = next((s for s in SCALES if most <= s), 1.0)
    middle, half = ABOVE + 0.5 * HIGH, 0.5 * HIGH
    width = (RIGHT - LEFT) / len(drawn)
    kinds = {
        "true": cases.met[drawn],
        "same": cases.same[drawn] & ~cases.met[drawn],
        "false": ~cases.met[drawn] & ~cases.same[drawn],
    }
    heights = np.clip(margin / scale, -1.0, 1.0) * half
    for kind, chosen in kinds.items():
        bars = "".join(
            f"M{LEFT + (k + 0.5) * width:.1f} {middle:.0f}v{-heights[k] or 0.5:.1f}"
            for k in np.flatnonzero(chosen)
        )
        if bars:
            yield f'<path class="{kind}" stroke-width="{max(width, 0.9):.1f}" d="{bars}"/>'
    yield f'<path class="axis" d="M{LEFT} {middle:.0f}H{RIGHT}"/>'
    for text, y in ((f"+{100 * scale:.0f} %", -half), ("0", 0.0), (f"−{100 * scale:.0f} %", half)):
        yield _text(LEFT - 8, middle + y + 4, text, "end")
    yield _text(0, middle + 4, "Margin", "name")
    share = f"{int(cases.met.sum())} of {len(cases.met)} cases agree"
    yield _text(0, middle + 4 + ROW, share, "")
    if cases.base is not None:
        rank = np.searchsorted(np.sort(cases.margin), cases.base) / len(cases.margin)
        x = LEFT + rank * (RIGHT - LEFT)
        yield f'<path class="base" d="M{x:.1f} {ABOVE}l-4 -8h8z"/>'


def _runs(has: NDArray[np.bool_], y: float) -> str:
    """Return horizontal marks at the cases that have an option; neighbouring cases share one mark."""
    width = (RIGHT - LEFT) / len(has)
    edges = np.diff(np.concatenate([[0], has.astype(int), [0]]))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return "".join(
        f"M{LEFT + a * width:.1f} {y:.0f}h{(b - a) * width:.1f}" for a, b in zip(starts, ends, strict=True)
    )


def _text(x: float, y: float, text: str, kind: str) -> str:
    return f'<text x="{x:.0f}" y="{y:.0f}" class="{kind}">{escape(text)}</text>'
