"""Positions of the parts of a scene: the unloaded line of the riser, and levels around it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.initial_shape import sagging
from riserstudy.model.sea import levels
from riserstudy.scene.paths import meets
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section

Point = tuple[float, float]
# share of the riser's length; shorter sections are shown with the end at which they are
SHORT = 0.1
LINE_POINTS = 201
ASSUMED, CALIBRATED = "*", "†"  # marks of such values in labels


@dataclass(frozen=True)
class Geometry:
    """The unstretched riser of a scene as a line in the plane of x and z, and levels around it (m).

    ``standing``: cylinders without an arrangement are on the platform below the ring and push the ring up.
    ``remarks``: remarks for the labels of parts, by the paths of the parts.
    ``assumed``, ``calibrated``: paths of values that the scene assumes, or fits to a published value.
    """

    scene: Resolved
    standing: bool = False
    remarks: Mapping[str, str] = field(default_factory=dict)
    assumed: frozenset[str] = frozenset()
    calibrated: frozenset[str] = frozenset()

    def remark(self, path: str) -> str:
        """Return the remark of a part in brackets, which follows its label; empty without a remark."""
        return f" ({self.remarks[path]})" if path in self.remarks else ""

    def assumes(self, path: str, excluded: str = "") -> bool:
        """Return whether the value at a path, a part of it (except ``excluded``) or its parent is assumed."""
        return _any_at(self.assumed - {excluded}, path)

    def mark(self, *paths: str) -> str:
        """Return the mark of a value from the given paths: assumed, calibrated, or none."""
        if any(map(self.assumes, paths)):
            return ASSUMED
        return CALIBRATED if any(_any_at(self.calibrated, path) for path in paths) else ""

    @cached_property
    def length(self) -> float:
        """Unstretched length up to the top, including the telescopic joint (m)."""
        joint = self.scene.top.telescopic_joint
        return self.riser_length + (joint.length if joint else 0.0)

    @cached_property
    def riser_length(self) -> float:
        """Unstretched length up to the tension ring (m)."""
        return sum(section.total_length for section in self.scene.riser)

    @cached_property
    def sections(self) -> list[tuple[Section, float, float]]:
        """Sections with the arclengths of their ends (m)."""
        rows, start = [], 0.0
        for section in self.scene.riser:
            rows.append((section, start, start + section.total_length))
            start += section.total_length
        return rows

    @cached_property
    def line(self) -> tuple[NDArray[np.float64], ...]:
        """Arclength, x and z of points along the riser (m): straight, or sagging if it is slack.

        Stack and conductor are vertical. A telescopic joint fills the gap between the riser and its top.
        """
        scene = self.scene
        s = np.linspace(0.0, self.length, LINE_POINTS)
        s = np.unique(np.concatenate([s, [end for *_, end in self.sections]]))
        foot = scene.bottom.elevation
        if foot is None:
            foot = (scene.top.elevation or 0.0) - self.length
        offset = scene.top.offset or 0.0
        rise = self.length if scene.top.elevation is None else scene.top.elevation - foot
        upright = self._upright if offset else 0.0
        length, rise = self.length - upright, rise - upright
        chord, hung = math.hypot(offset, rise), self.riser_length - upright
        above = np.maximum(s - upright, 0.0)
        if scene.top.telescopic_joint and hung < chord:
            share = np.interp(above, [0.0, hung, length], [0.0, hung / chord, 1.0])
            x, z = offset * share, rise * share
        elif offset and chord < length:
            x, z = sagging(above, offset, rise)
        else:
            # If only one end has a known elevation, the riser keeps its length.
            if scene.top.elevation is None and abs(offset) < length:
                rise = math.sqrt(length**2 - offset**2)
            x, z = offset * above / length, rise * above / length
        return s, x, z + np.minimum(s, upright) + foot

    @property
    def _upright(self) -> float:
        """Length of stack and conductor (m), above which the riser is inclined."""
        lowest = self.scene.lowest_riser_section or int(self.scene.soil is not None)
        return self.sections[lowest][1] if lowest < len(self.sections) else 0.0

    def at(self, s: float) -> Point:
        """Return the point of the riser at an arclength (m)."""
        along, x, z = self.line
        return float(np.interp(s, along, x)), float(np.interp(s, along, z))

    def between(self, low: float, high: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the line between two arclengths (m)."""
        s = self.line[0]
        inside = np.concatenate([[low], s[(s > low) & (s < high)], [high]])
        x, z = zip(*map(self.at, inside), strict=True)
        return np.array(x), np.array(z)

    @cached_property
    def bottom(self) -> Point:
        """The lower end."""
        return self.at(0.0)

    @cached_property
    def ring(self) -> Point:
        """The riser's top, which is the tension ring if it has one."""
        return self.at(self.riser_length)

    @cached_property
    def top(self) -> Point:
        """The upper end, above the telescopic joint if there is one."""
        return self.at(self.length)

    @cached_property
    def deck(self) -> float:
        """Elevation of the tensioners' upper ends, or of the riser's top (m)."""
        rig = self.scene.top.tensioners
        place = rig.arrangement if rig else None
        return max(place.deck_elevation, self.top[1]) if place else self.top[1]

    @cached_property
    def spans(self) -> list[tuple[float, float]]:
        """Seabed and surface (m), of the water and of each part of the current."""
        water, current = self.scene.water, self.scene.current
        rows = [levels(part, water) for part in current.parts] if current else []
        if water and water.surface is not None and water.seabed is not None:
            rows.insert(0, (water.seabed, water.surface))
        return rows

    @cached_property
    def surface(self) -> float | None:
        """Mean water level (m); None if the scene does not give it."""
        water = self.scene.water
        known = [water.surface] if water and water.surface is not None else []
        return next(iter([*known, *(high for _, high in self.spans)]), None)

    @cached_property
    def seabed(self) -> float | None:
        """Elevation of the seabed (m); None if the scene does not give it."""
        soil, water = self.scene.soil, self.scene.water
        known = [soil.mudline] if soil else []
        known += [water.seabed] if water and water.seabed is not None else []
        return next(iter([*known, *(low for low, _ in self.spans)]), None)

    @cached_property
    def lowest(self) -> float:
        """Lowest of all elevations (m)."""
        surfaces = [] if self.seabed is None else [self.seabed]
        return float(min([*self.line[2], *surfaces]))

    @cached_property
    def highest(self) -> float:
        """Highest of all elevations (m)."""
        surfaces = [] if self.surface is None else [self.surface]
        return float(max([self.deck, *self.line[2], *surfaces]))

    @cached_property
    def has_upright_cylinders(self) -> bool:
        """Whether cylinders have no length in the scene: they are symbols, and the platform is shifted."""
        top = self.scene.top
        return bool(top.tensioners and not top.tensioners.arrangement and not top.telescopic_joint)

    def short_below(self) -> float:
        """Return the length of the short sections at the lower end (m)."""
        total = 0.0
        for section, _, _ in self.sections:
            if section.total_length > SHORT * self.riser_length:
                break
            total += section.total_length
        return total


def _any_at(values: Iterable[str], path: str) -> bool:
    """Return whether any of the values' paths is the given path, below it or above it."""
    return any(meets(one, path) for one in values)


def labelled(scene: Resolved) -> Iterator[str]:
    """Yield the paths of the parts whose labels can have a remark."""
    for section in scene.riser:
        yield section.line
        if is_spring(section):
            yield from (f"{section.line}.axial_stiffness", f"{section.line}.length")
    yield from ("top", "bottom")
    if scene.top.tensioners:
        yield "top.tensioners"
    if scene.current:
        yield "current"
    if scene.top.telescopic_joint:
        yield "top.telescopic_joint"
    platform = scene.platform
    if platform:
        yield from (f"platform.{name}" for name, _ in platform.harmonics)
        if platform.centre_of_rotation:
            yield "platform.centre_of_rotation"


def is_spring(section: Section) -> bool:
    """Return whether a section has only an axial stiffness."""
    bare = section.mass is None and section.submerged_weight is None and not section.outer_diameter
    return bare and bool(section.axial_stiffness)
