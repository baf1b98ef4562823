"""Units as they are written after a number."""

from __future__ import annotations

import re

DEGREES = ("deg", "degree")
RAISED = str.maketrans("23456789", "²³⁴⁵⁶⁷⁸⁹")


def after_number(name: str) -> str:
    """Return a unit as written after a number, as in `` m/s`` for ``m s-1``; empty for a pure number.

    No library writes it so: pint sorts the factors by letters, and a moment in ``m·N`` reads as millinewton;
    it also refuses names such as ``bar absolute``. The notation has three parts, hence these few lines.
    """
    if name in ("", "1"):
        return ""
    if name in DEGREES:
        return "°"
    above: list[str] = []
    below: list[str] = []
    for part in name.split():
        factor = re.fullmatch(r"([A-Za-z]+)(-?)(|[1-9])", part)
        if factor is None or (factor[2] and not factor[3]):
            return f" {name}"
        power = factor[3].replace("1", "").translate(RAISED)
        (below if factor[2] else above).append(factor[1] + power)
    under = f"({' '.join(below)})" if len(below) > 1 else "".join(below)
    return f" {' '.join(above) or '1'}" + (f"/{under}" if below else "")
