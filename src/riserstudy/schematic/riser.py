"""The riser string of a schematic: sections to scale, joints between and at their ends, bodies, soil."""

from __future__ import annotations

from typing import Any

import numpy as np

from riserstudy.scene.ends import Body, FlexJoint, Rotation
from riserstudy.scene.riser import Section
from riserstudy.schematic.facts import (
    amount,
    body_text,
    bottom_text,
    joint_text,
    metres,
    section_text,
    spring_text,
    top_text,
)
from riserstudy.schematic.geometry import SHORT, Geometry, Point, is_spring
from riserstudy.schematic.labels import AWAY, FREEDOM, LOAD, PART
from riserstudy.schematic.view import SYMBOL, THIN, View

STEEL, COVER = "#9aa4ad", "#d7dce0"
SPRINGS = 8  # most springs that are drawn along a conductor
LEAST = 0.04  # height of a body (inches)
BODY = 0.26  # height of the symbol of a body (inches)
WEIGHT = 0.42  # length of the arrow of a weight (inches)
MOVES_ASIDE = 0.63  # distance of the arrow of an axial motion from the riser (inches)
BORDER = 0.05  # half width of the mark between two sections (inches)
COIL, TURN = 0.18, 0.07  # width and height of a turn of a spring (inches)


def riser(view: View, geometry: Geometry) -> None:
    """Draw all sections with their diameters in the scene."""
    length = geometry.riser_length
    for section, low, high in geometry.sections:
        path = section.line
        _section(view, geometry, section, low, high)
        long = high - low > SHORT * length
        visible = [s for s in _from_the_middle(low, high) if view.shows(geometry.at(s))]
        if visible:
            text = section_text(section, geometry, path)
            if is_spring(section):
                remarks = [geometry.remark(f"{path}.{n}") for n in ("axial_stiffness", "length")]
                text = spring_text(section, *remarks)
            text += geometry.remark(path)
            seen = any(end.shows(geometry.at(s)) for s in _from_the_middle(low, high) for end in view.ends)
            view.name(text, geometry.at(visible[0]), whole=long or (view.whole and not seen))
        if view.whole and low in borders(geometry):
            _border(view, geometry.at(low))
        if section.lateral_load:
            _line_load(view, geometry, section.lateral_load, low, high)
        if section.flex_joint_below:
            place = geometry.at(low)
            turning_joint(view, place, section.flex_joint_below.stiffness > 0.0)
            name = "lower flex joint" if geometry.scene.soil else "flex joint"
            mark = geometry.mark(f"{path}.flex_joint_below.stiffness")
            text = f"{name}, {joint_text(section.flex_joint_below.stiffness, mark)}"
            view.name_anywhere(text, place)
        if section.guide_below:
            x, z = geometry.at(low)
            view.spring((x, z), (x + 0.8 * view.inch, z), 0.12 * view.inch)
            mark = geometry.mark(f"{path}.guide_below.stiffness")
            text = f"guide, {amount(section.guide_below.stiffness, 'N')}/m{mark}"
            view.name_anywhere(text, (x, z))


def borders(geometry: Geometry) -> list[float]:
    """Arclengths (m) at which two sections of the riser meet without a joint, which are marked."""
    lowest = geometry.scene.lowest_riser_section or 0
    return [low for section, low, _ in geometry.sections[lowest + 1 :] if not section.flex_joint_below]


def _border(view: View, place: Point) -> None:
    """Mark where two sections meet, as their widths are invisible in the whole view."""
    x, z = place
    view.line([x - BORDER * view.inch, x + BORDER * view.inch], [z, z], linewidth=THIN, zorder=2.3)


def _from_the_middle(low: float, high: float) -> list[float]:
    """Return positions along a section, its middle first."""
    places = np.linspace(low, high, 41)[1:-1]
    return sorted(places, key=lambda s: abs(s - 0.5 * (low + high)))


