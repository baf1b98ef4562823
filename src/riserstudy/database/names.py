"""Names of tables and columns: unused names, and quoting for SQL."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, count


class Names:
    """Names in use; like SQL, it does not distinguish upper and lower case."""

    def __init__(self, taken: Iterable[str] = ()):
        self.taken = {name.lower() for name in taken}

    def free(self, wanted: str) -> str:
        """Return the wanted name, or the first unused name of wanted_2, wanted_3 and so on."""
        if wanted.lower().startswith("sqlite_"):  # prefix that SQLite reserves
            wanted = f"_{wanted}"
        numbered = (f"{wanted}_{number}" for number in count(2))
        name = next(n for n in chain([wanted], numbered) if n.lower() not in self.taken)
        self.taken.add(name.lower())
        return name


def quoted(name: str) -> str:
    """Return a name quoted for SQL, whatever characters it contains."""
    return '"' + name.replace('"', '""') + '"'
