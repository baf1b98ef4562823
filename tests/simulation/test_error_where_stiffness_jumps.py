"""The error at rest of risers of joints with different stiffness, weight and load, from cubic beam elements.

The elements are short, have the linear tension of a straight riser, and share nothing with the program.
"""

import math
import random

import numpy as np
import pytest
from random_rigs import written
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

GAUSS = ((0.5 - math.sqrt(0.15), 5 / 18), (0.5, 8 / 18), (0.5 + math.sqrt(0.15), 5 / 18))
SMALL = 1e-3  # error of the moment below which the elements count as inexact
UNITS = {"axial_stiffness": "N", "lateral_load": "N/m"}


def joints(seed):
    """Sections of 10 to 60 joints, pups of 0.3 m to 6 m among them; top tension, stiffness below, offset."""
    draw = random.Random(seed)
    sections = []
    for k in range(draw.randint(10, 60)):
        length = draw.choice([draw.uniform(0.3, 3.0), draw.uniform(3.0, 6.0), 22.86, 22.86])
        section = {"name": f"joint {k}", "length": length, "axial_stiffness": 1e12}
        section["bending_stiffness"] = 1.2e8 * draw.choice([0.7, 1.0, 1.5, 8.0])
        section["submerged_weight"] = draw.choice([-900.0, 0.0, 300.0, 2500.0])
        section["lateral_load"] = draw.choice([2.0, 30.0, -10.0])
        sections.append(section)
    weight = sum(max(one["submerged_weight"], 0.0) * one["length"] for one in sections)
    length = sum(one["length"] for one in sections)
    return sections, 1.5 * weight + 3e5, draw.choice([0.0, 3e6, 3e7]), 0.004 * length


def elements_of(sections):
    """Nodes (m) and section of each element."""
    nodes, section = [0.0], []
    for k, one in enumerate(sections):
        count = max(3, math.ceil(2.0 * one["length"]))
        nodes += [nodes[-1] + one["length"] / count * (j + 1) for j in range(count)]
        section += [k] * count
    return np.array(nodes), section


def moment_of(sections, tension, joint, offset, load):
    """Nodes (m) and bending moment (N m) of the beam in one plane; ``load``: the share of the line loads."""
    nodes, section = elements_of(sections)
    size = np.diff(nodes)
    bending, weight, push = (
        np.array([sections[k][name] for k in section])
        for name in ("bending_stiffness", "submerged_weight", "lateral_load")
    )
    pull = tension - np.append(np.cumsum((weight * size)[::-1])[::-1], 0.0)
    rows, columns, values, force = [], [], [], np.zeros(2 * len(nodes))
    for e, h in enumerate(size):
        row = np.array([12.0, 6.0 * h, -12.0, 6.0 * h])
        turn, far = np.array([6.0, 4.0 * h, -6.0, 2.0 * h]), np.array([6.0, 2.0 * h, -6.0, 4.0 * h])
        block = bending[e] / h**3 * np.stack([row, h * turn, -row, h * far])
        for x, share in GAUSS:
            slope = [6.0 * x * (x - 1.0) / h, 1.0 - 4.0 * x + 3.0 * x * x]
            slope += [-slope[0], x * (3.0 * x - 2.0)]
            block = block + share * h * ((1.0 - x) * pull[e] + x * pull[e + 1]) * np.outer(slope, slope)
        index = np.arange(2 * e, 2 * e + 4)
        rows += np.repeat(index, 4).tolist()
        columns += np.tile(index, 4).tolist()
        values += block.ravel().tolist()
        force[index] += load * push[e] * np.array([0.5 * h, h * h / 12.0, 0.5 * h, -h * h / 12.0])
    matrix = coo_array(([*values, joint], ([*rows, 1], [*columns, 1]))).tocsc()
    known = np.zeros(len(force))
    known[-2] = offset
    free = np.setdiff1d(np.arange(len(force)), [0, len(force) - 2])
    known[free] = spsolve(matrix[free][:, free], (force - matrix @ known)[free])
    y, turn = known[::2], known[1::2]
    bent = bending * (6.0 * np.diff(y) - size * (4.0 * turn[:-1] + 2.0 * turn[1:])) / size**2
    return nodes, np.append(bent, 0.0)


@pytest.mark.parametrize("analysis", [{"accuracy": "0.5%"}, {"mesh": {"elements": 140}}], ids=["free", "own"])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", [0, 4, 11, 24, 25, 36, 38])
def test_the_error_of_the_moment_is_not_underestimated(seed, spatial, analysis):
    sections, tension, joint, offset = joints(seed)
    sway = 0.6 * offset if spatial else 0.0
    tree = {
        "title": "joints",
        "gravity": 9.80665,
        "riser": sections,
        "bottom": {"hold": "wellhead", "elevation": 0.0, "rotation": {"stiffness": joint}},
        "top": {"x": "platform", "z": "free", "tension": tension, "rotation": "free"},
        "platform": {"position": {"surge": offset} | ({"sway": sway} if spatial else {})},
        "analysis": analysis,
    }
    result = run(SceneFile("joints.yaml", written(tree, unit_of=UNITS)).resolved())
    planes = [(offset, 1.0), (sway, 0.0)]
    parts = [moment_of(sections, tension, joint, *plane) for plane in planes]
    exact = np.hypot(*(np.interp(result.arrays["s_node"], *part) for part in parts))
    off = np.abs(np.abs(result.arrays["bending_moment_static"]) - exact).max() / exact.max()
    assert off <= max(1.25 * result.facts["error_estimate"]["moment"], SMALL)
