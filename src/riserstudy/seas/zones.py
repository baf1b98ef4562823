"""Check that times are in UTC, by netCDF attributes, which the decoder ignores, or by a column of zones."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.errors import InputError
from riserstudy.seas.columns import plain

if TYPE_CHECKING:
    import xarray as xr

#: names of attributes or columns with a zone, and of text that may mention one
ZONES_BY_NAME = ("time_zone", "timezone", "tz", "zone", "time_offset", "utc_offset", "gmt_offset")
TEXTS = ("long_name", "standard_name", "comment", "comments", "description", "note", "title", "summary")
UTC = re.compile(
    r"(?i)\b(?:utc|gmt|zulu|universal)\b(?! ?[+-] ?0*[1-9])"
    r"|^\s*(?:z|[+-]?0*[:.]?0*\s*(?:h|hours?)?)\s*$"
)
ABBREVIATIONS = r"\b(?:CET|CEST|WET|EET|MSK|BST|EST|EDT|CST|CDT|MST|MDT|PST|PDT|BRT|WAT|JST|AWST|AEST)\b"
LOCAL = r"(?i:\blocal (?:standard |civil |summer )?time|\b(?:utc|gmt) ?[+-] ?0*[1-9])"
OF_TIMES = re.compile(f"{LOCAL}|{ABBREVIATIONS}")
OF_FILE = re.compile(rf"{LOCAL}|(?i:\btimes?\b).{{0,20}}{ABBREVIATIONS}")


def check_zone(path: Path, clock: xr.DataArray, name: str, about: Mapping[Any, Any]) -> None:
    """Check that no attribute states another time zone than UTC.

    Raises InputError with the attribute that states it.

    Parameters
    ----------
    clock : the times; xarray has already applied a numeric offset in their units.
    about : attributes of the file.
    """
    for source, value in _other_zones(clock, name, about):
        allowed = "convert the times to UTC, or correct the attribute"
        raise InputError(path, source, f"{value!r} states a time zone other than UTC", allowed)


def check_zone_of_table(path: Path, heading: str, cells: Iterable[str]) -> None:
    """Check that a column of zones, identified by its heading, has only UTC.

    Raises InputError with the first row that has another zone.
    """
    if plain(heading) not in ZONES_BY_NAME:
        return
    for row, cell in enumerate(cells, start=2):
        if not UTC.search(cell):
            allowed = "convert the times to UTC"
            raise InputError(
                f"{path}, row {row}", heading, f"{cell!r} is a time zone other than UTC", allowed
            )


def _other_zones(clock: xr.DataArray, name: str, about: Mapping[Any, Any]) -> Iterator[tuple[str, str]]:
    """Attributes that state another zone than UTC, with their values."""
    units = str(clock.encoding.get("units", ""))
    if OF_TIMES.search(units):  # the decoder would ignore it
        yield f"{name}:units", units
    for where, attributes, local in ((f"{name}:", clock.attrs, OF_TIMES), ("", about, OF_FILE)):
        for key, value in attributes.items():
            text, key_plain = str(value), plain(str(key))
            zone = key_plain in ZONES_BY_NAME or (key_plain in TEXTS and local.search(text))
            if zone and not UTC.search(text):
                yield f"{where}{key}", text
