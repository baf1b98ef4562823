"""Limits of operations with a connected riser apply until a disconnect, as in a run that ends there."""

import json

import pytest
from random_rigs import moving, written

from riserstudy.scene.limits import ANGLES, SIGNED, UNITS
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.simulate import simulate

AT, AFTER = 12.0, 3.0  # s, time of the disconnect, and duration after it
STEP = 0.25  # s, a whole fraction of both
SI = {"rad": "1 rad", "m": "1 m", "N": "1 MN", "N*m": "1 MN m", "N/m^2": "1 MPa"}
OUTPUTS = [name for name in UNITS if name not in ("overpull", "lmrp_clearance", "stroke")]


def limits():
    """A limit of each mode on each side of each output, at the whole riser or its lowest section."""
    for mode in ("drilling", "connected", "disconnect"):
        for output in OUTPUTS:
            for side in ("largest", "smallest") if output not in SIGNED else ("largest",):
                yield {"output": output, side: SI[UNITS[output]], "mode": mode}
        for output in (*ANGLES, "joint_stroke"):
            yield {"output": output, "mean": SI[UNITS[output]], "mode": mode}


def runs(seed, spatial):
    """A rig with a disconnect in its run, and the same without, which ends when the other disconnects."""
    tree = moving(seed, spatial=spatial, conductor=False)
    times = {"duration": AT + AFTER, "step": STEP, "output": {"interval": STEP}}
    tree["analysis"] |= times | {"method": "ESDIRK4"}
    tree["limits"] = list(limits())
    tree["top"]["telescopic_joint"]["stop"] = {"collapse": "4 m", "stiffness": "5 MN/m"}
    release = {"at": f"{AT} s", "over": "0.3 s", "stack": {"stiffness": "20 MN/m"}}
    whole = tree | {"disconnect": release}
    ends = tree | {"analysis": tree["analysis"] | {"duration": AT}}
    return [SceneFile("rig.yaml", written(one)) for one in (whole, ends)]


def rows(file):
    """Limits of a run, and the times at which they are first reached."""
    run = simulate(file)
    return json.loads(run.attrs["limits"]), json.loads(run.attrs["limits_reached"])


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_run_that_goes_on_has_the_demands_of_a_run_that_ends_with_the_disconnect(seed, spatial):
    whole, ends = runs(seed, spatial)
    (found, reached), (expected, first) = rows(whole), rows(ends)
    changed = 0
    for row, other, time, early in zip(found, expected, reached, first, strict=True):
        about = (row["output"], row["mode"], row["side"])
        assert about == (other["output"], other["mode"], other["side"])
        if row["mode"] == "disconnect":
            changed += row["demand"] != other["demand"]
            continue
        if other["demand"] is None:  # a rig without this output
            assert row["demand"] is None, about
            continue
        assert row["demand"] == pytest.approx(other["demand"], rel=1e-9, abs=1e-12), about
        if row["side"] != "mean":
            assert row["time"] == pytest.approx(other["time"], abs=1e-6), about
        assert time == pytest.approx(early, abs=1e-6), about
        assert f"until the disconnect at {AT:.4g} s" in row["takes"]
    assert changed > 8  # the time after the disconnect has other extremes
