"""The view from above: cylinders around the ring, and headings of current, waves, wind and cruise."""

from __future__ import annotations

import math

from riserstudy.model.sea import current_velocity
from riserstudy.scene.resolve import Resolved
from riserstudy.schematic.facts import degrees
from riserstudy.schematic.geometry import Geometry
from riserstudy.schematic.labels import FREEDOM, LOAD, PART, WATER
from riserstudy.schematic.view import View

ROSE = 0.5  # length of the arrows of headings (inches)


def headings(scene: Resolved) -> list[tuple[str, float, str]]:
    """Return name, heading (rad) and colour of everything that has a heading."""
    platform, vessel = scene.platform, scene.vessel
    named = [
        ("current", scene.current, WATER),
        ("wave", scene.wave, WATER),
        ("wind", vessel and vessel.wind, LOAD),
        ("wave drift", vessel and vessel.wave_drift, LOAD),
        ("platform cruises", platform and platform.cruise, FREEDOM),
    ]
    rows = []
    for name, part, colour in named:
        if part is None:
            continue
        heading = getattr(part, "heading", None) or 0.0
        speed = getattr(part, "speed", None)
        if name == "current" and scene.current:
            heading = scene.current.towards
            if scene.current.turns:  # at the surface
                _, velocity = current_velocity(scene.current, scene.water)
                name, heading = "current at surface", math.atan2(velocity[1, -1], velocity[0, -1])
            speed = getattr(scene.current.profile, "surface_speed", None)
        against = speed is not None and speed < 0.0
        rows.append((name, heading + (math.pi if against else 0.0), colour))
    return rows


def has_plan(scene: Resolved) -> bool:
    """Return whether any part is outside the plane of x and z, or around the ring."""
    rig = scene.top.tensioners
    return bool(scene.spatial) or bool(rig and rig.arrangement)


def above(view: View, geometry: Geometry) -> None:
    """Draw everything from above, with the upper end in the middle."""
    rig = geometry.scene.top.tensioners
    place = rig.arrangement if rig else None
    view.ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0.0)
    view.ax.axvline(0.0, color="0.8", linewidth=0.6, zorder=0.0)
    if rig and place:
        for text, of, radius in (
            ("ring", "ring_radius", place.ring_radius),
            ("deck points", "deck_radius", place.deck_radius),
        ):
            turn = [2.0 * math.pi * k / 90 for k in range(91)]
            x, y = [radius * math.cos(a) for a in turn], [radius * math.sin(a) for a in turn]
            view.line(x, y, linewidth=0.8, color="0.5")
            at = (radius * math.cos(0.9), radius * math.sin(0.9))
            mark = geometry.mark(f"top.tensioners.arrangement.{of}")
            view.name(f"{text}, radius {radius:.3g} m{mark}", at)
        for bearing, works in zip(place.bearings(rig.count), rig.working, strict=True):
            c, s = math.cos(bearing), math.sin(bearing)
            radii = (place.ring_radius, place.deck_radius)
            colour = PART if works else "0.75"
            view.line([r * c for r in radii], [r * s for r in radii], linewidth=2.4, color=colour)
    pipe = geometry.scene.riser[-1].outer_diameter
    if pipe and place:
        view.box((0.0, -0.5 * pipe), pipe, pipe, facecolor="#9aa4ad", linestyle="-")
    else:
        view.ax.plot(0.0, 0.0, "o", markersize=4, color=PART, zorder=5)
    for name, heading, colour in headings(geometry.scene):
        reach = ROSE * view.symbol
        head = (reach * math.cos(heading), reach * math.sin(heading))
        view.arrow((0.0, 0.0), head, colour)
        view.name(f"{name} towards {degrees(heading % (2.0 * math.pi))}", head, colour)


def radius(geometry: Geometry) -> float:
    """Return half the height of the view from above (m)."""
    rig = geometry.scene.top.tensioners
    place = rig.arrangement if rig else None
    return 1.2 * max(place.deck_radius, place.ring_radius) if place else 1.0
