"""A number that the engine computes and its reference value; functions that several cases use."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.modes import modes_of
from riserstudy.simulation.simulate import simulate

if TYPE_CHECKING:
    import xarray as xr


FOURTH = "the error of 200 segments, which is of fourth order in their length"
CLOSED, SECOND, CONSERVED = "closed form", "second method", "conservation law"

Files = Mapping[str, SceneFile]


class Row(NamedTuple):
    """One quantity and its reference.

    ``tolerance`` is relative to ``scale``; None: the absolute value of the reference.
    """

    name: str
    quantity: str
    unit: str
    kind: str
    by: str
    reference: float
    value: float
    tolerance: float
    because: str
    scale: float | None = None

    @property
    def error(self) -> float:
        """Difference of value and reference, divided by the scale."""
        return abs(self.value - self.reference) / (self.scale or abs(self.reference))


Case = Callable[[Files], Iterator[Row]]


def pipe_of(file: SceneFile) -> tuple[float, float, float]:
    """Length (m), axial stiffness EA (N) and bending stiffness EI (N m2) of a scene's steel pipe."""
    section = file.resolved().riser[0]
    young, outer, inner = section.young_modulus, section.outer_diameter, section.inner_diameter
    if young is None or outer is None or inner is None:
        raise ValueError("the scene's riser is no pipe")
    area, second = math.pi / 4.0 * (outer**2 - inner**2), math.pi / 64.0 * (outer**4 - inner**4)
    return section.total_length, young * area, young * second


def simulated(file: SceneFile, sets: Mapping[str, Any] | None = None) -> xr.Dataset:
    """Simulate a scene after setting values in it."""
    return simulate(file.with_values(dict(sets or {}), "validation"), progress=False)


def frequencies_of(file: SceneFile, motion: str, count: int) -> list[float]:
    """Natural frequencies (rad/s) of one kind of motion, lowest first."""
    modes = modes_of(file.resolved(), 15)
    of = modes["frequency"].values[modes["motion"].values == motion]
    return [2.0 * math.pi * float(f) for f in of[:count]]


def held_below(section: dict[str, Any], top: dict[str, Any], analysis: dict[str, Any]) -> SceneFile:
    """Scene of a bar that is held below and whose top can move vertically."""
    tree = {
        "title": "held below",
        "riser": [{"name": "bar"} | section],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"z": "free"} | top,
        "analysis": analysis,
    }
    return SceneFile("validation", tree)


def hung(**section: Any) -> SceneFile:
    """Scene of a pipe that hangs from a held top and is free below."""
    pipe = {"name": "hung", "length": "300 m", "mass": "320 kg/m"} | section
    tree = {
        "title": "hung",
        "riser": [pipe],
        "bottom": {"hold": "free"},
        "top": {"x": "held", "z": "held", "elevation": "0 m"},
        "analysis": {"mesh": {"elements": 400}},
    }
    return SceneFile("validation", tree)
