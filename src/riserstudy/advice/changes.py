"""Changes of a scene by one effect: removed if the scene has it, else added."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from riserstudy.effects.catalogue import changes
from riserstudy.effects.registry import Change, Need
from riserstudy.model.layout import stiffness
from riserstudy.scene.forcing import Cruise, Current
from riserstudy.scene.load import SceneFile
from riserstudy.scene.paths import parent as parent_of
from riserstudy.scene.paths import value_at
from riserstudy.scene.resolve import Resolved

SEA_WATER = "1025 kg/m^3"
SECTIONS = "riser[*]"
TURN = math.radians(1e-4)
STOPS = 7.5  # distance of added stops from mid-stroke, either way (m)


def fitting(file: SceneFile) -> Iterator[tuple[Change, SceneFile]]:
    """Yield the possible changes of a scene, with the changed scene, which is not yet validated."""
    scene = file.resolved()
    for change in changes():
        if scene.analysis.solver and change.kind == "added":
            continue  # a change that the other solver cannot handle is not useful here
        if not all(suits(scene, need) for need in change.needs):
            continue
        if has(file.tree, scene, change.where) != (change.kind == "removed"):
            continue
        values = dict(_expanded(change, file.tree, scene))
        if values:
            yield change, file.with_values(values, f"the change '{change.label}'")


def suits(scene: Resolved, need: Need) -> bool:
    """Return whether a scene meets the condition under which an effect can matter."""
    water = scene.water
    return {
        "dynamics": scene.analysis.duration is not None,
        "lateral": bool(scene.lateral),
        "levels": water is not None and None not in (water.surface, water.seabed),
        "drag": any(section.drag for section in scene.riser),
    }[need]


def has(tree: dict[str, Any], scene: Resolved, where: str) -> bool:
    """Return whether a scene has the part that a path, or one of a few words, names."""
    special = {
        "riser[*].bending": all(stiffness(section).bending > 0.0 for section in scene.riser)
        and bool(scene.lateral),
        "lateral": not scene.spatial and scene.analysis.solver is None and bool(scene.lateral),
        "spatial": bool(scene.spatial),
    }
    if where in special:
        return special[where]
    if where.startswith(SECTIONS):
        return any(value_at(section, where[len(SECTIONS) + 1 :]) for section in tree["riser"])
    return bool(value_at(tree, where))


def _expanded(change: Change, tree: dict[str, Any], scene: Resolved) -> Iterator[tuple[str, Any]]:
    """Yield path and value of everything that a change sets in a scene."""
    for path, value in change.set.items():
        if not path.startswith(SECTIONS):
            parent = parent_of(path)
            if parent and parent != "water" and not value_at(tree, parent):
                continue
            if value is not None or value_at(tree, path) is not None:
                yield path, _filled(value, scene, 0)
            continue
        field = path[len(SECTIONS) + 1 :]
        for k, own in enumerate(tree["riser"]):
            yield f"riser[{k}].{field}", _filled(value, scene, _resolved_place(scene, own["name"]))


def _resolved_place(scene: Resolved, name: str) -> int:
    """Return the place of a section of the file among the resolved sections.

    Sections are divided at the surface, and a body that turns with the lower end is one more section.
    """
    return max(k for k, section in enumerate(scene.riser) if section.name == name)


def _filled(value: Any, scene: Resolved, k: int) -> Any:
    """Return a value with its placeholders replaced by values from the scene."""
    if isinstance(value, dict):
        return {name: _filled(part, scene, k) for name, part in value.items()}
    if not isinstance(value, str) or not value.startswith("="):
        return value
    section, body = scene.riser[k], scene.bottom.body
    length = sum(part.total_length for part in scene.riser)
    highest = scene.top.elevation
    lowest = scene.bottom.elevation
    if highest is None:
        highest = (lowest or 0.0) + length
    if lowest is None:
        lowest = highest - length
    return {
        "axial stiffness": f"{stiffness(section).axial!r} N",
        "outer diameter": f"{section.outer_diameter or 0.5334!r} m",
        "water": f"{scene.water.density!r} kg/m^3" if scene.water else SEA_WATER,
        "half the body": f"{0.5 * body.mass if body else 0.0!r} kg",
        "lowest": f"{lowest!r} m",
        "highest": f"{highest!r} m",
        "shortest reach": f"{max([-STOPS, *_reaches(scene)[:1]])!r} m",
        "longest reach": f"{min([STOPS, *_reaches(scene)[-1:]])!r} m",
        "current turned": _turned(scene.current),
        "cruise turned": _turned(scene.platform.cruise if scene.platform else None),
    }[value.removeprefix("=")]


def _reaches(scene: Resolved) -> list[float]:
    """Return the reaches in the tensioner table (m), in rising order; empty without a table."""
    rig = scene.top.tensioners
    return [row.reach for row in (rig and rig.table) or []]


def _turned(turned: Current | Cruise | None) -> str:
    """Return a heading that differs slightly from the heading of a current or cruise."""
    return f"{((turned.heading if turned else None) or 0.0) + TURN!r} rad"