def _section(view: View, geometry: Geometry, section: Section, low: float, high: float) -> None:
    x, z = geometry.between(low, high)
    if is_spring(section):
        _coiled(view, x, z)
        return
    pipe = section.outer_diameter
    around = [part.diameter for part in (section.drag, section.added_mass) if part]
    cover = max(around, default=0.0)
    if cover > (pipe or 0.0):
        style = SYMBOL if pipe is None else {"edgecolor": "0.6", "linewidth": 0.5}
        _tube(view, x, z, cover, facecolor=COVER, zorder=2.0, **style)
    if pipe:
        _tube(view, x, z, pipe, facecolor=STEEL, edgecolor=PART, linewidth=0.6, zorder=2.5)
    view.line(list(x), list(z), linewidth=THIN if pipe else 1.6, zorder=2.2)


def _coiled(view: View, x: np.ndarray, z: np.ndarray) -> None:
    """Draw a section that is a spring; an upright one has turns of one size in both views of the ends."""
    if x[0] != x[-1]:
        view.spring((x[0], z[0]), (x[-1], z[-1]), COIL * view.symbol)
        return
    _, _, lowest, highest = view.window
    low, high = max(float(z[0]), lowest), min(float(z[-1]), highest)
    turns = max(int((high - low) / (TURN * view.inch)), 3)
    away = np.concatenate([[0.0, 0.0], np.resize([0.5, -0.5], turns), [0.0, 0.0]]) * COIL * view.symbol
    view.line(list(x[0] + away), list(np.linspace(low, high, turns + 4)), linewidth=THIN)


def _tube(view: View, x: np.ndarray, z: np.ndarray, diameter: float, **style: Any) -> None:
    slope = np.stack([np.gradient(x), np.gradient(z)])
    normal = np.stack([slope[1], -slope[0]]) / np.hypot(*slope) * 0.5 * diameter
    around = np.concatenate([np.stack([x, z]) + normal, (np.stack([x, z]) - normal)[:, ::-1]], axis=1)
    view.ax.fill(around[0], around[1], **style)


def _line_load(view: View, geometry: Geometry, load: float, low: float, high: float) -> None:
    side = -1.0 if load > 0.0 else 1.0
    for share in np.linspace(0.05, 0.95, 9):
        x, z = geometry.at(low + share * (high - low))
        view.arrow((x + side * 0.45 * view.symbol, z), (x + side * 0.08 * view.symbol, z))
    x, z = geometry.at(low + 0.275 * (high - low))
    text = f"line load {amount(load, 'N/m')}"
    view.name(text, (x + side * 0.3 * view.symbol, z), LOAD, whole=True)


def turning_joint(view: View, place: Point, sprung: bool) -> None:
    """Draw a circle at a joint that turns; it is filled if a spring resists."""
    face = "#f3c94f" if sprung else "white"
    view.ax.plot(*place, "o", markersize=6.0, markerfacecolor=face, markeredgecolor=PART, zorder=5)


def end_joint(view: View, place: Point, rotation: Rotation | None) -> None:
    """Draw the rotational support of an end: a square if it is clamped, else a circle."""
    if rotation == "fixed":
        view.ax.plot(*place, "s", markersize=6.0, color=PART, zorder=5)
        return
    sprung = rotation not in (None, "free") and not isinstance(rotation, str)
    turning_joint(view, place, bool(sprung))


def ends(view: View, geometry: Geometry) -> None:
    """Draw supports and loads at both ends of the riser."""
    scene = geometry.scene
    bottom, top = scene.bottom, scene.top
    if bottom.hold != "free":
        x, z = geometry.bottom
        below = z - (_height(view, geometry, True) if bottom.body else 0.0)  # a body stands on what holds it
        _ground(view, (x, below), rolling=bottom.hold == "foot")
        if scene.lateral:
            end_joint(view, geometry.bottom, bottom.rotation)
    view.name(bottom_text(scene, geometry.remark("bottom")), geometry.bottom, FREEDOM, lift=AWAY)
    if bottom.body:
        body(view, geometry, bottom.body, geometry.bottom, below=True)
    if top.body:
        body(view, geometry, top.body, geometry.ring, below=False)
    if not (view.whole or scene.lateral) and top.z == "free":
        x, z = geometry.ring
        view.motion((x - MOVES_ASIDE * view.symbol, z), (0.0, 0.5 * BODY * view.symbol))
    if scene.lateral:
        end_joint(view, geometry.top, top.rotation)
    view.name(top_text(geometry), geometry.top, FREEDOM, lift=AWAY)
    for name, end, place in (("upper", top, geometry.top), ("lower", bottom, geometry.bottom)):
        if scene.lateral and isinstance(end.rotation, FlexJoint):
            mark = geometry.mark(f"{'top' if end is top else 'bottom'}.rotation.stiffness")
            text = f"{name} flex joint, {joint_text(end.rotation.stiffness, mark)}"
            view.name(text, place, lift=-AWAY)
    _wellhead(view, geometry)
    soil(view, geometry)


