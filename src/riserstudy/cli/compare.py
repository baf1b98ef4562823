"""A run compared with others' files: compare."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer

from riserstudy.cli.shared import AtOption, UnitsOption, place_of, wrote
from riserstudy.cli.targets import ForceOption, Writes, check_output
from riserstudy.dataset.unit_systems import UnitSystem, read_in, reading_in

COLUMNS = ("quantity", "rms", "of range", "largest", "at", "peak", "low", "lag", "rms in phase")


def compare(
    dataset: Annotated[Path, typer.Argument(help="dataset of a run or a study", metavar="FILE.nc")],
    other: Annotated[
        Path, typer.Argument(help="table of another program or a measurement", metavar="OTHER.csv")
    ],
    output: Annotated[
        Path,
        typer.Option("-o", "--output", help="figure (PNG, PDF or SVG)", metavar="OUT.png"),
        Writes("figure"),
    ],
    at: AtOption = None,
    force: ForceOption = False,
    units: UnitsOption = UnitSystem.FIELD,
) -> None:
    """Compare a run with a time series or values along the riser: differences, lag, and a figure.

    The first column of the table is `time (s)` or `s (m)`; the others name a variable, place and unit, such
    as `effective_tension at 300 m (kN)`.
    """
    from rich.console import Console
    from rich.table import Table

    from riserstudy.dataset.comparison import difference, pairs
    from riserstudy.dataset.diff import opened
    from riserstudy.dataset.place import place
    from riserstudy.figures import save
    from riserstudy.figures.comparison import MOST, comparison
    from riserstudy.figures.style import as_written

    of_run = opened(dataset)
    check_output(output, ("figure",), [dataset, other], force)
    run = of_run.isel(place(of_run, place_of(at)))
    found = pairs(run, other)
    table = Table(*COLUMNS)
    with reading_in(units), as_written():
        for pair in found:
            off, (scale, unit) = difference(pair), read_in(pair.unit)
            along = "s" if pair.axis == "time" else "m"
            table.add_row(
                f"{pair.heading.partition('(')[0].strip()} ({unit})",
                _number(scale * off.rms),
                "" if math.isnan(off.relative) else f"{_number(100.0 * off.relative)} %",
                _number(scale * off.largest),
                f"{off.at:.4g} {along}",
                *(_number(scale * value) for value in (off.peak, off.low)),
                "" if math.isnan(off.lag) else f"{round(off.lag, 4) + 0.0:.3g} s",
                _number(scale * off.rms_in_phase),
            )
        save(comparison(found, str(of_run.attrs.get("title", "a run")), other.name), output)
    console = Console(markup=False)
    if not console.is_terminal:
        console.width = 160  # a file has no width to wrap at
    console.print(table)
    print("differences: run less table; a lag is positive where the run is later")
    for pair in found:
        if pair.interpolated:
            print(f"{pair.heading}: the run is interpolated {pair.interpolated}")
    if len(found) > MOST:
        print(f"the figure shows the first {MOST} of {len(found)} columns")
    wrote(output)


def _number(value: float) -> str:
    if math.isnan(value):
        return ""
    return f"{value:.0f}" if 100.0 <= abs(value) < 1e6 else f"{value:.3g}"
