"""Random scenes for decks, and the way into a deck and back."""

import math

import numpy as np

from riserstudy.export.orcaflex import write_deck
from riserstudy.importers.orcaflex import read_deck
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import unwrap


def section(chance, name, length, dressed):
    outer = round(float(chance.uniform(0.45, 0.6)), 3)
    inner = round(outer - float(chance.uniform(0.03, 0.06)), 3)
    steel = 7850.0 * 0.25 * math.pi * (outer**2 - inner**2)
    foam = float(chance.uniform(0.0, 400.0)) if dressed else 0.0
    wet = 9.80665 * (steel + foam - 1025.0 * 0.25 * math.pi * outer**2) * (0.3 if dressed else 1.0)
    made = {
        "name": name,
        "length": f"{length} m",
        "outer_diameter": f"{outer} m",
        "inner_diameter": f"{inner} m",
        "young_modulus": "207 GPa",
        "mass": f"{steel + foam} kg/m",
        "submerged_weight": f"{wet} N/m",
        "drag": {"coefficient": 1.1, "diameter": f"{outer + 2e-3 * foam} m"},
        "added_mass": {"coefficient": 1.0, "diameter": f"{outer + 1e-3 * foam} m"},
    }
    if chance.random() < 0.5:
        made["tangential_drag"] = {"coefficient": 0.01, "diameter": f"{1.25 * outer} m"}
    if dressed and chance.random() < 0.5:
        made["lines"] = [
            {
                "name": "choke",
                "count": 2,
                "outer_diameter": "0.16 m",
                "inner_diameter": "0.11 m",
                "wall_density": "7850 kg/m^3",
                "contents": "1300 kg/m^3",
                "young_modulus": "207 GPa",
                "tension": "shared",
            }
        ]
    return made


def drawn(seed):
    """A scene of one of five kinds of upper end, of some sections in some current."""
    chance = np.random.default_rng(seed)
    kind = ("held", "tension", "upright", "joint", "inclined")[seed % 5]
    lengths = [40.0, float(chance.integers(200, 900)), 60.0]
    low = -float(sum(lengths)) - float(chance.integers(8, 14))
    riser = [section(chance, f"part {k}", length, dressed=k == 1) for k, length in enumerate(lengths)]
    if chance.random() < 0.7:
        mud = [f"{rho} kg/m^3" for rho in (1200, 1200 if chance.random() < 0.5 else 1350, 1200)]
        for one, rho in zip(riser, mud, strict=True):
            one["contents"] = {"density": rho}
    if chance.random() < 0.4:
        riser[1]["flex_joint_below"] = {"stiffness": "40 kN*m/deg"}
    ring = low + sum(lengths)
    scene = {
        "title": kind,
        "gravity": "9.80665 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": f"{low - 6.0} m"},
        "riser": riser,
        "bottom": {
            "hold": "wellhead",
            "elevation": f"{low} m",
            "rotation": {"stiffness": f"{chance.integers(10, 90)} kN*m/deg"},
        },
        "platform": {"position": {"surge": f"{chance.uniform(-0.01, 0.02) * sum(lengths):.2f} m"}},
        "current": {
            "profile": [
                {"depth": f"{d} m", "speed": f"{v} m/s"} for d, v in ((0, 0.9), (150, 0.3), (3000, 0.1))
            ],
            "heading": f"{chance.choice([0, 0, 180, 40])} deg",
        },
        "analysis": {},
    }
    hanging = SceneFile(
        "x", unwrap(scene | {"top": {"x": "held", "z": "held", "elevation": f"{ring} m"}, "platform": {}})[0]
    )
    weight, _ = hanging.resolved().hanging
    pull = 1.4 * max(weight, 3e5)
    joint = {"length": "12 m", "bending_stiffness": "5e8 N*m^2"}
    above = {
        "x": "platform",
        "z": "platform",
        "elevation": f"{ring + 12.0} m",
        "rotation": {"stiffness": "8 kN*m/deg"},
    }
    cylinders = {"count": 6, "mid_stroke": str(chance.choice(["riser unstretched", "riser in equilibrium"]))}
    law = chance.choice(["linear", "table", "gas"])
    laws = {
        "linear": {"linear": {"tension": f"{pull / 6} N", "stiffness": f"{pull / 200} N/m"}},
        "table": {
            "table": [{"reach": f"{r} m", "force": f"{pull / 6 * (1 + 0.03 * r)} N"} for r in (-6, -2, 1, 7)],
            "interpolation": "linear",
        },
        "gas": {
            "gas": {
                "area": "0.05 m^2",
                "pressure": f"{pull / 6 / 0.05} Pa absolute",
                "volume": "2 m^3",
                "exponent": 1.1,
            }
        },
    }
    scene["top"] = {
        "held": {
            "x": "platform",
            "z": "platform",
            "elevation": f"{ring + 4e-4 * sum(lengths):.3f} m",
            "rotation": "free",
        },
        "tension": {"x": "platform", "z": "free", "tension": f"{pull} N", "rotation": "free"},
        "upright": {"x": "platform", "z": "free", "rotation": "free", "tensioners": cylinders | laws[law]},
        "joint": above | {"telescopic_joint": joint | {"tension": f"{pull} N"}},
        "inclined": above
        | {
            "telescopic_joint": joint,
            "body": {"name": "ring", "mass": "12 t", "displaced_volume": "1.5 m^3"},
            "tensioners": cylinders
            | laws[law]
            | {
                "arrangement": {
                    "ring_radius": "1 m",
                    "deck_radius": "5 m",
                    "deck_elevation": f"{ring + 16.0} m",
                    "first_bearing": f"{chance.integers(-90, 90)} deg",
                }
            },
        },
    }[kind]
    return scene


