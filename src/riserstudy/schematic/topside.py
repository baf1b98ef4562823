"""Platform, tensioners, telescopic joint and the pull at the ring of a schematic."""

from __future__ import annotations

import math

from riserstudy.schematic.facts import (
    amount,
    metres,
    platform_texts,
    tension_text,
    tensioner_text,
    vessel_texts,
)
from riserstudy.schematic.geometry import Geometry
from riserstudy.schematic.labels import FREEDOM, LOAD, PART
from riserstudy.schematic.view import View

UPRIGHT = 0.9  # length of cylinders without a length in the scene (inches)
ASIDE = 0.28  # distance of upright cylinders from the riser (inches)
SLEEVE = 2.2  # diameter of a telescopic joint's outer barrel over the riser's diameter
BARREL = 0.09  # width of an upright cylinder (inches)
HULL = (1.5, 0.3)  # width and height of a platform (inches)
OPENING = 0.3  # width of the opening in a platform below the ring (inches)
HEAVE_ASIDE = 0.42  # distance of the heave arrow, as a share of the platform's width


def topside(view: View, geometry: Geometry) -> None:
    """Draw everything above the riser."""
    pull(view, geometry)
    telescopic_joint(view, geometry)
    tensioners(view, geometry)
    platform(view, geometry)


def pull(view: View, geometry: Geometry) -> None:
    """Draw the constant forces at the ring."""
    top = geometry.scene.top
    x, z = geometry.ring
    if top.tension:
        head = (x, z + 0.75 * view.symbol)
        if not view.whole:
            view.arrow((x, z), head)
        text = tension_text(geometry, top.tension)
        view.name(text, (x, z + 0.6 * view.symbol), LOAD)
    if top.lateral_force:
        side = math.copysign(0.6, top.lateral_force) * view.symbol
        if not view.whole:
            view.arrow((x, z), (x + side, z))
        force = f"{amount(top.lateral_force, 'N')}{geometry.mark('top.lateral_force')}"
        view.name(f"force {force} along x", (x + 0.8 * side, z), LOAD)


def telescopic_joint(view: View, geometry: Geometry) -> None:
    """Draw inner and outer barrel from the ring to the top."""
    joint = geometry.scene.top.telescopic_joint
    if joint is None:
        return
    (x, low), (_, high) = geometry.ring, geometry.top
    pipe = geometry.scene.riser[-1].outer_diameter or 0.06 * view.symbol
    view.box((x, low), SLEEVE * pipe, 0.55 * (high - low))
    view.box((x, low + 0.55 * (high - low)), pipe, 0.45 * (high - low), facecolor="white")
    stops = joint.stop and {1: joint.stop.stroke, -1: joint.stop.collapse}
    places = [metres(sign * by, "+") for sign, by in (stops or {}).items() if by]
    origin = "this length" if joint.mid_stroke is None else "the length in equilibrium"
    mark = geometry.mark("top.telescopic_joint.stop.stroke", "top.telescopic_joint.stop.collapse")
    stop = f", stop at {' and '.join(places)}{mark} from {origin}" if places else ""
    length = f"{joint.length:.4g} m{geometry.mark('top.telescopic_joint.length')}"
    text = f"telescopic joint: {length}{stop}{geometry.remark('top.telescopic_joint')}"
    view.name(text, (x + 0.5 * pipe, low + 0.7 * (high - low)))
    if joint.tension:
        if not view.whole:
            view.arrow((x, low), (x, low + 0.6 * view.symbol))
        mark = geometry.mark("top.telescopic_joint.tension")
        text = f"tension along the joint, {amount(joint.tension, 'N')}{mark}"
        view.name(text, (x, low + 0.4 * view.symbol), LOAD)


def deck(view: View, geometry: Geometry) -> float:
    """Return the drawn elevation of the platform (m); it includes the drawn length of cylinders without one.

    If the panels show a water surface for comparison, the elevation is equal in all panels; the sizes are
    those of symbols.
    """
    length = UPRIGHT * (view.symbol if geometry.surface is None else view.symbol_of_ends)
    if geometry.standing:
        return geometry.ring[1] - length - HULL[1] * view.symbol
    if geometry.has_upright_cylinders:
        return geometry.ring[1] + length
    return geometry.deck


