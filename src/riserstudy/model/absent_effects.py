"""Effects that a scene lacks, with the reason."""

from __future__ import annotations

from riserstudy.effects.catalogue import catalogue

SIDEWAYS = "lateral freedom"
_ASKS = f", and {SIDEWAYS}"


def absent(present: set[str]) -> dict[str, str]:
    """Effects that are not among those present, by what would call for them.

    Where nothing moves a riser sideways, that is the reason: what else the effect asks for may be there.
    A riser that has an effect which asks for lateral freedom has this freedom, named or not.
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
