"""A smallest pull is that of the cylinders that work, on rigs in motion of which some cylinders fail."""

import math

import numpy as np
import pytest
from random_rigs import on_cylinders, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

NEAR = 1e-3  # of the largest pull: a parabola through three steps lies between them


def failing_rig(seed, spatial, late):
    """A rig, cylinders that have failed from the start, cylinders that fail during the run, and when (s)."""
    tree = on_cylinders(seed, "count", spatial=spatial, conductor=False)
    draw = np.random.default_rng((seed, 7))
    rig, analysis = tree["top"]["tensioners"], tree["analysis"]
    chosen = draw.permutation(rig["count"])[: int(draw.integers(1, rig["count"]))].tolist()
    split = int(draw.integers(1, len(chosen) + 1)) if late else len(chosen)
    gone, going = chosen[: len(chosen) - split], chosen[len(chosen) - split :]
    if not late:
        gone, going = chosen, []
    step = analysis["step"]
    at = round(0.6 * analysis["duration"] / step) * step
    if gone:
        rig["failed"] = gone
    if going:
        rig["failing"] = {"at": f"{at!r} s", "cylinders": going}
    share = rig["count"] / (rig["count"] - len(chosen))  # what is left carries the riser
    for law in (rig.get("linear"), rig.get("gas")):
        for name in ("tension", "pressure"):
            if law and name in law:
                law[name] *= share
    for row in rig.get("table", []):
        row["force"] *= share
    analysis["output"]["interval"] = step
    return tree, gone, going, at


def smallest_by_hand(result, gone, going, at):
    """Smallest pull at an output of a cylinder that has not failed by then."""
    time, pulls = result.arrays["time"], result.arrays["tensioner_force"]
    least = math.inf
    for cylinder in range(pulls.shape[1]):
        if cylinder not in gone:
            last = at if cylinder in going else math.inf
            least = min(least, float(pulls[time < last - 1e-6, cylinder].min()))
    return least


@pytest.mark.parametrize("late", [False, True], ids=["from the start", "during the run"])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_failed_cylinder_is_below_no_smallest_pull(seed, spatial, late):
    tree, gone, going, at = failing_rig(seed, spatial, late)
    limits = [{"output": "tensioner_force", "smallest": "1 N", "mode": "connected"}]
    result = run(SceneFile("rig.yaml", written(tree) | {"limits": limits}).resolved(), estimated=False)
    least = smallest_by_hand(result, gone, going, at)
    (row,) = (row for row in result.facts["extremes"] if row["output"] == "tensioner_force")
    near = NEAR * row["largest"]
    assert least - 50.0 * near <= row["smallest"] <= least + near
    for allowed, within in ((row["smallest"] - near, True), (row["smallest"] + near, False)):
        limit = {"output": "tensioner_force", "smallest": f"{allowed!r} N", "mode": "connected"}
        file = SceneFile("rig.yaml", written(tree) | {"limits": [limit]})
        (one,) = checked(file, file.resolved(), result.facts)
        assert one.verdict == ("within" if within else "exceeded")
        assert ("without failed" in one.takes) == bool(gone)
        assert (f"only until {at:g} s" in one.takes) == bool(going)


@pytest.mark.parametrize("late", [False, True], ids=["from the start", "during the run"])
@pytest.mark.parametrize("seed", range(6))
def test_a_smallest_pull_is_reached_by_a_cylinder_that_works(seed, late):
    tree, gone, going, at = failing_rig(seed, seed % 2 == 1, late)
    plain = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    time, pulls = plain.arrays["time"], plain.arrays["tensioner_force"]
    least, first = smallest_by_hand(plain, gone, going, at), float(pulls[0][pulls[0] > 0.0].min())
    allowed = 0.5 * (least + first)
    limits = [
        {"output": "tensioner_force", "smallest": f"{force!r} N", "mode": "connected"}
        for force in (allowed, 0.5 * least)
    ]
    result = run(SceneFile("rig.yaml", written(tree) | {"limits": limits}).resolved(), estimated=False)
    works = np.ones(pulls.shape, bool)
    works[:, gone] = False
    works[np.ix_(time > at - 1e-6, going)] = False
    below = np.flatnonzero(np.where(works, pulls, np.inf).min(axis=1) <= allowed)
    reached, never = result.facts["limits_reached"]
    assert never == "never"
    assert time[below[0]] - tree["analysis"]["step"] - 1e-6 <= reached <= time[below[0]] + 1e-6


@pytest.mark.parametrize("seed", range(8))
def test_at_rest_the_smallest_pull_is_that_of_a_cylinder_that_works(seed):
    tree, gone, _, _ = failing_rig(seed, seed % 2 == 1, False)
    tree["analysis"] = {"mesh": {"elements": 30}}
    for motion in ("surge", "sway", "heave", "pitch", "roll"):
        tree["platform"].pop(motion, None)
    result = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    pulls = result.arrays["tensioner_force_static"]
    (row,) = (row for row in result.facts["extremes"] if row["output"] == "tensioner_force")
    assert row["smallest"] == np.delete(pulls, gone).min() > 0.0


@pytest.mark.parametrize("late", [False, True], ids=["from the start", "during the run"])
@pytest.mark.parametrize("seed", range(4))
def test_a_failed_cylinder_is_no_error_of_the_pulls(seed, late):
    """The estimated error of pulls is far below a pull, so that a limit with a margin is evaluated."""
    tree, gone, going, at = failing_rig(seed, seed % 2 == 1, late)
    plain = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    least = smallest_by_hand(plain, gone, going, at)
    limit = {"output": "tensioner_force", "smallest": f"{0.5 * least!r} N", "mode": "connected"}
    file = SceneFile("rig.yaml", written(tree) | {"limits": [limit]})
    facts = run(file.resolved()).facts
    own = {"tensioner_force": facts["error_estimate"].get("tensioner_force", 0.0)}
    assert own["tensioner_force"] < 0.3
    (one,) = checked(file, file.resolved(), facts | {"error_estimate": own})
    assert one.verdict == "within"
