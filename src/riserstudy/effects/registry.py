"""Registration of effects: name, key of the scene that includes the effect, changes, functions by role.

The texts here are for people and for `advice.changes`; compiled functions do not use them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple

from riserstudy.solve.evaluate import Programs

Need = Literal["dynamics", "lateral", "levels", "drag"]
LATERAL_FREEDOM = "lateral freedom"  # name of the effect that others require


class Change(NamedTuple):
    """The removal of one effect from a scene, or the addition of one.

    Attributes
    ----------
    where : path in a scene, present for a removal and absent for an addition; ``[*]`` is every section.
    set : paths and values to set; a text that starts with ``=`` is computed from the scene.
    needs : conditions that a scene must meet for the effect to matter.
    because : for an addition, the reason for the values that were chosen.
    """

    name: str
    kind: Literal["removed", "added"]
    where: str
    set: Mapping[str, Any]
    needs: tuple[Need, ...] = ()
    because: str | None = None

    @property
    def label(self) -> str:
        """Name of the change in figures and tables."""
        return f"{'without' if self.kind == 'removed' else 'with'} {self.name}"


def taken_out(name: str, where: str, *needs: Need, sets: Mapping[str, Any] | None = None) -> Change:
    """The removal of an effect: its key in the scene is removed, or other values are set."""
    return Change(name, "removed", where, sets or {where: None}, needs)


def put_in(name: str, where: str, sets: Mapping[str, Any], because: str, *needs: Need) -> Change:
    """The addition of an effect, with plausible values."""
    return Change(name, "added", where, sets, needs, because)


class Called(NamedTuple):
    """An effect as users see it.

    Attributes
    ----------
    name : name in lists, datasets and messages.
    section : key of a scene that includes it.
    changes : changes that remove or add it, when effects are compared.
    example : path and value that include it in a plain riser held at both ends, if no common scene has it.
    lateral : whether it also requires lateral freedom.
    """

    name: str
    section: str
    changes: tuple[Change, ...] = ()
    example: Mapping[str, Any] | None = None
    lateral: bool = False

    @property
    def requires(self) -> str:
        """All that a scene must contain for the effect."""
        return f"{self.section}, and {LATERAL_FREEDOM}" if self.lateral else self.section


ROLES: dict[type, dict[str, Callable]] = {}
CALLED: dict[str, Called] = {}
NAMES: dict[type, tuple[str, ...]] = {}


def register(record: type, *called: Called | str, **functions: Callable) -> None:
    """Register an effect: its names, and its functions by role.

    Parameters
    ----------
    called : the effect as users see it; several if records of this kind serve several effects. Only the name,
        if another record's file registers the effect; nothing, if no key of a scene includes it.
    functions : functions by role; the roles are the fields of ``Programs``.

    Raises
    ------
    TypeError
        When a role does not exist, only one of ``mass`` and ``lump`` is given, or a name is already used.
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
    """Add an effect to the list; a repeated identical entry has no effect.

    Raises
    ------
    TypeError
        When another effect has the same name.
    """
    if CALLED.setdefault(effect.name, effect) != effect:
        raise TypeError(f"two effects are called {effect.name!r}")
