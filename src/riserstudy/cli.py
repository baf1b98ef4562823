"""The commands of ``riserstudy``, thin: each calls what it is named for."""

from __future__ import annotations

import atexit
import gc
import json
import re
import sys
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from riserstudy.errors import InputError, RiserStudyError, shown

app = typer.Typer(
    name="riserstudy",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Simulate deepwater drilling risers, and look at what was simulated.",
)

SceneArgument = Annotated[Path, typer.Argument(help="scene file (YAML)", metavar="SCENE.yaml")]
WORTH_TELLING = 10.0  # seconds of a run, from which on it is announced
OBJECTS = (50_000, 20, 100)  # made, after which those are collected that nothing refers to
SAME_AS_STORED = 1e-9  # relative, of what is stored to ten digits

SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", help="set a value: platform.heave.amplitude='3 m'", metavar="PATH=VALUE"),
]

AtOption = Annotated[
    list[str] | None,
    typer.Option("--at", help="which point: heave_amplitude=5", metavar="AXIS=VALUE"),
]


def main() -> None:
    """Run the command line; errors go to stderr in one line, with their exit code."""
    _collect_seldom()
    try:
        if status := app(standalone_mode=False):  # of a command that ends with one
            sys.exit(status)
    except typer.Exit as done:
        sys.exit(done.exit_code)
    except (typer.Abort, KeyboardInterrupt):
        sys.exit(130)
    except RiserStudyError as error:
        print(f"riserstudy: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
    except Exception as error:
        if hasattr(error, "format_message"):  # a usage error of the command line itself
            print(f"riserstudy: command line: {shown(error.format_message())}", file=sys.stderr)
            sys.exit(2)
        raise


def _collect_seldom() -> None:
    """Have what is loaded looked through seldom, and not once more at the end: that takes half a second."""
    gc.set_threshold(*OBJECTS)
    atexit.register(gc.freeze)


def _scene(path: Path, settings: list[str] | None, accuracy: str | None = None) -> Any:
    from riserstudy.scene.load import plain_yaml, read_scene
    from riserstudy.simulation.simulate import at_accuracy

    overrides: dict[str, Any] = {}
    for setting in settings or []:
        name, equals, text = setting.partition("=")
        if not equals or not name.strip():
            raise InputError(
                "--set", setting, "no PATH=VALUE", "allowed is platform.heave.amplitude='3 m'"
            )
        overrides[name.strip()] = plain_yaml(text, f"--set {name.strip()}")
    file = read_scene(path).with_values(overrides, "--set")
    if accuracy is not None:
        file = at_accuracy(file, accuracy)
    file.scene()
    return file


def _compile_once() -> None:
    """What every command does that simulates."""
    from riserstudy.simulation.compile import compile_once

    compile_once(lambda said: print(f"riserstudy: {said}", file=sys.stderr))
    _plain_xarray()


def _plain_xarray() -> None:
    """Let xarray, which looks for kinds of arrays once, find no others than numpy's: no command has any."""
    from riserstudy.dataset.without import without

    with without("dask", "pint"):
        import xarray

        xarray.Dataset(coords={"s": [0.0]})


def _check_writable(output: Path, scene: Path) -> None:
    """Refuse what would not be made, or would take the place of a device, a link or the scene."""
    import os

    try:
        folder = output.resolve().parent
        taken = output.is_symlink() or (output.exists() and not output.is_file())
        if taken or not folder.is_dir() or not os.access(folder, os.W_OK):
            allowed = "allowed is a file in a folder that exists"
            raise InputError("--output", str(output), "cannot be written", allowed)
        if output.exists() and output.samefile(scene):
            raise InputError("--output", str(output), "the file that is read", "name another file")
    except (OSError, ValueError) as error:  # names too long, loops of links, no name at all
        reason = getattr(error, "strerror", None) or "no file name"
        raise InputError("--output", str(output), reason, "allowed is another file") from None


@app.command()
def run(
    scene: SceneArgument,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="dataset to write (netCDF)", metavar="OUT.nc")
    ],
    settings: SetOption = None,
    accuracy: Annotated[
        str | None,
        typer.Option(help="choose mesh and step for this error, such as 1%", metavar="PERCENT"),
    ] = None,
    patience: Annotated[
        str | None,
        typer.Option(help="take the best result after so long: 30, '10 min'", metavar="SECONDS"),
    ] = None,
) -> None:
    """Simulate a scene and write its dataset.

    Where patience ends before the accuracy is reached, the best result so far is written, with its
    estimate and a warning, and the exit status is 0; where no run ends in time, nothing is, and it is 3.
    """
    from riserstudy.simulation.simulate import seconds

    seconds(patience)
    file = _scene(scene, settings, accuracy)
    _check_writable(output, scene)
    _compile_once()
    from riserstudy.simulation.simulate import simulate
    from riserstudy.study.collect import write_dataset

    if output.suffix not in (".nc", ".csv"):
        allowed = "allowed are .nc (netCDF) and .csv (time series, or the state at rest's extremes)"
        raise InputError("--output", str(output), f"no dataset {output.suffix!r}", allowed)
    if patience is None:
        _forecast(file)
    dataset = simulate(file, patience=patience)
    if output.suffix == ".csv":
        from riserstudy.dataset import tables

        kind = "time-series" if "time" in dataset else "extremes"
        tables.write_csv(tables.table_of(kind, None, dataset), output)
    else:
        write_dataset(dataset, output)
    _say_warnings(dataset)
    print(_summary(dataset))
    for line in _limits(dataset):
        print(line)


