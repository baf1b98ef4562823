"""Vortex-induced vibration stays bounded and accounted for where it is hardest, by every implicit method."""

import copy

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.errors import SimulationError
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

VIV = {"model": "synchronisation", "diameter": "1.1 m", "coefficient": 1.2, "memory": 20.0, "seed": 3}
SCENE = {
    "title": "a drilling riser in a current",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3", "seabed": "0 m", "surface": "600 m"},
    "riser": [
        {
            "name": "riser",
            "length": "600 m",
            "outer_diameter": "0.5334 m",
            "inner_diameter": "0.4826 m",
            "young_modulus": "210 GPa",
            "mass": "700 kg/m",
            "submerged_weight": "0.8 kN/m",
            "drag": {"coefficient": 1.1, "diameter": "1.1 m"},
            "added_mass": {"coefficient": 1.0, "diameter": "1.1 m"},
            "viv": VIV | {"frequencies": [0.11, 0.18, 0.26]},
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": {"stiffness": "50 kN*m/deg"}},
    "top": {"x": "held", "z": "free", "tension": "1.2 MN"},
    "current": {
        "profile": [{"elevation": "0 m", "speed": "0.3 m/s"}, {"elevation": "600 m", "speed": "0.9 m/s"}]
    },
    "analysis": {
        "duration": "150 s",
        "output": {"interval": "0.5 s"},
        "mesh": {"elements": 60},
        "step": "0.1 s",
    },
}
WATER = 1025.0 * 0.25 * np.pi * 1.1**2
OWN = 0.5 / 600.0 * np.sqrt(0.96e6 / (700.0 + WATER))  # first natural frequency of a string, Hz


def speeds(*at):
    return [
        {"elevation": f"{z} m", "speed": f"{u} m/s"}
        for z, u in zip(np.linspace(0.0, 600.0, len(at)), at, strict=True)
    ]


def uniform(mode, frequency):
    """A current that sheds with a frequency over speed and diameter at that of a mode."""
    speed = mode * OWN * 1.1 / frequency
    return speeds(speed, speed)


turning = [
    {"elevation": f"{z} m", "speed": "0.7 m/s", "direction": f"{heading} deg"}
    for z, heading in ((0.0, 0.0), (200.0, 60.0), (400.0, 170.0), (600.0, 260.0))
]
CASES = {
    "strong shear": {"current.profile": speeds(0.0, 0.02, 2.5)},
    "a jump": {"current.profile": [*speeds(1.2, 1.2)[:1], {"elevation": "300 m", "speed": "1.2 m/s"},
               {"elevation": "300 m", "speed": "0 m/s"}, {"elevation": "600 m", "speed": "0 m/s"}]},
    "the slow edge of lock-in": {"current.profile": uniform(3, 0.26), "riser[0].viv.ramp": "40 s"},
    "the fast edge of lock-in": {"current.profile": uniform(3, 0.11)},
    "water that hardly moves": {"current.profile": speeds(1e-6, 1e-6), "riser[0].viv.ramp": "10 s"},
    "still water": {"current.profile": speeds(0.0, 0.0), "riser[0].viv.ramp": "10 s"},
    "a current that turns with depth": {"current.profile": turning, "current.headings": "towards"},
    "a wire": {"riser[0].viv.diameter": "5 mm", "analysis.duration": "5 s", "analysis.step": "1 ms",
               "analysis.output.interval": "5 ms"},
    "a column": {"riser[0].viv.diameter": "12 m", "riser[0].viv.ramp": "40 s"},
    "compression at the foot": {"top.tension": "0.45 MN", "riser[0].submerged_weight": "0.8 kN/m"},
    "a platform that surges": {"top.x": "platform",
                               "platform": {"surge": {"amplitude": "4 m", "period": "9 s", "ramp": "18 s"}},
                               "analysis.output.interval": "0.25 s"},
    "waves": {"wave": {"height": "6 m", "period": "11 s", "above_mean_level": "stretched", "ramp": "22 s"}},
}  # fmt: skip


def simulated(changes, method):
    file = SceneFile("test", copy.deepcopy(SCENE), {}).with_values(
        changes | {"analysis.method": method}, "test"
    )
    return run(file.resolved(), estimated=False)


@pytest.mark.long
@pytest.mark.parametrize("method", [{"rho_inf": 0.8}, "TR-BDF2", "ESDIRK4"], ids=str)
@pytest.mark.parametrize("case", CASES)
def test_it_stays_bounded_and_its_energy_is_accounted_for(case, method):
    found = simulated(CASES[case], method)
    assert all(np.isfinite(values).all() for values in found.arrays.values() if values.dtype == float)
    assert found.facts["audit"]["unexplained_share"] < 0.02
    late = found.arrays["time"] > found.facts["vibration_since"]
    y, x = found.arrays["y"][late], found.arrays["x"][late]
    diameter = float(str(CASES[case].get("riser[0].viv.diameter", "1.1 m")).split()[0])
    diameter *= 1e-3 if "mm" in str(CASES[case].get("riser[0].viv.diameter", "")) else 1.0
    size = np.sqrt(2.0) * found.facts["vibration_rms_max"]
    if "surge" not in case and "waves" not in case and "column" not in case:
        assert size < 2.0 * max(diameter, 1.1)
    assert abs(x).max() + abs(y).max() < 600.0


@pytest.mark.parametrize("case", ["still water", "water that hardly moves"])
def test_without_flow_nothing_moves(case):
    found = simulated(CASES[case], "TR-BDF2")
    assert found.facts["vibration_rms_max"] < 1e-6


@pytest.mark.parametrize("seed", range(8))
def test_without_flow_an_accuracy_is_reached_on_meshes_that_are_found(seed):
    """Water at rest, or so slow that nothing but rounding moves; risers upright or aside."""
    draw = np.random.default_rng(seed)
    speed = draw.choice([0.0, 10.0 ** draw.uniform(-12.0, -7.0)])
    changes = {
        "current.profile": speeds(speed, speed),
        "riser[0].viv.ramp": "10 s",
        "top.tension": f"{draw.uniform(0.8, 3.0)} MN",
        "top.offset": f"{draw.choice([0.0, 10.0])} m",
        "analysis": {"duration": "20 s", "output": {"interval": "0.25 s"}},
    }
    found = run(SceneFile("test", copy.deepcopy(SCENE), {}).with_values(changes, "test").resolved())
    assert max(found.facts["error_estimate"].values()) <= 0.01
    slow = ["almost no drag" in text for text in sentences(found.facts["warnings"])]
    assert slow == ([True] if speed > 0.0 else [])  # and no other warning
    assert found.facts["vibration_rms_max"] < 1e-6


def test_a_run_that_ends_before_its_ramps_is_refused():
    with pytest.raises(
        SimulationError, match=r"riser.viv: the ramps end at .* give a longer analysis.duration"
    ):
        simulated({"riser[0].viv.diameter": "12 m"}, "TR-BDF2")


@pytest.mark.parametrize("seed", range(24))
def test_random_rigs_on_inclined_tensioners_vibrate_and_account_for_their_energy(seed):
    tree = rig(seed, spatial=bool(seed % 2), conductor=seed % 3 == 0)
    assert tree["top"]["tensioners"]["arrangement"]
    for section in tree["riser"]:
        if section.get("drag"):
            own = {"diameter": section["drag"]["diameter"], "ramp": 10.0}
            section["viv"] = VIV | own | {"frequencies": [0.11, 0.18, 0.26]}
    tree["analysis"] = {"duration": 80.0, "step": 0.1, "mesh": {"elements": 80}, "output": {"interval": 0.5}}
    found = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    assert found.facts["audit"]["unexplained_share"] < 1e-3
    assert 0.0 < found.facts["vibration_rms_max"] < 2.0
