"""Effects that a scene lacks, with the reason."""

from __future__ import annotations

from riserstudy.effects.catalogue import catalogue

SIDEWAYS = "lateral freedom"
_ASKS = f", and {SIDEWAYS}"


def absent(present: set[str]) -> dict[str, str]:
    """Effects that are not present, each with the reason, which is the missing input of the scene.

    If nothing moves the riser sideways, this is the reason for every effect that requires lateral freedom. A
    riser that has one of these effects has lateral freedom, whether or not ``present`` contains it.
    """
    sections = {name: effect.section for name, effect in catalogue().items()}
    sideways = any(sections.get(name, "").endswith(_ASKS) for name in present)
    known = present | ({SIDEWAYS} if sideways else set())
    still = _why(sections[SIDEWAYS], "")
    return {
        name: _why(why, "" if SIDEWAYS in known else still)
        for name, why in sections.items()
        if name not in known
    }


def _why(why: str, instead: str) -> str:
    if why.endswith(_ASKS):
        return instead or f"no {why.removesuffix(_ASKS)}"
    return f"no {why.removeprefix('a ')}"