def _forecast(file: Any) -> None:
    """Say before a long run what it will take."""
    from riserstudy.simulation.forecast import forecast

    price = forecast(file.scene())
    if price and price.seconds > WORTH_TELLING:
        minutes = f"{price.seconds / 60.0:.2g} min" if price.seconds > 90.0 else ""
        print(
            f"riserstudy: takes about {minutes or f'{price.seconds:.2g} s'}: by its first "
            f"{price.piece:.4g} s, {price.elements} segments and a step of {price.step:.3g} s will do",
            file=sys.stderr,
            flush=True,
        )


def _say_warnings(dataset: Any) -> None:
    for warning in json.loads(dataset.attrs["warnings"]):
        print(f"riserstudy: warning: {warning}", file=sys.stderr)


def _limits(dataset: Any) -> list[str]:
    """A line a limit of the scene."""
    from riserstudy.dataset.tables import as_lines

    return as_lines(json.loads(dataset.attrs.get("limits", "[]")))


@app.command()
def check(
    scene: SceneArgument,
    settings: SetOption = None,
    accuracy: Annotated[
        str | None,
        typer.Option(help="choose mesh and step for this error, such as 1%", metavar="PERCENT"),
    ] = None,
) -> None:
    """Hold a scene against its limits: demand, allowable, use, where and when.

    Exit status 1 where one is exceeded, else 4 where one could not be evaluated.
    """
    file = _scene(scene, settings, accuracy)
    if "limits" not in file.tree:
        allowed = "allowed is a list such as {output: lfj_angle, largest: 4 deg, mode: drilling}"
        raise InputError(file.source, "limits", "missing", allowed)
    _compile_once()
    from riserstudy.dataset.limits import EXCEEDED, UNKNOWN
    from riserstudy.simulation.simulate import simulate

    _forecast(file)
    dataset = simulate(file)
    _say_warnings(dataset)
    for line in _limits(dataset):
        print(line)
    verdicts = {row["verdict"] for row in json.loads(dataset.attrs["limits"])}
    if verdicts & {EXCEEDED, UNKNOWN}:
        raise typer.Exit(1 if EXCEEDED in verdicts else 4)


def _place(at: list[str] | None) -> dict[str, str]:
    """Values by axis, as text."""
    given = [one.partition("=") for one in at or []]
    if bad := [name for name, equals, _ in given if not equals]:
        raise InputError("--at", bad[0], "no AXIS=VALUE", "allowed is heave_amplitude=5")
    return {name.strip(): value.strip() for name, _, value in given}


