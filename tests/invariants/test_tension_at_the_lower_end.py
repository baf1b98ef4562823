"""A limit on the tension at the riser's lower end is judged as one on the effective tension there."""

import numpy as np
import pytest
from random_rigs import moving, rig, written

from riserstudy.dataset.limits import checked
from riserstudy.design.operability import offsets
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def both(tree, foot, allowable):
    """A scene with the limit on either output, the level of the mud above its ring."""
    for section in tree["riser"]:
        section["contents"]["level"] = tree["top"]["elevation"] + 10.0
    one = {"mode": "connected", "smallest": f"{float(allowable)!r} N"}
    limits = [
        {**one, "output": "effective_tension", "at": f"lower end of {foot}"},
        {**one, "output": "lower_end_tension"},
    ]
    return SceneFile("rig.yaml", written(tree, unit_of={"level": "m"}) | {"limits": limits})


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_verdicts_agree_at_every_margin(seed, spatial):
    tree = moving(seed, spatial=spatial, conductor=bool(seed % 2))
    facts = run(both(tree, "section 0", 0.0).resolved()).facts
    rows = [row for row in facts["extremes"] if row["output"] == "lower_end_tension"]
    least = min(row["smallest"] for row in rows)
    verdicts = set()
    for share in np.linspace(-0.02, 0.12, 15):
        file = both(tree, "section 0", least - share * abs(least))
        along, end = checked(file, file.resolved(), facts)
        assert along.demand == pytest.approx(end.demand, rel=1e-9)
        assert along.verdict == end.verdict, (share, along, end)
        verdicts.add(end.verdict)
    assert len(verdicts) > 1


@pytest.mark.parametrize("seed", range(4))
def test_offsets_agree(seed):
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    facts = run(both(tree, "section 0", 0.0).resolved()).facts
    least = min(row["smallest"] for row in facts["extremes"] if row["output"] == "lower_end_tension")
    for share in (-0.01, 0.0, 0.05):
        scene = both(tree, "section 0", least - share * abs(least)).resolved()
        along, end = offsets(scene, 30.0, {})
        assert along == pytest.approx(end, abs=0.1, nan_ok=True) or along.missing == end.missing != ""
