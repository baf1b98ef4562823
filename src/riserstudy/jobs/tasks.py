"""Jobs of the workflow's rules, one function per rule: ``python -m riserstudy.jobs <function> ...``.

A job reads, computes, writes whole files and seals them. With ``--expect`` it raises a `SimulationError`
where scene, study or code changed since the workflow was planned. Modules are imported when a job needs
them: the server, from which jobs are forked, has most of them loaded, and a figure needs no solver.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from riserstudy.dataset.unit_systems import UnitSystem
from riserstudy.errors import InputError, RiserStudyError, printable
from riserstudy.jobs import CORES, SHARED
from riserstudy.jobs.planned import CONFIG, check_unchanged, datasets_of, read_plan, text_of
from riserstudy.jobs.points_done import ShowPoints
from riserstudy.records.words import counted

if TYPE_CHECKING:
    import xarray as xr

INTERRUPTED, BAD_INPUT = 130, 2  # exit statuses

Tier = Annotated[str, typer.Option(help="of the run")]
Threads = Annotated[int, typer.Option(help="that the job may use")]
Expect = Annotated[str, typer.Option(help="digest of what it is to do, as planned")]
Tuned = Annotated[Path | None, typer.Option(help="file of the settings that the study is tuned to")]
Papers = Annotated[list[str], typer.Option("--paper", help="may be repeated")]
Units = Annotated[UnitSystem, typer.Option(help="of what is drawn and written")]

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, no_args_is_help=True)


def run(arguments: Sequence[str]) -> int:
    """Run a job; return its exit status. A job that fails prints one line on stderr.

    ``arguments``: name of the job and its arguments.
    """
    try:
        return int(app(args=[*arguments], prog_name="riserstudy.jobs", standalone_mode=False) or 0)
    except typer.Abort:
        return INTERRUPTED
    except RiserStudyError as error:
        print(f"riserstudy: {error}", file=sys.stderr)
        return error.exit_code
    except Exception as error:
        if not hasattr(error, "format_message"):
            raise
        print(f"riserstudy: job: {printable(error.format_message())}", file=sys.stderr)
        return BAD_INPUT


def job(function: Callable[..., None]) -> Callable[..., None]:
    """Register a function as a job under its own name."""
    return app.command(function.__name__)(function)


def processes(claimed: int, worth: int) -> int:
    """Return the number of processes of a job. It may exceed the threads that the job claims.

    At its beginning and at its end another job leaves cores idle, which the additional processes use.

    Parameters
    ----------
    claimed : threads that Snakemake counts for the job.
    worth : threads that the job can use.
    """
    cores = int(os.environ.get(CORES, 0))  # of the run, where jobs share one machine
    return min(worth, SHARED * claimed, cores) if cores else claimed


# Grids


@job
def compile_kernels(group: Annotated[str | None, typer.Argument()] = None) -> None:
    """Compile a group of kernels before jobs start in parallel; without a group, mark all as compiled.

    Raises InputError when the group does not exist.
    """
    from riserstudy.simulation.compile import compile_group, join_markers
    from riserstudy.simulation.kernel_groups import GROUPS

    if group is None:
        join_markers()
    elif group in GROUPS:
        print(compile_group(group))
    else:
        found = f"{group!r} is not a group of compiled code"
        raise InputError("job", "group", found, f"use one of {', '.join(GROUPS)}")


@job
def tune(paper: str, study: str, target: Path, tier: Tier, expect: Expect) -> None:
    """Tune mesh, step and method of a study; write them into a file that its points use."""
    from riserstudy.study.settings import tuned_for, write_settings

    plan = read_plan(tier, [paper], only=[(paper, study)])
    check_unchanged(plan.settings_digest(paper, study), expect)
    found = tuned_for(plan.study(paper, study), lambda line: print(line, flush=True))
    print(found.because or f"{found.setting}: work {found.work:.2g} of the work of runs with the tolerance")
    write_settings(found, target)
    _seal(target)


@job
def shard(
    paper: str,
    study: str,
    shard: str,
    shards: str,
    target: Path,
    tier: Tier,
    threads: Threads,
    expect: Expect,
    settings: Tuned = None,
) -> None:
    """Simulate the points of one shard of a study that the store lacks, and store them.

    The target contains the number of points of the shard.
    """
    from riserstudy.files.whole import write_whole
    from riserstudy.study.settings import fill_tuned, read_settings, with_setting
    from riserstudy.study.simulate_points import fill

    plan = read_plan(tier, [paper], only=[])
    check_unchanged(plan.shard_digest(paper, study, shard, shards), expect)
    points = plan.shard(paper, study, shard, shards)
    planned = plan.study(paper, study)
    setting = read_settings(settings).setting if settings else None
    workers = processes(threads, plan.shard_threads(paper, study, shard, shards))
    if setting:
        tuned = with_setting(planned, setting)
        pairs = zip(points, tuned.shard(int(shard), int(shards)), strict=True)
        again = sum(fill_tuned(planned, tuned, pairs, workers, ShowPoints()).by_request)
        summary = f"{counted(len(points), 'point')}, {again} of them with the tolerance"
    else:
        made = fill(planned, points, workers, ShowPoints())
        summary = f"{counted(made, 'point')} simulated, {len(points) - made} from the store"
    print(f"{paper}/{study}, part {shard} of {shards}: {summary}")
    write_whole(target, f"{len(points)} points\n".encode())


@job
def simulate(
    paper: str, study: str, target: Path, tier: Tier, threads: Threads, expect: Expect, settings: Tuned = None
) -> None:
    """Simulate the points of a study that the store lacks, and write its dataset."""
    from riserstudy.study.settings import read_settings
    from riserstudy.study.write_study import write_study

    plan = read_plan(tier, [paper], only=[(paper, study)])
    check_unchanged(plan.study_digest(paper, study), expect)
    tuned = read_settings(settings) if settings else None
    workers = processes(threads, plan.threads(paper, study))
    write_study(plan.study(paper, study), target, workers, print, ShowPoints(), tuned)
    _seal(target)


@job
def sea_states(
    paper: str, study: str, part: int, target: Path, tier: Tier, threads: Threads, expect: Expect
) -> None:
    """Simulate and store the runs of one setting in one heading, in the sea states that it needs.

    The target contains the number of sea states. Raises SimulationError when the largest number of sea states
    does not suffice.
    """
    from riserstudy.files.whole import write_whole
    from riserstudy.seas.seas_hours import simulate_part

    plan = read_plan(tier, [paper], only=[])
    check_unchanged(plan.seas_digest(paper, study), expect)
    workers = processes(threads, plan.seas_threads(paper, study))
    count = simulate_part(plan.seas(paper, study), part, workers, _notify)
    write_whole(target, f"{count} sea states\n".encode())


@job
def hours(paper: str, study: str, target: Path, tier: Tier, threads: Threads, expect: Expect) -> None:
    """Write the dataset of the hours of a record.

    Raises SimulationError when the largest number of sea states does not suffice.
    """
    from riserstudy.seas.seas_hours import seas_hours

    plan = read_plan(tier, [paper], only=[])
    check_unchanged(plan.seas_digest(paper, study), expect)
    _write(seas_hours(plan.seas(paper, study), threads, _notify), target)


def _notify(line: str) -> None:
    print(line, flush=True)


@job
def measure(
    paper: str, study: str, target: Path, tier: Tier, papers: Papers, threads: Threads, expect: Expect
) -> None:
    """Make a dataset by measuring code of its chapter, instead of simulating a grid."""
    from riserstudy.chapters.measure import measure

    plan = read_plan(tier, papers, only=[])
    check_unchanged(plan.measured_digest(paper, study), expect)
    _write(measure(paper, study, plan.measured(paper, study), plan.setting(threads)), target)


# Results made from datasets


@job
def derive(
    paper: str,
    name: str,
    target: Path,
    sources: list[Path],
    settings: Annotated[str, typer.Option(help="further arguments, as JSON")],
    expect: Expect,
) -> None:
    """Derive a dataset from others."""
    from riserstudy.chapters.derive import derive

    datasets = datasets_of(sources)
    check_unchanged(read_plan(None, [paper], only=[]).derived_digest(paper, name), expect)
    _write(derive(paper, name, datasets, json.loads(settings)), target)


@job
def draw(
    paper: str,
    name: str,
    targets: Annotated[tuple[Path, Path, Path], typer.Argument(metavar="PNG PDF CSV")],
    expect: Expect,
    sources: Annotated[list[Path] | None, typer.Argument()] = None,
    units: Units = UnitSystem.FIELD,
) -> None:
    """Draw a figure from its datasets, or a schematic, which has no dataset, from its scene."""
    from riserstudy.dataset.unit_systems import reading_in
    from riserstudy.figures import save
    from riserstudy.jobs.figure import from_datasets, from_scene

    datasets = datasets_of(sources or [])
    check_unchanged(read_plan(None, [paper], only=[]).figure_digest(paper, name), expect)
    with reading_in(units):
        place = (CONFIG, paper, name)
        save(from_datasets(*place, datasets) if datasets else from_scene(*place), *targets)
    _seal(*targets)


@job
def grade(
    paper: str, graded: Path, errata: Path, margins: Path, false: Path, sources: list[Path], expect: Expect
) -> None:
    """Grade the numbers, claims and errata of a paper, and the false claims about it."""
    from riserstudy.chapters import checks_of
    from riserstudy.files.whole import write_whole
    from riserstudy.grading import grade as grading
    from riserstudy.grading.false_claims import read_false_claims
    from riserstudy.grading.falsify import FalseRow, false_rows
    from riserstudy.grading.published import read_published
    from riserstudy.grading.rows import ErratumRow, Row, row_of, table
    from riserstudy.records.graded import Case

    datasets, checks = datasets_of(sources), checks_of(paper)
    check_unchanged(read_plan(None, [paper], only=[]).grade_digest(paper), expect)
    file = read_published(CONFIG, paper, datasets)
    items = grading.grade(file, datasets, checks)
    cases = (case for item in items for case in item.cases)
    write_whole(graded, table(map(row_of, items), Row).encode())
    write_whole(margins, table(cases, Case).encode())
    write_whole(errata, table(grading.errata(file, datasets, checks), ErratumRow).encode())
    claims = read_false_claims(CONFIG, paper, file)
    refused = [*false_rows(CONFIG, file, claims, datasets, checks, items)]
    write_whole(false, table(refused, FalseRow).encode())
    _seal(graded, errata, margins, false)
    for item in items:
        print(f"{paper}/{item.id}: {item.verdict}")
    for row in refused:
        print(f"{paper}/{row.id}: {row.verdict}, a false claim made from {row.made_from}")


@job
def join_tables(target: Path, sources: list[Path]) -> None:
    """Join CSV tables with the same columns into one, in the order given.

    Raises InputError when a table cannot be read, or its columns differ.
    """
    from riserstudy.files.whole import write_whole

    texts = [text_of(source) for source in sources]
    headers = {text.partition("\n")[0] for text in texts}
    if len(headers) > 1:
        raise InputError(
            target, "", "the tables to join have different columns", "join tables with equal columns"
        )
    rows = "".join(text.partition("\n")[2] for text in texts)
    write_whole(target, ("".join(f"{header}\n" for header in headers) + rows).encode())
    _seal(target)


@job
def database(target: Path, papers: Papers, files: list[Path]) -> None:
    """Make the results database, or update it."""
    from riserstudy.database.build import build
    from riserstudy.database.sources import Sources
    from riserstudy.jobs.seals import is_intact, remove

    if not is_intact(target):
        remove(target)  # its content is not reused
    built = build(target, Sources(CONFIG, papers, files))
    _seal(target)
    print(f"{built.read} of {built.datasets} datasets were new or had changed")


@job
def report(
    target: Path,
    database: Path,
    compiled: Path,
    papers: Papers,
    expect: Expect,
    units: Units = UnitSystem.FIELD,
) -> None:
    """Write the report on all results."""
    from riserstudy.dataset.unit_systems import reading_in
    from riserstudy.report import write_report
    from riserstudy.report.contents import Sources

    check_unchanged(read_plan(None, papers, only=[]).report_digest, expect)
    with reading_in(units):
        write_report(Sources(CONFIG, papers, database, compiled), target)
    _seal(target)


def _write(dataset: xr.Dataset, target: Path) -> None:
    """Write a dataset, and seal it."""
    from riserstudy.dataset.write_dataset import write_dataset

    write_dataset(dataset, target)
    _seal(target)


def _seal(*targets: Path) -> None:
    """Seal files that were written."""
    from riserstudy.jobs.seals import seal

    seal(*targets)


# By hand


@job
def calibrate(
    study: Annotated[str, typer.Argument(help="paper/study")],
    ids: Annotated[list[str], typer.Argument(help="of printed numbers")],
    tier: Tier = "standard",
    most: Annotated[int | None, typer.Option(help="evaluations a start")] = None,
) -> None:
    """Fit the calibrated values of a study to published values, and print them; no file is written."""
    from riserstudy.jobs.calibration import fit_study

    fit_study(CONFIG, study, ids, tier, most)