class PlotKind(StrEnum):
    """Plots of a run."""

    RANGE = "range"
    TIME_SERIES = "time-series"
    SHAPE = "shape"


@app.command()
def plot(
    dataset: Annotated[Path, typer.Argument(help="dataset of a run or a study", metavar="FILE.nc")],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="figure (PNG, PDF or SVG)", metavar="OUT.png")
    ],
    kind: Annotated[PlotKind, typer.Option(help="which plot")] = PlotKind.RANGE,
    of: Annotated[
        list[str] | None,
        typer.Option(help="quantity to show: bending_moment; again for more", metavar="NAME"),
    ] = None,
    at: AtOption = None,
) -> None:
    """Draw one run: ranges along the riser with its limits, time series, or its shape."""
    from riserstudy.dataset.diff import opened
    from riserstudy.dataset.place import place
    from riserstudy.figures import save
    from riserstudy.figures.run import draw

    of_run = opened(dataset)
    _check_writable(output, dataset)
    if output.suffix not in (".png", ".pdf", ".svg"):
        allowed = "allowed are .png, .pdf and .svg"
        raise InputError("--output", str(output), f"no figure {output.suffix!r}", allowed)
    save(draw(kind.value, of_run.isel(place(of_run, _place(at))), of), output)


class TableKind(StrEnum):
    """Tables of a run."""

    STACK_UP = "stack-up"
    EXTREMES = "extremes"
    TIME_SERIES = "time-series"
    LIMITS = "limits"


@app.command()
def table(
    source: Annotated[
        Path, typer.Argument(help="scene (YAML), or the dataset of its run", metavar="SCENE.yaml")
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="table to write", metavar="OUT.csv")
    ],
    kind: Annotated[TableKind, typer.Option(help="which table")] = TableKind.EXTREMES,
    settings: SetOption = None,
) -> None:
    """Write a table as CSV: stack-up, extremes, time series, or limits with their use.

    A scene is simulated for all but the stack-up; a dataset (OUT.nc) is read.
    """
    from riserstudy.dataset import tables

    stored = source.suffix == ".nc"
    if stored and settings:
        raise InputError("--set", settings[0], "a dataset was simulated", "allowed with a scene")
    file = None if stored else _scene(source, settings)
    _check_writable(output, source)
    if output.suffix != ".csv":
        found = f"no table {output.suffix!r}"
        raise InputError("--output", str(output), found, "allowed is .csv")
    if file is None:
        made = _table_of_run(kind.value, source)
    elif kind is TableKind.STACK_UP:
        made = tables.table_of(kind.value, file.scene(), None)
    else:
        from riserstudy.simulation.simulate import simulate

        _compile_once()
        dataset = simulate(file)
        _say_warnings(dataset)
        made = tables.table_of(kind.value, None, dataset)
    tables.write_csv(made, output)


def _table_of_run(kind: str, source: Path) -> Any:
    """A table from the dataset of one run."""
    from riserstudy.dataset import tables
    from riserstudy.dataset.behind import scene_behind
    from riserstudy.dataset.diff import opened

    dataset = opened(source)
    if "point_key" in dataset:
        allowed = "allowed is the dataset of one run; `riserstudy results` lists points of studies"
        raise InputError(source, "", "a study", allowed)
    return tables.table_of(kind, scene_behind(dataset, {}), dataset)


