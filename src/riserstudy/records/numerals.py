"""Numbers and times in messages: few digits, and never an exponent."""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal

SPACED = 10_000  # least number with a space between its thousands


def plain(value: float, digits: int = 3) -> str:
    """Return a number with few significant digits and without an exponent: ``39900``, ``0.00002``."""
    if not math.isfinite(value):
        return f"{value:g}"
    return f"{Decimal(f'{value:.{digits}g}'):f}"


def at_most(value: float, digits: int = 3) -> str:
    """Return a positive upper limit, rounded down: a value that a user copies from a message is allowed."""
    return f"{Context(prec=digits, rounding=ROUND_FLOOR).create_decimal_from_float(value):f}"


def rounded_up(value: float, digits: int = 1) -> str:
    """Return a positive bound on results, rounded up unless only a rounding error exceeds its digits."""
    return f"{Context(prec=digits, rounding=ROUND_CEILING).create_decimal(f'{value:.9g}'):f}"


def spaced(value: float) -> str:
    """Return a number without decimals: ``9999``, ``11 793``; thousands are apart from five digits on."""
    return f"{value:,.0f}".replace(",", "\u00a0" if abs(value) >= SPACED else "")


def percent(share: float) -> str:
    """Return a share (1) in per cent: two significant digits, and no decimals from 10 % on."""
    size = 100.0 * share
    if 0.0 < abs(size) < 1e-4:
        return "< 0.0001 %"
    return f"{size:.0f} %" if abs(size) >= 10.0 else f"{plain(size, 2)} %"


def newtons(force: float) -> str:
    """Return a force (N) in N, and from 1000 N on in kN."""
    return f"{plain(force)} N" if abs(force) < 1e3 else f"{plain(force / 1e3)} kN"


def duration(seconds: float, digits: int = 2) -> str:
    """Return a time (s) in ms or s, from 100 s on in minutes, from two hours on in hours."""
    if seconds < 0.9995:
        return f"{plain(1e3 * seconds, digits)} ms"
    if seconds < 99.5:
        return f"{seconds:.{digits}g} s"
    number, unit = (seconds / 60.0, "min") if seconds < 7170.0 else (seconds / 3600.0, "h")
    return f"{number:.1f} {unit}" if number < 9.95 else f"{number:.0f} {unit}"
