"""Seeded scenes of drilling risers with real tensioners, in plane and space, as trees in SI units."""

from __future__ import annotations

import copy
import math
from typing import Any

import numpy as np

LAWS = ("linear", "gas", "table")
FOOT = 40.0  # m, of a conductor below the mudline


def rig(seed: int, *, spatial: bool | None = None, conductor: bool | None = None) -> dict[str, Any]:
    """A riser below a telescopic joint on inclined cylinders, at rest below a platform.

    The tensioners pull 1.3 to 1.8 times the weight that hangs on them, so that the riser is slack nowhere
    within a few per cent of its length.
    """
    draw = np.random.default_rng(seed)
    spatial = bool(draw.integers(2)) if spatial is None else spatial
    conductor = draw.random() < 0.3 if conductor is None else conductor
    depth = float(draw.uniform(300.0, 2500.0))
    outer = float(draw.uniform(0.45, 0.6))
    inner = outer - 2.0 * float(draw.uniform(0.018, 0.03))
    joint, above = float(draw.uniform(12.0, 25.0)), float(draw.uniform(15.0, 30.0))
    foot = float(draw.uniform(8.0, 20.0))  # of the riser's lower end above the seabed
    length = depth - foot + above - joint
    cuts = np.sort(draw.uniform(0.1, 0.9, int(draw.integers(0, 3))))
    lengths = np.diff(np.concatenate([[0.0], cuts, [1.0]])) * length
    sections, weight = [], 0.0
    for k, part in enumerate(lengths.tolist()):
        net = float(draw.uniform(-300.0, 1500.0))
        mud = float(draw.uniform(1025.0, 1600.0)) if k == 0 else sections[0]["contents"]["density"]
        sections.append(
            {
                "name": f"section {k}",
                "length": part,
                "outer_diameter": outer,
                "inner_diameter": inner,
                "young_modulus": 2.07e11,
                "mass": float(draw.uniform(400.0, 900.0)),
                "submerged_weight": net,
                "contents": {"density": mud},
                "drag": {"coefficient": float(draw.uniform(0.7, 1.2)), "diameter": outer + 0.4},
                "added_mass": {"coefficient": 1.0, "diameter": outer + 0.4},
            }
        )
        weight += (net + mud * 9.80665 * 0.25 * math.pi * inner**2) * part
    pull = float(draw.uniform(1.3, 1.8)) * weight
    count = int(draw.integers(3, 9))
    radius, deck = float(draw.uniform(0.5, 1.5)), float(draw.uniform(2.0, 6.0))
    cosine = joint / math.hypot(joint, deck - radius)
    tree: dict[str, Any] = {
        "title": f"rig {seed}",
        "gravity": 9.80665,
        "water": {"density": 1025.0, "surface": 0.0, "seabed": -depth},
        "riser": sections,
        "bottom": {
            "hold": "wellhead",
            "elevation": foot - depth,
            "rotation": {"stiffness": float(draw.uniform(0.0, 2e7))},
        },
        "top": {
            "x": "platform",
            "z": "platform",
            "elevation": above,
            "rotation": {"stiffness": float(draw.uniform(0.0, 2e6))},
            "telescopic_joint": {"length": joint, "bending_stiffness": float(draw.uniform(2e8, 8e8))},
            "tensioners": {
                "count": count,
                "mid_stroke": str(draw.choice(["riser unstretched", "riser in equilibrium"])),
                **law(str(draw.choice(LAWS)), pull / (count * cosine), draw),
                "arrangement": {
                    "ring_radius": radius,
                    "deck_radius": deck,
                    "deck_elevation": above,
                    "first_bearing": float(draw.uniform(0.0, 6.0)) if spatial else 0.0,
                },
            },
        },
        "platform": {"position": {"surge": 0.0}, "centre_of_rotation": {"elevation": 0.0}},
        "current": {
            "profile": {"shape": "power", "surface_speed": float(draw.uniform(0.1, 0.8)), "power": 1.0}
        },
        "analysis": {},
    }
    if conductor:
        stand_on_a_conductor(tree, draw)
    if spatial:
        tree["platform"]["position"]["sway"] = float(draw.uniform(-0.01, 0.01)) * depth
    return tree


