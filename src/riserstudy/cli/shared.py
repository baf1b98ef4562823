"""Arguments, options and steps that several commands share."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.cli.targets import Writes, check_name, check_output
from riserstudy.dataset.unit_systems import UnitSystem
from riserstudy.errors import InputError, RiserStudyError
from riserstudy.inputs.misfit import Misfit
from riserstudy.records.numerals import percent

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from riserstudy.dataset.table import Table
    from riserstudy.scene.resolve import Resolved

NOTEWORTHY = 10.0  # estimated time of a run (s) from which on it is announced
WORTH_A_RECIPE = 60.0  # estimated time of a run (s) from which on a cheaper run is proposed

SceneArgument = Annotated[Path, typer.Argument(help="scene file (YAML)", metavar="SCENE.yaml")]

SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        help="replace a value of the scene, such as platform.heave.amplitude='3 m'; may be repeated",
        metavar="PATH=VALUE",
    ),
]

AtOption = Annotated[
    list[str] | None,
    typer.Option(
        "--at",
        help="select a point of a study by the value of an axis, such as heave_amplitude=5; may be repeated",
        metavar="AXIS=VALUE",
    ),
]


AccuracyOption = Annotated[
    str | None,
    typer.Option(
        help="tolerance for which mesh and time step are chosen, such as 1%; default: as in the scene",
        metavar="PERCENT",
    ),
]
DatasetArgument = Annotated[Path, typer.Argument(help="dataset of a run or a study", metavar="FILE.nc")]
FigureOutput = Annotated[
    Path, typer.Option("-o", "--output", help="figure (PNG, PDF or SVG)", metavar="OUT.png"), Writes("figure")
]
ReturnOption = Annotated[
    list[int] | None,
    typer.Option(
        "--return-period",
        min=2,
        max=10000,
        help="return period of an extreme value to compute, in years; may be repeated",
        metavar="YEARS",
    ),
]


UnitsOption = Annotated[
    UnitSystem, typer.Option(help="units of the output: SI (si), kN and MPa (field), or feet and kips (us)")
]


def pairs(
    option: str, texts: list[str] | None, form: str, example: str, *, last: bool = False
) -> dict[str, str]:
    """Values by name, of texts ``NAME=VALUE``, each divided at its first or last sign of equality."""
    found: dict[str, str] = {}
    for text in texts or []:
        name, equals, value = (part.strip() for part in (text.rpartition if last else text.partition)("="))
        if not equals or not name:
            raise InputError(option, text, f"does not have the form {form}", f"write, for example, {example}")
        if name in found:
            raise InputError(option, text, f"{name} is given twice", "give each name once")
        found[name] = value
    return found


def scene_of(path: Path, settings: list[str] | None, accuracy: str | None = None) -> Any:
    """Read a scene with the values of ``--set`` and the error of ``--accuracy``, and check it."""
    from riserstudy.inputs.plain_yaml import plain_yaml
    from riserstudy.scene.load import read_scene
    from riserstudy.simulation.simulate import at_accuracy

    check_name(path)
    given = pairs("--set", settings, "PATH=VALUE", "platform.heave.amplitude='3 m'")
    overrides = {name: plain_yaml(text, f"--set {name}") for name, text in given.items()}
    file = read_scene(path).with_values(overrides, "--set")
    if accuracy is not None:
        file = at_accuracy(file, accuracy)
    file.resolved()
    return file


def compile_kernels(scene: Resolved) -> None:
    """Compile the kernels that runs of a scene need, before its runs are timed.

    This is done by a run that is interrupted. Compiling is then not included in the run's time or time limit.
    """
    from riserstudy.simulation.refine import run

    compile_as_needed()
    with suppress(RiserStudyError):  # the run itself will report the error
        run(scene, patience=0.0)


def compile_as_needed() -> None:
    """Compile kernels when a command needs them, with a report on stderr."""
    from riserstudy.simulation.compile import report_compiling

    report_compiling(notify)
    _plain_xarray()


def _plain_xarray() -> None:
    """Let xarray find only numpy arrays, because no command uses other kinds of arrays."""
    from riserstudy.dataset.without import without

    with without("dask", "pint"):
        import xarray

        xarray.Dataset(coords={"s": [0.0]})


PlotOption = Annotated[
    Path | None,
    typer.Option(help="also write a figure (PNG, PDF or SVG)", metavar="FILE.png"),
    Writes("figure"),
]
CsvOption = Annotated[
    Path | None,
    typer.Option("--csv", help="also write the printed table to this CSV file", metavar="OUT.csv"),
    Writes("table"),
]


def notify(line: str) -> None:
    """Print the present activity on stderr."""
    print(f"riserstudy: {line}", file=sys.stderr, flush=True)


def check_targets(
    reads: Iterable[Path],
    force: bool,
    csv: Path | None = None,
    plot: Path | None = None,
    output: Path | None = None,
) -> None:
    """Refuse a table, figure or dataset that cannot be written, before any computation."""
    reads = list(reads)
    for path, kind, option in (
        (csv, "table", "--csv"),
        (plot, "figure", "--plot"),
        (output, "dataset", "--output"),
    ):
        if path is not None:
            check_output(path, (kind,), reads, force, option)


def require_limits(file: Any) -> None:
    """Refuse a scene without limits."""
    if "limits" not in file.tree:
        allowed = "add a list with items such as {output: lfj_angle, largest: 4 deg, mode: drilling}"
        raise InputError(file.source, "limits", "missing, but this command evaluates limits", allowed)


def show(table: Table, csv: Path | None) -> None:
    """Print a table in columns, and write it if ``--csv`` names a file."""
    from riserstudy.dataset import tables

    for line in tables.in_columns(table):
        print(line)
    write_table(table, csv)


def write_table(table: Table, csv: Path | None) -> None:
    """Write a table if an option names a file, and print the name of the file."""
    if csv is not None:
        from riserstudy.dataset import tables

        tables.write_csv(table, csv)
        wrote(csv)


def save_dataset(dataset: xr.Dataset, output: Path | None) -> None:
    """Write a dataset if ``--output`` names a file, and print the name of the file."""
    if output is not None:
        from riserstudy.dataset.write_dataset import write_dataset

        write_dataset(dataset, output)
        wrote(output)


def save_figure(figure: Figure, plot: Path) -> None:
    """Write a figure, and print the name of its file."""
    from riserstudy.figures import save

    save(figure, plot)
    wrote(plot)


def wrote(*paths: Path) -> None:
    """Print the files that a command has written."""
    for path in paths:
        print(f"written: {path}")


def quantity(option: str, text: str, unit: str, allowed: str = "") -> float:
    """The value of an option in SI; ``allowed`` states what to write instead of a wrong one."""
    from riserstudy.scene.units import to_si

    try:
        return to_si(text, unit)
    except Misfit as fault:
        raise InputError(option, text, fault.found, allowed or fault.allowed) from None


def positive(option: str, text: str, unit: str) -> float:
    """The value of an option in SI, above zero."""
    value = quantity(option, text, unit)
    if not (value > 0.0 and math.isfinite(value)):
        raise InputError(
            option, text, "the value is not above 0", f"give a positive value, such as '1 {unit}'"
        )
    return value


def simulated(file: Any) -> Any:
    """The dataset of a scene's run, with the estimated time before the run and its warnings after it."""
    compile_kernels(file.resolved())
    from riserstudy.simulation.simulate import simulate

    announce(file)
    dataset = simulate(file)
    print_warnings(dataset)
    return dataset


