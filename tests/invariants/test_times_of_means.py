"""A limit on a mean names the time from which the mean is taken, on rigs with tensioners in motion."""

import re

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_a_mean_over_the_times_of_its_note_is_the_value(seed, spatial):
    draw = np.random.default_rng((seed, 5))
    tree = moving(seed, spatial=spatial, conductor=False)
    ramp = max(part["ramp"] for part in tree["platform"].values() if "ramp" in part)
    start = float(draw.choice([0.0, 0.5 * ramp, draw.uniform(1.05, 1.5) * ramp]))
    tree["analysis"]["output"]["start"] = start
    limit = {"output": "x", "mean": "1 km", "mode": "drilling", "at": "upper end of section 0"}
    released = seed % 2 == 0 and start < 0.9 * ramp
    if released:
        limit = {"output": "lfj_angle", "mean": "1 deg", "mode": "drilling"}
        release = float(draw.choice([0.9, 1.4])) * ramp
        tree["disconnect"] = {"at": f"{release!r} s", "over": "0.3 s", "stack": {"stiffness": "20 MN/m"}}
        tree["analysis"]["duration"] = release + 1.0
    file = SceneFile("rig.yaml", written(tree, unit_of={"start": "s"}) | {"limits": [limit]})
    found = run(file.resolved(), estimated=False)
    (row,) = checked(file, file.resolved(), found.facts)
    note = re.match(r"from (\S+) s on|includes ramps", row.takes)
    begin = float(note[1]) if note and note[1] else start
    end = file.resolved().lower_joint_until if released else np.inf
    assert note
    assert start * (1.0 - 1e-5) <= begin < end
    # the mean of many values, linear between the outputs; some means are over the steps between them
    time = found.arrays["time"]
    last = time[time <= end][-1]
    middles = begin + (last - begin) * (np.arange(20_000) + 0.5) / 20_000
    value = abs(np.interp(middles, time, history(found, limit, file)).mean())
    # in space, the mean of an angle is the magnitude of the mean rotation
    assert row.demand == pytest.approx(value, rel=1e-3 if released else 1e-4)


def history(found, limit, file):
    """The limited output over time."""
    if limit["output"] == "lfj_angle":
        return found.arrays["lfj_angle"]
    end = file.resolved().riser[0].total_length
    return found.arrays["x"][:, int(np.argmin(abs(found.arrays["s"] - end)))]