def law(kind: str, pull: float, draw: np.random.Generator) -> dict[str, Any]:
    """The law of a cylinder that pulls so hard (N) at mid-stroke."""
    stiffness = float(draw.uniform(0.01, 0.06)) * pull  # N/m
    if kind == "linear":
        return {"linear": {"tension": pull, "stiffness": stiffness}}
    if kind == "table":
        rows = [(-12.0, 0.6), (-5.0, 0.85), (0.0, 1.0), (6.0, 1.15), (12.0, 1.5)]
        return {"table": [{"reach": reach, "force": share * pull} for reach, share in rows]}
    area, exponent = 0.08, 1.1
    volume = exponent * pull * area / stiffness
    return {"gas": {"area": area, "pressure": pull / area, "volume": volume, "exponent": exponent}}


def at_mid_stroke(tensioners: dict[str, Any]) -> float:
    """Pull of a cylinder at mid-stroke (N)."""
    if "linear" in tensioners:
        return float(tensioners["linear"]["tension"])
    if "gas" in tensioners:
        return float(tensioners["gas"]["area"] * tensioners["gas"]["pressure"])
    return next(row["force"] for row in tensioners["table"] if row["reach"] == 0.0)


def stand_on_a_conductor(tree: dict[str, Any], draw: np.random.Generator) -> None:
    """Put the riser on a stack and a conductor in soil, with its flex joint between."""
    joint = tree["bottom"]["rotation"]["stiffness"] or 1e6
    seabed = tree["water"]["seabed"]
    high = tree["bottom"]["elevation"] - seabed
    pipe = {
        "outer_diameter": 0.9144,
        "inner_diameter": 0.8382,
        "young_modulus": 2.07e11,
        "mass": 1500.0,
        "submerged_weight": 5000.0,
        "contents": copy.deepcopy(tree["riser"][0]["contents"]),
        "drag": {"coefficient": 1.0, "diameter": 0.9144},
        "added_mass": {"coefficient": 1.0, "diameter": 0.9144},
    }
    low = [
        {**copy.deepcopy(pipe), "name": "conductor", "length": FOOT},
        {
            **copy.deepcopy(pipe),
            **{"name": "stack", "length": high, "outer_diameter": 1.5, "inner_diameter": 0.47},
            **{"mass": 8000.0, "submerged_weight": 6e4},
        },
    ]
    tree["riser"][0]["flex_joint_below"] = {"stiffness": joint}
    tree["riser"] = low + tree["riser"]
    tree["bottom"] = {"hold": "foot", "elevation": seabed - FOOT, "rotation": "free"}
    stiffness = float(draw.uniform(2e6, 2e7))
    tree["soil"] = {"mudline": seabed, "resistance": {"stiffness": stiffness}}
    if stiffness > 1e7:
        tree["soil"]["damping"] = {"ratio": 0.1, "at_period": 6.0}


def timed(duration: float, step: float, elements: int, interval: float) -> dict[str, Any]:
    """How a rig is simulated in time (s), on a mesh and by a step of its own."""
    return {
        "duration": duration,
        "step": step,
        "mesh": {"elements": elements},
        "output": {"interval": interval},
    }


HIGHEST = 0.26  # frequency of the lift of vortices (1)
VIV = {"model": "synchronisation", "coefficient": 1.2, "memory": 20.0, "seed": 3}
VIV |= {"frequencies": [0.11, 0.18, HIGHEST]}


def shed_vortices(tree: dict[str, Any], ramp: float = 10.0) -> dict[str, Any]:
    """The same rig, whose sections all shed vortices after a ramp (s)."""
    for section in tree["riser"]:
        section["viv"] = VIV | {"diameter": section["drag"]["diameter"], "ramp": ramp}
    return tree


