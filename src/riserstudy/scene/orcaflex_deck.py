"""A deck as a tree that knows which of its entries were taken."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from riserstudy.errors import InputError

MOST_SHOWN = 40  # characters of a value that is left out


class Part:
    """One object of a deck; what is asked of it counts as taken."""

    def __init__(self, data: Any, path: str, source: Path) -> None:
        if not isinstance(data, dict):
            raise InputError(source, path, "no object", "allowed are names with values")
        self.data, self.path, self.source = data, path, source
        self.taken: set[str] = set()
        self.otherwise: dict[str, str] = {}  # what of an entry that was taken is not in the scene
        self.below: dict[str, list[Part]] = {}

    def refused(self, key: str, found: str, allowed: str) -> InputError:
        """What to raise of an entry that a scene cannot say."""
        return InputError(self.source, f"{self.path}.{key}".strip("."), found, allowed)

    def optional(self, key: str) -> Any:
        """A value, None where there is none."""
        self.taken.add(key)
        value = self.data.get(key)
        return None if value == "~" else value

    def value(self, key: str) -> Any:
        """A value that must be there."""
        entry = self.optional(key)
        if entry is None:
            raise self.refused(key, "missing", "nothing is guessed; write it into the deck")
        return entry

    def text(self, key: str) -> str:
        """A text that must be there."""
        return str(self.value(key))

    def number(self, key: str) -> float:
        """A number that must be there, in the unit of the deck."""
        entry = self.value(key)
        if isinstance(entry, bool) or not isinstance(entry, int | float):
            raise self.refused(key, repr(entry), "allowed is a number")
        return float(entry)

    def values(self, key: str, count: int) -> list[Any]:
        """A list of so many values."""
        entry = self.value(key)
        if not isinstance(entry, list) or len(entry) != count:
            raise self.refused(key, repr(entry), f"allowed are {count} values")
        return entry

    def rows(self, key: str, least: int) -> list[list[Any]]:
        """Rows of a table of at least so many columns."""
        entry = self.value(key)
        if not isinstance(entry, list) or any(
            not isinstance(row, list) or len(row) < least for row in entry
        ):
            raise self.refused(key, "no table", f"allowed are rows of {least} values or more")
        return entry

    def demand(self, key: str, wanted: Any) -> None:
        """See that an entry has the one value that a scene can say."""
        entry = self.value(key)
        if entry != wanted and str(entry).lower() != {True: "yes", False: "no"}.get(wanted, wanted):
            raise self.refused(key, str(entry), f"allowed is {wanted}")

    def alike(self, one: str, other: str) -> None:
        """See that both directions are alike, where the second is given."""
        if (second := self.optional(other)) not in (None, self.optional(one)):
            raise self.refused(other, str(second), f"allowed is that of {one}")

    def part(self, key: str) -> Part:
        """An object within."""
        return self._kept(key, [self.value(key)], [f"{self.path}.{key}".strip(".")])[0]

    def parts(self, key: str) -> list[Part]:
        """Objects of a list within; none where there is no such list."""
        entries = self.optional(key) or []
        if not isinstance(entries, list):
            raise self.refused(key, "no list", "allowed is a list of objects")
        names = [
            one.get("Name", k) if isinstance(one, dict) else k for k, one in enumerate(entries)
        ]
        return self._kept(key, entries, [f"{self.path}.{key}[{n}]".strip(".") for n in names])

    def only(self, key: str) -> Part:
        """The one object of a list."""
        found = self.parts(key)
        if len(found) != 1:
            raise self.refused(key, f"{len(found)} of them", "allowed is one")
        return found[0]

    def _kept(self, key: str, data: list[Any], paths: list[str]) -> list[Part]:
        if key not in self.below:
            self.below[key] = [Part(d, p, self.source) for d, p in zip(data, paths, strict=True)]
        return self.below[key]

    def unused(self) -> list[str]:
        """Everything that nobody asked for, by its path with its value, and what is otherwise in a scene."""
        names = [f"{self.path}.{key}: {told}" for key, told in self.otherwise.items()]
        for key, value in self.data.items():
            if key in self.below:
                names += [line for part in self.below[key] for line in part.unused()]
            elif key not in self.taken:
                text = " ".join(str(value).split())
                text = text if len(text) <= MOST_SHOWN else f"{text[:MOST_SHOWN]} ..."
                names.append(f"{self.path}.{key}: {text}".removeprefix("."))
        return names