@app.command()
def statistics(
    dataset: Annotated[Path, typer.Argument(help="dataset of a run or a study", metavar="FILE.nc")],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="table to write", metavar="OUT.csv")
    ],
    start: Annotated[
        str, typer.Option(help="leave out what is before: 200 s", metavar="TIME")
    ] = "0 s",
    exposure: Annotated[
        str | None,
        typer.Option(help="time for which extremes are told: 3 h; absent: the record's"),
    ] = None,
    over: Annotated[
        str | None, typer.Option(help="axis of seeds: extremes by Gumbel", metavar="AXIS")
    ] = None,
    at: AtOption = None,
) -> None:
    """Statistics in an irregular sea as CSV: mean, deviation, most probable extremes; Gumbel over seeds."""
    from riserstudy.dataset import statistics_tables, tables
    from riserstudy.dataset.diff import opened
    from riserstudy.dataset.place import place
    from riserstudy.scene.units import to_si

    of_run = opened(dataset)
    _check_writable(output, dataset)
    if output.suffix != ".csv":
        raise InputError("--output", str(output), f"no table {output.suffix!r}", "allowed is .csv")
    if over and exposure:
        allowed = "over seeds extremes are those of the duration: leave it out"
        raise InputError("--exposure", exposure, "given with --over", allowed)
    times = {}
    for option, text in (("--start", start), ("--exposure", exposure)):
        try:
            times[option] = None if text is None else to_si(text, "s")
        except ValueError as fault:
            raise InputError(option, str(text), str(fault), "allowed is such as 3 h") from None
    begin = times["--start"] or 0.0
    if over:
        apart = of_run.isel({over: [0]}) if over in of_run.dims else of_run
        index = {axis: k for axis, k in place(apart, _place(at)).items() if axis != over}
        made = statistics_tables.over_seeds(of_run.isel(index), over, begin)
    else:
        run = of_run.isel(place(of_run, _place(at)))
        made = statistics_tables.of_a_run(run, begin, times["--exposure"])
    tables.write_csv(made, output)


def _summary(dataset: Any) -> str:
    estimate = json.loads(dataset.attrs.get("error_estimate", "{}"))
    errors = ", ".join(f"{name} {100 * value:.2g} %" for name, value in estimate.items())
    step = f", step {dataset.attrs['step']:.4g} s" if "step" in dataset.attrs else ""
    return (
        f"{dataset.attrs['elements']} segments{step}; estimated error: {errors or 'none given'}; "
        f"{dataset.attrs['wall_seconds']:.3g} s"
    )


@app.command()
def rerun(
    dataset: Annotated[Path, typer.Argument(help="dataset of a study or a run", metavar="FILE.nc")],
    at: AtOption = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="write all of the run", metavar="OUT.nc"),
    ] = None,
) -> None:
    """Run a point of a dataset anew, from what the dataset says of itself alone, and compare.

    ``-o`` writes all of the run, with what its study does not keep. Exit status 1 where a variable changed by
    more than 1e-9 of its largest magnitude; ten digits are stored.
    """
    from riserstudy.dataset.diff import opened

    place = _place(at)
    old = opened(dataset)
    if output is not None:
        _check_writable(output, dataset)
    _compile_once()
    from riserstudy.study.collect import write_dataset
    from riserstudy.study.rerun import rerun as run_anew

    outcome = run_anew(old, place)
    for name, change in sorted(outcome.changes.items(), key=lambda item: -item[1]):
        print(f"{change:9.2g}  {name}")
    if output is not None:
        write_dataset(outcome.run, output)
    changed = sum(change > SAME_AS_STORED for change in outcome.changes.values())
    where = ", ".join(f"{axis}={value}" for axis, value in outcome.place.items())
    print(f"{changed} of {len(outcome.changes)} variables changed{' at ' if where else ''}{where}")
    if outcome.engines[0] != outcome.engines[1]:
        print(f"made by engine {outcome.engines[0]}, run anew by {outcome.engines[1]}")
    if changed:
        raise typer.Exit(1)


