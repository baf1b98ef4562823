"""A platform that is moved moves the riser, or the scene is refused."""

import json

import numpy as np
import pytest
from random_rigs import rig, written
from some_seeds import seeds

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.scene.forcing import TILTS
from riserstudy.scene.load import SceneFile

OUTPUTS = ("x", "y", "z", "effective_tension", "ufj_angle")
REFUSED = "has no effect"
ROW = {"surge": "1 m/m", "surge_phase": "0 deg", "pitch": "1 deg/m", "pitch_phase": "0 deg"}
ROWS = [{"period": f"{period} s", **ROW} for period in (2, 30)]
CENTRE = {"centre_of_rotation": {"elevation": "5 m"}}
RESPONSE = {"operators": ROWS, "phases": "lead", "wave": {"height": "2 m", "period": "10 s"}}


def at_rest(tree):
    """Outputs of a scene at rest."""
    dataset = simulate(SceneFile("rig", written(tree), {}))
    names = (f"{name}{end}" for name in OUTPUTS for end in ("_static", ""))
    return {name: dataset[name].values for name in names if name in dataset}


def drawn(seed):
    """A random rig whose upper end is held or follows, on cylinders as drawn, upright ones, or none."""
    draw = np.random.default_rng((seed, 7))
    tree = rig(seed, conductor=False)
    tree["analysis"] = {"mesh": {"elements": 60}}
    top = tree["top"]
    top["x"] = str(draw.choice(["held", "platform"]))
    top["z"] = str(draw.choice(["held", "platform"]))
    kind = str(draw.choice(["inclined", "upright", "constant"]))
    if kind != "inclined":
        top["tensioners"].pop("arrangement")
    if kind == "constant":
        top.pop("tensioners")
        weight = sum(part["length"] * (part["submerged_weight"] + 4e3) for part in tree["riser"])
        top["telescopic_joint"]["tension"] = 1.6 * weight
    return tree


@pytest.mark.long
@pytest.mark.parametrize("motion, shift", [("surge", 0.01), ("heave", 0.5), ("pitch", 0.05), ("roll", 0.05)])
def test_a_platform_that_is_moved_moves_the_riser_or_is_refused(motion, shift):
    """Surge by a hundredth of the depth, heave by half a metre, tilts about a centre far from the riser.

    Rigs of all kinds, in plane and space.
    """
    refused = moved = 0
    for seed in range(16):
        tree = drawn(seed)
        tree["platform"]["position"] = {}
        tree["platform"]["centre_of_rotation"] = {"x": "20 m", "y": "15 m", "elevation": "5 m"}
        before = at_rest(tree)
        depth = -tree["water"]["seabed"]
        by = shift * (depth if motion == "surge" else 1.0)
        unit = "rad" if motion in TILTS else "m"
        tree["platform"]["position"] = {motion: f"{by!r} {unit}"}
        try:
            after = at_rest(tree)
        except InputError as error:
            refused += 1
            assert REFUSED in str(error)  # noqa: PT017
            continue
        apart = max(
            float(np.abs(after[name] - values).max() / np.abs(values).max())
            for name, values in before.items()
            if np.abs(values).max() > 0.0
        )
        assert apart > 1e-6, f"seed {seed}"
        moved += 1
    assert refused >= (1 if motion in TILTS else 2)
    assert moved >= 5


@pytest.mark.parametrize(
    "platform, end",
    [
        ({"surge": {"amplitude": "2 m", "period": "10 s"}}, "top.x"),
        ({"cruise": {"speed": "1 m/s"}}, "top.x"),
        ({"heave": {"amplitude": "2 m", "period": "10 s"}}, "top.z"),
        ({"position": {"sway": "3 m"}}, "top.x"),
        ({"pitch": {"amplitude": "2 deg", "period": "10 s"}}, "top.x"),
        ({"position": {"yaw": "3 deg"}}, "top.x"),
        ({"response": RESPONSE}, "top.z"),
        ({"response": RESPONSE | {"motions": ["pitch"]}}, "top.x"),
    ],
)
def test_a_motion_that_nothing_follows_is_refused_with_the_line_to_change(platform, end):
    tree = written(drawn(0) | {"platform": {}})
    tree["top"] |= {"x": "held", "z": "held"}
    tree["top"].pop("tensioners", None)
    tree["top"]["telescopic_joint"]["tension"] = "9 MN"
    tree |= {"platform": platform | CENTRE, "analysis": {"duration": "10 s", "output": {"interval": "1 s"}}}
    with pytest.raises(InputError, match=f"{REFUSED}.*'{end}: platform'"):
        SceneFile("rig", tree, {}).resolved()


@pytest.mark.parametrize("seed", seeds(16, few=8))
def test_a_run_warns_of_motions_of_a_response_that_change_nothing(seed):
    """Each motion alone is taken out of the operators, and the run is compared with the whole one."""
    row = {"surge": "0.5 m/m", "heave": "0.2 m/m", "pitch": "0.2 deg/m"}
    row |= {f"{name}_phase": "20 deg" for name in ("surge", "heave", "pitch")}
    tree = written(drawn(seed)) | {"analysis": {"duration": "4 s", "step": "0.2 s", "mesh": {"elements": 12}}}
    tree["analysis"]["output"] = {"interval": "1 s"}

    def answered(**changed):
        rows = [{"period": f"{period} s", **row, **changed} for period in (2, 30)]
        response = RESPONSE | {"operators": rows}
        return simulate(SceneFile("rig", tree | {"platform": {"response": response} | CENTRE}, {}))

    try:
        whole = answered()
    except InputError as error:
        assert REFUSED in str(error)  # noqa: PT017
        return
    said = [one for one in json.loads(whole.attrs["warnings"]) if REFUSED in one]
    assert len(said) <= 1
    for name, still in (("surge", "0 m/m"), ("heave", "0 m/m"), ("pitch", "0 deg/m")):
        without = answered(**{name: still})
        idle = all(whole[one].equals(without[one]) for one in ("x", "z", "effective_tension", "ufj_angle"))
        assert idle == any(name in one.split(" of the platform")[0] for one in said), name
