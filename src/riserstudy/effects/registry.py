"""What an effect says of itself: its name, what calls for it, what takes it out, which function does what.

Texts here are for people and for `advice.changes`: kernels never see them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple

from riserstudy.solve.evaluate import Programs

Need = Literal["dynamics", "lateral", "levels", "drag"]


class Change(NamedTuple):
    """One effect removed from a scene, or added to one.

    Attributes
    ----------
    where : the path in a scene that has it, or lacks it; ``[*]`` stands for every section.
    set : path and value of what to set; a text that starts with ``=`` follows from the scene.
    needs : what a scene must be for the effect to matter.
    because : what was chosen, where it is added.
    """

    name: str
    kind: Literal["removed", "added"]
    where: str
    set: Mapping[str, Any]
    needs: tuple[Need, ...] = ()
    because: str | None = None

    @property
    def label(self) -> str:
        """How figures and tables name it."""
        return f"{'without' if self.kind == 'removed' else 'with'} {self.name}"


def taken_out(name: str, where: str, *needs: Need, sets: Mapping[str, Any] | None = None) -> Change:
    """An effect taken out: what calls for it made absent, or other values set."""
    return Change(name, "removed", where, sets or {where: None}, needs)


def put_in(name: str, where: str, sets: Mapping[str, Any], because: str, *needs: Need) -> Change:
    """An effect put in, with values that a riser might have."""
    return Change(name, "added", where, sets, needs, because)


class Called(NamedTuple):
    """An effect as users meet it.

    Attributes
    ----------
    name : in lists, datasets and messages.
    section : of a scene, that calls for it.
    changes : what takes it out or puts it in, when effects are compared.
    example : path and value that call for it in a plain riser held at both ends, where no common scene does.
    """

    name: str
    section: str
    changes: tuple[Change, ...] = ()
    example: Mapping[str, Any] | None = None


ROLES: dict[type, dict[str, Callable]] = {}
CALLED: dict[str, Called] = {}
NAMES: dict[type, tuple[str, ...]] = {}


def register(record: type, *called: Called | str, **functions: Callable) -> None:
    """Say how an effect is called, and what its functions are for.

    Parameters
    ----------
    called : as users meet it, several where records of one kind serve several; only the name where another
        record's file says the rest; none where a scene cannot call for it.
    functions : the roles are the fields of ``Programs``.

    Raises
    ------
    TypeError
        When there is no such role, or one of two that must be given together, or a name is taken.
    """
    if unknown := set(functions) - set(Programs._fields):
        raise TypeError(f"{record.__name__}: no such role: {', '.join(sorted(unknown))}")
    if ("mass" in functions) != ("lump" in functions):
        raise TypeError(f"{record.__name__}: mass and lump must be given together")
    for one in called:
        if isinstance(one, Called):
            call(one)
    ROLES[record] = functions
    NAMES[record] = tuple(one if isinstance(one, str) else one.name for one in called)


def call(effect: Called) -> None:
    """Put an effect on the list, once.

    Raises
    ------
    TypeError
        When there is another of that name.
    """
    if CALLED.setdefault(effect.name, effect) != effect:
        raise TypeError(f"two effects are called {effect.name!r}")