UNITS = {
    "gravity": "m/s^2",
    "density": "kg/m^3",
    "surface": "m",
    "seabed": "m",
    "length": "m",
    "outer_diameter": "m",
    "inner_diameter": "m",
    "young_modulus": "Pa",
    "mass": "kg/m",
    "submerged_weight": "N/m",
    "diameter": "m",
    "elevation": "m",
    "bending_stiffness": "N*m^2",
    "tension": "N",
    "force": "N",
    "reach": "m",
    "area": "m^2",
    "volume": "m^3",
    "pressure": "Pa absolute",
    "ring_radius": "m",
    "deck_radius": "m",
    "deck_elevation": "m",
    "first_bearing": "rad",
    "surge": "m",
    "sway": "m",
    "offset": "m",
    "surface_speed": "m/s",
    "mudline": "m",
    "amplitude": "m",
    "period": "s",
    "ramp": "s",
    "duration": "s",
    "interval": "s",
    "step": "s",
    "phase": "rad",
    "at_period": "s",
    "speed": "m/s",
}
STIFFNESS = {"rotation": "N*m/rad", "flex_joint_below": "N*m/rad", "resistance": "Pa"}


def written(tree: Any, inside: str = "", unit_of: dict[str, str] | None = None) -> Any:
    """A tree of SI numbers as a scene file has it: each number with its unit."""
    units = UNITS | (unit_of or {})
    if isinstance(tree, list):
        return [written(one, inside, unit_of) for one in tree]
    if not isinstance(tree, dict):
        return tree
    made = {}
    for name, value in tree.items():
        if isinstance(value, dict | list):
            made[name] = written(value, name, unit_of)
        elif isinstance(value, float) and name == "stiffness":
            made[name] = f"{value!r} {STIFFNESS.get(inside, 'N/m')}"
        elif isinstance(value, float) and name == "amplitude" and inside in ("roll", "pitch", "yaw"):
            made[name] = f"{value!r} rad"
        elif isinstance(value, float) and name == "mass" and inside in ("vessel", "body"):
            made[name] = f"{value!r} kg"
        elif isinstance(value, float) and name in units:
            made[name] = f"{value!r} {units[name]}"
        else:
            made[name] = value
    return made


def on_cylinders(seed: int, *needs: str, **kind: bool | None) -> dict[str, Any]:
    """The first rig in motion, from a seed on in steps of 97, whose tensioners have these entries."""
    rigs = (moving(k, **kind) for k in range(seed, seed + 2000, 97))
    return next(tree for tree in rigs if {*needs} <= {*tree["top"].get("tensioners", {})})


def moving(seed: int, **kind: bool | None) -> dict[str, Any]:
    """A rig in motion: surge, heave and pitch, in space sway and roll too, with its own mesh and step.

    Some are held by constant tension or by upright cylinders instead of inclined ones.
    """
    tree = rig(seed, **kind)
    draw = np.random.default_rng((seed, 1))
    top = tree["top"]
    period = float(draw.uniform(7.0, 16.0))
    names = ["surge", "heave", "sway"] if tree["platform"]["position"].get("sway") else ["surge", "heave"]
    for name in names:
        phase = float(draw.uniform(0.0, 6.0))
        tree["platform"][name] = {
            "amplitude": float(draw.uniform(0.3, 3.0)),
            "period": period,
            "phase": phase,
            "ramp": period,
        }
    if draw.random() < 0.5:
        tree["platform"]["pitch"] = {
            "amplitude": float(draw.uniform(0.005, 0.04)),
            "period": period,
            "ramp": period,
        }
    held = draw.choice(["inclined", "upright", "constant"], p=[0.6, 0.2, 0.2])
    rig_of = top["tensioners"]
    if held != "inclined":
        place = rig_of.pop("arrangement")
        lean = place["deck_radius"] - place["ring_radius"]
        length = top["telescopic_joint"]["length"]
        if held == "constant":
            upright = length / math.hypot(length, lean)
            top["telescopic_joint"]["tension"] = rig_of["count"] * at_mid_stroke(rig_of) * upright
            del top["tensioners"]
    step = period / float(draw.integers(20, 60))
    tree["analysis"] = {
        "duration": 2.0 * period,
        "step": step,
        "mesh": {"elements": int(draw.integers(20, 60))},
        "output": {"interval": float(draw.uniform(0.6, 1.7)) * step},
    }
    return tree
