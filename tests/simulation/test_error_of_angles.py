"""The estimated error of angles: it covers the true one, falls as the method does, and chooses nothing."""

import copy
import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from random_rigs import moving, rig, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.limits import ANGLES
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation import refinement as module
from riserstudy.simulation.error_estimate import controlled, difference
from riserstudy.simulation.halved import Halved
from riserstudy.simulation.refine import run
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import single

MANY = 1000  # segments of a run, which four times finer would take a minute
COVERED = 1.5  # true over estimated error, at most: as the other quantities of a long record


def file_of(tree, **more):
    return SceneFile("rig.yaml", written(tree) | more)


def requested(tree, accuracy):
    """A rig that requests an accuracy in place of its mesh and step."""
    file = file_of(tree)
    sets = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": accuracy}
    return file.with_values(sets, "test").resolved()


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(5))
def test_the_estimate_of_a_request_covers_the_true_error(seed, spatial):
    """Rigs in motion on real tensioners, against segments and steps a quarter as long, or half of many."""
    scene = requested(moving(seed, spatial=spatial, conductor=False), "2 %")
    refinement = Refinement(scene)
    found = refinement.result()
    halvings = 1 if len(refinement.finest_mesh.l0) > MANY else 2
    mesh = refinement.finest_mesh
    for _ in range(halvings):
        mesh = mesh.halved()
    fine = single(scene, mesh, found.facts["step"] / 2.0**halvings)
    true, told = difference(found, fine), found.facts["error_estimate"]
    for joint in ANGLES:
        assert true[joint] <= COVERED * told[joint]


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(20, 24))
def test_the_estimate_at_rest_covers_the_true_error(seed, spatial):
    """Without motion, conductors among them; segments an eighth as long."""
    scene = requested(rig(seed, spatial=spatial), "2 %")
    refinement = Refinement(scene)
    found = refinement.result()
    mesh = refinement.finest_mesh.halved().halved().halved()
    true = difference(found, single(scene, mesh, None))
    for joint in ANGLES:
        assert true.get(joint, 0.0) <= COVERED * found.facts["error_estimate"].get(joint, 0.0) + 1e-9


@pytest.mark.parametrize("interval", [0.5, 40.0], ids=["many outputs", "first and last"])
@pytest.mark.parametrize("seed", range(4))
def test_the_estimate_on_a_mesh_and_step_of_ones_own_covers_the_true_error(seed, interval):
    """Also where outputs tell nothing of what is in between."""
    tree = moving(seed + 40, conductor=False)
    tree["analysis"]["output"]["interval"] = interval * tree["analysis"]["step"]
    fine = copy.deepcopy(tree)
    fine["analysis"]["mesh"]["elements"] *= 4
    fine["analysis"]["step"] /= 4.0
    found = run(file_of(tree).resolved())
    true = difference(found, run(file_of(fine).resolved(), estimated=False))
    for joint in ANGLES:
        assert true[joint] <= COVERED * found.facts["error_estimate"][joint]


@pytest.mark.parametrize("spatial", [False, True])
def test_angles_converge_with_the_order_of_the_method(spatial):
    """Mesh and step halved together: second order, on a rig whose outputs are at common steps."""
    tree = moving(3, spatial=spatial, conductor=False)
    period = tree["platform"]["surge"]["period"]
    tree["analysis"] = {"duration": 2.0 * period, "output": {"interval": period / 20.0}}
    runs = []
    for k in range(5):
        analysis = {"mesh": {"elements": 40 * 2**k}, "step": period / (40.0 * 2**k)}
        runs.append(
            run(file_of(tree | {"analysis": tree["analysis"] | analysis}).resolved(), estimated=False)
        )
    for joint in ANGLES:
        changes = [difference(coarse, fine)[joint] for coarse, fine in pairwise(runs)]
        falls = [before / after for before, after in pairwise(changes)]
        assert min(falls[1:]) > 3.0  # 4 in the limit


def test_an_error_of_angles_chooses_neither_mesh_nor_step(monkeypatch):
    """One that never falls and is above the result itself."""
    scene = requested(moving(1, spatial=False, conductor=False), "5 %")
    plain = run(scene)

    def hopeless(coarse, fine):
        return controlled(difference(coarse, fine)) | dict.fromkeys(ANGLES, 3.0)

    monkeypatch.setattr(module, "difference", hopeless)
    found = run(scene)
    steps = [[one[k] for k in ("elements", "step")] for one in found.facts["refinements"]]
    assert steps == [[one[k] for k in ("elements", "step")] for one in plain.facts["refinements"]]
    assert found.facts["warnings"] == plain.facts["warnings"]
    assert min(found.facts["error_estimate"][joint] for joint in ANGLES) > 1.0
    assert controlled(found.facts["error_estimate"]) == controlled(plain.facts["error_estimate"])


