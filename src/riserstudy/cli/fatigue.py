"""Fatigue over years: damage in a study's sea states, weighted by their occurrence."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.cli.shared import (
    AtOption,
    CsvOption,
    PlotOption,
    check_targets,
    place_of,
    save_figure,
    show,
    write_table,
)
from riserstudy.cli.targets import ForceOption, Writes, check_output
from riserstudy.errors import InputError
from riserstudy.records.numerals import percent
from riserstudy.records.words import counted

if TYPE_CHECKING:
    from riserstudy.fatigue.years import Years


StudyArgument = Annotated[
    Path,
    typer.Argument(
        help="dataset of a study or of a run that contains damage_rate, the damage per year",
        metavar="STUDY.nc",
    ),
]
ScatterOption = Annotated[
    Path | None,
    typer.Option(
        help="scatter table (share of time of each sea state), with columns hs (m),tp (s),share (%)",
        metavar="TABLE.csv",
    ),
]
SeasOption = Annotated[
    Path | None, typer.Option(help="record of sea states, instead of a scatter table", metavar="RECORD")
]
GammaOption = Annotated[
    float | None,
    typer.Option(
        min=1.0,
        max=7.0,
        help="peak enhancement (JONSWAP gamma) with which zero-crossing periods of a record are converted to "
        "peak periods; default: the value of the study",
    ),
]
CalmOption = Annotated[
    bool,
    typer.Option(
        "--calm",
        help="treat wave heights and periods below the simulated range as the lowest simulated value",
    ),
]
WithoutOption = Annotated[
    Path | None,
    typer.Option(
        help="dataset of the same study without vortex-induced vibration, to compute the share of the damage "
        "that the vibration causes",
        metavar="STUDY.nc",
    ),
]
AlongOption = Annotated[
    Path | None,
    typer.Option(help="also write the damage along the riser to this CSV file", metavar="OUT.csv"),
    Writes("table"),
]
BySeaOption = Annotated[
    Path | None,
    typer.Option(help="also write the damage by sea state to this CSV file", metavar="OUT.csv"),
    Writes("table"),
]


def fatigue(
    study: StudyArgument,
    scatter: ScatterOption = None,
    seas: SeasOption = None,
    gamma: GammaOption = None,
    calm: CalmOption = False,
    at: AtOption = None,
    without: WithoutOption = None,
    csv: CsvOption = None,
    along: AlongOption = None,
    by_sea: BySeaOption = None,
    plot: PlotOption = None,
    force: ForceOption = False,
) -> None:
    """Compute fatigue damage per year and fatigue life from a study of sea states and their occurrence.

    For each fatigue detail, the table gives the place with the largest damage, and the damage at this
    place without and with the safety factor. A second table lists the sea states that cause half of the
    damage of the governing detail, which has the largest damage with its safety factor. The command
    ``fatigue`` refuses sea states outside the simulated range.
    """
    reads = [path for path in (study, scatter, seas, without) if path]
    check_targets(reads, force, csv, plot)
    for path, option in ((along, "--along"), (by_sea, "--by-sea")):
        if path is not None:
            check_output(path, ("table",), reads, force, option)
    _check_apart({"--csv": csv, "--along": along, "--by-sea": by_sea})
    if scatter and seas:
        raise InputError("--seas", str(seas), "--scatter is also given", "give either --scatter or --seas")
    if gamma and not seas:
        found = f"{gamma:g} has no effect without --seas"
        raise InputError("fatigue", "--gamma", found, "add --seas, or omit --gamma")
    from riserstudy.fatigue import tables

    years = _summed(study, scatter, seas, gamma, at, calm)
    for line in years.notes:
        print(line)
    _print_error(years)
    show(tables.of_details(years), csv)
    if years.axes:
        print(f"half of the damage of {years.worst[years.governing].detail}:")
        for line in _in_columns(tables.by_sea(years, all_of_them=False)):
            print(line)
    if years.by_vibration > 0.0:
        print(
            f"sea states simulated with vortex-induced vibration cause {100 * years.by_vibration:.3g} % "
            "of the damage"
        )
    if without is not None:
        _print_comparison(years, _summed(without, scatter, seas, gamma, at, calm))
    for path, table in ((along, tables.along(years)), (by_sea, tables.by_sea(years))):
        write_table(table, path)
    if plot is not None:
        from riserstudy.figures.fatigue import fatigue as drawn

        save_figure(drawn(years), plot)


def _print_error(years: Years) -> None:
    """Print the estimated error of the runs, and for how many sea states it is known."""
    if math.isnan(years.error_runs):
        print("estimated error of damage in runs: unknown, no run that causes damage has an estimate")
        return
    known = sum(math.isfinite(sea.error) for sea in years.seas)
    print(
        f"estimated error of damage in runs: {percent(years.error_runs)}, runs weighted by "
        f"their damage; known for {known} of {counted(len(years.seas), 'sea state')}"
    )


def _check_apart(tables: dict[str, Path | None]) -> None:
    """Refuse two tables of one name, of which the second would replace the first."""
    named: dict[Path, str] = {}
    for option, path in tables.items():
        if path is None:
            continue
        if other := named.get(path.resolve()):
            raise InputError(option, str(path), f"{other} also writes to this file", "name another file")
        named[path.resolve()] = option


def _summed(
    path: Path, scatter: Path | None, seas: Path | None, gamma: float | None, at: list[str] | None, calm: bool
) -> Years:
    import numpy as np

    from riserstudy.dataset.open import open_dataset
    from riserstudy.fatigue.occurrence import Occurrence, of_record, of_table
    from riserstudy.fatigue.years import axes_of, gamma_of, over_years

    dataset = open_dataset(path)
    axes = axes_of(dataset)
    if scatter:
        occurs = of_table(scatter, dataset, axes)
    elif seas:
        from riserstudy.cli.seas import USUAL_GAMMA, check_gamma
        from riserstudy.seas.record import read_record, with_peak_period
        from riserstudy.seas.sea_states import with_calm_periods

        record = read_record(seas)
        check_gamma("fatigue", gamma, record)
        record = with_peak_period(record, gamma or gamma_of(dataset, place_of(at)) or USUAL_GAMMA)
        occurs = of_record(with_calm_periods(record), dataset, axes)
    elif axes:
        raise InputError(
            "--scatter",
            "",
            "the scatter table of a study is missing",
            "give a scatter table, or --seas RECORD",
        )
    else:
        occurs = Occurrence({}, np.ones(1), ("the sea state of the run, all year",))
    return over_years(dataset, occurs, place_of(at), calm)


def _in_columns(table: Any) -> list[str]:
    from riserstudy.dataset.tables import in_columns

    return [f"  {line}" for line in in_columns(table)]


def _print_comparison(years: Years, without: Years) -> None:
    """Print the share of vortex-induced vibration in each detail's damage."""
    from riserstudy.fatigue.vibration_share import shares

    for one in shares(years, without):
        print(
            f"vortex-induced vibration causes {100 * one.share:.3g} % of the damage of {one.of.detail}: "
            f"{one.of.rate:.3g} per year with vibration and {one.without:.3g} without, at s = "
            f"{one.of.s:.4g} m (largest damage without vibration: {one.largest_without:.3g})"
        )