@app.command()
def cost(
    scene: SceneArgument,
    settings: SetOption = None,
    plot: Annotated[
        Path | None, typer.Option(help="also draw it (PNG or PDF)", metavar="FILE.png")
    ] = None,
) -> None:
    """Say what 5, 1, 0.2 and 0.05 % of error cost for a scene, before a grid of it is launched."""
    file = _scene(scene, settings)
    if plot is not None:
        _check_writable(plot, scene)
    _compile_once()
    from riserstudy.numerics import accuracy_cost as requests

    prices: list[requests.Price] = []
    for price in requests.prices(file):
        if not prices:  # a scene that is refused has no table
            print("asked for  estimated  segments      step   time")
        prices.append(price)
        step = f"{price.step:7.3g} s" if price.step else "   none  "
        shares = f"{100 * price.requested:7.3g} %  {100 * price.estimated:7.2g} %"
        print(f"{shares}  {price.elements:8d}  {step}  {price.seconds:.3g} s")
    if plot is not None:
        requests.plot(prices, str(file.tree["title"]), plot)


@app.command()
def effects(scene: SceneArgument, settings: SetOption = None) -> None:
    """Say which effects a scene has, because of which line, and what each costs."""
    from rich.console import Console
    from rich.table import Table

    from riserstudy.model.active_effects import ledger
    from riserstudy.numerics.effect_shares import priced

    file = _scene(scene, settings)
    rows = ledger(file.scene())
    _compile_once()
    price = priced(file)
    table = Table("effect", "", "because of", "time", title=str(file.tree["title"]))
    for row in rows:
        share = price.share.get(row.name)
        spent = f"{100 * share:.1f} %" if share is not None else ""
        style = None if row.on else "dim"
        table.add_row(row.name, "on" if row.on else "off", row.because, spent, style=style)
    console = Console(markup=False)
    console.print(table)
    for line in price.said:
        console.print(line, highlight=False)


@app.command()
def advise(scene: SceneArgument, settings: SetOption = None) -> None:
    """Say which effects a scene could do without at its accuracy, and which missing one would matter."""
    from rich.console import Console
    from rich.table import Table

    from riserstudy.numerics.advice import advice

    file = _scene(scene, settings)
    _compile_once()
    given = advice(file)
    columns = ("displacement", "moment", "tension", "run time")
    table = Table("change", *columns, "verdict", title=str(file.tree["title"]))
    for row in given.rows:
        table.add_row(row.label, *row.changes, row.verdict, style=None if row.counts else "dim")
    console = Console(markup=False)
    console.print(table)
    for line in given.said:
        console.print(line, highlight=False)


@app.command()
def modes(
    scene: SceneArgument,
    settings: SetOption = None,
    count: Annotated[int, typer.Option(min=1, max=1000, help="how many")] = 10,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="write frequencies and shapes here")
    ] = None,
) -> None:
    """Natural frequencies about the static equilibrium."""
    from rich.console import Console
    from rich.table import Table

    from riserstudy.simulation.modes import modes_of

    file = _scene(scene, settings)
    if output is not None:
        _check_writable(output, scene)
    _compile_once()
    dataset = modes_of(file.scene(), count)
    table = Table("mode", "period (s)", "frequency (Hz)", "motion")
    for k in range(dataset.sizes["mode"]):
        frequency = float(dataset["frequency"][k])
        period = f"{1 / frequency:.5g}" if frequency > 0 else "unstable"
        table.add_row(str(k + 1), period, f"{frequency:.6g}", str(dataset["motion"].values[k]))
    Console(markup=False).print(table)
    if output is not None:
        from riserstudy.study.collect import write_dataset

        write_dataset(dataset, output)


@app.command()
def draw(
    scene: SceneArgument,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="drawing (PNG, PDF or SVG)", metavar="OUT.png")
    ],
    settings: SetOption = None,
) -> None:
    """Draw a scene to scale: what is there, what it is free to do, what acts on it."""
    file = _scene(scene, settings)
    _check_writable(output, scene)
    if output.suffix not in (".png", ".pdf", ".svg"):
        allowed = "allowed are .png, .pdf and .svg"
        raise InputError("--output", str(output), f"no drawing {output.suffix!r}", allowed)
    from riserstudy.figures import save
    from riserstudy.schematic import schematic

    save(schematic(file.scene()), output)


