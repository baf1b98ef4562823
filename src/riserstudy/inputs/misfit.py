"""What does not fit in data whose fields are well-formed one by one."""

from __future__ import annotations


class Misfit(ValueError):
    """A fault of several fields together, or of a value that its kind alone does not forbid.

    Parameters
    ----------
    path : str
        Dotted path, counted from the part that is checked; "" for that part itself.
    found, allowed : str
        What stands there, and what may stand there or what to do.
    also : tuple of str
        Paths, counted alike, of what the fault is about besides.
    """

    def __init__(self, path: str, found: str, allowed: str, also: tuple[str, ...] = ()):
        self.path, self.found, self.allowed, self.also = path, found, allowed, also
        super().__init__(f"{path}: {found}; {allowed}" if path else f"{found}; {allowed}")

    def below(self, path: str) -> Misfit:
        """The same, counted from what holds the checked part at ``path``."""
        return Misfit(joined(path, self.path), self.found, self.allowed, self.also)


def joined(path: str, rest: str) -> str:
    """A path and one that goes on from there."""
    return f"{path}.{rest}" if path and rest and not rest.startswith("[") else path + rest
