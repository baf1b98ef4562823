"""Names of inputs and options in verdicts: in words, not as paths of a scene."""

from __future__ import annotations

import re
from collections.abc import Mapping

_INDEX = re.compile(r"^(\w+)\[(\d+)\]$")
_COUNTED = {"riser": "riser section"}
_JOINED = re.compile(r"[a-z]+(_[a-z0-9]+)+")
ABSENT = "none"
OF_A_LOAD = ("coefficient", "diameter")


def input_name(path: str, called: Mapping[str, str] | None = None) -> str:
    """A path of a scene, or the name of an axis or of interpretations, in words.

    ``current.profile.sum[0].surface_speed`` is the surface speed of current profile part 1.

    Parameters
    ----------
    path : path of an input.
    called : names of inputs in a paper's file, by path. None: none.
    """
    if called and path in called:
        return called[path]
    *above, last = path.split(".")
    if last in OF_A_LOAD and above:  # the coefficient of drag is a drag coefficient
        last = f"{above.pop()}_{last}"
    words = " ".join(_part(part) for part in above)
    return f"{_part(last)} of {words}" if words else _part(last)


def _part(part: str) -> str:
    indexed = _INDEX.match(part)
    if not indexed:
        return part.replace("_", " ")
    name, number = indexed[1], int(indexed[2]) + 1
    return f"{'part' if name == 'sum' else _COUNTED.get(name, name)} {number}"


def option_name(option: str) -> str:
    """An option in words; a part that is removed from a scene is "absent"."""
    if option == "None":
        return ABSENT
    return option.replace("_", " ") if _JOINED.fullmatch(option) else option
