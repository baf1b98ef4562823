"""Comparison of a run with files of others: compare."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from riserstudy.cli.shared import AtOption, DatasetArgument, FigureOutput, UnitsOption, pairs, place_of, wrote
from riserstudy.cli.targets import ForceOption, check_output
from riserstudy.dataset.unit_systems import Reading, UnitSystem, read_in, reading_in

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.comparison import Difference, Pair
    from riserstudy.scene.resolve import Resolved

COLUMNS = ("quantity", "rms", "of range", "largest", "at", "peak", "low", "lag", "rms in phase")


ColumnOption = Annotated[
    list[str] | None,
    typer.Option(
        "--column",
        help="quantity in a column of OTHER.csv, such as 'Line 1 Te=effective_tension at 300 m (kN)'; "
        "may be repeated",
        metavar="NAME=HEADING",
    ),
]
EndAOption = Annotated[
    str | None,
    typer.Option(
        help="place of end A, where the arc length of OrcaFlex is 0: top, bottom, or, if the line is a part "
        "of the riser, a place such as '872 m down' (872 m above the riser's lower end, arc length increases "
        "downwards)",
        metavar="PLACE",
    ),
]


def compare(
    dataset: DatasetArgument,
    other: Annotated[
        Path, typer.Argument(help="file of another program or a measurement", metavar="OTHER.csv")
    ],
    output: FigureOutput,
    column: ColumnOption = None,
    end_a: EndAOption = None,
    at: AtOption = None,
    force: ForceOption = False,
    units: UnitsOption = UnitSystem.FIELD,
) -> None:
    """Compare a run with results of another program or a measurement: differences, time lag, and a figure.

    The first column of the table OTHER.csv is `time (s)`, or the arclength `s (m)` from the riser's lower
    end. The headings of the other columns name a variable, the place along the riser and the unit, such
    as `effective_tension at 300 m (kN)`. Commas, semicolons or tabs separate the cells. The command
    ``compare`` converts a column `wall_tension` to effective tension with the pressures inside and
    outside the pipe, computed from the scene. The command ``compare`` also reads time histories and range
    graphs of OrcaFlex, such as `Effective tension (kN)` over `Arc length (m)`. With the package `qats`
    (`pip install "riserstudy[formats]"`), ``compare`` reads time series of SIMA, RIFLEX, Matlab and
    others. For each time series that is read with `qats`, --column must define the quantity, the place
    and the unit.
    """
    from riserstudy.dataset.comparison import compared, difference
    from riserstudy.dataset.open import open_dataset
    from riserstudy.dataset.place import complete, place
    from riserstudy.figures import save
    from riserstudy.figures.comparison import MOST, comparison
    from riserstudy.figures.style import as_written

    of_run = open_dataset(dataset)
    check_output(output, ("figure",), [dataset, other], force)
    index = place(of_run, place_of(at))
    found, notes = compared(
        complete(of_run.isel(index)), other, scene=_scene(of_run, index), called=_called(column), end_a=end_a
    )
    with reading_in(units), as_written():
        _print([(pair, difference(pair)) for pair in found])
        save(comparison(found, str(of_run.attrs.get("title", "a run")), other.name), output)
    print(
        "differences: run minus table; the lag is positive if the run is later, and is sought within a "
        "quarter of the record"
    )
    for note in notes:
        print(f"{other.name}: {note}")
    for pair in found:
        for note in pair.notes:
            print(f"{pair.title}: {note}")
    if len(found) > MOST:
        print(f"the figure shows the first {MOST} of {len(found)} columns")
    wrote(output)


def _called(settings: list[str] | None) -> dict[str, str]:
    """Headings in the terms of a run, by names of columns in the file."""
    example = "'Line 1 Te=effective_tension at 300 m (kN)'"
    return pairs("--column", settings, "NAME=HEADING", example, last=True)


def _scene(of_run: xr.Dataset, index: dict[str, int]) -> Resolved | None:
    """The scene of the point; None if the dataset has no scene."""
    from riserstudy.dataset.provenance import scene_of_point

    if not {"provenance", "scene"} & of_run.attrs.keys():
        return None
    return scene_of_point(of_run, index)


def _print(found: list[tuple[Pair, Difference]]) -> None:
    """Print differences as a table, in the reader's units."""
    from rich.console import Console
    from rich.table import Table

    table = Table(*COLUMNS)
    for pair, off in found:
        scale, unit = read_in(pair.unit)
        along = Reading(1.0, "s") if pair.axis == "time" else read_in("m")
        table.add_row(
            f"{pair.name} ({unit})",
            _number(scale * off.rms),
            "" if math.isnan(off.relative) else f"{_number(100.0 * off.relative)} %",
            _number(scale * off.largest),
            f"{along.factor * off.at:.4g} {along.unit}",
            *(_number(scale * value) for value in (off.peak, off.low)),
            "" if math.isnan(off.lag) else f"{round(off.lag, 4) + 0.0:.3g} s",
            _number(scale * off.rms_in_phase),
        )
    console = Console(markup=False)
    if not console.is_terminal:
        console.width = 160  # a file has no width for wrapping
    console.print(table)


def _number(value: float) -> str:
    if math.isnan(value):
        return ""
    return f"{value:.0f}" if 100.0 <= abs(value) < 1e6 else f"{value:.3g}"
