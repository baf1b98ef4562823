"""Reference solutions are data: they judge as whole runs do, and those that are not sound are refused."""

from dataclasses import replace
from functools import cache
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from chapters.numerics import models
from chapters.numerics.attempt import errors
from chapters.numerics.fixed_step import stepped, whole
from chapters.numerics.make_references.compute import compute
from chapters.numerics.make_references.wanted import all_wanted
from chapters.numerics.reference import check, store
from chapters.numerics.reference.converge import HARD, converged
from chapters.numerics.reference.folder import FOLDER, path_of
from chapters.numerics.reference.identity import PHYSICS, scene_digest
from chapters.numerics.reference.kept import RESOLUTION, Damaged, Kept, packed, reduced, unpacked
from chapters.numerics.report.section import references
from riserstudy.errors import InputError
from riserstudy.jobs.workplan import Workplan
from riserstudy.model.mesh import even
from riserstudy.scene.load import read_scene
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[3] / "config"
SCENES = {
    "planar": ("hard/surge.yaml", {"analysis.duration": "12 s"}),
    "in space": (
        "hard/surge.yaml",
        {"analysis.duration": "12 s", "platform.sway": {"amplitude": "1 m", "period": "9 s", "ramp": "9 s"}},
    ),
    "axial": ("bench/s3.yaml", {"analysis.duration": "6 s"}),
    "at rest": ("fem_riser/base.yaml", {"analysis": {}}),
    "vibrating": ("hard/vortices.yaml", {"analysis.duration": "20 s"}),
}
METHOD = {"analysis.method": {"rho_inf": 0.8}}
SURE = 3.0  # ratio of an error to its estimate above which the physics may be others
NOTICED = 1e-4  # relative change by other physics that is noticed


def case(name, **sets):
    path, own = SCENES[name]
    return read_scene(CONFIG / "scenes" / path).with_values(own | sets, "test")


@cache
def runs(name):
    """A coarse and a fine run of a scene, whole."""
    file = case(name)
    found = []
    for elements, step in ((16, 0.1), (64, 0.05)):
        mesh, step = (even(file.resolved(), elements), step if file.resolved().analysis.duration else None)
        scene = stepped(file, METHOD, mesh, step) if step else whole(file.resolved())
        found.append(single(scene, mesh, step, True))
    return found


def kept_of(name):
    fine = runs(name)[1]
    return Kept(name, scene_digest(case(name).resolved()), PHYSICS, "engine", "a run", {}, reduced(fine))


@pytest.mark.parametrize("name", SCENES)
def test_errors_by_what_is_kept_are_those_by_the_whole_run(name):
    coarse, fine = runs(name)
    by_all = errors(coarse, fine)
    for nodes in (None, coarse.arrays["s_node"]):
        kept = replace(kept_of(name), result=reduced(fine, nodes))
        by_kept = errors(coarse, unpacked(packed(kept)).result)
        assert by_kept.keys() == by_all.keys()
        for quantity, error in by_all.items():
            # not all instants see no more than all do, and envelopes tell the extremes of all
            assert by_kept[quantity] <= 1.02 * error + 2.0 * RESOLUTION
            assert by_kept[quantity] >= 0.8 * error


@pytest.mark.parametrize("name", SCENES)
def test_a_solution_is_itself(name):
    fine = runs(name)[1]
    kept = unpacked(packed(kept_of(name)))
    for found in (errors(fine, kept.result), errors(kept.result, kept.result)):
        assert max(found.values()) <= 2.0 * RESOLUTION


def test_of_a_vibration_statistics_are_kept_and_no_instants():
    kept = unpacked(packed(kept_of("vibrating")))
    assert "time" not in kept.result.arrays
    assert not {"x", "y", "z", "mesh_moment"} & kept.result.arrays.keys()
    assert kept.result.facts["statistics"]["frequency"] > 0.0
    assert len(packed(kept)) < 0.5 * len(packed(kept_of("in space")))


