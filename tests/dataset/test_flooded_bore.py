"""The stack-up of risers whose upper end is above the water, with a section divided at the surface or not."""

from __future__ import annotations

import copy
import math
from pathlib import Path
from typing import Any

import pytest
import yaml

from riserstudy.dataset.stack_up import stack_up
from riserstudy.scene.load import SceneFile, load_scene
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


@pytest.mark.long
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


def _lines(tree: dict[str, Any]) -> list[dict[str, Any]]:
    """The stack-up, a dictionary for each line from the top down."""
    table = stack_up(SceneFile("rig.yaml", tree).resolved())
    return [dict(zip(table.columns, row, strict=True)) for row in table.rows]


@pytest.mark.parametrize("datum", [-1750.0, 340.0])
@pytest.mark.parametrize("seed", range(6))
def test_the_datum_of_elevations_changes_no_weight(seed: int, datum: float) -> None:
    tree = rig(seed, spatial=False)
    moved = copy.deepcopy(tree)
    for end, name in (
        ("water", "surface"),
        ("water", "seabed"),
        ("bottom", "elevation"),
        ("top", "elevation"),
    ):
        moved[end][name] += datum
    if "soil" in moved:
        moved["soil"]["mudline"] += datum
    for one, other in zip(_lines(written(tree)), _lines(written(moved)), strict=True):
        assert other.pop("upper end") == pytest.approx(one.pop("upper end") + datum)
        for name, cell in one.items():
            assert other[name] == (cell if isinstance(cell, str | None) else pytest.approx(cell, abs=1e-6))


PIPE = {"outer_diameter": "0.5 m", "inner_diameter": "0.45 m", "young_modulus": "210 GPa"}
UPRIGHT = {
    "title": "joints below the water",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3", "surface": "0 m"},
    "bottom": {"hold": "wellhead", "elevation": "-205 m", "rotation": "free"},
    "top": {"x": "held", "z": "free", "tension": "3 MN", "rotation": "free"},
    "analysis": {"mesh": {"elements": 10}},
}


@pytest.mark.parametrize("net", [800.0, 2100.0])
def test_sea_water_in_the_bore_weighs_the_same_as_contents_and_within_the_weight(net: float) -> None:
    """A weight with the bore empty and sea water as contents, or a weight that includes the water."""
    flood = 1025.0 * 9.81 * math.pi / 4.0 * 0.45**2
    joints = {"name": "joints", "joints": {"count": 8, "length": "25 m"}, "mass": "400 kg/m"}
    apart, within = (
        _lines(UPRIGHT | {"riser": [PIPE | joints | {"submerged_weight": f"{weight!r} N/m"} | more]})[0]
        for weight, more in ((net, {"contents": {"density": "1025 kg/m^3"}}), (net + flood, {}))
    )
    for name in ("wet weight", "wet weight a joint", "hook load", "with contents from the top"):
        assert within[name] == pytest.approx(apart[name])
    assert within["wet weight"] == pytest.approx(0.2 * (net + flood))  # kN, of 200 m
    assert within["dry weight a joint"] == pytest.approx(400.0 * 9.81e-3 * 25.0)


def test_joints_of_unknown_mass_have_no_dry_weight() -> None:
    joints = PIPE | {"name": "joints", "joints": {"count": 8, "length": "25 m"}}
    (line,) = _lines(UPRIGHT | {"riser": [joints | {"submerged_weight": "900 N/m"}]})
    assert line["dry weight a joint"] is line["dry weight"] is line["uplift"] is None
    assert line["hook load"] == line["wet weight"] == pytest.approx(8 * line["wet weight a joint"])
    assert line["wet weight"] == pytest.approx(0.9 * 200.0)
