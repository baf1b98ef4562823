"""Parameters of every point of a study, against the scene of the point alone, which is written anew."""

import json
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.database.parameters import TITLES, parameters_of
from riserstudy.database.read_dataset import Axis, Grid
from riserstudy.scene.paths import leaves

SCENE = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"
#: values by path; some replace or remove what others set below or above them
VALUES = {
    "current": [None, {"profile": {"shape": "uniform", "surface_speed": "0.5 m/s"}}],
    "current.profile": [
        {"shape": "power", "surface_speed": "1 m/s", "power": 2.0},
        {"shape": "layer", "surface_speed": "1 m/s", "layer": "20 m", "vanishes": "300 m"},
    ],
    "current.profile.surface_speed": ["0.7 m/s", "2 knot"],
    "riser[0].drag": [None, {"coefficient": 1.2, "diameter": "1 m"}],
    "riser[0].drag.coefficient": [0.7, 1.4],
    "riser[1].mass": ["900 kg/m", "0.9 t/m"],
    "gravity": ["9.81 m/s^2"],
    "limits": [[{"output": "ufj_angle", "mean": "2 deg"}, {"output": "x", "largest": "9 m"}], [], None],
}


def placed(draw):
    """Axes of two values that set some paths, and the sets of each value."""
    axes, sets = [], []
    for number in range(int(draw.integers(1, 4))):
        of = [{} if draw.random() < 0.2 else drawn(draw) for _ in range(2)]
        labels = [f"value {number}{k}" for k in range(2)]
        axes.append(
            Axis(f"axis {number}", labels, None, None, json.dumps(dict(zip(labels, of, strict=True))))
        )
        sets.append(of)
    return axes, sets


def drawn(draw):
    """Values of one or two paths, which do not contain one another."""
    first, second = (str(path) for path in draw.choice([*VALUES], 2, replace=False))
    paths = [first] if first.startswith(second) or second.startswith(first) else [first, second]
    return {path: VALUES[path][int(draw.integers(len(VALUES[path])))] for path in paths}


@pytest.mark.parametrize("seed", range(40))
def test_each_point_has_the_values_of_its_own_scene(seed):
    draw = np.random.default_rng(seed)
    file, (axes, sets) = load_scene(SCENE), placed(draw)
    attributes = {"scene": json.dumps(file.tree), "origins": "{}", "evidence": "{}"}
    grid = Grid(axes, [])
    same, varied = parameters_of(attributes, grid)
    for cell in np.ndindex(grid.shape):
        own = file
        for of, k in zip(sets, cell, strict=True):
            own = own.with_values(of[k], "test")
        expected = {path: value for path, value in leaves(own.tree) if path.split(".")[0] not in TITLES}
        found = {one.path: one.as_written for one in same}
        for one in varied:
            number = int(one.at[cell])
            found |= {of.path: of.as_written for of, k in one.values.items() if k == number}
        written = {path: of if isinstance(of, str) else json.dumps(of) for path, of in expected.items()}
        assert found == written
    assert not {one.path for one in same} & {of.path for one in varied for of in one.values}