def tensioners(view: View, geometry: Geometry) -> None:
    """Draw cylinders from the ring to the deck, to scale if the scene gives their positions."""
    rig = geometry.scene.top.tensioners
    if rig is None:
        return
    x, z = geometry.ring
    place = rig.arrangement
    if place:
        bearings = [math.cos(b) for b in place.bearings(rig.count)]
        feet = [(place.ring_radius * c, place.deck_radius * c) for c in bearings]
        high = place.deck_elevation
        view.line([x - place.ring_radius, x + place.ring_radius], [z, z], linewidth=2.4, zorder=4)
    else:
        places = [0.0] if rig.count == 1 else [-ASIDE * view.symbol, ASIDE * view.symbol]
        feet = [(a, a) for a in places]
        high = deck(view, geometry) + (HULL[1] * view.symbol if geometry.standing else 0.0)
        reach = max(feet[-1][0], BARREL * view.symbol)  # of the ring, also for a single cylinder
        view.line([x - reach, x + reach], [z, z], linewidth=2.4, zorder=4)
    for (low_x, high_x), works in zip(feet, rig.working, strict=False):
        middle = (x + 0.5 * (low_x + high_x), 0.5 * (z + high))
        colour = PART if works else "0.75"
        if place:
            view.line([x + low_x, middle[0]], [z, middle[1]], color=colour, zorder=3)
            rest = {"color": colour, "linewidth": 2.6, "zorder": 3}
            view.line([middle[0], x + high_x], [middle[1], high], **rest)
        else:
            view.line([middle[0]] * 2, [z, middle[1]], color=colour, linestyle=(0, (4, 2)))
            view.box(middle, BARREL * view.symbol, high - middle[1], edgecolor=colour)  # upward or downward
    right = max(feet, key=lambda foot: foot[1])
    at = (x + 0.5 * (right[0] + right[1]), 0.65 * high + 0.35 * z)
    text = tensioner_text(rig, geometry)
    unknown = "length not given" if rig.count <= 2 else "two are drawn; length not given"
    view.name(text + ("" if place else f" ({unknown})"), at)
    ring_end = max(foot[0] for foot in feet)
    view.name(f"tension ring{geometry.remark('top.tensioners')}", (x + ring_end, z))


def platform(view: View, geometry: Geometry) -> None:
    """Draw the platform as a symbol, with its motions and its loads."""
    scene = geometry.scene
    if scene.platform is None and scene.vessel is None:
        return
    width, height = (side * view.symbol for side in HULL)
    x, z = geometry.top[0], deck(view, geometry)
    if geometry.standing:  # the riser passes through an opening
        side = 0.5 * (width - OPENING * view.symbol)
        for sign in (-1.0, 1.0):
            view.box((x + sign * 0.5 * (width - side), z), side, height, facecolor="#dfe5ea")
    else:
        view.box((x, z), width, height, facecolor="#dfe5ea")
    middle = z + 0.5 * height
    edge = x + 0.5 * width
    afloat = vessel_texts(geometry)
    if scene.platform:
        motion = "; ".join(platform_texts(scene.platform, geometry) or ["none"])
        _motions(view, geometry, (x, middle), (width, height))
        if afloat:  # one label, because there is little room
            afloat[0] += f"; first-order motion: {motion}"
        else:
            view.name("platform (outline is a symbol)", (edge, z + 0.2 * height))
            view.name(f"platform motion: {motion}", (edge, middle), FREEDOM)
    for k, text in enumerate(afloat):
        colour = LOAD if k else FREEDOM
        view.name(text, (edge, z + (0.9 - 0.25 * k) * height), colour)
    if scene.vessel and not view.whole:
        view.motion((x, middle), (0.35 * width, 0.0))


def _motions(view: View, geometry: Geometry, middle: tuple[float, float], size: tuple[float, float]) -> None:
    of = geometry.scene.platform
    if of is None or view.whole:
        return
    moving = set(of.response.moving) if of.response else set()
    moving |= {n for n in ("surge", "sway", "heave", "roll", "pitch", "yaw") if getattr(of, n)}
    (x, z), (width, height) = middle, size
    if moving & {"surge", "sway"}:
        view.motion((x, z), (0.35 * width, 0.0))
    if "heave" in moving:
        view.motion((x - HEAVE_ASIDE * width, z), (0.0, 0.9 * height))
    if moving & {"pitch", "roll"}:
        view.turning((x, z + 0.5 * height), 0.3 * width)
    if of.cruise:
        view.arrow((x, z), (x + math.copysign(0.45 * width, of.cruise.speed), z), FREEDOM)
    centre = of.centre_of_rotation
    if centre and moving & {"roll", "pitch", "yaw"}:
        place = (centre.x or 0.0, centre.elevation)
        view.ax.plot(*place, "P", markersize=6, color=FREEDOM, markeredgecolor="white", zorder=7)
        level = metres(centre.elevation) + geometry.mark("platform.centre_of_rotation.elevation")
        text = f"centre of rotation, {level}{geometry.remark('platform.centre_of_rotation')}"
        view.name(text, place, FREEDOM)
