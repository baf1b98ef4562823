"""Rigs with welds whose fatigue is computed."""

from __future__ import annotations

import copy

WELD = {
    "name": "weld",
    "face": "outside",
    "curve": {"detail_class": "D", "environment": "seawater with cathodic protection"},
    "stress_concentration": 1.3,
    "safety_factor": 10.0,
}
INSIDE = WELD | {"name": "inside", "face": "inside", "curve": {"detail_class": "F", "environment": "air"}}


def fatigued(tree, *details, angles=8):
    """A rig with details of fatigue, after its ramps."""
    tree = copy.deepcopy(tree)
    period = listed(tree["platform"]["surge"])["period"]
    tree["analysis"]["duration"] = 4.0 * period
    tree["analysis"]["output"]["interval"] = period / 40.0
    tree["fatigue"] = {"angles": angles, "details": [*details]}
    return tree


def listed(motion):
    return motion[0] if isinstance(motion, list) else motion