SHEAR = {
    "current.profile": [{"elevation": "0 m", "speed": "0 m/s"}, {"elevation": "13 m", "speed": "0.8 m/s"}],
    "current.beyond": "hold",
    "analysis.duration": "12 s",
    "analysis.output.interval": "20 ms",
    "analysis.accuracy": "5 %",
}


@pytest.mark.long
def test_references_of_a_vibration_that_begins_otherwise_agree_within_their_errors():
    """Several modes take turns, so that phases at the begin decide the histories, and refinement does not."""
    found = []
    for seed in range(1, 4):
        file = case("vibrating", **SHEAR, **{"riser[0].viv.seed": seed})
        first = run(whole(file.resolved()))
        found.append(converged("shear", file, first, replace(HARD, most_work=4e5)))
    pairs = [check.deviation(a, b) for a, b in combinations(found, 2)]
    assert max(pairs) <= 1.0
    assert max(errors(found[0].result, found[1].result).values()) > HARD.enough


def test_equal_solutions_have_equal_bytes_and_say_where_they_come_from():
    one = packed(kept_of("planar"))
    assert one == packed(kept_of("planar"))
    back, given = unpacked(one), kept_of("planar")
    assert replace(back, result=None) == replace(given, result=None)


def test_a_case_without_a_solution_keeps_why():
    kept = Kept("snap", "digest", PHYSICS, "engine", "", missing="it buckles")
    assert unpacked(packed(kept)) == kept


