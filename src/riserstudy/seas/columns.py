"""What columns of a sea record may be: names, units and ranges, and the header that says so."""

from __future__ import annotations

import re
from typing import NamedTuple

from riserstudy.errors import InputError
from riserstudy.scene.units import to_si


class Column(NamedTuple):
    """A quantity of a sea record."""

    name: str
    unit: str  # SI, as `to_si` takes it; "deg" stays degrees
    long_name: str
    standard_name: str  # of CF
    least: float
    most: float
    names: tuple[str, ...]  # that headers give it, in lower case with underscores


COLUMNS = (
    Column(
        "significant_wave_height",
        "m",
        "significant wave height",
        "sea_surface_wave_significant_height",
        0.0,
        35.0,
        ("hs", "h_s", "hm0", "swh", "significant_height", "wave_height"),
    ),
    Column(
        "peak_period",
        "s",
        "peak period",
        "sea_surface_wave_period_at_variance_spectral_density_maximum",
        0.5,
        40.0,
        ("tp", "t_p", "wave_period_at_peak"),
    ),
    Column(
        "zero_crossing_period",
        "s",
        "mean zero-upcrossing period",
        "sea_surface_wave_zero_upcrossing_period",
        0.5,
        30.0,
        ("tz", "t_z", "t02", "tm02", "zero_up_crossing_period", "zero_upcrossing_period"),
    ),
    Column(
        "wave_from_direction",
        "deg",
        "direction that waves come from, clockwise from north",
        "sea_surface_wave_from_direction",
        0.0,
        360.0,
        ("mwd", "wave_direction_from", "mean_wave_direction_from"),
    ),
    Column("wind_speed", "m/s", "wind speed", "wind_speed", 0.0, 120.0, ("u10", "wind")),
    Column(
        "current_speed",
        "m/s",
        "speed of the current",
        "sea_water_speed",
        0.0,
        10.0,
        ("current", "surface_current_speed"),
    ),
)
NAMES = {name: one for one in COLUMNS for name in (one.name, *one.names)}
#: headers that say too little, and what to say instead
UNSURE = {
    "period": "peak_period or zero_crossing_period: one is some 1.3 times the other",
    "t": "peak_period or zero_crossing_period",
    "wave_period": "peak_period or zero_crossing_period",
    "mean_period": "zero_crossing_period, if it is that of zero upcrossings",
    "direction": "wave_from_direction or wave_to_direction",
    "wave_direction": "wave_from_direction or wave_to_direction",
    "dir": "wave_from_direction or wave_to_direction",
}
#: noted of records, which seldom hold other heights
UNSURE_HEIGHT = "wave_height is taken as the significant height, not as that of the largest wave"
_HEAD = re.compile(r"\s*(?P<name>[^(\[]+?)\s*[(\[](?P<unit>[^)\]]*)[)\]]\s*")


def labels_of(one: Column) -> dict[str, str]:
    """Attributes of a variable, by CF."""
    units = {"deg": "degree", "m/s": "m s-1"}.get(one.unit, one.unit)
    return {"units": units, "long_name": one.long_name, "standard_name": one.standard_name}


#: directions that waves go to, which are half a turn from those that they come from
GOES_TO = ("wave_to_direction", "wave_direction_to", "mean_wave_direction_to")


class Head(NamedTuple):
    """A column of a file: its quantity, None of one that is not known, and what one of its units is in SI."""

    quantity: Column | None
    heading: str
    factor: float
    unit: str
    turned: bool = False  # whether it is the direction that waves go to


def plain(name: str) -> str:
    """A name in lower case with underscores."""
    return re.sub(r"\W+", "_", name.strip().lower()).strip("_")


def head(where: str, text: str) -> Head:
    """What a header such as ``hs (ft)`` says.

    Raises
    ------
    InputError
        When it is ambiguous, or gives no unit of its dimension.
    """
    match = _HEAD.fullmatch(text)
    name, unit = (match["name"], match["unit"].strip()) if match else (text, "")
    key = plain(name)
    if key in UNSURE:
        raise InputError(where, text.strip(), "is ambiguous", f"say {UNSURE[key]}")
    turned = key in GOES_TO
    quantity = NAMES["wave_from_direction"] if turned else NAMES.get(key)
    if quantity is None or key == "time":
        return Head(None, key, 1.0, unit)
    if not unit:
        allowed = f"allowed is a unit after the name, as in '{quantity.name} ({quantity.unit})'"
        raise InputError(where, text.strip(), "no unit", allowed)
    if quantity.unit == "deg":
        if plain(unit) not in ("deg", "degree", "degrees", "degt", "deg_true", "degree_true"):
            raise InputError(where, text.strip(), f"unit {unit!r}", "allowed is deg")
        return Head(quantity, key, 1.0, unit, turned)
    try:
        return Head(quantity, key, to_si(f"1 {unit}", quantity.unit), unit)
    except ValueError as error:
        raise InputError(where, text.strip(), str(error), f"as in {quantity.unit}") from None
