"""What the pipeline promises, on the real workflow in small."""

import contextlib
import hashlib
import os
import random
import re
import time

import psutil
import pytest
import xarray as xr
from edits import edit, prose_edit
from planning import dry_run

pytestmark = pytest.mark.long

SEAL = 32  # bytes at the end of compiled code
SIMULATE = {f"simulate chang2020/{study}" for study in ("steady", "from_rest", "quasi_static")}
AFTER = {"derive chang2020/asymmetry", "draw chang2020/fig14"}
COMPILE = {"compile kernels, once: line"}
STUDY = "config/studies/chang2020.yaml"
PLAIN = ("chang2020", "--workflow-profile", "none", "--quiet", "host")
SCENE = "config/scenes/chang2020/heave.yaml"


def numbers(checkout, name):
    """A dataset without what differs between runs: the time they took."""
    dataset = xr.load_dataset(checkout / f"results/chang2020/{name}.nc")
    return dataset.drop_vars([n for n in dataset if n.endswith("seconds")])


def assert_same_numbers(one, other):
    for name in ("steady", "from_rest", "quasi_static", "asymmetry"):
        xr.testing.assert_identical(numbers(one, name), numbers(other, name))


# A second run, and edits


def test_a_second_run_does_nothing(finished):
    assert finished.planned() == set()
    before = finished.stored()
    status, said, complained = finished.run()
    assert (status, complained) == (0, "")
    assert said.startswith("Nothing to do")
    assert finished.stored() == before


def test_a_new_grid_value_simulates_its_points_and_what_depends_on_them(checkout):
    before = checkout.stored()
    checkout.edit(STUDY, "- -5.0", "- -5.0\n        - -2.5")
    status, _, complained = checkout.run()
    assert (status, complained) == (0, "")
    assert checkout.done() == {"simulate chang2020/quasi_static"} | AFTER
    assert before < checkout.stored()
    assert len(checkout.stored() - before) == 2  # one for each tensioner model
    log = (checkout / "logs/chang2020/quasi_static.log").read_text()
    assert "2 points simulated, 10 from the store" in log
    assert checkout.planned() == set()


def test_a_scene_value_reruns_what_depends_on_it(checkout):
    checkout.edit(SCENE, "damping: 967 N*s/m", "damping: 968 N*s/m")
    assert checkout.planned() == SIMULATE | AFTER
    checkout.edit(SCENE, "damping: 968 N*s/m", "damping: 967.0 N*s/m")
    checkout.edit(SCENE, "assumed: 5 m,", "assumed: 4 m,")  # which every study of the figure sets
    before = checkout.stored()
    status, _, complained = checkout.run()
    assert (status, complained) == (0, "")
    assert checkout.stored() == before


def test_a_comment_in_a_scene_reruns_nothing(checkout):
    checkout.edit(SCENE, "riser:", "# the string\nriser:")
    assert checkout.planned() == set()


def test_an_edited_package_reruns_what_the_edited_part_makes(checkout):
    package = checkout.own_package()
    assert checkout.planned() == set()
    for file, jobs in (
        (checkout / "chapters/chang2020/figures/sweeps.py", {"draw chang2020/fig14"}),
        (checkout / "chapters/chang2020/derived.py", AFTER),
        (package / "scene/weight.py", SIMULATE | AFTER),
        (package / "effects/weight.py", COMPILE | SIMULATE | AFTER),
    ):
        with file.open("a") as source:
            source.write("\nEDITED = 1\n")
        assert checkout.planned() == jobs


def test_the_files_of_a_chapter_are_inputs_of_the_rules_that_run_them(checkout):
    """Seen by what Snakemake tells of a file that comes into a chapter and is imported there."""
    with (checkout / "chapters/chang2020/derived.py").open("a") as source:
        source.write("\nfrom chapters.chang2020.more import MORE as MORE\n")
    (checkout / "chapters/chang2020/more.py").write_text("MORE = 1\n")
    _, said = dry_run(checkout.folder, checkout.environment, "chang2020")
    changed = "Set of input files has changed since last execution"
    jobs = re.findall(rf"^Job \d+: (.*)\nReason: .*{changed}", said, re.MULTILINE)
    assert set(jobs) == {"derive chang2020/asymmetry"}
    assert checkout.planned() == AFTER


