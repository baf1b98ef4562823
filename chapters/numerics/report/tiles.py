"""The three answers on the first screen, each with a number in large type, a line and a small picture."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING

from chapters.numerics.answers import (
    QUANTITIES,
    Price,
    Ranked,
    hard,
    never,
    others,
    price,
    ranking,
    without_time,
)
from chapters.numerics.figures.scenes import in_one_line
from chapters.numerics.figures.stability import ENDS, REFUSED, WRONG, ended
from riserstudy.records.numerals import plain
from riserstudy.records.page import Tile
from riserstudy.records.words import listed, sentence

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr

WIDTH, HEIGHT = 240, 48  # of a small picture
TOP = 3  # effects that are named
ROWS = 5  # effects that are drawn
EQUAL = 1.1  # ratio of run times up to which they count as equal


def tiles(datasets: Mapping[str, xr.Dataset]) -> list[Tile]:
    """Return a tile for each question; it has no answer if its dataset, or a number in it, is missing."""
    questions = [
        ("cost", "What does accuracy cost?", "accuracy", _cost),
        ("stability", "What stays stable?", "stability", _hard),
        ("effects", "Which effects matter?", "effects", _effects),
    ]
    found = []
    for figure, question, name, answer_of in questions:
        words = answer_of(datasets[name]) if name in datasets else None
        found.append(Tile(figure, question, *(words or ())))
    return found


def _cost(accuracy: xr.Dataset) -> tuple[str, str, str] | None:
    found = price(accuracy)
    if found is None:
        return None
    scene = accuracy["request_scene"].values
    requested, seconds = accuracy["requested"].values, accuracy["request_seconds"].values
    answer = _times(found, scene[usual := (requested == found.coarse) & (seconds > 0.0)], seconds[usual])
    if peers := others(accuracy):
        answer += (
            f" For the surge of a riser, with an error of {100 * peers.error:g}\u00a0%, {peers.codes} other "
            f"programs take {peers.low:.2g} to {peers.high:.3g} times as long as riserstudy."
        )
    lines = []
    for name in dict.fromkeys(scene):
        of = (scene == name) & (seconds > 0.0)
        points = sorted(zip(-requested[of], seconds[of], strict=True))
        lines.append([(math.log(-x), math.log(y)) for x, y in points])
    drawn_lines = [line for line in lines if len(line) > 1]
    drawn = _lines(drawn_lines)
    known = requested[seconds > 0.0]
    between = f"{100 * known.max():g} to {100 * known.min():g}\u00a0%"
    per = "; one line per scene" if len(drawn_lines) > 1 else ""
    under = f"run time (log scale) for tolerances from {between}{per}"
    if left := without_time(accuracy):
        under += (
            f", without {listed(f'“{in_one_line(name)}”' for name in left)}, whose runs exceed the time limit"
        )
    time = f"{found.words}× the time" if found.high > EQUAL else "no more time"
    number = f"{100 * found.fine:g}\u00a0% error instead of {100 * found.coarse:g}\u00a0%: {time}"
    return number, answer, drawn + (_under(under) if drawn else "")


def _times(found: Price, scenes: np.ndarray, seconds: np.ndarray) -> str:
    """State run times (s) of scenes with the coarse tolerance, and how much longer the fine one takes."""
    low, high = (plain(1e3 * time, 2) for time in (seconds.min(), seconds.max()))
    one = len(scenes) == 1
    what = (
        f"a simulation of “{in_one_line(str(scenes[0]))}” takes" if one else f"{len(scenes)} test scenes take"
    )
    return (
        f"With a tolerance of {100 * found.coarse:g}\u00a0% for {listed(QUANTITIES)}, {what} "
        f"{low if low == high else f'{low} to {high}'}\u00a0ms. "
        f"With a tolerance of {100 * found.fine:g}\u00a0%, "
        f"{'the simulation takes' if one else 'the test scenes take'} "
        f"{found.words} times as long."
    )


def _hard(stability: xr.Dataset) -> tuple[str, str, str]:
    counts, ends = hard(stability), ended(stability)
    parts = [(ENDS[end], ends.count(end)) for end in ENDS if end in ends]
    silent = counts.silent
    refused, other = ends.count(REFUSED), ends.count(WRONG)
    run = counts.cases - refused - other
    number = f"{run} of {counts.cases} difficult scenes run to their end"
    words = []
    if silent:
        words.append(number)
        number = f"{silent} of {counts.compared} results inaccurate without a warning"
    ends_of = [(refused, "refused with a stated reason"), (other, "not as expected")]
    left = [(count, f"{'is' if count == 1 else 'are'} {end}") for count, end in ends_of if count]
    if len(left) > 1:
        words.append(f"of the difficult scenes, {listed(f'{count} {end}' for count, end in left)}")
    elif left:
        [(count, end)] = left
        words.append(f"{'one difficult scene' if count == 1 else f'{count} difficult scenes'} {end}")
    words.append("difficult scenes include compression and disconnects")
    if counts.compared and not silent:
        words.append(
            f"{counts.compared} results are compared with a reference solution, "
            "and each of these results is accurate or has a warning"
        )
    answer = " ".join(map(sentence, words))
    each = [(ENDS[end], f"{ends.count(end)} {end}") for end in ENDS if end in ends]
    return number, answer, _stack(parts) + _key(each)


def _effects(effects: xr.Dataset) -> tuple[str, str, str] | None:
    ranked = ranking(effects)
    if not ranked:
        return None
    top = [one for one in ranked[:TOP] if one.changed]
    none = never(ranked)[:2]
    least = min((100 * one.changed // one.scenes for one in top), default=0)
    number = sentence(listed(one.name for one in top) if top else "none").removesuffix(".")
    answers = []
    if top:
        added = any(one.added for one in top)
        any_of = " or ".join([*[", ".join(one.name for one in top[:-1])][: len(top) > 1], top[-1].name])
        subject = any_of if added else f"leaving out {any_of}"
        answers.append(
            f"{subject} changes displacement, moment or tension by more than 1\u00a0% in at least "
            f"{least}\u00a0% of the scenes that include the effect"
        )
    if none:
        what = "no displacement, moment or tension"
        answers.append(f"{_named(none)} {what} by more than 1\u00a0%")
    rows = [*ranked[: ROWS - len(none)], *none]
    drawn = sorted(((one.name, one.changed / one.scenes) for one in rows), key=lambda row: -row[1])
    if len(ranked) > len(top) + len(none) and len(never(ranked)) == len(none) > 0:
        answers.append("the influence of all other effects lies between these extremes")
    return (
        number,
        " ".join(map(sentence, answers)),
        _bars(drawn)
        + _under(
            "share of scenes in which the effect changes displacement, moment or tension by more than 1 %"
        ),
    )


def _named(effects: Sequence[Ranked]) -> str:
    """Subject and verb of a sentence about effects."""
    names = listed(f"“{one.name}”" for one in effects)
    return f"The effects {names} change" if len(effects) > 1 else f"The effect {names} changes"


def _svg(inside: str) -> str:
    return (
        f'<svg class="spark" viewBox="0 0 {WIDTH} {HEIGHT}" preserveAspectRatio="none" '
        f'aria-hidden="true">{inside}</svg>'
    )


def _lines(lines: Sequence[Sequence[tuple[float, float]]]) -> str:
    """Draw one line per scene; finer tolerances to the right, longer times upwards."""
    if not lines:
        return ""
    xs, ys = zip(*(point for line in lines for point in line), strict=True)

    def place(x: float, y: float) -> str:
        across = (max(xs) - x) / ((max(xs) - min(xs)) or 1.0)
        up = (y - min(ys)) / ((max(ys) - min(ys)) or 1.0)
        return f"{4 + across * (WIDTH - 8):.1f},{HEIGHT - 4 - up * (HEIGHT - 8):.1f}"

    drawn = (" ".join(place(*point) for point in line) for line in lines)
    return _svg("".join(f'<polyline class="line" points="{points}"/>' for points in drawn))


def _stack(parts: Sequence[tuple[str, int]]) -> str:
    """Draw one bar, divided in proportion to its parts."""
    total, x, drawn = sum(count for _, count in parts), 0.0, ""
    for colour, count in parts:
        width = WIDTH * count / total
        drawn += f'<rect x="{x:.1f}" y="14" width="{width:.1f}" height="20" fill="{colour}"/>'
        x += width
    return _svg(drawn)


def _bars(shares: Sequence[tuple[str, float]]) -> str:
    """Draw one named bar per share, from top to bottom."""
    rows = (
        f"<span>{escape(name)}, {100.0 * share:.0f}&nbsp;%</span>"
        f'<i><b style="width: {100.0 * share:.0f}%"></b></i>'
        for name, share in shares
    )
    return f'<span class="ranked" aria-hidden="true">{"".join(rows)}</span>'


def _key(parts: Sequence[tuple[str, str]]) -> str:
    """Return the words below a divided bar, each after a square of its part's colour."""
    words = (f'<b style="color: {colour}">\u25a0</b>\u00a0{escape(word)}' for colour, word in parts)
    return f'<span class="under">{"; ".join(words)}</span>'


def _under(words: str) -> str:
    """Return the text below a small picture, which states what the picture shows."""
    return f'<span class="under">{escape(words)}</span>'
