"""Outputs of a run: plot, table, statistics."""

from __future__ import annotations

import math
from collections.abc import Iterator
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.cli.shared import (
    AtOption,
    DatasetArgument,
    FigureOutput,
    SetOption,
    UnitsOption,
    compile_kernels,
    notify,
    place_of,
    print_warnings,
    quantity,
    scene_of,
    wrote,
)
from riserstudy.cli.targets import ForceOption, Writes, check_output
from riserstudy.dataset.unit_systems import UnitSystem, reading_in
from riserstudy.errors import InputError
from riserstudy.records.numerals import at_most, percent

if TYPE_CHECKING:
    from riserstudy.scene.resolve import Resolved

SUCH_AS = "write, for example, 3 h"
SHORT = 10.0  # ratio of exposure time to record from which on there is a warning
MISSED = 0.03  # share of a range by which extremes of outputs may differ from those over all time steps


class PlotKind(StrEnum):
    """Plots of a run."""

    RANGE = "range"
    TIME_SERIES = "time-series"
    SHAPE = "shape"


def plot(
    dataset: DatasetArgument,
    output: FigureOutput,
    kind: Annotated[
        PlotKind, typer.Option(help="extremes along the riser (range), time series, or shape")
    ] = PlotKind.RANGE,
    of: Annotated[
        list[str] | None,
        typer.Option(help="quantity to plot, such as bending_moment; may be repeated", metavar="NAME"),
    ] = None,
    at: AtOption = None,
    force: ForceOption = False,
    units: UnitsOption = UnitSystem.FIELD,
) -> None:
    """Plot one run: extremes along the riser with the limits, time series, or the shape of the riser."""
    from riserstudy.dataset.open import open_dataset
    from riserstudy.dataset.place import complete, place
    from riserstudy.figures import save
    from riserstudy.figures.run import draw

    of_run = open_dataset(dataset)
    check_output(output, ("figure",), [dataset], force)
    with reading_in(units):
        run = complete(of_run.isel(place(of_run, place_of(at))))
        save(draw(kind.value, run, of), output)
    wrote(output)


class TableKind(StrEnum):
    """Tables of a run."""

    STACK_UP = "stack-up"
    EXTREMES = "extremes"
    TIME_SERIES = "time-series"
    LIMITS = "limits"
    RECOIL = "recoil"


def table(
    source: Annotated[
        Path, typer.Argument(help="scene (YAML), or the dataset of its run", metavar="SCENE.yaml")
    ],
    output: Annotated[
        Path,
        typer.Option(
            "-o", "--output", help="table to write, or an .xlsx workbook of all tables", metavar="OUT.csv"
        ),
        Writes("table", "workbook"),
    ],
    kind: Annotated[
        TableKind | None, typer.Option(help="kind of table; default: extremes, or all in a workbook")
    ] = None,
    settings: SetOption = None,
    force: ForceOption = False,
    units: UnitsOption = UnitSystem.SI,
) -> None:
    """Write a table as CSV: stack-up, extremes, time series, limits, recoil; or all tables as a workbook.

    The input is a scene or the dataset of a run. The stack-up lists the riser sections of the scene; for all
    other tables, a scene is first simulated. Workbooks (OUT.xlsx) require `pip install
    "riserstudy[workbook]"`.
    """
    from riserstudy.dataset import tables, workbook

    book = output.suffix == workbook.ENDING
    if book and (fault := workbook.lacks_library(output)):
        raise fault
    stored = source.suffix == ".nc"
    if stored and settings:
        raise InputError(
            "--set", settings[0], "has no effect on a dataset, which contains results", "give a scene instead"
        )
    file = None if stored else scene_of(source, settings)
    check_output(output, ("table", "workbook"), file.files if file else [source], force)
    one = kind or (None if book else TableKind.EXTREMES)
    scene, dataset = _run_of(source) if file is None else (file.resolved(), None)
    if dataset is None and one is not TableKind.STACK_UP:
        from riserstudy.simulation.simulate import simulate

        compile_kernels(scene)
        dataset = simulate(file or source)
        print_warnings(dataset)
    with reading_in(units):
        if one is None and dataset is not None:
            made = tables.tables_of(scene, dataset)
        else:
            name = (one or TableKind.EXTREMES).value
            made = {name: tables.table_of(name, scene, dataset)}
    made = {name: tables.in_units(of, units) for name, of in made.items()}
    if book:
        workbook.write_workbook(made, output)
    else:
        tables.write_csv(next(iter(made.values())), output)
    wrote(output)


def _run_of(source: Path) -> tuple[Any, Any]:
    """The scene and the dataset of one run."""
    from riserstudy.dataset.open import open_dataset
    from riserstudy.dataset.provenance import scene_of_point

    dataset = open_dataset(source)
    if "point_key" in dataset:
        allowed = "give the dataset of one run; `riserstudy rerun` writes it for a point (--at, -o)"
        raise InputError(source, "", "the dataset is from a study with several runs", allowed)
    return scene_of_point(dataset, {}), dataset