@pytest.mark.parametrize("seed", range(2))
def test_an_edit_of_prose_reruns_nothing(checkout, seed):
    """Comments, docstrings, annotations and layout, in several files of each folder."""
    package, draw = checkout.own_package(), random.Random(seed)
    parts = [package / part for part in ("solve", "effects", "scene", "simulation", "study")]
    for folder in (*parts, checkout / "chapters/chang2020"):
        files = sorted(folder.glob("*.py"))
        for file in draw.sample(files, min(4, len(files))):
            file.write_text(prose_edit(file.read_text(), draw)[1])
    assert checkout.planned() == set()


@pytest.mark.parametrize("seed", range(3))
def test_an_edit_of_what_kernels_do_compiles_and_simulates(checkout, seed):
    draw, package = random.Random(seed), checkout.own_package()
    file = package / draw.choice(["solve/newton.py", "solve/implicit.py", "effects/inertia.py"])
    kind, text = edit(file.read_text(), draw)
    assert kind
    file.write_text(text)
    assert checkout.planned() == COMPILE | SIMULATE | AFTER


def test_a_figure_simulates_only_what_it_needs(fresh):
    fresh.edit(
        STUDY, "figures:", "figures:\n  fig13:\n    caption: other\n    reads: [steady]\n    plot: lines"
    )
    assert fresh.planned("chang2020_fig14") - COMPILE == SIMULATE | AFTER
    only = {"simulate chang2020/steady", "draw chang2020/fig13"}
    assert fresh.planned("chang2020_fig13") - COMPILE == only
    assert fresh.planned("chang2020") - COMPILE == SIMULATE | AFTER | only


# Studies that several jobs share


def test_shards_of_a_study_join_to_the_same_dataset(fresh, finished):
    dataset = "results/chang2020/quasi_static.nc"
    fresh.edit("config/config.yaml", "tier: standard", "tier: standard\npoints_per_job: 5")
    parts = {f"simulate chang2020/quasi_static, part {k} of 2" for k in (1, 2)}
    status, _, complained = fresh.run("chang2020_fig14")
    assert (status, complained) == (0, "")
    assert fresh.done() - COMPILE == SIMULATE | AFTER | parts
    log = (fresh / "logs/chang2020/quasi_static.log").read_text()
    assert "0 points simulated, 10 from the store" in log
    assert len(fresh.stored()) == len(finished.stored())
    assert_same_numbers(fresh, finished)
    sharded = xr.load_dataset(fresh / dataset)
    fresh.edit("config/config.yaml", "points_per_job: 5", "points_per_job: 500")
    assert fresh.run("chang2020_fig14")[0] == 0
    assert fresh.done() == {"simulate chang2020/quasi_static"} | AFTER
    # from the same points, so with the same times too
    xr.testing.assert_identical(xr.load_dataset(fresh / dataset), sharded)


# Killed runs, damaged files


@pytest.mark.parametrize("moment", [".cache/points/*/*.point2", "results/chang2020/*.nc"])
def test_a_run_killed_at_any_moment_is_finished_by_the_next(fresh, finished, moment):
    run = fresh.start("chang2020")
    deadline = time.monotonic() + 240
    while not any(fresh.folder.glob(moment)):
        assert time.monotonic() < deadline
        assert run.poll() is None, run.communicate()
        time.sleep(0.01)
    for process in [psutil.Process(run.pid), *psutil.Process(run.pid).children(recursive=True)]:
        with contextlib.suppress(psutil.NoSuchProcess):  # it may end of itself meanwhile
            process.kill()
    run.communicate()
    before = fresh.stored()
    assert before
    status, _, complained = fresh.run()
    assert status == 0
    assert all(line.startswith("riserstudy: note: ") for line in complained.splitlines())
    assert before <= fresh.stored()  # none is written again
    assert len(fresh.stored()) == len(finished.stored())
    assert_same_numbers(fresh, finished)
    assert {path.name for path in fresh.folder.glob("results/**/.*")} <= {".seals"}


