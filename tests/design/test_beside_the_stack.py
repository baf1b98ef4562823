"""A released lower end that swings aside: its distance from the well, and contact where no stack may be."""

import math

import numpy as np
import pytest
import yaml
from random_rigs import rig, timed, written

from riserstudy import load_scene, simulate
from riserstudy.dataset.recoil_table import recoil

FALL = 8.0  # m, by which the platform sinks after the disconnect


def load(tree, folder):
    file = folder / "scene.yaml"
    file.write_text(yaml.safe_dump(written(tree)), "utf-8")
    return load_scene(file)


def released(seed, spatial, aside, folder):
    """A rig at an offset (m) that lets go with little overpull, below a platform that sinks."""
    tree = rig(seed, spatial=spatial, conductor=False)
    tree["bottom"]["rotation"] = "free"
    top, position = tree["top"], tree["platform"]["position"]
    position["surge"] = aside * (math.cos(0.7) if spatial else 1.0)
    if spatial:
        position["sway"] = aside * math.sin(0.7)
    rigging = top["tensioners"]
    for law in ("gas", "table"):
        rigging.pop(law, None)
    place, count = rigging["arrangement"], rigging["count"]
    length = top["telescopic_joint"]["length"]
    cosine = length / math.hypot(length, place["deck_radius"] - place["ring_radius"])
    rigging["mid_stroke"] = "riser unstretched"
    hung = sum(
        part["length"]
        * (
            part["submerged_weight"]
            + part["contents"]["density"] * 9.80665 * 0.25 * math.pi * part["inner_diameter"] ** 2
        )
        for part in tree["riser"]
    )
    pull = 1.2 * hung / (count * cosine)
    rigging["linear"] = {"tension": pull, "stiffness": 0.05 * pull}
    rigging["damping"] = f"{0.05 * pull!r} N*s/m"
    sinks = [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0), (35.0, -FALL), (45.0, -FALL), (60.0, -FALL)]
    tree["platform"]["heave"] = {"points": [{"time": f"{t!r} s", "value": f"{z!r} m"} for t, z in sinks]}
    tree["disconnect"] = {"at": "2 s", "over": "0.5 s", "stack": {"stiffness": 2e7}}
    if not aside:
        del tree["current"]
    ends = 60.0 if aside else 40.0  # before it buckles aside, pressed on the stack
    tree["analysis"] = timed(ends, 0.05, 40, 0.5)
    return load(tree, folder)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_contact_aside_from_the_well_is_warned_of(tmp_path, seed, spatial):
    file = released(seed, spatial, 40.0, tmp_path)
    found = simulate(file, progress=False)
    x = found["x"].isel(s=0).to_numpy()
    y = found["y"].isel(s=0).to_numpy() if "y" in found else 0.0 * x
    np.testing.assert_allclose(found["lift_aside"], np.hypot(x, y), atol=1e-9)
    touching = (found["lift"] < -1e-6).to_numpy() & (found["time"] > 2.0).to_numpy()
    furthest = float(np.hypot(x, y)[touching].max())
    assert furthest > 1.0
    assert found.attrs["recontact_aside"] >= furthest - 1e-9
    assert any("m aside from the well" in one for one in found.attrs["warnings"].split('", "'))
    notes = {row[0]: row[4] for row in recoil(file.resolved(), found).rows}
    assert notes["re-contact"].endswith("m aside from the well")
    assert notes["re-contact"].startswith("yes, up to ")


@pytest.mark.parametrize("seed", range(2))
def test_contact_above_the_well_is_not(tmp_path, seed):
    file = released(seed, False, 0.0, tmp_path)
    found = simulate(file, progress=False)
    assert "recontact_time" in found.attrs
    assert "aside" not in found.attrs["warnings"]
    notes = {row[0]: row[4] for row in recoil(file.resolved(), found).rows}
    assert notes["re-contact"] == "yes"
