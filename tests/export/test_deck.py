"""Scenes as decks: what comes back is the same riser at rest, and what did not go is named."""

import math
import sys

import numpy as np
import pytest
from ruamel.yaml import YAML

from riserstudy import load_scene, simulate
from riserstudy.cli import main
from riserstudy.errors import InputError
from riserstudy.export.orcaflex import write_deck
from riserstudy.scene.load import SceneFile
from riserstudy.scene.orcaflex import read_deck
from riserstudy.scene.origin import unwrap

MESH = {"analysis": {"mesh": {"elements": 40}}}


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
        made["tangential_drag"] = {"coefficient": 0.01, "diameter": f"{outer} m"}
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
    riser = [
        section(chance, f"part {k}", length, dressed=k == 1) for k, length in enumerate(lengths)
    ]
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
                {"depth": f"{d} m", "speed": f"{v} m/s"}
                for d, v in ((0, 0.9), (150, 0.3), (3000, 0.1))
            ],
            "heading": f"{chance.choice([0, 0, 180, 40])} deg",
        },
        "analysis": {},
    }
    hanging = SceneFile(
        "x",
        unwrap(
            scene | {"top": {"x": "held", "z": "held", "elevation": f"{ring} m"}, "platform": {}}
        )[0],
    )
    weight, _ = hanging.scene().hanging
    pull = 1.4 * max(weight, 3e5)
    joint = {"length": "12 m", "bending_stiffness": "5e8 N*m^2"}
    above = {
        "x": "platform",
        "z": "platform",
        "elevation": f"{ring + 12.0} m",
        "rotation": {"stiffness": "8 kN*m/deg"},
    }
    cylinders = {
        "count": 6,
        "mid_stroke": str(chance.choice(["riser unstretched", "riser in equilibrium"])),
    }
    law = chance.choice(["linear", "table", "gas"])
    laws = {
        "linear": {"linear": {"tension": f"{pull / 6} N", "stiffness": f"{pull / 200} N/m"}},
        "table": {
            "table": [
                {"reach": f"{r} m", "force": f"{pull / 6 * (1 + 0.03 * r)} N"}
                for r in (-6, -2, 1, 7)
            ],
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
        "upright": {
            "x": "platform",
            "z": "free",
            "rotation": "free",
            "tensioners": cylinders | laws[law],
        },
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
                    "first_bearing": "0 deg",
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


@pytest.mark.parametrize("seed", range(15))
def test_a_deck_read_back_is_the_same_riser_at_rest(tmp_path, seed):
    file = file_of(drawn(seed))
    back, _ = there_and_back(file, tmp_path)
    one, other = (simulate(f.with_values(MESH, "test"), progress=False) for f in (file, back))
    assert one["s"].to_numpy() == pytest.approx(other["s"].to_numpy())
    for name in ("effective_tension", "bending_moment", "x", "z"):
        a, b = one[name].to_numpy(), other[name].to_numpy()
        assert np.abs(a - b).max() < 2e-4 * np.abs(a).max(), name


@pytest.mark.parametrize("seed", range(5))
def test_masses_and_drag_come_back(tmp_path, seed):
    file = file_of(drawn(seed))
    scene, back = file.scene(), there_and_back(file, tmp_path)[0].scene()
    light = (9.9, 1.01)  # N and kg, of the ring that a deck needs where a scene has none
    for one, same, more in zip(scene.hanging, back.hanging, light, strict=True):
        assert one == pytest.approx(same, abs=more)
    for one, same in zip(scene.riser, back.riser, strict=True):
        assert one.elasticity == pytest.approx(same.elasticity)
        for name, power in (("drag", 1), ("tangential_drag", 1), ("added_mass", 2)):
            a, b = (getattr(s, name) for s in (one, same))
            assert (a is None) == (b is None)
            if a:
                assert a.coefficient * a.diameter**power == pytest.approx(
                    b.coefficient * b.diameter**power
                )


def test_what_a_deck_cannot_say_is_named(tmp_path):
    scene = drawn(0)
    scene["limits"] = [{"output": "lfj_angle", "largest": "4 deg", "mode": "drilling"}]
    scene["platform"]["heave"] = {"amplitude": "1 m", "period": "10 s", "ramp": "20 s"}
    scene["analysis"] = {"duration": "100 s", "output": {"interval": "0.5 s"}, "accuracy": "1 %"}
    scene["riser"][0]["lateral_load"] = "3 N/m"
    left = there_and_back(file_of(scene), tmp_path)[1]
    paths = {line.partition(":")[0] for line in left}
    assert {"limits.output", "platform.heave", "analysis.accuracy", "riser.lateral_load"} <= paths


@pytest.mark.parametrize("path", ["limits", "platform.sway", "wave.phase", "top.tension_loss.at"])
def test_a_line_that_nobody_writes_cannot_go_missing(tmp_path, path):
    """Whatever is put into a scene beyond what a deck says is in the list."""
    more = {
        "limits": [{"output": "effective_tension", "smallest": "0 N", "mode": "drilling"}],
        "platform.sway": {"amplitude": "1 m", "period": "10 s", "ramp": "20 s"},
        "wave.phase": "30 deg",
        "top.tension_loss.at": "50 s",
    }[path]
    extra = {path: more, "analysis.duration": "100 s", "analysis.output": {"interval": "0.5 s"}}
    if path.startswith("wave"):
        extra |= {
            "wave.height": "3 m",
            "wave.period": "10 s",
            "wave.above_mean_level": "none",
            "wave.ramp": "20 s",
        }
    if path.startswith("top"):
        extra |= {"top.tension_loss.share": 0.2, "top.tension_loss.over": "5 s"}
    left = write_deck(file_of(drawn(1)).with_values(extra, "test")).left_out
    assert any(line.startswith(path.rpartition(".")[0] or path) for line in left)


@pytest.mark.parametrize(
    "change, said",
    [
        (
            {"bottom": {"hold": "free"}, "top": {"x": "held", "z": "held", "elevation": "0 m"}},
            "bottom.hold",
        ),
        (
            {"water": {"density": "1025 kg/m^3", "seabed": "-912 m"}, "current": None},
            "water.surface",
        ),
        ({"top": {"x": "free", "z": "free", "tension": "2 MN", "rotation": "free"}}, "top.x"),
        (
            {
                "top": {
                    "x": "platform",
                    "z": "platform",
                    "held_at_tension": "2 MN",
                    "rotation": "free",
                }
            },
            "held_at_tension",
        ),
    ],
)
def test_what_would_be_another_riser_is_refused(change, said):
    file = file_of(drawn(0)).with_values(change, "test")
    with pytest.raises(InputError, match="drawn") as refused:
        write_deck(file)
    assert said in str(refused.value)


def test_the_command_writes_the_deck_and_prints_what_is_not_in_it(tmp_path, capsys):
    scene, deck = tmp_path / "scene.yaml", tmp_path / "deck.yml"
    with scene.open("w") as file:
        YAML().dump(drawn(3), file)
    sys.argv = ["riserstudy", "export", str(scene), "-o", str(deck)]
    main()
    said = capsys.readouterr().out
    assert "left out: top.telescopic_joint" in said
    assert f"{deck} is written" in said
    assert read_deck(deck).tree["top"]["telescopic_joint"]["tension"].endswith("kN")
    assert load_scene(scene)