@app.command("import")
def import_deck(
    deck: Annotated[Path, typer.Argument(help="OrcaFlex text model", metavar="DECK.yml")],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="scene to write", metavar="SCENE.yaml")
    ],
) -> None:
    """Make a scene of a deck: the OrcaFlex text model of a vertical riser.

    Everything that is not in the scene is named; what would make it another riser is refused.
    """
    from riserstudy.scene.orcaflex import as_text, read_deck

    deck_scene = read_deck(deck)
    _check_writable(output, deck)
    output.write_text(as_text(deck_scene, deck), "utf-8")
    for line in deck_scene.left_out:
        print(f"left out: {line}")
    print(f"{output} is written; {len(deck_scene.left_out)} entries of the deck are not in it")


@app.command()
def new(folder: Annotated[Path, typer.Argument(help="folder to make", metavar="FOLDER")]) -> None:
    """Make a folder for a study of one's own: Snakefile, configuration, an example to change."""
    from riserstudy.study.new import new_study

    new_study(folder)
    print(f"{folder} is ready: `cd {folder}`, then `snakemake`; README.md there goes on from here.")


@app.command()
def schema(
    kind: Annotated[str, typer.Argument(help="scene, study or config", metavar="[KIND]")] = "scene",
) -> None:
    """Print the JSON schema of scene, study or configuration files, for editors."""
    from riserstudy.study.schemas import schemas

    if kind not in (known := schemas()):
        raise InputError("schema", kind, "no kind of file", f"allowed are {', '.join(known)}")
    print(json.dumps(known[kind], indent=2))


ResultsOption = Annotated[Path, typer.Option("--results", help="results folder", metavar="FOLDER")]
CsvOption = Annotated[
    Path | None, typer.Option("--csv", help="write it to a file instead", metavar="FILE.csv")
]
JsonOption = Annotated[bool, typer.Option("--json", help="print JSON")]
IN_RESULTS = Path("results")


@app.command()
def results(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            help="a study, or words that points must contain", metavar="[STUDY | FILTER...]"
        ),
    ] = None,
    where: Annotated[
        str | None, typer.Option(help="which points: 'heave_amplitude > 3'", metavar="CONDITION")
    ] = None,
    columns: Annotated[
        str | None, typer.Option(help="what to show of them", metavar="A,B,...")
    ] = None,
    sort: Annotated[
        str | None, typer.Option(help="by which columns; -A from the largest", metavar="A,B,...")
    ] = None,
    csv: CsvOption = None,
    as_json: JsonOption = False,
    folder: ResultsOption = IN_RESULTS,
) -> None:
    """List studies; the points of one, with what they found; or points by words.

    By words: key, study, place on its axes, scene, engine, time and effects of every point that has them all.
    """
    from riserstudy.database import listing
    from riserstudy.database.ask import NAME, opened

    words = names or []
    with opened(folder / NAME) as db:
        table = listing.table_of(db, words[0]) if len(words) == 1 else None
        if table is None and (where or columns or sort):
            found = f"no study {' '.join(words)!r}" if words else "no study"
            raise InputError("results", "", found, "allowed is one that `riserstudy results` lists")
        if table is not None:
            parts = [re.split(r"\s*,\s*", part.strip()) if part else [] for part in (columns, sort)]
            answer = listing.cells(db, table, parts[0] or None, where, parts[1])
            units = listing.units(db, table)
        else:
            answer = listing.points(db, words) if words else listing.studies(db)
            units = {}
    _show(answer, csv, as_json, units)


@app.command()
def sql(
    statement: Annotated[str, typer.Argument(help="one select", metavar="STATEMENT")],
    csv: CsvOption = None,
    as_json: JsonOption = False,
    folder: ResultsOption = IN_RESULTS,
) -> None:
    """Ask the results database; nothing can be changed by it."""
    from riserstudy.database.ask import NAME, ask, opened

    with opened(folder / NAME) as db:
        answer = ask(db, statement)
    _show(answer, csv, as_json)


