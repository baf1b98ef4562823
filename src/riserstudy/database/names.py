"""Names of tables and columns: free ones, and as SQL writes them."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, count


class Names:
    """Names that are taken, whatever their case, as SQL compares them."""

    def __init__(self, taken: Iterable[str] = ()):
        self.taken = {name.lower() for name in taken}

    def free(self, wanted: str) -> str:
        """The name that is wanted, or the first of wanted_2, wanted_3 ... that is not taken."""
        if wanted.lower().startswith("sqlite_"):  # which SQLite keeps for itself
            wanted = f"_{wanted}"
        numbered = (f"{wanted}_{number}" for number in count(2))
        name = next(n for n in chain([wanted], numbered) if n.lower() not in self.taken)
        self.taken.add(name.lower())
        return name


def quoted(name: str) -> str:
    """A name as SQL takes it, whatever is in it."""
    return '"' + name.replace('"', '""') + '"'
