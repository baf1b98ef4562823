"""Errors of data whose single fields have the correct type."""

from __future__ import annotations


class Misfit(ValueError):
    """An error of several fields together, or of a value that its type alone does not forbid.

    Parameters
    ----------
    path : str
        Dotted path, relative to the part that is checked; "" for that part itself.
    found, allowed : str
        The value that was found, and the values that are allowed or what to do.
    also : tuple of str
        Further paths that the error concerns, relative to the same part.
    """

    def __init__(self, path: str, found: str, allowed: str, also: tuple[str, ...] = ()):
        self.path, self.found, self.allowed, self.also = path, found, allowed, also
        super().__init__(f"{path}: {found}; {allowed}" if path else f"{found}; {allowed}")

    def below(self, path: str) -> Misfit:
        """Return the same error with paths relative to the part that has the checked part at ``path``."""
        return Misfit(joined(path, self.path), self.found, self.allowed, self.also)


def joined(path: str, rest: str) -> str:
    """Return a path joined with a path relative to it."""
    return f"{path}.{rest}" if path and rest and not rest.startswith("[") else path + rest
