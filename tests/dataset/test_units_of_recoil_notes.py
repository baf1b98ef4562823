"""Notes in the table of a disconnect give the ends of strokes in the unit of the strokes beside them."""

import csv
import re

import pytest
from random_rigs import moving, written

from riserstudy import simulate
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.scene.load import SceneFile
from riserstudy.scene.units import factor

AT = 4.0  # s
ENDS = {"shortest joint stroke": -4.0, "longest joint stroke": 6.0}  # m


def released(seed):
    """A rig that disconnects, whose telescopic joint has two ends."""
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)
    tree["analysis"] |= {"duration": AT + 6.0, "step": 0.1, "output": {"interval": 0.5}, "method": "ESDIRK4"}
    tree["top"]["telescopic_joint"]["stop"] = {"collapse": "4 m", "stroke": "6 m", "stiffness": "5 MN/m"}
    tree["disconnect"] = {"at": f"{AT} s", "over": "0.3 s", "stack": {"stiffness": "20 MN/m"}}
    return SceneFile("rig.yaml", written(tree))


@pytest.mark.parametrize("seed", range(6))
def test_the_end_of_a_stroke_has_the_unit_of_the_stroke(tmp_path, commands, seed):
    write_dataset(simulate(released(seed), progress=False), tmp_path / "run.nc")
    for units, length in (("si", "m"), ("field", "m"), ("us", "ft")):
        table = tmp_path / f"{units}.csv"
        code, _, wrong = commands(
            "table", tmp_path / "run.nc", "-o", table, "--kind", "recoil", "--units", units
        )
        assert (code, wrong) == (0, "")
        rows = {row["quantity"]: row for row in csv.DictReader(table.open())}
        for name, end in ENDS.items():
            row = rows[name]
            noted, unit = re.search(r"at ([-+][\d.]+) (\w+)$", row["note"]).groups()
            assert row["unit"] == unit == length
            assert float(noted) * factor(unit, "m") == pytest.approx(end, rel=1e-3)  # of four digits
            beyond = (float(row["value"]) - float(noted)) * (1.0 if end > 0.0 else -1.0)
            assert row["note"].startswith("stroke-out") == (beyond * factor(unit, "m") > 1e-3)