def _show(
    answer: Any, csv: Path | None, as_json: bool, units: dict[str, str] | None = None
) -> None:
    import os

    from riserstudy.database import show

    if csv is not None:
        show.write_csv(answer, csv)
        return
    lines = [show.as_json(answer)] if as_json else show.as_table(answer, units)
    try:
        for line in lines:
            print(line)
        sys.stdout.flush()
    except BrokenPipeError:  # whoever reads has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@app.command()
def verify(folder: ResultsOption = IN_RESULTS) -> None:
    """Compare every dataset, figure, table and stored point with the digest it had.

    Exit status 1 where something differs.
    """
    from riserstudy.database.ask import NAME
    from riserstudy.database.verify import verify as verified

    verdict = verified(folder / NAME)
    for line in verdict.wrong:
        print(line)
    print(f"{len(verdict.wrong)} faults in {verdict.files} files and {verdict.points} points")
    if verdict.gone:
        print(f"{verdict.gone} points are not in this store; their datasets do without them")
    if verdict.wrong:
        raise typer.Exit(1)


@app.command()
def prune(
    every: Annotated[
        bool,
        typer.Option("--all", help="also points of this engine that no study here refers to"),
    ] = False,
    yes: Annotated[bool, typer.Option("--yes", help="do not ask")] = False,
    config: Annotated[
        Path, typer.Option(help="folder of the configuration", metavar="FOLDER")
    ] = Path("config"),
    folder: ResultsOption = IN_RESULTS,
) -> None:
    """Remove stored points that nothing needs, once their size was told and it was agreed to.

    Those of other engines, of former formats, or damaged. Where studies of several folders share a store,
    ``--all`` takes what only the others need.
    """
    from riserstudy.database.ask import NAME
    from riserstudy.database.prune import unneeded
    from riserstudy.study import store

    superfluous = unneeded(folder / NAME, config)
    size = {
        name: sum(h.bytes for h in getattr(superfluous, name)) / 1e6 for name in ("old", "strange")
    }
    print(f"needed: {superfluous.needed} points")
    print(
        f"of other engines or formats, or damaged: {len(superfluous.old)} files, {size['old']:.1f} MB"
    )
    print(
        f"of this engine, but of no study here: {len(superfluous.strange)} files, {size['strange']:.1f} MB"
    )
    going = [*superfluous.old, *(superfluous.strange if every else [])]
    if not going:
        print("nothing to remove")
        return
    if not yes and not typer.confirm(f"remove {len(going)} files?"):
        raise typer.Exit(1)
    for held in going:
        store.remove(held)
    print(f"{len(going)} files removed, {sum(held.bytes for held in going) / 1e6:.1f} MB")


@app.command()
def diff(
    old: Annotated[Path, typer.Argument(help="results folder, dataset or table", metavar="OLD")],
    new: Annotated[Path, typer.Argument(help="the same, made anew", metavar="NEW")],
) -> None:
    """Say what changed between two sets of results: published numbers, verdicts, every dataset.

    Exit status 1 where something did.
    """
    from rich.console import Console
    from rich.table import Table

    from riserstudy.dataset.diff import changes

    changed = changes(old, new)
    console = Console(markup=False)
    if not console.is_terminal:
        console.width = 160  # a file has no width to wrap at
    if changed.graded:
        table = Table("number or claim", "", "old", "new")
        for one in changed.graded:
            table.add_row(*one)
        console.print(table)
    if changed.varied:
        table = Table("dataset", "variable", "largest change", "")
        for name, variable, change, why in changed.varied:
            table.add_row(name, variable, "" if why else f"{change:.2g}", why)
        console.print(table)
    print(
        f"{len({one.item for one in changed.graded})} of {changed.rows} numbers and claims changed"
    )
    print(
        f"{len(changed.varied)} of {changed.variables} variables changed, by {changed.largest:.2g} at most"
    )
    if changed.graded or changed.varied:
        raise typer.Exit(1)