def statistics(
    dataset: DatasetArgument,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="table to write", metavar="OUT.csv"), Writes("table")
    ],
    start: Annotated[
        str, typer.Option(help="leave out times before this time, such as '200 s'", metavar="TIME")
    ] = "0 s",
    exposure: Annotated[
        str | None,
        typer.Option(
            help="duration of the storm for which extremes are estimated, such as '3 h'; default: the whole "
            "record"
        ),
    ] = None,
    over: Annotated[
        str | None,
        typer.Option(
            help="axis of seeds (random phases of the sea); a Gumbel distribution is fitted to the extremes",
            metavar="AXIS",
        ),
    ] = None,
    at: AtOption = None,
    force: ForceOption = False,
    units: UnitsOption = UnitSystem.SI,
) -> None:
    """Compute statistics in an irregular sea: mean, standard deviation, and extremes of one or several runs.

    For one run, the table also gives the most probable extremes during a longer time (--exposure). The
    option --over evaluates several runs of a study, which differ only by the seed (random phases) of
    their waves. With --over, ``statistics`` fits a Gumbel distribution to the extremes of all runs.
    """
    from riserstudy.dataset import statistics_tables, tables
    from riserstudy.dataset.open import open_dataset
    from riserstudy.dataset.place import complete, place
    from riserstudy.dataset.provenance import scene_of_point

    of_run = open_dataset(dataset)
    check_output(output, ("table",), [dataset], force)
    if over and exposure:
        found = "has no effect with --over, which uses extremes over the whole duration"
        raise InputError("--exposure", exposure, found, "omit --exposure or --over")
    if over in place_of(at):
        found = "the option --over uses all runs along this axis"
        raise InputError("--at", over, found, "omit the axis from --at")
    begin = quantity("--start", start, "s", SUCH_AS)
    within = None if exposure is None else quantity("--exposure", exposure, "s", SUCH_AS)
    if exposure and not (within or 0.0) > 0.0:
        raise InputError("--exposure", exposure, "this is not a duration above 0", SUCH_AS)
    missed = ("", 0.0)
    if over:
        apart = of_run.isel({over: [0]}) if over in of_run.dims else of_run
        index = {axis: k for axis, k in place(apart, place_of(at)).items() if axis != over}
        made = statistics_tables.over_seeds(complete(of_run.isel(index)), over, begin)
        index, record = index | {over: 0}, math.inf
    else:
        index = place(of_run, place_of(at))
        run = complete(of_run.isel(index))
        made = statistics_tables.of_a_run(run, begin, within)
        missed = statistics_tables.most_missed(run)
        record = float(run["time"][-1]) - begin
    scene = scene_of_point(of_run, index)
    for text in [*_warnings(scene, begin, record, within), *_of_outputs(scene, missed)]:
        notify(f"warning: {text}")
    tables.write_csv(tables.in_units(made, units), output)
    wrote(output)


def _warnings(scene: Resolved, begin: float, record: float, exposure: float | None) -> Iterator[str]:
    """Reasons why statistics of a record (s) from a time (s) on may be wrong."""
    output = scene.analysis.output
    if exposure and exposure > SHORT * record:
        yield (
            f"extremes of {exposure:g} s are estimated from a record of {record:g} s, "
            f"which is {exposure / record:.0f} times shorter; simulate a longer record, or more seeds"
        )
    if max(begin, (output and output.start) or 0.0) < scene.built_up * (1.0 - 1e-9):
        yield (
            f"ramps end at {scene.built_up:.4g} s, and the statistics include earlier "
            f"times; omit times before the end of the ramps by --start '{scene.built_up:.4g} s'"
        )
    if math.isfinite(scene.lower_joint_until):
        yield (
            f"statistics of lfj_angle end with the disconnect at {scene.lower_joint_until:.4g} s, because "
            "the riser's lower end is then free"
        )


def _of_outputs(scene: Resolved, missed: tuple[str, float]) -> Iterator[str]:
    """Reasons why outputs are too far apart for statistics.

    ``missed``: the history whose extremes differ most from those over all steps, and the share of its range.
    """
    from riserstudy.dataset.statistics import IN_A_PERIOD

    output, shortest = scene.analysis.output, scene.shortest_period
    if output and shortest and output.interval > shortest / IN_A_PERIOD * (1.0 + 1e-9):
        yield (
            f"outputs {output.interval:g} s apart miss peaks: extremes are too small, and periods too long; "
            f"run the scene with analysis.output.interval of at most {at_most(shortest / IN_A_PERIOD)} s"
        )
    elif output and missed[1] > MISSED:
        yield (
            f"outputs {output.interval:g} s apart miss peaks of {missed[0]}: its extremes differ by "
            f"{percent(missed[1])} of the range from the extremes over all time steps; run the scene with "
            f"analysis.output.interval of at most {at_most(0.5 * output.interval)} s"
        )
