"""Ways to write one scene otherwise, and what its results then are: nothing of them may depend on the way."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from random_rigs import UNITS, written

from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile

Tree = dict[str, Any]
ALONG = ("x", "y", "z", "effective_tension", "bending_moment")
OVER_TIME = ("ufj_angle", "lfj_angle", "joint_stroke", "tensioner_stroke", "tensioner_force")
EXTREMES = ("shear_force_absmax", "von_mises_stress_max", "effective_tension_min", "bending_moment_absmax")


class Otherwise(NamedTuple):
    """A scene written otherwise, and what its outputs are to be before they are compared."""

    tree: Tree  # as a file has it, with units
    back: Callable[[dict[str, np.ndarray]], dict[str, np.ndarray]]
    within: float = 1e-6  # of the largest value of an output


def same(arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Outputs as they are."""
    return arrays


OTHER = {
    "m": ("ft", 0.3048),
    "N": ("kip", 4448.2216152605),
    "kg/m": ("lb/ft", 0.45359237 / 0.3048),
    "N/m": ("lbf/ft", 4.4482216152605 / 0.3048),
    "Pa": ("ksi", 6894757.293168361),
    "rad": ("deg", math.pi / 180.0),
    "s": ("min", 60.0),
    "m/s": ("knot", 1852.0 / 3600.0),
    "kg/m^3": ("lb/ft^3", 0.45359237 / 0.3048**3),
}