def test_how_errors_are_seen_to_fall_is_that_of_the_quantities_that_an_accuracy_bounds():
    before = Halved({"moment": 0.8, "ufj_angle": 9.0}, None)
    assert Halved({"moment": 0.2, "ufj_angle": 9.0}, before).fall == pytest.approx(4.0)


def check_limits_near_angles(facts, file_with, word):
    """Limits below the largest angle, and above it by less and by more than its estimated error.

    Parameters
    ----------
    file_with : scene with a limit.
    word : in what a limit says that its error leaves undecided.
    """
    rows = {row["output"]: row for row in facts["extremes"] if row["output"] in ANGLES}
    sizes = {name: max(abs(row["largest"]), abs(row["smallest"])) for name, row in rows.items()}
    for name, size in sizes.items():
        share = facts["error_estimate"][name]  # of the true value, which may be larger by as much
        error = share * size / max(1.0 - share, 0.1)
        assert error > 0.0
        for margin, verdict in ((-0.5, "exceeded"), (0.5, "not evaluated"), (1.5, "within")):
            largest = f"{max(size + margin * error, 0.5 * size)!r} rad"
            file = file_with({"output": name, "mode": "drilling", "largest": largest})
            (row,) = checked(file, file.resolved(), facts)
            assert row.verdict == verdict
            assert (word in row.missing) == (verdict == "not evaluated")
    return rows


@pytest.mark.parametrize("seed", range(4))
def test_an_angle_is_within_its_limit_only_with_its_error(seed):
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)

    def file_with(limit):
        return file_of(tree, limits=[limit])

    facts = run(file_of(tree).resolved()).facts
    assert check_limits_near_angles(facts, file_with, "flex joint angle")
    file = file_with({"output": "bending_moment", "mode": "drilling", "largest": "1e9 N*m"})
    poor = facts | {"error_estimate": dict.fromkeys(ANGLES, 3.0)}
    (row,) = checked(file, file.resolved(), poor)
    assert row.verdict == "within"


VIBRATING = Path(__file__).parents[2] / "config/scenes/hard/vortices.yaml"
SHEAR = [{"elevation": "0 m", "speed": "0 m/s"}, {"elevation": "10 m", "speed": "0.5 m/s"}]


@pytest.mark.long
@pytest.mark.parametrize("own", [{}, {"mesh": {"elements": 24}, "step": "20 ms"}], ids=["found", "own"])
@pytest.mark.parametrize("shear", [False, True])
def test_an_angle_of_a_riser_that_vibrates_is_within_its_limit_only_with_its_error(shear, own):
    """Of mesh, step and chance, whether mesh and step are the scene's own or found."""
    analysis = {"duration": "30 s", "output": {"interval": "40 ms"}} | (own or {"accuracy": "5 %"})
    sets = {"analysis": analysis} | ({"current": {"profile": SHEAR}} if shear else {})
    file = read_scene(VIBRATING).with_values(sets, "test")
    result = run(file.resolved())
    for joint in ANGLES:
        assert result.facts["sampling_error"][joint] > 0.0
        assert result.facts["error_estimate"][joint] >= result.facts["sampling_error"][joint]
    rows = check_limits_near_angles(
        result.facts, lambda limit: file.with_values({"limits": [limit]}, "test"), "run longer"
    )
    assert rows.keys() == set(ANGLES)


def test_a_string_aside_tells_the_error_of_its_upper_angle():
    """Steep angles at the ends of a string without bending stiffness, at 2 % of displacement and tension."""
    tree = {
        "title": "a string aside",
        "gravity": "10 m/s^2",
        "riser": [
            {
                "name": "string",
                "length": "1000 m",
                "axial_stiffness": "1e10 N",
                "submerged_weight": "1000 N/m",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "held", "offset": "150 m", "elevation": "980 m"},
        "analysis": {"accuracy": "2 %"},
    }
    scene = SceneFile("string.yaml", tree).resolved()
    refinement = Refinement(scene)
    found = refinement.result()
    mesh = refinement.finest_mesh
    for _ in range(4):
        mesh = mesh.halved()
    true = difference(found, single(scene, mesh, None))
    for joint in ANGLES:
        assert true[joint] <= COVERED * found.facts["error_estimate"][joint]
        assert np.isfinite(found.facts["error_estimate"][joint])
    assert true["ufj_angle"] > 1e-6
    assert json.dumps(found.facts["error_estimate"])
