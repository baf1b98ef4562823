"""Names, units and labels of variables, from the file of the package and those of chapters."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from riserstudy.dataset.chapter_variables import joined_tables
from riserstudy.files.chapters import own_chapters
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.records.facts import point_columns
from riserstudy.scene.quantities import QUANTITIES

ENDINGS = {"_max": "largest ", "_min": "smallest ", "_absmax": "largest size of ", "_static": "static "}
OVER_TIME = {"_deviation": "standard deviation of ", "_spectrum": "spectral density of "}


DIMENSIONS = (
    "time",
    "s",
    "s_node",
    "cylinder",
    "detail",
    "wall_angle",
    "point",
    "limit",
    "statistic",
)  # names in runs, and in studies while they are joined
#: quantities that runs return, with or without endings, if the scene has them
OF_RUNS = frozenset(name for name, of in QUANTITIES.items() if of.is_array)

DATA_FILES = ("variables.yaml",)
#: dimensions and variables of natural modes, if a study requests them
OF_MODES = frozenset(
    (
        *("mode", "s_relative", "natural_frequency", "frequency_error", "natural_period"),
        *("mode_motion", "mode_shape_x", "mode_shape_y", "mode_shape_z"),
    )
)


def of_points(name: str) -> bool:
    """Whether a name belongs to a number that studies may hold for each point."""
    return any(c.name == name and c.about.kind != "text" for c in point_columns())


def about_points() -> frozenset[str]:
    """Names of all variables that studies may hold for each point."""
    return frozenset(("point_key", "failure", *(column.name for column in point_columns())))


def quantity_of(name: str) -> str:
    """The quantity of runs that a variable belongs to; "" for others, such as values of all points."""
    return next((of for end in ("", *ENDINGS) if (of := name.removesuffix(end)) in QUANTITIES), "")


def of_runs(name: str) -> bool:
    """Whether a name is that of a quantity that runs return, with or without an ending."""
    return quantity_of(name) in OF_RUNS


def arrays_of(quantity: str) -> list[str]:
    """Names of the arrays in which runs return a quantity."""
    of = QUANTITIES[quantity]
    return [quantity + ending for ending in of.endings] if of.is_array else []


def variables() -> dict[str, dict[str, str]]:
    """Names, units and labels of all variables: the package's, and those of chapters where one works.

    Raises InputError when the file of a chapter is not valid, or gives a name that has another meaning
    elsewhere.
    """
    return _in_files(Path.cwd()) | _of_points()


def _of_points() -> dict[str, dict[str, str]]:
    return {column.name: column.attributes for column in point_columns() if column.attributes}


@cache
def _in_files(_folder: Path) -> dict[str, dict[str, str]]:
    own: dict[str, dict[str, str]] = read_yaml(Path(__file__).with_name(DATA_FILES[0]), keep=True)
    return own | joined_tables(own_chapters(), own | _of_points())


def attributes(name: str) -> dict[str, str]:
    """CF attributes of a variable."""
    for ending, word in (ENDINGS | OVER_TIME).items():
        base = name.removesuffix(ending)
        if base != name and base in variables():
            of = variables()[base]
            unit = density(of["units"]) if ending == "_spectrum" else of["units"]
            comment = {"comment": of["comment"]} if "comment" in of else {}
            return {"units": unit, "long_name": word + of["long_name"]} | comment
    of = variables().get(name, {})
    return {key: value for key, value in of.items() if key != "label"}


def density(unit: str) -> str:
    """Unit of a spectral density over frequency: ``N m`` becomes ``N2 m2 Hz-1``."""
    parts = (re.fullmatch(r"(\D+?)(-?\d+)?", part) for part in unit.split())
    powers = [f"{p[1]}{2 * int(p[2] or 1)}" for p in parts if p]  # without the number 1
    return " ".join([*powers, "Hz-1"])


def cf_unit(unit: str) -> str:
    """A unit in the notation of CF: ``kN*s^2/m^2`` becomes ``kN s2 m-2``; CF units are not changed."""
    unit = re.sub(r"\bdeg\b", "degree", unit)
    over, *under = unit.replace("^", "").split("/")
    below = [re.sub(r"(?<=[A-Za-z])(\d*)$", r"-\1", u) for part in under for u in part.split("*")]
    return " ".join([*over.split("*"), *(u if u[-1:].isdigit() else f"{u}1" for u in below)])
