"""The estimated error of shear covers the true one; Newton's iteration leaves little of moment and shear."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from random_rigs import moving, rig, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import single

VIBRATING = Path(__file__).parents[2] / "config/scenes/hard/vortices.yaml"
COVERED = 1.5  # true over estimated error, at most: as that of angles


def file_of(tree, **more):
    return SceneFile("rig.yaml", written(tree) | more)


def requested(tree, accuracy="2 %"):
    """A rig that requests an accuracy in place of its mesh and step."""
    sets = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": accuracy}
    return file_of(tree).with_values(sets, "test").resolved()


def refined(tree):
    scene = requested(tree)
    refinement = Refinement(scene)
    return scene, refinement.result(), refinement.finest_mesh


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(5))
def test_the_estimate_of_a_request_covers_the_true_error(seed, spatial):
    """Rigs in motion on real tensioners, against segments and steps a quarter as long."""
    scene, found, mesh = refined(moving(seed, spatial=spatial, conductor=False))
    fine = single(scene, mesh.halved().halved(), found.facts["step"] / 4.0)
    true, estimated = difference(found, fine), found.facts["error_estimate"]
    assert 0.0 < true["shear"] <= COVERED * estimated["shear"]


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(20, 28))
def test_the_estimate_at_rest_covers_the_true_error(seed, spatial):
    """Conductors among them; segments an eighth as long."""
    scene, found, mesh = refined(rig(seed, spatial=spatial))
    true = difference(found, single(scene, mesh.halved().halved().halved(), None))
    assert true["shear"] <= COVERED * found.facts["error_estimate"]["shear"] + 1e-9


@pytest.mark.parametrize("seed", range(4))
def test_the_estimate_on_a_mesh_and_step_of_ones_own_covers_the_true_error(seed):
    tree = moving(seed + 40, conductor=False)
    tree["analysis"]["mesh"]["elements"] = 160
    fine = tree | {"analysis": tree["analysis"] | {"mesh": {"elements": 640}}}
    fine["analysis"]["step"] = tree["analysis"]["step"] / 4.0
    found = run(file_of(tree).resolved())
    true = difference(found, run(file_of(fine).resolved(), estimated=False))
    assert true["shear"] <= COVERED * found.facts["error_estimate"]["shear"]


@pytest.mark.parametrize("seed, above", [(64, 0.0), (71, 0.0), (63, 3.5), (67, 2.7), (71, 1.7)])
def test_the_largest_shear_of_a_conductor_on_a_mesh_of_ones_own_is_covered(seed, above):
    """The coarser meshes of the estimate have few nodes of it: one of 27 segments is compared with 13.

    It stands so far (m) above the mudline, which is within a segment then.
    """
    tree = rig(seed, spatial=bool(seed % 2), conductor=True)
    tree["soil"]["mudline"] -= above
    tree["water"]["seabed"] -= above
    found = run(file_of(tree | {"analysis": {"mesh": {"elements": 600}}}).resolved())
    fine = file_of(tree | {"analysis": {"mesh": {"elements": 4800}}}).resolved()
    largest, true = (
        float(abs(one.arrays["shear_force_static"]).max()) for one in (found, run(fine, estimated=False))
    )
    assert abs(true - largest) <= COVERED * found.facts["error_estimate"]["shear"] * largest


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_shear_at_the_mudline_is_that_of_the_stack_above(seed, spatial):
    """No force acts at the mudline alone.

    The error falls with the order of the method where segments are halved.
    """
    scene, _, mesh = refined(rig(seed + 60, spatial=spatial, conductor=True))
    values = []
    for _ in range(3):
        mesh = mesh.halved()
        found = single(scene, mesh, None).arrays
        top = mesh.foot(1)  # of the conductor
        above = np.interp(scene.riser[0].total_length + 0.5, mesh.s, found["shear_force_static"])
        values.append((found["shear_force_static"][top], above))
    far = [abs(at - above) for at, above in values]
    assert far[-1] <= 0.02 * abs(values[-1][1])
    changes = [abs(after[0] - before[0]) for before, after in pairwise(values)]
    assert changes[1] <= changes[0] / 3.0 + 1e-6 * abs(values[-1][0])


@pytest.mark.parametrize(
    "seed, spatial, halvings",
    [
        *((seed, spatial, k) for seed, spatial in ((0, False), (4, False), (4, True)) for k in range(3)),
        *((9, False, k) for k in range(2)),
        pytest.param(9, False, 2, marks=pytest.mark.slow),
    ],
)
def test_moment_and_shear_are_those_of_converged_iterations(seed, spatial, halvings):
    """Tensioners with corners in their force, on short segments, where positions say too little."""
    scene, found, mesh = refined(moving(seed, spatial=spatial, conductor=False))
    for _ in range(halvings):
        mesh = mesh.halved()
    analysis = scene.analysis.replaced(newton_tolerance=1e-14)
    sure = scene.replaced(analysis=analysis)
    step = found.facts["step"] / 2.0**halvings
    off = difference(single(scene, mesh, step), single(sure, mesh, step))
    assert off["moment"] <= 0.003
    assert off["shear"] <= 0.006


@pytest.mark.parametrize("seed", range(4))
def test_shear_is_within_its_limit_only_with_its_error(seed):
    """Limits below the largest shear, and above it by less and by more than its estimated error."""
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)
    facts = run(file_of(tree).resolved()).facts
    rows = [row for row in facts["extremes"] if row["output"] == "shear_force"]
    largest = max(abs(row[side]) for row in rows for side in ("largest", "smallest"))
    share = facts["error_estimate"]["shear"]  # of the true value, which may be larger by as much
    error = share * largest / max(1.0 - share, 0.1)
    assert error > 0.0
    for margin, verdict in ((-0.5, "exceeded"), (0.5, "not evaluated"), (1.5, "within")):
        limit = {"output": "shear_force", "mode": "drilling"}
        limit["largest"] = f"{max(largest + margin * error, 0.5 * largest)!r} N"
        file = file_of(tree, limits=[limit])
        (row,) = checked(file, file.resolved(), facts)
        assert row.verdict == verdict
        assert ("error of the shear force" in row.missing) == (verdict == "not evaluated")


@pytest.mark.parametrize("share", [0.5, 0.99, 1.5])
def test_a_limit_of_shear_is_not_met_by_a_riser_that_vibrates_in_vortices(share):
    """Nothing estimates the error of shear there."""
    analysis = {"duration": "20 s", "output": {"interval": "40 ms"}}
    analysis |= {"mesh": {"elements": 24}, "step": "20 ms"}
    file = read_scene(VIBRATING).with_values({"analysis": analysis}, "test")
    facts = run(file.resolved(), estimated=False).facts
    rows = [row for row in facts["extremes"] if row["output"] == "shear_force"]
    largest = max(abs(row[side]) for row in rows for side in ("largest", "smallest"))
    limit = {"output": "shear_force", "mode": "drilling", "largest": f"{largest * share!r} N"}
    file = file.with_values({"limits": [limit]}, "test")
    (row,) = checked(file, file.resolved(), facts)
    assert row.verdict == ("exceeded" if share < 1.0 else "not evaluated")
