"""The errors that users see: place, found value, and allowed values or remedy."""

from __future__ import annotations

LONGEST = 400  # most characters of a part of a message


def printable(value: object) -> str:
    """Return a value as text for a message: of bounded length, on one line, without control characters."""
    text = str(value)
    return on_one_line(text if len(text) <= LONGEST else f"{text[: LONGEST - 4]} ...")


def on_one_line(text: str) -> str:
    """Return a text with escapes in place of line breaks and other control characters."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


class RiserStudyError(Exception):
    """Base class of the errors of this package. ``exit_code`` is the exit status of the command."""

    exit_code = 1

    @property
    def fault(self) -> str:
        """What is wrong: the message, without file and remedy if the error knows them separately."""
        return str(self)


class InputError(RiserStudyError):
    """A scene, study, table or command line is invalid.

    Parameters
    ----------
    where : object
        File, or "command line".
    field : str
        Dotted path of the field, "" for the whole file.
    found : str
        The invalid value, or the fault.
    allowed : str
        The allowed values, or the remedy.
    also : tuple of str
        Dotted paths of other fields that the fault concerns. They are not part of the message.
    """

    exit_code = 2

    def __init__(self, where: object, field: str, found: str, allowed: str, also: tuple[str, ...] = ()):
        self.where, self.field, self.found, self.allowed = str(where), field, found, allowed
        self.also = also
        super().__init__(f"{printable(where)}: {self.without_place}")

    @property
    def fault(self) -> str:
        """The field, and what is wrong with it."""
        return f"{printable(self.field)}: {printable(self.found)}" if self.field else printable(self.found)

    @property
    def without_place(self) -> str:
        """The message without the file."""
        return f"{self.fault}; {printable(self.allowed)}"

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, str, str, tuple[str, ...]]]:
        """Return class and arguments with which another process makes the error again."""
        return type(self), (self.where, self.field, self.found, self.allowed, self.also)


class InputErrors(InputError):
    """Several errors in one file, reported together, one per line.

    Parameters
    ----------
    faults : list of InputError
        One or more errors, all in one file.
    """

    def __init__(self, faults: list[InputError]):
        first = faults[0]
        super().__init__(first.where, first.field, first.found, first.allowed)
        self.faults = tuple(faults)
        if len(faults) > 1:
            lines = "".join(f"\n  {fault.without_place}" for fault in faults)
            self.args = (f"{printable(first.where)}: {len(faults)} faults:{lines}",)

    def __reduce__(self) -> tuple[type[InputErrors], tuple[list[InputError]]]:  # type: ignore[override]
        """Return class and arguments with which another process makes the error again."""
        return type(self), (list(self.faults),)


class SimulationError(RiserStudyError):
    """A simulation cannot be completed. The message gives cause and remedy, if they are known."""

    exit_code = 3


class PhysicallyUnstable(SimulationError):
    """An unstable equilibrium, which no finer mesh or step can cure."""


class TakesTooLong(SimulationError):
    """A run that takes longer than allowed."""


class StepFailed(SimulationError):
    """A time step that could not be completed, which a finer mesh and step may cure."""