def _wellhead(view: View, geometry: Geometry) -> None:
    """Label the top of a conductor in soil, which is one or more sections from the lower end upwards."""
    if geometry.scene.bottom.hold != "foot":
        return
    tops = [high for section, _, high in geometry.sections if "conductor" in section.name]
    if tops:
        x, z = geometry.at(max(tops))
        view.name_anywhere(f"wellhead, {metres(z)}", (x, z))


def _ground(view: View, place: Point, rolling: bool) -> None:
    x, z = place
    size = 0.16 * view.symbol
    view.ax.fill(
        [x, x - 0.7 * size, x + 0.7 * size], [z, z - size, z - size], facecolor="white", edgecolor=PART,
        linewidth=0.9, zorder=4,
    )  # fmt: skip
    gap = 0.35 * size if rolling else 0.0
    view.line([x - size, x + size], [z - size - gap, z - size - gap], linewidth=1.2, zorder=4)


def body(view: View, geometry: Geometry, body_of: Body, place: Point, below: bool) -> None:
    """Draw a concentrated mass as a symbol, as a scene does not contain its size."""
    scene = geometry.scene
    size = _height(view, geometry, below)
    x, z = place
    middle = z - 0.5 * size if below else z
    view.box((x, middle - 0.5 * size), 1.3 * size, size, facecolor="#c9ced3")
    density = scene.water.density if scene.water else 0.0
    weight = body_of.weight(scene.gravity or 0.0, density)
    path = f"{'bottom' if below else 'top'}.body"
    view.name(body_text(body_of, geometry, path), (x + 0.65 * size, middle))
    if weight:
        # below a body that hangs, beside one that stands, above one on the riser, where nothing else is drawn
        side, start = 0.0, z + 0.5 * size + WEIGHT * view.symbol
        if below:
            stands = scene.bottom.hold != "free"
            side, start = (0.9 * size, z + 0.3 * size) if stands else (0.0, z - size)
        if not view.whole:
            view.arrow((x + side, start), (x + side, start - WEIGHT * view.symbol))
        named = (x + side, start - (0.86 if below else 0.5) * WEIGHT * view.symbol)
        mark = geometry.mark(f"{path}.submerged_weight")
        view.name(f"weight {amount(weight, 'N')}{mark}", named, LOAD)


def _height(view: View, geometry: Geometry, below: bool) -> float:
    """Return the height of the symbol of a body; one below the riser does not reach the seabed (m)."""
    size, foot = BODY * view.symbol, geometry.bottom[1]
    if view.whole and below and geometry.seabed is not None and geometry.seabed < foot:
        return min(size, max(0.5 * (foot - geometry.seabed), LEAST * view.inch))
    return size


def soil(view: View, geometry: Geometry) -> None:
    """Draw springs along the part of the string in the soil."""
    of = geometry.scene.soil
    if of is None or view.whole:
        return
    foot = geometry.bottom[1]
    reach = 0.5 * view.symbol
    half = 0.5 * (geometry.scene.riser[0].outer_diameter or 0.0)
    depths = np.linspace(of.mudline, foot, SPRINGS + 2)[1:-1]
    for z in depths:
        for side in (-1.0, 1.0):
            view.spring((side * half, z), (side * (half + reach), z), 0.08 * view.symbol, linewidth=0.7)
    law = "p-y curves of soft clay" if hasattr(of.resistance, "straight_up_to") else "linear springs"
    view.name(f"soil: {law}", (half + reach, float(depths[2])))
