"""Advice on risers whose highest section crosses the water surface, and is divided there."""

from typing import Any

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.advice.ablation import ablate
from riserstudy.advice.changes import fitting
from riserstudy.advice.recommendations import advice
from riserstudy.effects.catalogue import changes
from riserstudy.model.layout import stiffness
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single

BORE = 0.48  # m; with the mass of the wall


def crossing(seed: int) -> dict[str, Any]:
    """A rig whose sections differ, and whose highest one crosses the surface with a weight by its parts."""
    tree = moving(seed, conductor=False)
    for k, section in enumerate(tree["riser"]):
        section |= {"outer_diameter": 0.53 + 0.02 * k, "inner_diameter": BORE}
        del section["added_mass"]
    highest = tree["riser"][-1]
    del highest["submerged_weight"]
    highest["mass"] = 7850.0 * 0.25 * np.pi * (highest["outer_diameter"] ** 2 - BORE**2)
    # carries the section, which may be heavier than before: a riser that buckles has several equilibria
    joint = tree["top"]["telescopic_joint"]
    if "tension" in joint:
        joint["tension"] += 9.81 * highest["mass"] * highest["length"]
    return tree


def crosses(tree: dict[str, Any]) -> bool:
    """Whether there are several sections, of which the highest crosses the surface."""
    ring = tree["top"]["elevation"] - tree["top"]["telescopic_joint"]["length"]
    return len(tree["riser"]) > 1 and 0.0 < ring < tree["riser"][-1]["length"]


SEVERAL = [seed for seed in range(20) if crosses(crossing(seed))][:5]


@pytest.mark.parametrize("seed", SEVERAL)
def test_what_a_change_fills_in_is_of_its_own_section(seed):
    file = SceneFile("rig.yaml", written(crossing(seed)))
    found = {change.label: other.tree["riser"] for change, other in fitting(file)}
    for k, section in enumerate(crossing(seed)["riser"]):
        by_name = {one.name: one for one in file.resolved().riser}
        axial = stiffness(by_name[section["name"]]).axial
        assert found["without bending"][k]["axial_stiffness"] == f"{axial!r} N"
        width = found["with added mass"][k]["added_mass"]["diameter"]
        assert width == f"{section['outer_diameter']!r} m"


@pytest.mark.parametrize("seed", SEVERAL)
def test_a_riser_without_weight_is_the_one_that_is_written_without_it(seed):
    """Without a weight by its parts, a section is one at the surface; the segments stay where they were."""
    tree = crossing(seed)
    tree["analysis"]["duration"] *= 0.5
    others = {change.label for change in changes()} - {"without weight"}
    base = ablate(SceneFile("rig.yaml", written(tree)), 1, 1e6, left_out=others)
    (without,) = base.changed
    for section in tree["riser"]:
        section["submerged_weight"] = 0.0
    scene = SceneFile("rig.yaml", written(tree)).resolved()
    names = [section.name for section in base.file.resolved().riser]
    assert len(names) == len(scene.riser) + 1
    own = base.mesh._replace(
        section=base.mesh.section - (base.mesh.section >= len(scene.riser))
    )  # the part above the water belongs to the section below
    found = single(scene, own, base.step).arrays["bending_moment_absmax"].max()
    assert without.message == ""
    assert without.peaks.moment == pytest.approx(float(found), rel=1e-12)


@pytest.mark.parametrize("limit", ["smallest", "largest"])
@pytest.mark.parametrize("at", [None, "section 0"])
def test_what_the_largest_values_do_not_show_is_named(limit, at, monkeypatch):
    """Dampers change the largest tension by less, as a share, than the smallest one."""
    monkeypatch.setattr("riserstudy.advice.ablation.fitting", lambda _: [])
    tree = moving(0)
    tree["limits"] = [
        {"output": "effective_tension", limit: "1 kN", "mode": "connected"} | ({"at": at} if at else {})
    ]
    told = [line for line in advice(SceneFile("rig.yaml", written(tree))).sentences if "Not compared" in line]
    expected = ("smallest " if limit == "smallest" else "") + "effective_tension" + (f" ({at})" if at else "")
    assert bool(told) == (expected != "effective_tension")
    assert all(line.startswith(f"Not compared: {expected}. ") for line in told)
