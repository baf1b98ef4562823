"""A deck as a tree that records which of its entries were read, and collects the errors in them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError

#: values of an empty entry, which is never listed
EMPTY: tuple[Any, ...] = (None, "~", [], {})
MOST = 1e30  # in the unit of the deck: above all real values; its fourth power is still finite
GUESS = "write the value into the OrcaFlex model, since the import assumes no values"
CHANGE = "change the OrcaFlex model, or write the scene by hand"


class Part:
    """One object of a deck; every entry that is requested counts as read.

    Errors are collected in a list that all parts of a deck share, so that a user sees them together.
    """

    def __init__(self, data: Any, path: str, source: Path, faults: list[InputError] | None = None) -> None:
        if not isinstance(data, dict):
            allowed = "write names with values, as OrcaFlex saves objects"
            raise InputError(source, path, "this is not an object of OrcaFlex", allowed)
        self.data, self.path, self.source = data, path, source
        self.faults: list[InputError] = [] if faults is None else faults
        self.taken: set[str] = set()
        # entries that were read, and what of them the scene lacks
        self.otherwise: dict[str, str] = {}
        self.apart = ""  # why the scene contains nothing of this object
        self.below: dict[str, list[Part]] = {}

    def refused(self, key: str, found: str, allowed: str) -> InputError:
        """Return the error for an entry that a scene cannot describe."""
        return InputError(self.source, f"{self.path}.{key}".strip("."), found, allowed)

    @contextmanager
    def noting(self) -> Iterator[None]:
        """Record an error that ends the block, and continue after the block."""
        try:
            yield
        except InputError as fault:
            self.note(fault)

    def note(self, fault: InputError) -> None:
        """Record an error once."""
        if str(fault) not in map(str, self.faults):
            self.faults.append(fault)

    def optional(self, key: str) -> Any:
        """Return a value; None if it is missing."""
        self.taken.add(key)
        value = self.data.get(key)
        return None if value == "~" else value

    def value(self, *keys: str) -> Any:
        """Return a required value, under the first of its names that the object has."""
        present = [key for key in keys if self.data.get(key) not in (None, "~")]
        if not present:
            raise self.refused(" or ".join(keys), "missing", GUESS)
        return self.optional(present[0])

    def text(self, key: str) -> str:
        """Return a required text."""
        return str(self.value(key))

    def number(self, *keys: str, endless: bool = False) -> float:
        """Return a required number in the unit of the deck; NaN after an error, which is recorded.

        ``endless``: whether it may be Infinity, as the stiffness of a clamp.
        """
        with self.noting():
            return self._number(" or ".join(keys), self.value(*keys), endless)
        return math.nan

    def given(self, key: str) -> float:
        """Return a number in the unit of the deck; 0 if it is missing."""
        entry = self.optional(key)
        return 0.0 if entry is None else self.number(key)

    def numbers(self, key: str) -> list[float]:
        """Return a list of numbers in the unit of the deck, 0 for empty ones; empty without the list."""
        entry = self.optional(key) or []
        if not isinstance(entry, list):
            raise self.refused(key, f"{entry!r} is not a list", "write a list of numbers")
        return [self._number(key, 0.0 if one in EMPTY else one) for one in entry]

    def components(self, key: str) -> list[float]:
        """Return numbers for x, y and z in the unit of the deck, 0 for empty ones and without the list."""
        numbers = self.numbers(key) or [0.0] * 3
        if len(numbers) != 3:
            found = f"the number of values is {len(numbers)}"
            raise self.refused(key, found, "write 3 values, for x, y and z")
        return numbers

    def vector(self, key: str) -> tuple[float, float, float]:
        """Return three numbers in the unit of the deck, 0 for empty ones."""
        self.value(key)
        x, y, z = self.components(key)
        return x, y, z

    def _number(self, key: str, entry: Any, endless: bool = False) -> float:
        value = math.inf if entry == "Infinity" else entry
        if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value):
            raise self.refused(key, f"{entry!r} is not a number", "write a number")
        if math.isinf(value) and not endless:
            raise self.refused(key, f"{entry} is not finite", "write a finite number")
        if MOST < abs(value) < math.inf:
            raise self.refused(key, f"{entry!r} is too large", "write a number of at most 1e30")
        return float(value)

    def whole(self, key: str) -> int:
        """Return a required integer; 0 after an error, which is recorded."""
        number = self.number(key)
        return 0 if math.isnan(number) else int(number)

    def has(self, *columns: str) -> bool:
        """Return whether the object has a table with these columns."""
        return self._header(columns) is not None

    def table(self, *columns: str, of: tuple[str, ...] = (), idle: tuple[str, ...] = ()) -> list[list[Any]]:
        """Return cells of the named columns of a table; versions differ in other columns and in their order.

        Parameters
        ----------
        columns : names of required columns.
        of : names of optional columns, which follow in the result.
        idle : names of columns without meaning here; any further column is reported as left out.

        Returns
        -------
        list of list
            One list per row; None for a cell that is empty or beyond the end of its row.
        """
        key = self._header(columns)
        if key is None:
            raise self.refused(", ".join(columns), "missing", GUESS)
        names, rows = [name.strip() for name in key.split(",")], self.value(key)
        if not isinstance(rows, list) or not all(isinstance(row, list) for row in rows):
            allowed = f"write rows of {len(names)} values, one for each name"
            raise self.refused(key, "the entry is not a table", allowed)
        full = [
            {name: None if cell in ("~", []) else cell for name, cell in zip(names, row, strict=False)}
            for row in rows
        ]
        for name in names:
            cells = [row.get(name) for row in full]
            if name not in (*columns, *of, *idle) and any(cell not in (None, 0) for cell in cells):
                self.otherwise[name] = f"{', '.join(map(str, cells))}; left out"
        return [[row.get(name) for name in (*columns, *of)] for row in full]

    def figures(
        self, *columns: str, of: tuple[str, ...] = (), idle: tuple[str, ...] = (), endless: str = ""
    ) -> list[list[float]]:
        """Return cells of a table as numbers in the unit of the deck; 0 for an empty optional cell.

        ``endless``: column whose numbers may be Infinity.
        """
        rows = self.table(*columns, of=of, idle=idle)
        names = (*columns, *of)
        return [
            [
                self._number(name, 0.0 if name in of and cell is None else cell, name == endless)
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
        """Check that an entry has the only value that a scene can describe."""
        with self.noting():
            entry = self.value(key)
            yes = {True: "yes", False: "no"}.get(wanted, wanted)
            if entry != wanted and str(entry).lower() != yes:
                allowed = f"write {wanted}, or {CHANGE}"
                raise self.refused(key, f"the import cannot convert the setting {entry}", allowed)

    def idle(self, key: str, *allowed: Any) -> None:
        """Check that an entry, if present, has no effect: empty, 0, or one of the allowed values."""
        if (entry := self.optional(key)) not in (*EMPTY, 0, *allowed):
            words = " or ".join(map(str, allowed)) or "0"
            remedy = f"write {words}, or {CHANGE}"
            self.note(self.refused(key, f"the import cannot convert the value {entry}", remedy))

    def alike(self, one: str, other: str) -> None:
        """Check that both directions have equal values, if the second is given."""
        if (second := self.optional(other)) not in (None, self.optional(one)):
            allowed = f"write the value of {one}, since a scene has one value for both directions"
            self.note(self.refused(other, f"{second} differs from {one}", allowed))

    def part(self, key: str) -> Part:
        """Return an object inside this one."""
        return self._kept(key, [self.value(key)], [f"{self.path}.{key}".strip(".")])[0]

    def parts(self, key: str) -> list[Part]:
        """Return the objects of a list inside this one; empty if the list is missing."""
        entries = self.optional(key) or []
        if not isinstance(entries, list):
            raise self.refused(
                key, "the entry is not a list", "write a list of objects, as OrcaFlex saves it"
            )
        names = [one.get("Name", k) if isinstance(one, dict) else k for k, one in enumerate(entries)]
        return self._kept(key, entries, [f"{self.path}.{key}[{n}]".strip(".") for n in names])

    def named(self, key: str) -> dict[str, Part]:
        """Return the objects of a list inside this one, by their names."""
        return {one.text("Name"): one for one in self.parts(key)}

    def _kept(self, key: str, data: list[Any], paths: list[str]) -> list[Part]:
        if key not in self.below:
            made = [Part(d, p, self.source, self.faults) for d, p in zip(data, paths, strict=True)]
            self.below[key] = made
        return self.below[key]

    @property
    def name(self) -> str:
        """Name of the object, "" without a name."""
        return str(self.data.get("Name", ""))


def q(value: float, unit: str) -> str:
    """Return a quantity as text for a scene."""
    return f"{value:.10g} {unit}"
