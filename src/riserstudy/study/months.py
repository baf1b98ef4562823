"""Months of a record: hours of each month, and a check of equal coverage."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
DAYS = np.array((31.0, 28.25, 31.0, 30.0, 31.0, 30.0, 31.0, 31.0, 30.0, 31.0, 30.0, 31.0))
UNEVEN = 0.1  # largest relative difference of a month's hours from an equal share without a note


def month_of(time: NDArray[np.datetime64]) -> NDArray[np.int_]:
    """Month of each time, (n,): 0 is January."""
    return np.asarray(time.astype("datetime64[M]").astype(int) % 12)


def hours_of_month(year: int, month: int) -> float:
    """Length of a month in its unit, hours; 0 is January."""
    first = np.datetime64(f"{year}-{month + 1:02d}", "M")
    begin, end = (of.astype("datetime64[h]") for of in (first, first + 1))
    return float((end - begin) / np.timedelta64(1, "h"))


def uneven_months(time: NDArray[np.datetime64]) -> str:
    """A note about times, (n,), that do not cover the months of a year equally; "" if they do."""
    if not len(time):
        return ""
    rows = np.bincount(month_of(time), minlength=12)
    even = rows / (rows.sum() * DAYS / DAYS.sum())
    if (np.abs(even - 1.0) <= UNEVEN).all():
        return ""
    return (
        "the record covers the months unevenly, and its results are not those of a whole year; hours "
        "compared with an even share: " + ", ".join(f"{MONTHS[k]} {of:.0%}" for k, of in enumerate(even))
    )