@pytest.mark.parametrize("spoil", [lambda b: b[: len(b) // 2], lambda b: b[:40] + b"x" + b[41:]])
def test_damaged_bytes_are_no_solution(spoil):
    with pytest.raises(Damaged):
        unpacked(spoil(packed(kept_of("planar"))))


@pytest.fixture
def folder(tmp_path):
    """A folder with one kept solution."""
    store.write(tmp_path, "study", kept_of("planar"))
    return tmp_path


@pytest.mark.parametrize(
    "how",
    [
        {"analysis.mesh": {"elements": 7}, "analysis.step": "0.3 s"},
        {"analysis.accuracy": "3 %", "analysis.method": {"rho_inf": 0.5}, "title": "Another"},
    ],
)
def test_a_kept_solution_serves_whatever_mesh_step_and_accuracy_are_asked_for(folder, how):
    assert store.read(folder, "study", "planar", case("planar", **how).resolved()).result


@pytest.mark.parametrize(
    "change",
    [
        {"analysis.duration": "13 s"},
        {"platform.surge.amplitude": "2.5 m"},
        {"riser[0].mass": "1007 kg/m"},
        {"riser[0].added_mass": None},
    ],
)
def test_a_solution_of_a_scene_that_changed_is_refused_by_name(folder, change):
    with pytest.raises(store.NotUsed, match="'planar' is no longer the scene") as refused:
        store.read(folder, "study", "planar", case("planar", **change).resolved())
    assert str(path_of(folder, "study", "planar")) in str(refused.value)


def test_a_solution_of_other_physics_or_damaged_or_missing_is_refused_by_name(folder):
    scene = case("planar").resolved()
    with pytest.raises(store.NotUsed, match="'other' has no reference"):
        store.read(folder, "study", "other", scene)
    store.write(folder, "study", replace(kept_of("planar"), physics=PHYSICS + 1))
    with pytest.raises(store.NotUsed, match="'planar' was solved with physics"):
        store.read(folder, "study", "planar", scene)
    path = path_of(folder, "study", "planar")
    path.write_bytes(path.read_bytes()[:-9])
    with pytest.raises(store.NotUsed, match="'planar' is damaged"):
        store.read(folder, "study", "planar", scene)


@pytest.mark.long
def test_every_case_has_a_solution_that_can_be_used_or_says_why_there_is_none():
    for study, every in wanted().items():
        for one in every:
            kept = store.read(CONFIG, study, one.case, one.file.resolved())
            assert kept.result or kept.missing


def test_no_solution_is_kept_that_no_case_needs():
    needed = {path_of(CONFIG, study, one.case) for study, of in wanted().items() for one in of}
    assert needed == set((CONFIG / FOLDER).glob("*/*"))


@cache
def wanted():
    return all_wanted(read_studies(CONFIG, "numerics").measured, CONFIG)


def test_a_study_is_measured_anew_when_one_of_its_solutions_changes(folder, monkeypatch):
    plan = Workplan.read(CONFIG, {"tier": "preview"}, only=[])
    names = ("stability", "energy")
    before = [plan.measured_digest("numerics", name) for name in names]
    (path,) = (folder / FOLDER).glob("*/*")
    lists = {"stability": [path], "energy": []}
    monkeypatch.setattr(models, "references", lambda _, study: lists[study])
    given = [plan.measured_digest("numerics", name) for name in names]
    path.write_bytes(path.read_bytes()[:-1])
    after = [plan.measured_digest("numerics", name) for name in names]
    assert len({before[0], given[0], after[0]}) == 3
    assert before[1] == given[1] == after[1]


def test_a_solution_found_anew_deviates_when_physics_do():
    kept = replace(kept_of("planar"), error={"moment": 1e-3, "displacement": 1e-3, "tension": 1e-3})
    assert check.deviation(kept, kept) <= 1.0
    heavier = {"riser[0].mass": "1100 kg/m"}
    file = case("planar", **heavier)
    mesh = even(file.resolved(), 64)
    other = single(stepped(file, METHOD, mesh, 0.05), mesh, 0.05, True)
    assert check.deviation(kept, replace(kept, result=reduced(other))) > 1.0
    assert check.deviation(kept, replace(kept, result=None, missing="no")) == np.inf


def test_the_report_names_solutions_that_a_rerun_does_not_find(folder):
    def wanted(compute):
        return [store.Wanted("planar", case("planar"), compute)]

    kept = kept_of("planar")
    other = replace(kept, result=reduced(runs("planar")[0]))
    same = check.recomputed(folder, "study", wanted(lambda: kept))
    away = check.recomputed(folder, "study", wanted(lambda: other))
    assert references({"stability": same})[0].startswith(
        "A rerun reproduces 1 of 1 reference solution within"
    )
    assert references({"stability": away})[0].endswith("It does not reproduce: stability, planar.")
    assert references({"effects": same.drop_vars("recomputed")}) == []


@pytest.mark.long
@pytest.mark.parametrize("number", [1, 4])
def test_kept_solutions_are_those_of_the_present_physics(number):
    """Where a law or the meaning of a field changes, runs of today leave the kept solutions.

    They then differ by more than their estimated errors, and `PHYSICS` must be increased.
    """
    off = {}
    for one in wanted()["random_scenes"]:
        scene = whole(one.file.resolved())
        kept = store.read(CONFIG, "random_scenes", one.case, scene)
        if kept.result is None or not one.case.endswith(f" {number}"):
            continue
        found = run(scene)
        allowed = {
            name: SURE * error + kept.error.get(name, 0.0) + NOTICED
            for name, error in found.facts["error_estimate"].items()
        }
        by = {name: error - allowed[name] for name, error in errors(found, kept.result).items()}
        off |= {f"{one.case}, {name}": error for name, error in by.items() if error > 0.0}
    assert off == {}


@pytest.mark.slow
def test_a_tenth_of_all_solutions_found_anew_is_what_is_kept():
    every = [(study, one) for study, of in wanted().items() for one in of]
    chosen = {one.case for one in check.tenth([one for _, one in every])}
    off = {
        f"{study}/{one.case}": check.deviation(
            store.read(CONFIG, study, one.case, one.file.resolved()), one.compute()
        )
        for study, one in every
        if one.case in chosen
    }
    assert {name: by for name, by in off.items() if by > 1.0} == {}


@pytest.mark.parametrize("name", ["no such study", "stability/no such case", "stability/"])
def test_a_reference_that_nothing_needs_is_not_computed_in_silence(name):
    with pytest.raises(InputError, match="no reference"):
        compute(CONFIG, [name], again=False, processes=1)
