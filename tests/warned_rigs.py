"""Seeded rigs on real tensioners, in plane and space, whose runs have warnings of many kinds."""

import numpy as np
from random_rigs import at_mid_stroke, law, moving, shed_vortices, written

from riserstudy.errors import RiserStudyError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

GRAVITY = 9.80665


def heavy(tree, draw):
    """A section heavier in water than in air."""
    section = tree["riser"][-1]
    section["submerged_weight"] = float(draw.uniform(1.0, 1.2)) * GRAVITY * section["mass"]


def bare(tree, draw):
    """Sections without added mass, in waves that may break."""
    tree["riser"][int(draw.integers(len(tree["riser"])))].pop("added_mass")
    period = float(draw.uniform(4.0, 12.0))
    tree["wave"] = {"height": f"{draw.uniform(0.5, 6.0)!r} m", "period": period, "above_mean_level": "none"}


def barely(tree, draw):
    """A current in another unit."""
    tree["current"]["profile"]["surface_speed"] = float(draw.uniform(1e-5, 4e-4))


def stopped(tree, draw):
    """Cylinders, or a joint, with stops that the motion reaches."""
    room = f"{draw.uniform(0.1, 0.6)!r}"
    if tensioners := tree["top"].get("tensioners"):
        stops = {"shortest": f"-{room} m", "longest": f"{room} m", "stop_stiffness": "2 MN/m"}
        tensioners["stroke"] = stops
    if draw.random() < 0.5:
        stop = {
            "collapse": f"{room} m",
            "stroke": f"{room} m",
            "stiffness": f"{draw.uniform(0.001, 5)!r} MN/m",
        }
        tree["top"]["telescopic_joint"]["stop"] = stop


def pushing(tree, draw):
    """Cylinders so stiff that they push."""
    if tensioners := tree["top"].get("tensioners"):
        pull = at_mid_stroke(tensioners)
        for name in ("gas", "table", "linear"):
            tensioners.pop(name, None)
        tensioners["linear"] = {"tension": pull, "stiffness": float(draw.uniform(0.2, 1.5)) * pull}


def narrow(tree, draw):
    """Cylinders whose table is shorter than their stroke."""
    if tensioners := tree["top"].get("tensioners"):
        pull = at_mid_stroke(tensioners)
        for name in ("gas", "table", "linear"):
            tensioners.pop(name, None)
        tensioners |= law("table", pull, draw)
        for row in tensioners["table"]:
            row["reach"] *= 0.03


def seldom(tree, draw):
    """Few outputs, from the start or later."""
    output = tree["analysis"]["output"]
    output["interval"] = float(draw.uniform(0.25, 0.35)) * tree["analysis"]["duration"]  # of two periods
    if draw.random() < 0.5:
        output["start"] = f"{output['interval']!r} s"


def turned(tree, draw):
    """Operators with angles in another unit."""
    for name in ("surge", "heave", "sway", "pitch"):
        tree["platform"].pop(name, None)
    wave = {"height": "1 m", "period": f"{draw.uniform(5, 14)!r} s"}
    size, phase = draw.uniform(0.001, 3.0), draw.choice([0.5, 90.0, 2000.0])
    rows = [
        {"period": f"{period} s", "heave": f"{size!r} m/m", "heave_phase": f"{phase * share} deg"}
        | {"pitch": f"{size * share!r} rad/m", "pitch_phase": "0 deg"}
        for period, share in ((6, 0.3), (9, 0.6), (12, 1.0))
    ]
    response = {"operators": rows, "phases": "lead", "wave": wave, "ramp": "5 s"}
    tree["platform"]["response"] = response | {"beyond": str(draw.choice(["hold", "zero"]))}


def slack(tree, draw):
    """Too little tension."""
    for section in tree["riser"]:
        section["submerged_weight"] += float(draw.uniform(0.2, 0.8)) * GRAVITY * section["mass"]


def shedding(tree, draw):
    """Vortices, seen by few outputs."""
    shed_vortices(tree, float(draw.uniform(1.0, 5.0)))


def still(tree, draw):
    """At rest, although something moves the platform."""
    tree["analysis"] = {"mesh": tree["analysis"]["mesh"]}
    tree["platform"]["heave"] = {"amplitude": float(draw.uniform(30.0, 90.0)), "period": 10.0}


SLIPS = (heavy, bare, barely, stopped, pushing, narrow, seldom, turned, slack, shedding)


def warned_rig(seed, spatial):
    """A rig with up to three slips, at rest or in motion, as a scene file."""
    tree = moving(seed, spatial=spatial, conductor=False)
    draw = np.random.default_rng((seed, spatial, 41))
    tree["analysis"]["mesh"] = {"elements": int(draw.integers(10, 25))}
    for number in draw.choice(len(SLIPS), int(draw.integers(1, 4)), replace=False):
        SLIPS[number](tree, draw)
    if "viv" not in tree["riser"][0] and draw.random() < 0.3:
        still(tree, draw)
    return SceneFile(f"rig {seed}", written(tree))


def warned_run(seed, spatial):
    """Its run; None if it has no equilibrium, or a step fails."""
    try:
        return run(warned_rig(seed, spatial).resolved(), estimated=False)
    except RiserStudyError:
        return None
