"""Published figures to which a name or an entry of a paper's file refers."""

from __future__ import annotations

NAME = "fig"  # prefix of the number, in names of figures that repeat a published figure
NO_NUMBER = "is not the number of a figure"


def number_of(name: str) -> int | None:
    """Number of the published figure that a figure repeats: 8 for ``fig08``; None for an added figure."""
    number = name.removeprefix(NAME)
    return int(number) if name != number and _is_number(number) else None


def figures_in(text: str) -> frozenset[int]:
    """Numbers of the published figures that contain a value or claim.

    ``text``: figures, ranges of figures and other places, separated by commas: ``4a, 6 to 8, section 6.2``.
    Raises ValueError, with fault and remedy, when a part begins like a figure but is not one.
    """
    return frozenset(number for part in text.split(",") for number in _numbers(part.strip()))


def _numbers(part: str) -> range:
    first, _, rest = part.lower().partition(" ")
    if rest and first in ("fig", "fig.", "figs.", "figure", "figures"):
        raise ValueError(f"{part!r} {NO_NUMBER}", "write the number only, such as 8, 8a or 6 to 8")
    if not part[:1].isdigit():  # another place: text, conclusions, section 6.2
        return range(0)
    ends = [end.rstrip("abcdefghijklmnopqrstuvwxyz") for end in part.split(" to ")]
    if len(ends) > 2 or not all(map(_is_number, ends)) or int(ends[0]) > int(ends[-1]):
        raise ValueError(f"{part!r} {NO_NUMBER}", "write, for example, 8, 8a, or 6 to 8 for several")
    return range(int(ends[0]), int(ends[-1]) + 1)


def _is_number(text: str) -> bool:
    return text.isascii() and text.isdecimal()
