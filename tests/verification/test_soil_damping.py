"""Dashpots of the soil: a conductor that sways in it against a damped beam on springs, energies, refusals."""

import math
from pathlib import Path

import numpy as np
import pytest
from test_conductor_in_clay import BELOW, CLAY, SCENE, resistance

from riserstudy.effects.soil_damping import SoilDamping
from riserstudy.errors import InputError
from riserstudy.export.orcaflex import write_deck
from riserstudy.model.build import build
from riserstudy.model.mesh import even
from riserstudy.model.soil import sand_resistance
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.soil import Sand
from riserstudy.simulation.run import single

LENGTH, STIFF, MASS, SPRING, TENSION = 60.0, 2e9, 3000.0, 4e6, 3e5
AMPLITUDE, PERIOD, RATIO, CYCLES = 0.05, 1.5, 0.12, 14
BURIED = {
    "title": "a pile whose head is moved from side to side",
    "riser": [
        {"name": "pile", "length": f"{LENGTH} m", "outer_diameter": "1 m", "axial_stiffness": "1e10 N",
         "bending_stiffness": f"{STIFF} N*m^2", "mass": f"{MASS} kg/m", "submerged_weight": "0 N/m"},
    ],
    "bottom": {"hold": "foot", "elevation": f"{-LENGTH} m", "rotation": "free"},
    "top": {"x": "platform", "z": "free", "tension": f"{TENSION} N", "rotation": "free"},
    "platform": {
        "surge": {"amplitude": f"{AMPLITUDE} m", "period": f"{PERIOD} s", "ramp": f"{4 * PERIOD} s"},
    },
    "soil": {
        "mudline": "0 m",
        "resistance": {"stiffness": f"{SPRING} Pa"},
        "damping": {"ratio": RATIO, "at_period": f"{PERIOD} s"},
    },
    "analysis": {
        "duration": f"{CYCLES * PERIOD} s",
        "output": {"interval": f"{PERIOD / 40} s"},
    },
}  # fmt: skip


def beam(s, period):
    """Complex displacement of a beam along s (m) from its foot, its head moved by one.

    EI y'''' - T y'' + (k (1 + 2 i ratio period0 / period) - m w^2) y = 0, four exponentials.
    """
    w = 2.0 * math.pi / period
    lag = 2j * RATIO * PERIOD / period
    roots = np.roots([STIFF, 0.0, -TENSION, 0.0, SPRING * (1.0 + lag) - MASS * w * w])
    up = np.exp(roots * LENGTH)
    ends = np.array(
        [roots**2, STIFF * roots**3 - TENSION * roots, up, up * roots**2]  # moment, shear; place, moment
    )
    return np.exp(np.outer(s, roots)) @ np.linalg.solve(ends, [0.0, 0.0, 1.0, 0.0])


def swayed(period, elements, step):
    """Nodes (m from the foot), and their complex displacement over that of the head."""
    changes = {
        "platform.surge.period": f"{period} s",
        "analysis.duration": f"{CYCLES * period} s",
        "platform.surge.ramp": f"{4 * period} s",
        "analysis.output.interval": f"{period / 40} s",
    }
    of = SceneFile("pile.yaml", BURIED).with_values(changes, "test").resolved()
    found = single(of, even(of, elements), step * period).arrays
    turning = np.exp(-2j * math.pi * np.arange(80) / 40)
    x = np.asarray(found["x"])
    moved = np.tensordot(turning, x[-80:], axes=(0, 0)) if x.shape[0] > 80 else None
    return found["s_node"], moved / moved[-1]


@pytest.mark.parametrize("period", [1.0, PERIOD, 4.0])
def test_a_pile_sways_as_a_damped_beam_on_springs(period):
    s, found = swayed(period, 60, 1 / 160)
    expected = beam(s, period)
    late = np.abs(expected.imag).max()  # by the dashpots alone
    assert late > 0.01
    assert np.abs(found - expected).max() < 2e-3 * np.abs(expected).max()
    assert np.abs(found.imag - expected.imag).max() < 0.01 * late


def test_a_finer_mesh_and_step_come_closer_to_the_beam_by_the_square():
    misses = []
    for elements, step in ((30, 1 / 40), (60, 1 / 80)):
        s, found = swayed(PERIOD, elements, step)
        misses.append(np.abs(found - beam(s, PERIOD)).max())
    assert 3.3 < misses[0] / misses[1] < 4.7