def file_of(tree, source="drawn.yaml"):
    plain, origins, faults = unwrap(tree)
    assert not faults
    return SceneFile(str(source), plain, origins)


def there_and_back(file, folder):
    deck = write_deck(file)
    path = folder / "deck.yml"
    path.write_text(deck.text)
    return file_of(read_deck(path).tree, path), deck.left_out


def loaded(seed):
    """A scene of ``drawn`` with motion: a wave or sea, operators, drift, dampers, a body, limits."""
    chance = np.random.default_rng(1000 + seed)
    scene = drawn(seed)
    some = lambda share: chance.random() < share  # noqa: E731
    ramp = f"{chance.integers(10, 40)} s"
    scene["analysis"] = {"duration": "200 s", "output": {"interval": "0.5 s"}}
    if some(0.4):
        scene["wave"] = {"height": f"{chance.uniform(2, 8)} m", "period": f"{chance.uniform(7, 14)} s"}
    elif some(0.6):
        scene["wave"] = {
            "significant_height": f"{chance.uniform(2, 8)} m",
            "peak_period": f"{chance.uniform(8, 14)} s",
            "peak_enhancement": float(chance.uniform(1, 5)),
            "components": 60,
            "seed": int(chance.integers(1, 99)),
        }
    if "wave" in scene:
        stretching = ["none", "constant", "stretched"]
        scene["wave"] |= {"above_mean_level": str(chance.choice(stretching)), "ramp": ramp}
        if some(0.5):
            scene["wave"]["heading"] = f"{chance.integers(0, 360)} deg"
        if some(0.3) and "height" in scene["wave"]:
            scene["wave"]["phase"] = "30 deg"
    if "wave" in scene and some(0.8):
        scene["platform"] |= {
            "response": response(chance, ramp),
            "centre_of_rotation": {"elevation": f"{chance.uniform(-5, 5)} m"},
        }
    if some(0.3):
        drift = {"speed": "0.3 m/s", "heading": f"{chance.integers(0, 90)} deg", "ramp": ramp}
        scene["platform"]["cruise"] = drift
    if some(0.3) and "response" not in scene["platform"]:
        scene["platform"]["surge"] = {"amplitude": "1 m", "period": "12 s", "ramp": ramp}
    rig = scene["top"].get("tensioners")
    if rig and some(0.5):
        rig["damping"] = f"{chance.uniform(1, 40)} kN*s/m"
    if rig and "gas" in rig and some(0.4):
        rig["linearised"] = {"by": "tangent"}
    if rig and some(0.3):
        rig["stroke"] = {"shortest": "-6 m", "longest": "7 m", "stop_stiffness": "20 MN/m"}
    if rig and some(0.3):
        rig["failed"] = [int(chance.integers(6))]
    if rig and some(0.3):
        rig["failing"] = {"at": "50 s", "cylinders": [1]}
    if "body" in scene["top"] and some(0.6):
        scene["top"]["body"] |= {
            "drag_area": {"horizontal": "6 m^2", "vertical": "9 m^2"},
            "added_mass": {"horizontal": "3 t", "vertical": "5 t"},
        }
    part = scene["riser"][int(chance.integers(3))]
    if some(0.4):
        for one in scene["riser"]:
            one["structural_damping"] = {"ratio": 0.01, "at_period": "10 s"}
    if some(0.2):
        part["lateral_load"] = "3 N/m"
    if some(0.2) and "drag" in part:
        part["drag"]["coefficient"] = [
            {"elevation": "-5000 m", "value": 0.7},
            {"elevation": "0 m", "value": 1.2},
        ]
    if some(0.3):
        scene["limits"] = [{"output": "effective_tension", "smallest": "0 N", "mode": "drilling"}]
    if some(0.3):
        scene["current"]["ramp"] = ramp
    if some(0.3):
        scene["current"]["beyond"] = "hold"
    if some(0.3):
        scene["top"]["rotation"] = {"stiffness": f"{chance.integers(2, 20)} kN*m/deg"}
    if some(0.2):
        scene["bottom"]["rotation"] = str(chance.choice(["free", "fixed"]))
    return scene


def response(chance, ramp):
    """Operators of all or some motions, in waves of one or several headings."""
    motions = ["surge", "heave", "pitch"] if chance.random() < 0.5 else ["surge", "sway", "heave"]
    headings = [None] if chance.random() < 0.5 else [0, 45, 90, 135, 180]
    rows = []
    for heading in headings:
        for period in (6, 9, 12, 16, 25):
            row = {"period": f"{period} s"} | ({} if heading is None else {"heading": f"{heading} deg"})
            for name in motions:
                unit = "deg/m" if name == "pitch" else "m/m"
                row[name] = f"{chance.uniform(0.05, 0.9):.3f} {unit}"
                row[f"{name}_phase"] = f"{chance.integers(-180, 180)} deg"
            rows.append(row)
    made = {"operators": rows, "phases": str(chance.choice(["lag", "lead"])), "ramp": ramp}
    if len(headings) > 1:
        made |= {"headings": str(chance.choice(["towards", "from"]))}
        made |= {"symmetry": "sides"} if chance.random() < 0.5 else {}
    return made | {"beyond": str(chance.choice(["hold", "zero"]))}
