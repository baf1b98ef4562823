"""Effects that a scene lacks, with the reason."""

from __future__ import annotations

from riserstudy.effects.catalogue import catalogue
from riserstudy.effects.registry import LATERAL_FREEDOM


def absent(present: set[str]) -> dict[str, str]:
    """Effects that are not present, each with the reason, which is the missing input of the scene.

    If nothing moves the riser sideways, this is the reason for every effect that requires lateral freedom. A
    riser that has one of these effects has lateral freedom, whether or not ``present`` contains it.
    """
    return {name: f"no {inputs}" for name, inputs in missing(present).items()}


def missing(present: set[str]) -> dict[str, str]:
    """Effects that are not present, each with the input of the scene that it lacks; see ``absent``."""
    effects = catalogue()
    moves = LATERAL_FREEDOM in present or any(effects[n].lateral for n in present & effects.keys())
    known = present | ({LATERAL_FREEDOM} if moves else set())
    return {
        name: effects[LATERAL_FREEDOM if effect.lateral and not moves else name].section.removeprefix("a ")
        for name, effect in effects.items()
        if name not in known
    }
