"""A deck as a tree that knows which of its entries were taken, and that gathers what is wrong with them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError

#: of an entry that says nothing, which is never listed
EMPTY: tuple[Any, ...] = (None, "~", [], {})
MOST = 1e30  # in the unit of the deck: beyond all that is met, and fourth powers of it are numbers
GUESS = "nothing is guessed. Write the value into the OrcaFlex model"
CHANGE = "Change the OrcaFlex model, or write the scene by hand"


class Part:
    """One object of a deck; what is asked of it counts as taken.

    Faults are kept in a list that all parts of a deck share, so that a reader sees them together.
    """

    def __init__(
        self, data: Any, path: str, source: Path, faults: list[InputError] | None = None
    ) -> None:
        if not isinstance(data, dict):
            allowed = "write names with values, as OrcaFlex saves an object"
            raise InputError(source, path, "is not an object", allowed)
        self.data, self.path, self.source = data, path, source
        self.faults: list[InputError] = [] if faults is None else faults
        self.taken: set[str] = set()
        self.otherwise: dict[str, str] = {}  # what of an entry that was taken is not in the scene
        self.apart = ""  # why nothing of it is in the scene
        self.below: dict[str, list[Part]] = {}

    def refused(self, key: str, found: str, allowed: str) -> InputError:
        """What to raise of an entry that a scene cannot say."""
        return InputError(self.source, f"{self.path}.{key}".strip("."), found, allowed)

    @contextmanager
    def noting(self) -> Iterator[None]:
        """Keep the fault that ends what is done within, and go on after it."""
        try:
            yield
        except InputError as fault:
            self.note(fault)

    def note(self, fault: InputError) -> None:
        """Keep a fault, once."""
        if str(fault) not in map(str, self.faults):
            self.faults.append(fault)

    def optional(self, key: str) -> Any:
        """A value, None where there is none."""
        self.taken.add(key)
        value = self.data.get(key)
        return None if value == "~" else value

    def value(self, *keys: str) -> Any:
        """A value that must be there, under the first of its names that is."""
        present = [key for key in keys if self.data.get(key) not in (None, "~")]
        if not present:
            raise self.refused(" or ".join(keys), "missing", GUESS)
        return self.optional(present[0])

    def text(self, key: str) -> str:
        """A text that must be there."""
        return str(self.value(key))

    def number(self, *keys: str) -> float:
        """A number that must be there, in the unit of the deck; a fault is noted, and is no number."""
        with self.noting():
            return self._number(" or ".join(keys), self.value(*keys))
        return math.nan

    def given(self, key: str) -> float:
        """A number in the unit of the deck, 0 where there is none."""
        entry = self.optional(key)
        return 0.0 if entry is None else self.number(key)

    def numbers(self, key: str) -> list[float]:
        """Numbers in the unit of the deck, 0 where one is empty; none where there is no such list."""
        entry = self.optional(key) or []
        if not isinstance(entry, list):
            raise self.refused(key, repr(entry), "allowed is a list of numbers")
        return [self._number(key, 0.0 if one in EMPTY else one) for one in entry]

    def vector(self, key: str) -> tuple[float, float, float]:
        """Three numbers in the unit of the deck, 0 where one is empty."""
        self.value(key)
        numbers = self.numbers(key)
        if len(numbers) != 3:
            raise self.refused(
                key, f"{len(numbers)} values", "allowed are 3 values, for x, y and z"
            )
        return numbers[0], numbers[1], numbers[2]

    def _number(self, key: str, entry: Any) -> float:
        value = math.inf if entry == "Infinity" else entry
        if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value):
            raise self.refused(key, repr(entry), "allowed is a number")
        if MOST < abs(value) < math.inf:
            raise self.refused(key, repr(entry), "allowed are magnitudes of at most 1e30")
        return float(value)

    def whole(self, key: str) -> int:
        """A whole number that must be there; 0 where a fault was noted."""
        number = self.number(key)
        return 0 if math.isnan(number) else int(number)

    def has(self, *columns: str) -> bool:
        """Whether there is a table with these columns."""
        return self._header(columns) is not None

    def table(
        self, *columns: str, of: tuple[str, ...] = (), idle: tuple[str, ...] = ()
    ) -> list[list[Any]]:
        """Cells of some columns of a table, whatever others its version has and in whatever order.

        Parameters
        ----------
        columns : names of the columns that must be there.
        of : names of those that may be, which follow.
        idle : names of those that do not matter; of any other column what stands in it is left out by name.

        Returns
        -------
        list of list
            One list a row; None where a cell is empty, or its row ends before it.
        """
        key = self._header(columns)
        if key is None:
            raise self.refused(", ".join(columns), "missing", GUESS)
        names, rows = [name.strip() for name in key.split(",")], self.value(key)
        if not isinstance(rows, list) or not all(isinstance(row, list) for row in rows):
            allowed = f"write rows of {len(names)} values, one for each name"
            raise self.refused(key, "is not a table", allowed)
        full = [
            {
                name: None if cell in ("~", []) else cell
                for name, cell in zip(names, row, strict=False)
            }
            for row in rows
        ]
        for name in names:
            cells = [row.get(name) for row in full]
            if name not in (*columns, *of, *idle) and any(cell not in (None, 0) for cell in cells):
                self.otherwise[name] = f"{', '.join(map(str, cells))}; left out"
        return [[row.get(name) for name in (*columns, *of)] for row in full]

    def figures(
        self, *columns: str, of: tuple[str, ...] = (), idle: tuple[str, ...] = ()
    ) -> list[list[float]]:
        """Cells of a table in the unit of the deck; of columns that may be missing 0 where one is empty."""
        rows = self.table(*columns, of=of, idle=idle)
        names = (*columns, *of)
        return [
            [
                self._number(name, 0.0 if name in of and cell is None else cell)
                for name, cell in zip(names, row, strict=True)
            ]
            for row in rows
        ]

    def _header(self, columns: tuple[str, ...]) -> str | None:
        for key in self.data:
            if set(columns) <= {name.strip() for name in str(key).split(",")}:
                return str(key)
        return None

    def demand(self, key: str, wanted: Any) -> None:
        """See that an entry has the one value that a scene can say."""
        with self.noting():
            entry = self.value(key)
            yes = {True: "yes", False: "no"}.get(wanted, wanted)
            if entry != wanted and str(entry).lower() != yes:
                allowed = f"allowed is {wanted}: the import reads no other setting. {CHANGE}"
                raise self.refused(key, str(entry), allowed)

    def idle(self, key: str, *allowed: Any) -> None:
        """See that an entry, where there is one, is without effect: empty, 0, or one of what is allowed."""
        if (entry := self.optional(key)) not in (*EMPTY, 0, *allowed):
            words = " or ".join(map(str, allowed)) or "0"
            remedy = f"allowed is {words}: the import cannot convert other values. {CHANGE}"
            self.note(self.refused(key, str(entry), remedy))

    def alike(self, one: str, other: str) -> None:
        """See that both directions are alike, where the second is given."""
        if (second := self.optional(other)) not in (None, self.optional(one)):
            allowed = f"allowed is the value of {one}: a scene has one value for both directions"
            self.note(self.refused(other, str(second), allowed))

    def part(self, key: str) -> Part:
        """An object within."""
        return self._kept(key, [self.value(key)], [f"{self.path}.{key}".strip(".")])[0]

    def parts(self, key: str) -> list[Part]:
        """Objects of a list within; none where there is no such list."""
        entries = self.optional(key) or []
        if not isinstance(entries, list):
            raise self.refused(
                key, "is not a list", "write a list of objects, as OrcaFlex saves it"
            )
        names = [
            one.get("Name", k) if isinstance(one, dict) else k for k, one in enumerate(entries)
        ]
        return self._kept(key, entries, [f"{self.path}.{key}[{n}]".strip(".") for n in names])

    def named(self, key: str) -> dict[str, Part]:
        """Objects of a list within, by their names."""
        return {one.text("Name"): one for one in self.parts(key)}

    def _kept(self, key: str, data: list[Any], paths: list[str]) -> list[Part]:
        if key not in self.below:
            made = [Part(d, p, self.source, self.faults) for d, p in zip(data, paths, strict=True)]
            self.below[key] = made
        return self.below[key]

    @property
    def name(self) -> str:
        """What it is called, "" without a name."""
        return str(self.data.get("Name", ""))