def dashpots(soil, elements=1090):
    of = SceneFile("clay.yaml", SCENE).with_values({"soil": soil}, "test").resolved()
    effects = build(of, even(of, elements), None).effects
    return next((e.record for e in effects if isinstance(e.record, SoilDamping)), None)


@pytest.mark.parametrize("millimetres", [0.1, 5.0, 80.0, 900.0])
def test_a_cycle_loses_the_ratio_of_the_energy_of_the_secant(millimetres):
    """At the period and displacement that are named, node by node, by Matlock's formula."""
    y, period = 1e-3 * millimetres, 7.0
    damping = {"ratio": 0.08, "at_period": f"{period} s", "at_displacement": f"{millimetres} mm"}
    found = dashpots({"mudline": "0 m", "resistance": CLAY, "damping": damping})
    # places of the nodes between the foot and the mudline, each a metre
    depth = BELOW - found.node[1:-1]
    lost = found.damping[1:-1] * math.pi * (2.0 * math.pi / period) * y * y
    stored = 0.5 * resistance(depth, y) * y
    np.testing.assert_allclose(lost, 4.0 * math.pi * 0.08 * stored, rtol=1e-9)


def test_without_a_ratio_there_are_no_dashpots():
    damping = {"ratio": 0.0, "at_period": "7 s", "at_displacement": "5 mm"}
    assert dashpots({"mudline": "0 m", "resistance": CLAY, "damping": damping}) is None
    assert dashpots({"mudline": "0 m", "resistance": CLAY}) is None


@pytest.mark.parametrize("loading", ["static", "cyclic"])
def test_sand_has_the_secant_of_its_curve(loading):
    """A hyperbolic tangent, by numpy; its table's pieces are within 1e-6 of it."""
    given = {
        "friction_angle": "33 deg", "submerged_unit_weight": "9 kN/m^3",
        "initial_modulus": "15 MN/m^3", "loading": loading,
    }  # fmt: skip
    damping = {"ratio": 0.05, "at_period": "10 s", "at_displacement": "12 mm"}
    found = dashpots({"mudline": "0 m", "resistance": given, "damping": damping})
    sand = Sand(**given)
    depth = (BELOW - found.node[1:-1]).astype(float)
    most = sand_resistance(sand, depth, np.full(depth.shape, 0.9144))
    secant = most * np.tanh(15e6 * depth * 0.012 / most) / 0.012
    np.testing.assert_allclose(found.damping[1:-1], 0.05 * 10.0 / math.pi * secant, rtol=1e-5)


@pytest.mark.parametrize(
    "resistance_, damping, where",
    [
        (CLAY, {"ratio": 0.1, "at_period": "5 s"}, "soil.damping.at_displacement"),
        (
            {"stiffness": "1 MPa"},
            {"ratio": 0.1, "at_period": "5 s", "at_displacement": "1 mm"},
            "soil.damping.at_displacement",
        ),
        (CLAY, {"ratio": -0.1, "at_period": "5 s", "at_displacement": "1 mm"}, "soil.damping.ratio"),
        (CLAY, {"ratio": 0.1, "at_period": "0 s", "at_displacement": "1 mm"}, "soil.damping.at_period"),
        (CLAY, {"ratio": 0.1, "at_displacement": "1 mm"}, "soil.damping.at_period"),
    ],
)
def test_damping_that_says_too_little_or_too_much_is_refused(resistance_, damping, where):
    with pytest.raises(InputError, match=where.replace(".", r"\.")):
        dashpots({"mudline": "0 m", "resistance": resistance_, "damping": damping})


def test_a_deck_has_no_dashpots_in_the_soil():
    """An even clay alone can be written; with its dashpots the deck would be that of another well."""
    path = Path(__file__).parents[2] / "config/scenes/hard/conductor.yaml"
    file = read_scene(path).with_values({"soil.resistance.strength_gradient": "0 Pa/m"}, "test")
    damped = {"ratio": 0.1, "at_period": "5 s", "at_displacement": "1 mm"}
    with pytest.raises(InputError, match=r"soil\.damping"):
        write_deck(file.with_values({"soil.damping": damped}, "test"))
    assert "P-yModels" in write_deck(file).text
