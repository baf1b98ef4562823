"""Years of sea: what a record holds, and the hours that limits leave."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from riserstudy.cli.shared import CsvOption, PlotOption, check_tables, quantity, show, wrote
from riserstudy.cli.targets import ForceOption, Writes, check_output
from riserstudy.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.seas.years import Band

RecordArgument = Annotated[
    Path, typer.Argument(help="record of sea states: CSV or netCDF", metavar="RECORD.csv")
]


def seas(
    record: Annotated[
        Path | None,
        typer.Argument(help="record of sea states: CSV or netCDF", metavar="RECORD.csv"),
    ] = None,
    synthetic: Annotated[
        int | None,
        typer.Option(min=1, max=100, help="make a record of so many years instead"),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="of the synthetic record")] = 1,
    gamma: Annotated[
        float,
        typer.Option(
            min=1.0, max=7.0, help="peakedness by which zero-crossing become peak periods"
        ),
    ] = 3.3,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="write the record here (netCDF)", metavar="OUT.nc"),
        Writes("dataset"),
    ] = None,
    force: ForceOption = False,
) -> None:
    """Read a record of sea states, say what it holds, and write it with labels.

    Gaps are named and never filled. A CSV file has a header such as ``time,hs (m),tp (s)``, times in UTC.
    """
    if (record is None) == (synthetic is None):
        raise InputError("RECORD", "", "none or two", "give a record, or --synthetic YEARS")
    if output is not None:
        check_output(output, ("dataset",), [record] if record else [], force)
    from riserstudy.seas.record import read_record, with_peak_period, write_record
    from riserstudy.seas.synthetic import synthetic as made

    found = made(synthetic or 1, seed) if record is None else read_record(record)
    found = with_peak_period(found, gamma)
    for line in described(found):
        print(line)
    if output is not None:
        write_record(found, output)
        wrote(output)


def downtime(
    record: RecordArgument,
    limit: Annotated[
        list[str],
        typer.Option(help="'hs <= 2.5 m'; may be repeated: all must be met", metavar="LIMIT"),
    ],
    window: Annotated[
        list[str] | None,
        typer.Option(help="length of work in one go: '24 h'; may be repeated", metavar="TIME"),
    ] = None,
    ahead: Annotated[int, typer.Option("--next", min=1, help="years to come")] = 10,
    hold_back: Annotated[
        int,
        typer.Option(min=0, help="last years to keep back, predicted from those before"),
    ] = 0,
    csv: CsvOption = None,
    plot: PlotOption = None,
    force: ForceOption = False,
) -> None:
    """Compute the hours of a record that limits on the sea leave, the windows, and the waits for them.

    With bands from whole years drawn with replacement. A window ends at a gap of the record; a wait that
    meets one counts as longer than that.
    """
    check_tables(csv, [record], force)
    if plot is not None:
        check_output(plot, ("figure",), [record], force, "--plot")
    from riserstudy.seas.hours import hours, sea_limit
    from riserstudy.seas.record import read_record

    limits = [sea_limit(one) for one in limit]
    lengths = [quantity("--window", one, "s") / 3600.0 for one in window or []]
    sea = read_record(record)
    if hold_back:
        held_back(sea, limits, hold_back)
    found = hours(sea, limits)
    print(f"{found.rows} rows of {found.interval:g} h; {found.lacking} more lack a value")
    print(f"workable: {found.share:.2%} of all; {banded(found.band)} of a mean year")
    print(f"next {ahead} years: {banded(found.next_years(ahead))}")
    for year in found.partial_years:
        print(f"{year.year}: {year.recorded:.0%} recorded, left out of these bands")
    for length in lengths:
        of = found.of_windows(length)
        print(
            f"{length:g} h: {of.number} windows with {of.inside:.2%} of the hours; "
            f"{of.starts:.2%} can start one"
        )
        print("  wait (h)   mean    50 %    90 %   open")
        for name, one in found.of_waits(length):
            p50, p90 = ("–" if math.isnan(p) else f"{p:.0f}" for p in (one.p50, one.p90))
            print(f"  {name:8} {one.mean:6.1f}  {p50:>6}  {p90:>6}  {one.open:5d}")
    show(found.by_month(), csv)
    if plot is not None:
        from riserstudy.figures import save
        from riserstudy.figures.calendar import calendar

        save(calendar(found.by_month(), f"{record.name}: hours with {' and '.join(limit)}"), plot)
        wrote(plot)


def described(record: xr.Dataset) -> list[str]:
    """What a record holds, in lines."""
    import numpy as np

    from riserstudy.seas.record import gaps

    time = record["time"].values
    holes = gaps(record)
    missing = sum((g.after - g.before) / np.timedelta64(1, "h") for g in holes)
    missing -= len(holes) * record.attrs["interval_hours"]
    span = (time[-1] - time[0]) / np.timedelta64(1, "h") + record.attrs["interval_hours"]
    first, last = (str(t.astype("datetime64[m]")).replace("T", " ") for t in (time[0], time[-1]))
    lines = [
        f"{first} to {last} UTC: {len(time)} rows, most {record.attrs['interval_hours']:g} h apart",
        f"gaps: {len(holes)}, {missing:.0f} h together, {missing / span:.1%} of the time",
    ]
    widest = sorted(holes, key=lambda g: g.before - g.after)[:3]
    for gap in widest:
        ends = (str(t.astype("datetime64[m]")).replace("T", " ") for t in gap)
        lines.append(
            f"  {(gap.after - gap.before) / np.timedelta64(1, 'h'):.0f} h: {' to '.join(ends)}"
        )
    if record.attrs["conversions"]:
        lines.append(f"converted: {record.attrs['conversions']}")
    lines.append(f"{'':28}    mean    99 %  largest  missing")
    for name, values in record.data_vars.items():
        known = values.values[np.isfinite(values.values)]
        numbers = (
            f"{known.mean():8.5g}{np.quantile(known, 0.99):8.5g}{known.max():9.5g}"
            if len(known)
            else f"{'':25}"
        )
        about = f"{name} ({values.attrs.get('units', '')})"
        lines.append(f"{about:28}{numbers}{len(values) - len(known):9d}")
        if "comment" in values.attrs:
            lines.append(f"  {values.attrs['comment']}")
    return lines


def held_back(sea: xr.Dataset, limits: list, count: int) -> None:  # type: ignore[type-arg]
    """Predict the last years from those before, and print what came."""
    import numpy as np

    from riserstudy.seas.hours import hours

    year = sea["time"].values.astype("datetime64[Y]").astype(int) + 1970
    first = int(year.max()) - count + 1
    before = sea.isel(time=np.flatnonzero(year < first))
    if before.sizes["time"] < 2:
        raise InputError("--hold-back", str(count), "nothing is left", "allowed are fewer years")
    known, came = (
        hours(sea.isel(time=np.flatnonzero(at)), limits) for at in (year < first, year >= first)
    )
    predicted = known.next_years(count)
    said = "inside" if predicted.low <= came.band.share <= predicted.high else "outside"
    print(
        f"kept back from {first} on: predicted {banded(predicted)}, came {came.band.share:.2%}: {said}"
    )


def banded(of: Band) -> str:
    """A share with its band."""
    if math.isnan(of.low):
        return f"{of.share:.2%} (of one year: no band)"
    return f"{of.share:.2%} ({of.low:.2%} to {of.high:.2%} in nine of ten)"
