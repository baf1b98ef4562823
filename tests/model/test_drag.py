"""Drag in sections: coefficients of every kind beside each other, across the pipe and horizontal."""

import random

import numpy as np
import pytest

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.simulate import simulate

LENGTH = 60.0  # m, of each section


def drag_of(kind, rng):
    """Drag of a section: none, of one coefficient or of a table, across the pipe or horizontal."""
    if kind == "none":
        return None
    number = round(rng.uniform(0.4, 1.6), 3)
    levels = sorted(rng.uniform(0.0, 3 * LENGTH) for _ in range(rng.randint(2, 4)))
    jumps = sorted([*levels, rng.choice(levels)])
    table = [
        {"elevation": f"{level:.2f} m", "value": round(rng.uniform(0.4, 1.6), 3)}
        for level in rng.choice([levels, jumps])
    ]
    drag = {"coefficient": number if "constant" in kind else table, "diameter": "0.6 m"}
    return drag | ({"direction": "horizontal"} if "horizontal" in kind else {})


KINDS = ("none", "constant", "table", "horizontal constant", "horizontal table")


def scene(drags, rng, dynamic):
    """Sections with these drags in a current, and in waves of motion where it is dynamic."""
    riser = [
        {
            "name": f"section {k}", "length": f"{LENGTH} m", "outer_diameter": "0.5 m",
            "inner_diameter": "0.46 m", "young_modulus": "210 GPa", "mass": "400 kg/m",
            "submerged_weight": "2 kN/m", **({"drag": drag} if drag else {}),
        }
        for k, drag in enumerate(drags)
    ]  # fmt: skip
    if rng.random() < 0.5:
        for section in riser:
            section["added_mass"] = {"coefficient": 1.0, "diameter": "0.5 m"}
    surface = rng.choice([None, f"{2.5 * LENGTH} m"])  # through a section, or nowhere
    water = {"density": "1025 kg/m^3"} | ({"surface": surface} if surface else {})
    tree = {
        "title": "drags", "gravity": "9.81 m/s^2", "water": water, "riser": riser,
        "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free"},
        "top": {"x": "platform", "z": "free", "tension": "1.5 MN", "rotation": "free"},
        "current": {"profile": [{"elevation": "0 m", "speed": "0.2 m/s"},
                                {"elevation": "180 m", "speed": "1.1 m/s"}]},
        "platform": {"position": {"surge": "5 m"}},
        "analysis": {"mesh": {"elements": 9}},
    }  # fmt: skip
    if dynamic:
        tree["platform"]["surge"] = {"amplitude": "1 m", "period": "8 s"}
        tree["analysis"] |= {"duration": "2 s", "step": "0.1 s", "output": {"interval": "0.5 s"}}
    return tree


def as_tables(drags, rng):
    """The same with each coefficient as a table of one value, of which many are the same."""
    written = []
    for drag in drags:
        if drag and not isinstance(drag["coefficient"], list):
            levels = sorted(rng.uniform(-50.0, 250.0) for _ in range(rng.randint(2, 3)))
            points = [{"elevation": f"{z} m", "value": drag["coefficient"]} for z in levels]
            drag = drag | {"coefficient": points}
        written.append(drag)
    return written


COMBINATIONS = [(a, b) for a in KINDS for b in KINDS if (a, b) != ("none", "none")]


@pytest.mark.parametrize("kinds", COMBINATIONS, ids=" beside ".join)
def test_a_coefficient_is_a_table_of_the_same_value_whatever_stands_beside_it(kinds):
    rng = random.Random(str(kinds))
    kinds = [*kinds, rng.choice(KINDS)]
    rng.shuffle(kinds)
    drags = [drag_of(kind, rng) for kind in kinds]
    dynamic = rng.random() < 0.4
    state = rng.getstate()
    one = simulate(SceneFile("a.yaml", scene(drags, rng, dynamic)))
    rng.setstate(state)
    other = simulate(SceneFile("b.yaml", scene(as_tables(drags, random.Random(1)), rng, dynamic)))
    for name in ("x", "bending_moment", "effective_tension"):
        size = float(abs(one[name]).max())
        np.testing.assert_allclose(other[name], one[name], rtol=0.0, atol=1e-7 * size)
    assert float(abs(one["x"]).max()) > 1.0