def recipe_lines(scene: Resolved) -> list[str]:
    """The recipe for long records in words; empty for other scenes."""
    from riserstudy.records.numerals import duration
    from riserstudy.simulation.recipe import recipe

    found = recipe(scene)
    if found is None:
        return []
    errors = ", ".join(f"{name} {percent(value)}" for name, value in found.error.items())
    return [
        f"recipe for long records: {found.words}",
        f"  takes about {duration(found.seconds)} with its error estimate; estimated error on the first "
        f"{found.piece:.4g} s: {errors or 'none given'}",
    ]


def place_of(at: list[str] | None) -> dict[str, str]:
    """Values by axis, as text."""
    return pairs("--at", at, "AXIS=VALUE", "heave_amplitude=5")


def print_warnings(dataset: Any) -> None:
    """Print the warnings of a run."""
    for warning in json.loads(dataset.attrs["warnings"]):
        notify(f"warning: {warning}")


def announce(file: Any) -> None:
    """Print the estimated time of a long run before it, and the reasons for this time."""
    from riserstudy.records.numerals import duration
    from riserstudy.records.warning import sentences
    from riserstudy.scene.sudden import sudden_wave
    from riserstudy.simulation.forecast import forecast
    from riserstudy.simulation.progress_line import progress_line
    from riserstudy.simulation.time_limit import Watch

    for text in sentences(sudden_wave(file.resolved())):
        notify(f"warning: {text}")
    with progress_line(True) as show_progress:
        price = forecast(file.resolved(), Watch(notify=show_progress))
    if price and price.seconds > NOTEWORTHY:
        notify(
            f"takes about {duration(price.seconds)}: by its first {price.piece:.4g} s, "
            f"{price.elements} segments and a step of {price.step:.3g} s are enough"
        )
        for line in recipe_lines(file.resolved()) if price.seconds > WORTH_A_RECIPE else []:
            notify(line)
