"""Elevations of a scene's riser and of its sections, before it stretches."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

ROUNDED = 1.0  # m, to which papers round elevations of decks
# distance (m) below which an end of a section is at a level: the sum of many lengths has a rounding error,
# which must not become a section
NEAR = 1e-6


class Span(NamedTuple):
    """Elevations of a riser's ends (m), as given or, where they are not given, of the unstretched riser."""

    bottom: float
    top: float


def span(scene: Parts) -> Span | None:
    """Elevations of the riser's ends; None where the scene gives neither elevation."""
    length = length_of(scene)
    top = scene.top.elevation
    if scene.bottom.elevation is None:
        return None if top is None else Span(top - length, top)
    return Span(scene.bottom.elevation, scene.bottom.elevation + length if top is None else top)


def levels(scene: Parts, k: int) -> tuple[float, float] | None:
    """Elevations of a section's ends before it stretches (m); None where they are not given.

    An end is exactly at the water surface if only a rounding error is between them.
    """
    lengths = [section.total_length for section in scene.riser]
    ends = span(scene)
    if ends is None:
        return None
    low = ends.bottom + sum(lengths[:k])
    surface = scene.water.surface if scene.water else None
    return at_level(surface, low), at_level(surface, low + lengths[k])


def at_level(level: float | None, end: float) -> float:
    """A level (m) if only a rounding error is between it and an elevation (m), else the elevation."""
    return level if level is not None and abs(end - level) < NEAR else end


def length_of(scene: Parts) -> float:
    """Length along the riser from end to end, with its telescopic joint (m)."""
    joint = scene.top.telescopic_joint
    return sum(s.total_length for s in scene.riser) + (joint.length if joint else 0.0)
