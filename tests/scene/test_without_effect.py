"""Values of a scene that no run would use are refused, with the field that holds them."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

SEEDS = range(6)


def rig(seed, law="count", hold=("wellhead", "foot")):
    """A rig in motion on tensioners as a scene file has it, every second one in space, and random numbers."""
    draws = (moving(k, spatial=bool(seed % 2)) for k in range(100 * seed, 100 * seed + 100))
    held = (tree for tree in draws if tree["bottom"]["hold"] in hold)
    tree = next(tree for tree in held if law in tree["top"].get("tensioners", {}))
    return written(tree), np.random.default_rng(seed)


def refused(tree, field, *words):
    with pytest.raises(InputError) as error:
        SceneFile("rig.yaml", tree, {}).resolved()
    said = str(error.value)
    assert said.startswith(f"rig.yaml: {field}: "), said
    assert all(word in said for word in words), said


@pytest.mark.parametrize("seed", SEEDS)
def test_a_cylinder_is_named_once(seed):
    tree, draw = rig(seed)
    rig_of = tree["top"]["tensioners"]
    one, other = (int(c) for c in draw.choice(rig_of["count"], 2, replace=False))
    rig_of["failed"] = [one, one]
    refused(tree, "top.tensioners.failed", f"{one} occurs twice")
    rig_of["failed"] = [one]
    rig_of["failing"] = {"at": "1 s", "cylinders": [other, other]}
    refused(tree, "top.tensioners.failing.cylinders", f"{other} occurs twice")
    rig_of["failing"]["cylinders"] = [one]
    refused(tree, "top.tensioners.failing.cylinders", f"{one} is also listed in 'failed'")
    del rig_of["failed"]
    SceneFile("rig.yaml", tree, {}).resolved()


@pytest.mark.parametrize("seed", SEEDS)
def test_an_event_is_within_the_run(seed):
    tree, draw = rig(seed)
    end = float(tree["analysis"]["duration"].split()[0])
    late = f"{end + draw.uniform(0.0, 9.0)!r} s"
    tree["top"]["tensioners"]["failing"] = {"at": late, "cylinders": [0]}
    refused(tree, "top.tensioners.failing.at", "not before the end of the run")
    tree["top"]["tensioners"]["failing"]["at"] = f"{0.5 * end!r} s"
    SceneFile("rig.yaml", tree, {}).resolved()


@pytest.mark.parametrize("over", [None, "0.5 s"])
@pytest.mark.parametrize("seed", range(3))
def test_a_loss_of_tension_is_within_the_run(seed, over):
    tree, draw = rig(seed)
    end = float(tree["analysis"]["duration"].split()[0])
    top = tree["top"]
    del top["tensioners"], top["telescopic_joint"]
    top |= {"z": "free", "tension": "5 MN"}
    del top["elevation"]
    loss = {"share": 0.3, "at": f"{end + draw.uniform(0.0, 9.0)!r} s"} | ({"over": over} if over else {})
    top["tension_loss"] = loss
    refused(tree, "top.tension_loss.at", "not before the end of the run")


@pytest.mark.parametrize("seed", SEEDS)
def test_recoil_valves_close_within_the_run(seed):
    tree, draw = rig(seed, "gas", ("wellhead",))
    end = float(tree["analysis"]["duration"].split()[0])
    valve = {"oil_density": "900 kg/m^3", "opening": "0.02 m^2", "discharge": 0.7}
    valve |= {"residual": 0.05, "over": "1 s", "delay": f"{end!r} s"}
    tree["disconnect"] = {"at": f"{draw.uniform(0.1, 0.9) * end!r} s", "recoil_valve": valve}
    refused(tree, "disconnect.recoil_valve.delay", "not before the end of the run")


@pytest.mark.parametrize("seed", SEEDS)
def test_a_jump_of_the_drag_has_two_points(seed):
    tree, draw = rig(seed)
    low, high = sorted(draw.uniform(-250.0, 0.0, 2))
    drag = tree["riser"][-1]["drag"]

    def points(*elevations):
        values = draw.uniform(0.5, 1.5, len(elevations))
        pairs = zip(elevations, values, strict=True)
        return [{"elevation": f"{z!r} m", "value": float(value)} for z, value in pairs]

    drag["coefficient"] = points(float(low), float(low), float(high), float(high))
    SceneFile("rig.yaml", tree, {}).resolved()
    drag["coefficient"] = points(float(low), float(high), float(high), float(high))
    refused(tree, f"riser[{len(tree['riser']) - 1}].drag.coefficient", "three points")


@pytest.mark.parametrize("name", ["", " ", "lower end of section 0", "upper end of the pipe"])
def test_a_name_of_a_section_is_no_place(name):
    tree, _ = rig(0)
    tree["riser"][-1]["name"] = name
    refused(tree, f"riser[{len(tree['riser']) - 1}].name", "does not name a section")


def test_the_part_above_the_water_has_a_name_of_its_own():
    tree, _ = rig(2)
    low = dict(tree["riser"][-1])
    del low["submerged_weight"]
    length = float(low["length"].split()[0])
    high = low | {"length": f"{0.8 * length!r} m"}
    low |= {"length": f"{0.2 * length!r} m", "name": f"{high['name']}, above water"}
    tree["riser"][-1:] = [low, high]
    refused(tree, f"riser[{len(tree['riser']) - 1}].name", "rename the other section")


@pytest.mark.parametrize("angle", ["90.1 deg", "180 deg", "200 deg", "1000 deg"])
def test_a_latitude_ends_at_the_pole(angle):
    tree, _ = rig(1)
    drift = {"wind_speed": "10 m/s", "latitude": angle, "surface_factor": 0.0127}
    drift |= {"depth_factor": "7.6 s", "component": "magnitude"}
    tree["current"] = {"profile": drift}
    refused(tree, "current.profile.latitude", angle)
    tree["current"] = {"profile": drift | {"latitude": "90 deg"}}
    SceneFile("rig.yaml", tree, {}).resolved()


def test_damage_needs_two_outputs():
    tree, _ = rig(3)
    period, ramps = 9.0, 18.0
    tree["wave"] = {"height": "2 m", "period": f"{period} s", "above_mean_level": "none"}
    curve = {"detail_class": "D", "environment": "seawater with cathodic protection"}
    weld = {"name": "weld", "face": "outside", "curve": curve, "stress_concentration": 1.0}
    weld |= {"at": tree["riser"][-1]["name"], "safety_factor": 1.0}
    tree["fatigue"] = {"angles": 8, "details": [weld]}
    end = f"{ramps + 0.1} s"
    output = {"interval": "0.5 s", "start": f"{ramps} s"}
    tree["analysis"] |= {"duration": end, "output": output, "step": "0.25 s"}
    with pytest.raises(Exception, match="fewer than two outputs follow"):
        run(SceneFile("rig.yaml", tree, {}).resolved(), estimated=False)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("end", ["bottom", "top"])
def test_the_rotation_of_a_string_is_not_held(seed, end):
    """A string that hangs on upright tensioners: its ends turn freely, whatever would hold them."""
    draw = np.random.default_rng((seed, 6))
    tree, _ = rig(seed, hold=("wellhead",))
    for part in tree["riser"]:
        del part["young_modulus"]
        part["axial_stiffness"] = "8000 MN"
    tensioners = tree["top"]["tensioners"]
    tensioners.pop("arrangement", None)
    tree["top"] = {"x": "platform", "z": "free", "rotation": "free", "tensioners": tensioners}
    tree["bottom"]["rotation"] = "free"
    SceneFile("rig.yaml", tree, {}).resolved()
    stiff = {"stiffness": f"{draw.uniform(1, 90)} kN*m/deg"}
    tree[end]["rotation"] = "fixed" if seed % 2 else stiff
    refused(tree, f"{end}.rotation", "bending stiffness")
