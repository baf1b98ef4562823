"""What a deck means by OrcaFlex's theory: its stretch, and the weight of its ring, are those of the scene.

The deck is read with plain YAML, and its numbers are used by the formulas of OrcaFlex's manual.
"""

import math
import re

import numpy as np
import pytest
from drawn_decks import drawn, file_of
from ruamel.yaml import YAML

from riserstudy import simulate
from riserstudy.export.orcaflex import write_deck

GRAVITY = 9.80665
FINE = 4001  # points along the riser


def deck_of(file):
    made = write_deck(file)
    return YAML(typ="safe", pure=True).load(made.text), made.left_out


def area(diameter):
    return 0.25 * math.pi * diameter**2


def pieces(deck):
    """Line type, length (m) and density of contents (kg/m3) of each section of the riser, from the top."""
    kinds = {kind["Name"]: kind for kind in deck["LineTypes"]}
    return [
        (kinds[name], length, 1e3 * line["ContentsDensity"])
        for line in deck["Lines"]
        for name, length, _ in line["LineType, Length, TargetSegmentLength"]
    ]


def stretched(deck, pull, top):
    """Elongation (m) of the riser below a pull (N) at an elevation (m), by the law of OrcaFlex's lines.

    The effective tension is EA times the strain, plus (1 - 2 nu) times the external pressure on the outer
    less the internal pressure on the inner area of the load-bearing wall (Line theory: Tension forces).
    """
    sea = deck["Environment"]
    water, surface = 1e3 * sea["Density"], sea["WaterSurfaceZ"]
    tension, z, inside, whole = pull, top, 0.0, 0.0
    for kind, length, mud in pieces(deck):
        outer, inner = kind["OD"], kind["ID"]
        pipe = kind["Category"] == "Homogeneous pipe"
        wall = area(outer) - area(inner)
        mass = 1e3 * (kind["MaterialDensity"] * wall if pipe else kind["MassPerUnitLength"])
        stiffness = 1e3 * (kind["E"] * wall if pipe else kind["EA"])
        weight = GRAVITY * (mass + mud * area(inner) - water * area(outer))
        s = np.linspace(0.0, length, FINE)
        external = water * GRAVITY * np.maximum(surface - (z - s), 0.0)
        internal = inside + mud * GRAVITY * s
        bearing = (kind.get("StressOD") or outer, kind.get("StressID") or inner)
        pressed = external * area(bearing[0]) - internal * area(bearing[1])
        strain = (tension - weight * s - (1.0 - 2.0 * kind["PoissonRatio"]) * pressed) / stiffness
        whole += float(np.trapezoid(strain, s))
        tension, z, inside = tension - weight * length, z - length, float(internal[-1])
    return whole


@pytest.mark.parametrize("seed", range(12))
def test_a_deck_stretches_as_far_as_the_riser(seed):
    """Pressures stretch no riser of a scene; with a Poisson's ratio of steel they would, by centimetres."""
    tree = drawn(5 * seed + 1)
    del tree["current"], tree["platform"]
    tree["top"] |= {"x": "held"}
    for section in tree["riser"]:
        section["contents"] = {"density": f"{np.random.default_rng(seed).uniform(1100, 1900)} kg/m^3"}
    tree["analysis"] = {"mesh": {"elements": 60}}
    weight, _ = file_of(tree).resolved().hanging
    tree["top"]["tension"] = f"{1.4 * max(weight, 3e5)} N"
    file = file_of(tree)
    deck, _ = deck_of(file)
    scene = file.resolved()
    rest = scene.bottom.elevation + sum(section.total_length for section in scene.riser)
    found = simulate(file, progress=False)
    longer = float(found["z"].values.ravel()[-1]) - rest
    assert stretched(deck, scene.top.tension, rest) == pytest.approx(longer, rel=5e-3, abs=1e-5)


@pytest.mark.parametrize("kind", [1, 2, 4])
@pytest.mark.parametrize("seed", range(8))
def test_the_weight_of_a_ring_is_the_one_of_the_scene_or_named(seed, kind):
    """A ring above the water displaces none in OrcaFlex, whatever its volume; nor has it added mass."""
    draw = np.random.default_rng((seed, kind))
    tree = drawn(5 * seed + kind)
    low = float(tree["bottom"]["elevation"].split()[0])
    ring = low + sum(float(section["length"].split()[0]) for section in tree["riser"])
    surface = ring + float(draw.choice([-1.0, 1.0]) * draw.uniform(1.0, 6.0))
    tree["water"]["surface"] = f"{surface} m"
    mass, weight = float(draw.uniform(5e3, 4e4)), float(draw.uniform(0.1, 1.0))
    body = {"name": "ring", "mass": f"{mass} kg", "submerged_weight": f"{weight * mass * GRAVITY} N"}
    if draw.random() < 0.5:
        body["added_mass"] = {"horizontal": "3 t", "vertical": "5 t"}
    tree["top"]["body"] = body
    deck, left = deck_of(file_of(tree))
    (buoy,) = deck["6DBuoys"]
    wet = ring < surface
    volume = buoy["Volume"] if wet else 0.0
    in_orcaflex = GRAVITY * (buoy["Mass"] - deck["Environment"]["Density"] * volume)
    more = in_orcaflex - 1e-3 * weight * mass * GRAVITY
    line = next((line for line in left if line.startswith("top.body: ")), "")
    named = re.search(r"weighs its mass: (\S+) kN", line)
    assert more == pytest.approx(float(named[1]) if named else 0.0, rel=1e-3, abs=2e-3)
    assert ("neither drag nor added mass" in line) == ("added_mass" in body and not wet)
