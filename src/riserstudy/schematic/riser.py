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
            view.name(text, geometry.at(visible[0]), whole=long)
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


def _from_the_middle(low: float, high: float) -> list[float]:
    """Return positions along a section, its middle first."""
    places = np.linspace(low, high, 41)[1:-1]
    return sorted(places, key=lambda s: abs(s - 0.5 * (low + high)))


def _section(view: View, geometry: Geometry, section: Section, low: float, high: float) -> None:
    x, z = geometry.between(low, high)
    if is_spring(section):
        view.spring((x[0], z[0]), (x[-1], z[-1]), 0.18 * view.inch)
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
        _ground(view, geometry.bottom, rolling=bottom.hold == "foot")
        if scene.lateral:
            end_joint(view, geometry.bottom, bottom.rotation)
    view.name(bottom_text(scene, geometry.remark("bottom")), geometry.bottom, FREEDOM, lift=AWAY)
    if bottom.body:
        body(view, geometry, bottom.body, geometry.bottom, below=True)
    if top.body:
        body(view, geometry, top.body, geometry.ring, below=False)
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
    size = 0.26 * view.symbol
    x, z = place
    if view.whole and below and geometry.seabed is not None and geometry.seabed < z:
        # hangs freely, as in reality
        size = min(size, max(0.5 * (z - geometry.seabed), LEAST * view.inch))
    middle = z - 0.5 * size if below else z
    view.box((x, middle - 0.5 * size), 1.3 * size, size, facecolor="#c9ced3")
    density = scene.water.density if scene.water else 0.0
    weight = body_of.weight(scene.gravity or 0.0, density)
    path = f"{'bottom' if below else 'top'}.body"
    view.name(body_text(body_of, geometry, path), (x + 0.65 * size, middle))
    if weight:
        tail = (x, middle - 0.5 * size)
        if not view.whole:
            view.arrow(tail, (x, tail[1] - 0.42 * view.symbol))
        head = (x, tail[1] - 0.36 * view.symbol)
        mark = geometry.mark(f"{path}.submerged_weight")
        view.name(f"weight {amount(weight, 'N')}{mark}", head, LOAD)


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
