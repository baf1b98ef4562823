"""Workable hours of a record of sea states, by limits on the sea and limits of a riser."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.cli.downtime_lines import (
    Ahead,
    banded,
    held_back,
    show_directions,
    show_hours,
    show_riser,
    waiting,
)
from riserstudy.cli.shared import (
    CsvOption,
    PlotOption,
    ReturnOption,
    SetOption,
    check_targets,
    compile_kernels,
    notify,
    positive,
    quantity,
    save_figure,
    scene_of,
    show,
    wrote,
)
from riserstudy.cli.targets import ForceOption, Writes
from riserstudy.dataset.unit_systems import UnitSystem
from riserstudy.errors import InputError
from riserstudy.records.words import counted
from riserstudy.study.persistence import LEAST_PERSISTENCE, MOST_AHEAD, MOST_PERSISTENCE, PERSISTENCE

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.table import Table
    from riserstudy.seas.directions import Directions
    from riserstudy.seas.hours import SeaLimit
    from riserstudy.seas.riser_downtime import Downtime


SEEDS, ERROR, MOST = 5, 0.05, 400  # default number of runs, tolerance, and number of sea states

RecordArgument = Annotated[
    Path, typer.Argument(help="record of sea states: CSV or netCDF", metavar="RECORD.csv")
]
SceneOption = Annotated[
    Path | None,
    typer.Option(
        help="scene of the riser whose limits apply; the scene must have an irregular sea and a duration",
        metavar="SCENE.yaml",
    ),
]
LimitOption = Annotated[
    list[str] | None,
    typer.Option(
        help="limit on the sea, such as 'hs <= 2.5 m'; may be repeated, and all must be met", metavar="LIMIT"
    ),
]
ResumeOption = Annotated[
    list[str] | None,
    typer.Option(
        help="further limit on the sea that must be met before operations resume after a stop, such as "
        "'hs <= 2 m'; may be repeated",
        metavar="LIMIT",
    ),
]
WindowOption = Annotated[
    list[str] | None,
    typer.Option(help="length of a weather window, such as '24 h'; may be repeated", metavar="TIME"),
]
NextOption = Annotated[
    int, typer.Option("--next", min=1, max=MOST_AHEAD, help="number of future years that are predicted")
]
PersistenceOption = Annotated[
    float,
    typer.Option(
        min=LEAST_PERSISTENCE,
        max=MOST_PERSISTENCE,
        help="Hurst exponent of the yearly workable hours: larger values mean that similar years follow each "
        "other; 0.5: independent years",
    ),
]
HoldBackOption = Annotated[
    int, typer.Option(min=0, help="number of last years to hold back and predict from the earlier years")
]
VaryOption = Annotated[
    list[str] | None,
    typer.Option(
        help="print only a table of workable hours, with one row per operating mode, for this value of "
        "the scene, such as platform.position.surge='5 m'; may be repeated",
        metavar="PATH=VALUE",
    ),
]
SectorsOption = Annotated[
    int | None,
    typer.Option(
        min=2,
        max=36,
        help="number of wave headings to simulate, evenly spaced over 360 deg; requires --x-towards",
    ),
]
XTowardsOption = Annotated[
    str | None,
    typer.Option(
        help="compass bearing of the x axis of the scene, such as '90 deg'; requires --sectors",
        metavar="ANGLE",
    ),
]
ByDirectionOption = Annotated[
    int | None,
    typer.Option(
        min=2,
        max=36,
        help="also print workable hours by the direction that waves come from, in this number of "
        "equal sectors",
    ),
]
SeedsOption = Annotated[
    int | None,
    typer.Option(min=1, help="number of runs of each sea state, with different random phases; default: 5"),
]
ErrorOption = Annotated[
    float | None,
    typer.Option(
        min=0.001,
        max=0.5,
        help="tolerance on the interpolated response, as a fraction of the allowable value, or of the "
        "response if the response is larger; default: 0.05",
    ),
]
MostOption = Annotated[
    int | None, typer.Option(min=20, help="largest number of sea states to simulate; default: 400")
]
CoresOption = Annotated[int | None, typer.Option(min=1, help="number of processes; default: number of cores")]
LimitUnitsOption = Annotated[
    UnitSystem | None,
    typer.Option(
        help="units of printed limits: SI (si), kN and MPa (field, the default), or feet and kips (us)"
    ),
]
ResponsesOption = Annotated[
    Path | None,
    typer.Option(
        "-o", "--output", help="also write the simulated responses to this file (netCDF)", metavar="OUT.nc"
    ),
    Writes("dataset"),
]


def downtime(
    record: RecordArgument,
    scene: SceneOption = None,
    limit: LimitOption = None,
    resume: ResumeOption = None,
    window: WindowOption = None,
    ahead: NextOption = 10,
    persistence: PersistenceOption = PERSISTENCE,
    hold_back: HoldBackOption = 0,
    settings: SetOption = None,
    vary: VaryOption = None,
    by_direction: ByDirectionOption = None,
    period: ReturnOption = None,
    sectors: SectorsOption = None,
    x_towards: XTowardsOption = None,
    seeds: SeedsOption = None,
    error: ErrorOption = None,
    most: MostOption = None,
    cores: CoresOption = None,
    output: ResponsesOption = None,
    csv: CsvOption = None,
    plot: PlotOption = None,
    units: LimitUnitsOption = None,
    force: ForceOption = False,
) -> None:
    """Compute workable hours of a record of sea states under limits, with weather windows and waiting times.

    For future years, ``downtime`` predicts a range of workable hours by Student's t-distribution, from
    the workable hours of each complete year of the record. The option --persistence sets how similar
    consecutive years are. A weather window is an uninterrupted period of workable hours; a gap in the
    record ends the window. If a gap is before the start of the next weather window, only a lower bound of the
    waiting time is known.

    With the option --resume, operations that have stopped wait until the limits of --resume are also met. At
    the start of the record and after a gap, operations are stopped.

    With the option --scene, an hour is workable only if the limits of the scene are also met. The command
    ``downtime`` simulates the riser in some sea states of the record, and interpolates the response of
    the riser between the simulated sea states. The command ``downtime`` adds simulated sea states until
    the error of the interpolation is within the tolerance --error. Finally, ``downtime`` checks the
    interpolation by simulations of further sea states.
    """
    from riserstudy.seas.directions import FROM, check_directions
    from riserstudy.seas.hours import check_resumes, idle_limits, sea_limit
    from riserstudy.seas.record import check_windows

    check_targets([path for path in (record, scene) if path], force, csv, plot, output)
    with_scene = {
        "-o": output, "--sectors": sectors, "--x-towards": x_towards, "--vary": vary,
        "--return-period": period, "--set": settings, "--seeds": seeds,
        "--error": error, "--most": most, "--cores": cores, "--units": units and units.value,
    }  # fmt: skip
    refuse(scene, limit, with_scene, {"--hold-back": hold_back})
    if vary and (output or plot or period or window or by_direction):
        allowed = "omit the other option (--csv is possible)"
        others = "--output, --plot, --return-period, --window or --by-direction"
        raise InputError("downtime", "--vary", f"{vary[0]!r} cannot be combined with {others}", allowed)
    if vary and units:
        raise InputError("downtime", "--units", "has no effect on the table of --vary", "omit --units")
    limits = [sea_limit(text) for text in limit or []]
    resumes = [sea_limit(text, "--resume") for text in resume or []]
    check_resumes(limits, resumes)
    lengths = [positive("--window", one, "s") / 3600.0 for one in window or []]
    sea, years = _read(record), Ahead(ahead, persistence)
    check_windows(sea, window or [])
    if by_direction:
        check_directions(sea, "downtime", "--by-direction", f"add a column {FROM}, or omit the option")
    for text in idle_limits(sea, [*limits, *resumes]):
        notify(f"warning: {text}")
    if not scene:
        of_the_sea(sea, limits, resumes, lengths, years, hold_back, by_direction, csv, plot, record.name)
        return
    directions = _directions(sectors, x_towards)

    def simulated(file: Any) -> Downtime:
        from riserstudy.seas.riser_downtime import riser_downtime
        from riserstudy.simulation.compile import available_cores

        compile_kernels(file.resolved())
        return riser_downtime(
            file, sea, limits, resumes=resumes, directions=directions,
            seeds=seeds or SEEDS, error=error or ERROR, most=most or MOST,
            cores=cores or available_cores(), notify=notify,
        )  # fmt: skip

    if vary:
        return show(varied(scene, settings or [], vary, simulated, years), csv)
    made = simulated(scene_of(scene, settings))
    show_riser(made, lengths, years, csv, units or UnitSystem.FIELD)
    for mode in made.hours.modes:
        show_directions(mode.hours, sea, by_direction, f"{mode.mode}: ")
    if period:
        _show_returns(made, period, units or UnitSystem.FIELD)
    _write(made, output, plot)


def _read(record: Path) -> xr.Dataset:
    """A record of seas; conversions are printed."""
    from riserstudy.seas.record import read_record

    sea = read_record(record)
    if sea.attrs["conversions"]:
        print(f"converted: {sea.attrs['conversions']}")
    return sea


def _show_returns(made: Downtime, period: list[int], units: UnitSystem) -> None:
    """Print the return values of responses for some return periods (years)."""
    from riserstudy.dataset.tables import in_units
    from riserstudy.seas.riser_returns import returned, table_of

    print("responses that are exceeded in a year with a probability of 1 / return period:")
    show(in_units(table_of(returned(made.demands, period)), units), None)


def _write(made: Downtime, output: Path | None, plot: Path | None) -> None:
    """Write the responses of a riser and the figure of governing limits, if requested."""
    if output is not None:
        from riserstudy.dataset.netcdf import write_netcdf

        write_netcdf(made.responses, output, {})
        wrote(output)
    if plot is not None:
        from riserstudy.figures.governing import governing

        first = made.hours.modes[0]
        save_figure(governing(made.responses, first.mode, first.hours.share), plot)


def refuse(
    scene: Path | None, limit: list[str] | None, with_scene: dict[str, Any], without: dict[str, Any]
) -> None:
    """Refuse options that do not fit: some require a scene, others exclude one."""
    if not (scene or limit):
        raise InputError("downtime", "--limit", "missing", "give limits on the sea, or --scene")
    for options, fits, allowed in (
        (with_scene, scene is not None, "omit the option, or give --scene"),
        (without, scene is None, "omit the option, or omit --scene"),
    ):
        for name, value in options.items():
            if value and not fits:
                found = ", ".join(map(str, value)) if isinstance(value, list) else str(value)
                used = "with limits on the sea" if scene is None else "with --scene"
                raise InputError("downtime", name, f"{found} has no effect {used}", allowed)


def of_the_sea(
    sea: xr.Dataset,
    limits: list[SeaLimit],
    resumes: list[SeaLimit],
    lengths: list[float],
    ahead: Ahead,
    hold_back: int,
    by_direction: int | None,
    csv: Path | None,
    plot: Path | None,
    name: str,
) -> None:
    """Print workable hours by limits on the sea."""
    from riserstudy.seas.hours import hours

    if hold_back:
        held_back(sea, limits, resumes, Ahead(hold_back, ahead.persistence))
    found = hours(sea, limits, resumes)
    lacking = counted(found.lacking, "further row")
    print(f"{counted(found.rows, 'row')} of {found.interval:g} h; {lacking} without a value")
    for one in limits:
        if calm := int(one.calm(sea).sum()):
            print(f"{counted(calm, 'row')} without waves or a {one.quantity.long_name} meet the limit")
    for line in [*map(str, found.lost), *waiting(found), *found.notes]:
        print(line)
    mean = banded(found.mean_year(ahead.persistence))
    print(f"workable: {found.share:.2%} of all rows; {mean} in a mean year")
    show_hours(found, lengths, ahead)
    show(found.by_month(), csv)
    show_directions(found, sea, by_direction)
    if plot is not None:
        from riserstudy.figures.calendar import calendar

        title = f"{name}: hours with {' and '.join(map(str, limits))}"
        if resumes:
            title += f", resumed with {' and '.join(map(str, resumes))}"
        save_figure(calendar(found.by_month(), title), plot)


def varied(
    scene: Path, settings: list[str], vary: list[str], simulated: Callable[[Any], Downtime], ahead: Ahead
) -> Table:
    """Print workable hours by mode for several settings, to show the gain of each."""
    from riserstudy.dataset.table import Cell, Table

    files = [(one, scene_of(scene, [*settings, one])) for one in vary]  # checks all of them first
    rows: list[list[Cell]] = []
    for setting, file in files:
        notify(setting)
        made = simulated(file)
        for line in made.lines:
            notify(line)
        rows += [
            [setting, one.mode, 100.0 * one.hours.share, 100.0 * one.low, 100.0 * one.high,
             8766.0 * one.hours.share,
             *("" if math.isnan(end) else 8766.0 * end
               for end in one.hours.next_years(*ahead)[1:])]
            for one in made.hours.modes
        ]  # fmt: skip
    heads = ["setting", "mode", "workable", "at worst", "at best", "hours a year"]
    return Table(
        [*heads, f"next {counted(ahead.years, 'year')} from", "to"], ["", "", *["%"] * 3, *["h"] * 3], rows
    )


def _directions(sectors: int | None, x_towards: str | None) -> Directions | None:
    """Conversion of directions to headings; None if they are not used."""
    from riserstudy.seas.directions import Directions

    if (sectors is None) != (x_towards is None):
        allowed = "give both --sectors and --x-towards, or neither"
        raise InputError("downtime", "--sectors", "only one of --sectors and --x-towards is given", allowed)
    if sectors is None or x_towards is None:
        return None
    return Directions(sectors, quantity("--x-towards", x_towards, "rad"))
