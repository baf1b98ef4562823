"""Report of the entries of a deck that its scene lacks: all that were not read, equal ones together."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from riserstudy.errors import on_one_line
from riserstudy.importers.orcaflex.deck import EMPTY, Part

MOST_LISTED = 40  # most characters of a listed value
#: values of an entry that switch something off
OFF = ("0", "0.0", "None", "(none)", "(no damping)", "False", "No")
#: entries for drawings, which change no result
DRAWN = re.compile(
    r"Pen\b|Pen[A-Z]|^Draw|^Hid|^DefaultView|^Vertex|^Edge|Symbol|Shaded|Shading|Colou?r|^Label"
)


class Entry(NamedTuple):
    """An entry that is left out: its list and object, its name and its value."""

    of: str
    object: str
    key: str
    value: str


def left_out(deck: Part) -> list[str]:
    """Return lines that name everything that the scene lacks, the most important first.

    Names in a deck may have line breaks; a line has escapes in their place.
    """
    apart, otherwise, entries = _gathered(deck)
    drawn = [entry for entry in entries if DRAWN.search(entry.key)]
    off = [entry for entry in entries if entry not in drawn and _is_off(entry.value)]
    alike: dict[tuple[str, str, str], list[str]] = {}
    for entry in entries:
        if entry not in drawn and entry not in off:
            alike.setdefault((entry.of, entry.key, entry.value), []).append(entry.object)
    plain = []
    for (of, key, value), objects in alike.items():
        place = f"{of}[{', '.join(objects)}]" if any(objects) else of
        plain.append(f"{place}.{key}: {value}".lstrip("."))
    for label, some in (("values that are 0 or none", off), ("values that affect only drawings", drawn)):
        keys = dict.fromkeys(f"{entry.of}.{entry.key}".lstrip(".") for entry in some)
        plain += [f"{label}: {', '.join(keys)}"] if keys else []
    return [on_one_line(line) for line in (*apart, *otherwise, *plain)]


def _is_off(value: str) -> bool:
    """Return whether a value, or each value of a list, switches something off."""
    return all(word.strip() in OFF for word in value.strip("[]").split(","))


def _gathered(part: Part) -> tuple[list[str], list[str], list[Entry]]:
    """Return objects left out whole, entries that the scene has in another form, and entries left out."""
    if part.apart:
        return [f"{part.path}: left out whole: {part.apart}"], [], []
    apart: list[str] = []
    otherwise = [f"{part.path}.{key}: {reason}" for key, reason in part.otherwise.items()]
    entries: list[Entry] = []
    for key, value in part.data.items():
        if key in part.below:
            for inner in part.below[key]:
                found = _gathered(inner)
                apart += found[0]
                otherwise += found[1]
                entries += found[2]
        elif key not in part.taken and key != "Name" and value not in EMPTY:
            entries.append(_entry(part, str(key), value))
    return apart, otherwise, entries


def _entry(part: Part, key: str, value: Any) -> Entry:
    of, bracket, rest = part.path.partition("[")
    name, _, inner = rest.partition("]")
    text = " ".join(str(value).split())
    text = text if len(text) <= MOST_LISTED else f"{text[:MOST_LISTED]} ..."
    return Entry(of, name if bracket else "", f"{inner}.{key}".lstrip("."), text)
