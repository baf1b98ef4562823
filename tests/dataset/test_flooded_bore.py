"""The stack-up of risers whose upper end is above the water, with a section divided at the surface or not."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import pytest
import yaml

from riserstudy.dataset.stack_up import stack_up
from riserstudy.scene.load import load_scene
from tests.random_rigs import rig, written

SEEDS = range(40)


def _reaches_out(tree: dict[str, Any]) -> float:
    """Length of the uppermost section above the water (m)."""
    top = tree["top"]
    return float(top["elevation"] - top["telescopic_joint"]["length"])


def _divided(tree: dict[str, Any], out: float) -> dict[str, Any]:
    """The same riser with its uppermost section in two parts, one above the water."""
    tree = copy.deepcopy(tree)
    lower = tree["riser"][-1]
    upper = {**copy.deepcopy(lower), "name": "above the water", "length": out}
    upper.pop("flex_joint_below", None)
    tree["riser"].append(upper)
    lower["length"] -= out
    return tree


def _sums(path: Path, tree: dict[str, Any]) -> dict[str, float]:
    """Sums of the stack-up over the whole riser (kN)."""
    path.write_text(yaml.safe_dump(written(tree)))
    table = stack_up(load_scene(path).resolved())
    first, last = (dict(zip(table.columns, row, strict=True)) for row in (table.rows[0], table.rows[-1]))
    return {
        "hook load": first["hook load"],
        "wet weight from the top": last["wet weight from the top"],
        "with contents from the top": last["with contents from the top"],
    }


@pytest.mark.parametrize("spatial", [False, True])
def test_a_division_at_the_surface_does_not_change_weights(tmp_path: Path, spatial: bool) -> None:
    """Sea water fills the bore up to the surface, whether a section ends there or reaches through it."""
    tried = 0
    for seed in SEEDS:
        tree = rig(seed, spatial=spatial)
        out = _reaches_out(tree)
        if not 0.5 < out < tree["riser"][-1]["length"] - 1.0:
            continue
        tried += 1
        whole = _sums(tmp_path / "whole.yaml", tree)
        parts = _sums(tmp_path / "parts.yaml", _divided(tree, out))
        for name, value in whole.items():
            assert parts[name] == pytest.approx(value, rel=1e-9, abs=1e-6), (seed, name)
    assert tried > 10
