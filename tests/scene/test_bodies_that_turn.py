"""A body that turns with the riser's end counts as no section: not in lines, not in the stack-up."""

import random
import re

import pytest

from riserstudy.dataset.tables import stack_up
from riserstudy.model.active_effects import ledger
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.scene.wave_forces import without_inertia
from riserstudy.scene.weight import doubts

TURNING = {"bottom.body.centre_below": "3 m", "bottom.body.rotary_inertia": "2e6 kg*m^2"}


def hung(rng):
    """A riser that hangs in waves from a floating platform, with faults and joints in random sections."""
    count = rng.randint(2, 5)
    jointed, guided, wet, heavy = (rng.randrange(1, count) for _ in range(4))
    riser = []
    for k in range(count):
        section = {
            "name": f"section {k}", "length": f"{rng.randint(40, 90)} m", "outer_diameter": "0.5 m",
            "inner_diameter": "0.46 m", "young_modulus": "210 GPa", "mass": "400 kg/m",
            "submerged_weight": f"{rng.uniform(1.0, 1.8):.3f} kN/m",
        }  # fmt: skip
        if k == jointed:
            section["flex_joint_below"] = {"stiffness": "1e5 N*m/rad"}
        if k == guided:
            section["guide_below"] = {"stiffness": "1e4 N/m"}
        if k == wet or rng.random() < 0.5:
            section["drag"] = {"coefficient": 1.0, "diameter": "0.5 m"}
        if k == heavy:
            section |= {"submerged_weight": "3.9 kN/m", "contents": {"density": "1100 kg/m^3"}}
        riser.append(section)
    return {
        "title": "hung", "gravity": "9.81 m/s^2", "riser": riser,
        "water": {"density": "1025 kg/m^3", "surface": "0 m", "seabed": "-900 m"},
        "bottom": {"hold": "free", "body": {"name": "LMRP", "mass": "60 t", "density": "7850 kg/m^3"}},
        "top": {"x": "held", "z": "held", "elevation": "-20 m", "rotation": "free"},
        "wave": {"height": "2 m", "period": "9 s", "above_mean_level": "none"},
        "analysis": {"mesh": {"elements": 20}, "step": "0.1 s", "duration": "1 s",
                     "output": {"interval": "0.5 s"}},
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(25))
def test_lines_of_sections_are_those_of_the_file(seed):
    file = SceneFile("hung.yaml", hung(random.Random(seed)))
    point, turning = file.resolved(), file.with_values(TURNING, "test").resolved()
    for told in (doubts, without_inertia):
        assert told(turning) == told(point)
        assert told(point)
    for found in sentences([*doubts(turning), *without_inertia(turning)]):
        k = int(re.match(r"riser\[(\d+)\]\.", found)[1])
        assert f"'{file.tree['riser'][k]['name']}'" in found
    reasons = [
        {row.name: row.because for row in ledger(scene) if "riser[" in row.because}
        for scene in (point, turning)
    ]
    assert reasons[0] == reasons[1]
    for because in reasons[1].values():
        k, field = re.fullmatch(r"riser\[(\d+)\]\.(\w+)", because).groups()
        assert field in file.tree["riser"][int(k)]


@pytest.mark.parametrize("seed", range(25))
def test_how_a_body_turns_changes_no_line_of_the_stack_up(seed):
    rng = random.Random(seed)
    file = SceneFile("hung.yaml", hung(rng))
    arm = {"bottom.body.centre_below": f"{rng.uniform(0.5, 9.0)} m"}
    turning = file.with_values(TURNING | arm, "test")
    assert stack_up(turning.resolved()) == stack_up(file.resolved())
    table = stack_up(turning.resolved())
    names = [section["name"] for section in reversed(file.tree["riser"])]
    assert [row[0] for row in table.rows] == [*names, "LMRP"]
    lowest = table.rows[-1][table.columns.index("upper end")]
    lengths = [float(s["length"].split()[0]) for s in file.tree["riser"]]
    assert lowest == pytest.approx(-20.0 - sum(lengths))