def in_other_units(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """Each number in the unit of another trade."""

    def turned(text: Any) -> Any:
        if isinstance(text, dict):
            return {name: turned(value) for name, value in text.items()}
        if isinstance(text, list):
            return [turned(value) for value in text]
        number, _, unit = text.partition(" ") if isinstance(text, str) else ("", "", "")
        if unit not in OTHER:
            return text
        name, size = OTHER[unit]
        return f"{float(number) / size!r} {name}"

    return Otherwise(turned(written(tree)), same)


def lifted(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """Sea, well and platform together up or down."""
    tree, by = copy.deepcopy(tree), float(draw.uniform(-3000.0, 3000.0))
    for path in (("water", "surface"), ("water", "seabed"), ("bottom", "elevation"), ("top", "elevation")):
        tree[path[0]][path[1]] += by
    tree["platform"]["centre_of_rotation"]["elevation"] += by
    if place := tree["top"].get("tensioners", {}).get("arrangement"):
        place["deck_elevation"] += by
    if "soil" in tree:
        tree["soil"]["mudline"] += by
    return Otherwise(written(tree), lambda arrays: arrays | {"z": arrays["z"] - by})


def rotated(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """All of it about the vertical; in space, where it is not there already."""
    tree, angle = copy.deepcopy(tree), float(draw.uniform(0.3, 6.0))
    if tree["platform"].get("pitch"):  # finite turns about two axes are not one about an axis between
        return Otherwise(written(tree), same)
    c, s = math.cos(angle), math.sin(angle)
    position = tree["platform"]["position"]
    x, y = position.get("surge", 0.0), position.get("sway", 0.0)
    position |= {"surge": c * x - s * y, "sway": s * x + c * y}
    tree["current"]["heading"] = angle
    turn(tree["platform"], "surge", "sway", c, s)
    if place := tree["top"].get("tensioners", {}).get("arrangement"):
        place["first_bearing"] += angle

    def back(arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        x, y = arrays["x"], arrays["y"]
        return arrays | {"x": c * x + s * y, "y": c * y - s * x}

    return Otherwise(written(tree, unit_of={"heading": "rad"}), back)


def turn(platform: Tree, first: str, second: str, c: float, s: float) -> None:
    """Motions along two axes as motions along the turned axes, harmonic by harmonic."""
    motions: dict[str, list[Tree]] = {first: [], second: []}
    for name, shares in ((first, (c, s)), (second, (-s, c))):
        for one in listed(platform.pop(name, None)):
            for target, share in zip((first, second), shares, strict=True):
                phase = one.get("phase", 0.0) + (math.pi if share < 0.0 else 0.0)
                motions[target].append({**one, "amplitude": abs(share) * one["amplitude"], "phase": phase})
    platform |= {name: several for name, several in motions.items() if several}


def listed(motion: Tree | list[Tree] | None) -> list[Tree]:
    """The harmonics of a motion."""
    return motion if isinstance(motion, list) else [motion] if motion else []


def mirrored(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """Seen from the other side: x and y the other way round, by half a turn about the vertical."""
    tree = copy.deepcopy(tree)
    position = tree["platform"]["position"]
    for name in ("surge", "sway"):
        if name in position:
            position[name] = -position[name]
    tree["current"]["heading"] = math.pi
    for name in ("surge", "sway", "pitch", "roll"):
        for one in listed(tree["platform"].get(name)):
            one["phase"] = one.get("phase", 0.0) + math.pi
    if place := tree["top"].get("tensioners", {}).get("arrangement"):
        place["first_bearing"] += math.pi

    def back(arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        flat = "y" not in arrays  # in space sizes have no sign
        names = ("x", "y", *(("bending_moment", "ufj_angle", "lfj_angle") if flat else ()))
        return arrays | {name: -arrays[name] for name in names if name in arrays}

    return Otherwise(written(tree, unit_of={"heading": "rad"}), back)


def split(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """Each section that has an even number of segments as two."""
    scene = SceneFile("rig.yaml", written(tree)).resolved()
    counts = np.bincount(even(scene, tree["analysis"]["mesh"]["elements"]).section)
    total = sum(section["length"] for section in tree["riser"])
    size = total / tree["analysis"]["mesh"]["elements"]
    tree, sections = copy.deepcopy(tree), []
    for section, count in zip(tree["riser"], counts, strict=False):
        half = 0.5 * section["length"]
        if section["name"] in ("conductor", "stack") or 2 * max(1, round(half / size)) != count:
            sections.append(section)
            continue
        upper = {**copy.deepcopy(section), "name": section["name"] + ", upper", "length": half}
        upper.pop("flex_joint_below", None)
        sections += [{**section, "length": half}, upper]
    tree["riser"] = sections
    return Otherwise(written(tree), same, 1e-5)


def swayed_by_nothing(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """With a sway of a picometre: the same riser in space."""
    tree = copy.deepcopy(tree)
    period = listed(tree["platform"]["surge"])[0]["period"]
    tree["platform"].setdefault("sway", {"amplitude": 1e-12, "period": period, "ramp": period})
    return Otherwise(written(tree), same, 1e-5)


def moved_by_the_top(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """The platform's surge at rest as an offset of the riser's top."""
    tree = copy.deepcopy(tree)
    if tree["platform"].get("pitch"):  # which turns about a centre that does not move with an offset
        return Otherwise(written(tree), same)
    tree["top"]["offset"] = tree["platform"]["position"]["surge"]
    tree["platform"]["position"]["surge"] = 0.0
    return Otherwise(written(tree), same)


DIMENSIONS = {  # powers of length, mass and time
    "m": (1, 0, 0),
    "m/s^2": (1, 0, -2),
    "kg/m^3": (-3, 1, 0),
    "Pa": (-1, 1, -2),
    "Pa absolute": (-1, 1, -2),
    "kg/m": (-1, 1, 0),
    "N/m": (0, 1, -2),
    "N": (1, 1, -2),
    "N*m^2": (3, 1, -2),
    "N*m/rad": (2, 1, -2),
    "m^2": (2, 0, 0),
    "m^3": (3, 0, 0),
    "m/s": (1, 0, -1),
    "s": (0, 0, 1),
    "rad": (0, 0, 0),
}
OF_OUTPUTS = {
    **dict.fromkeys(("x", "y", "z", "joint_stroke", "tensioner_stroke"), (1, 0, 0)),
    **dict.fromkeys(("effective_tension", "effective_tension_min", "tensioner_force"), (1, 1, -2)),
    **dict.fromkeys(("bending_moment", "bending_moment_absmax"), (2, 1, -2)),
    "shear_force_absmax": (1, 1, -2),
    "von_mises_stress_max": (-1, 1, -2),
}


def scaled(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """The same numbers of similarity: lengths, masses and times by a factor each."""
    factors = [float(draw.uniform(0.5, 2.0)) for _ in range(3)]

    def factor(powers: tuple[int, int, int]) -> float:
        return math.prod(f**power for f, power in zip(factors, powers, strict=True))

    def grown(text: Any) -> Any:
        if isinstance(text, dict):
            return {name: grown(value) for name, value in text.items()}
        if isinstance(text, list):
            return [grown(value) for value in text]
        number, _, unit = text.partition(" ") if isinstance(text, str) else ("", "", "")
        if unit not in DIMENSIONS:
            return text
        return f"{float(number) * factor(DIMENSIONS[unit])!r} {unit}"

    def back(arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: values / factor(OF_OUTPUTS.get(name, (0, 0, 0))) for name, values in arrays.items()}

    return Otherwise(grown(written(tree)), back)


def told_less_often(tree: Tree, draw: np.random.Generator) -> Otherwise:
    """With every second output; the others are compared."""
    tree = copy.deepcopy(tree)
    tree["analysis"]["output"]["interval"] *= 2.0
    return Otherwise(written(tree), same, 0.0)


WAYS = (
    in_other_units,
    lifted,
    rotated,
    mirrored,
    split,
    swayed_by_nothing,
    moved_by_the_top,
    scaled,
    told_less_often,
)
assert UNITS  # numbers of random rigs are written with these