def test_damaged_points_and_datasets_are_made_anew(checkout, finished):
    point = next((checkout / ".cache/points").glob("*/*.point2"))
    os.truncate(point, point.stat().st_size // 2)
    for study in SIMULATE:
        os.truncate(checkout / f"results/{study.split()[1]}.nc", 4000)
    whole = {entry for entry in checkout.stored() if entry[0] != point.name}
    status, _, complained = checkout.run()
    assert status == 0
    notes = complained.splitlines()
    assert all(line.startswith("riserstudy: note: ") for line in notes)
    assert sum("is not as its job wrote it; it is made again when needed" in line for line in notes) == 3
    assert whole < checkout.stored()
    assert len(checkout.stored()) == len(whole) + 1
    assert_same_numbers(checkout, finished)


def whole(file):
    """Whether a file of compiled code is as it was written."""
    content, seal = file.read_bytes()[:-SEAL], file.read_bytes()[-SEAL:]
    return seal == hashlib.sha256(file.name.encode() + b"\n" + content).digest()


def test_damaged_kernels_are_compiled_anew(checkout, finished):
    kernels = checkout.own_kernels()
    damaged = [*kernels.rglob("gas_spring.force-*.nbc"), *kernels.rglob("end_mass.*.nbi")]
    for file in damaged:
        os.truncate(file, file.stat().st_size // 2)
    for path in (checkout / ".cache/points").glob("*/*.point2"):
        path.unlink()
    (checkout / "results/chang2020/from_rest.nc").unlink()
    status, _, complained = checkout.run()
    assert (status, complained) == (0, "")
    # what the run needed was written anew; what it did not need is healed when it is
    for ending in (".nbc", ".nbi"):
        assert any(whole(file) for file in damaged if file.suffix == ending)
    assert_same_numbers(checkout, finished)


# Bad input


@pytest.mark.parametrize(
    "file, old, new, where",
    [
        (SCENE, "volume: 3.2 m^3", "volume: 3.2 m^2", "heave.yaml: top.tensioners.gas.volume"),
        (SCENE, "volume: 3.2 m^3", "volume: .nan", "heave.yaml: top.tensioners.gas.volume"),
        (SCENE, "count: 4", "count: !!python/name:os.system 4", "heave.yaml: line"),
        (STUDY, "- -5.0", "- -19.0\n        - .inf", "chang2020.yaml: "),
        (STUDY, "path: platform.position.heave", "path: platform.nothing", "platform.nothing"),
        (
            STUDY,
            "scene: scenes/chang2020/heave.yaml\n    caption: the last period",
            "scene: absent\n    caption: the last period",
            "absent",
        ),
        (STUDY, "reads: [asymmetry]", "reads: [symmetry]", "figures.fig14.reads"),
        (STUDY, "studies:", "studies: [", "chang2020.yaml: line"),
        ("config/config.yaml", "- chang2020", "- nobody2020", "studies/nobody2020.yaml: No such file"),
    ],
)
def test_bad_input_is_told_in_one_line_where_jobs_would_be_planned(laid_out, file, old, new, where):
    laid_out.edit(file, old, new)
    status, complained = dry_run(laid_out.folder, laid_out.environment, *PLAIN)
    assert status == 2
    assert complained.startswith("riserstudy: ")
    assert where in complained
    assert complained.count("\n") == 1


@pytest.mark.parametrize(
    "file, old, new", [(SCENE, "volume: 3.2 m^3", "volume: 3.2 m^2"), (STUDY, "studies:", "studies: [")]
)
def test_bad_input_stops_a_run_before_any_job_in_the_same_words(laid_out, file, old, new):
    laid_out.edit(file, old, new)
    planned = dry_run(laid_out.folder, laid_out.environment, *PLAIN)
    status, said, complained = laid_out.run()
    assert (status, said, complained) == (2, "", planned[1])
    assert not (laid_out / "results").exists()
    assert not (laid_out / "logs").exists()
