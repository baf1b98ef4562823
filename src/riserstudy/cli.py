"""The commands of ``riserstudy``: new, run, cost, effects, advise, modes, draw, schema, results, diff."""

from __future__ import annotations

import json
import sys
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
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", help="set a value: platform.heave.amplitude='3 m'", metavar="PATH=VALUE"),
]


def main() -> None:
    """Run the command line; errors go to stderr in one line, with their exit code."""
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
            raise InputError("--output", str(output), "the scene itself", "name another file")
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
) -> None:
    """Simulate a scene and write its dataset."""
    file = _scene(scene, settings, accuracy)
    _check_writable(output, scene)
    from riserstudy.simulation.simulate import simulate
    from riserstudy.study.collect import write_dataset

    dataset = simulate(file)
    write_dataset(dataset, output)
    for warning in json.loads(dataset.attrs["warnings"]):
        print(f"riserstudy: warning: {warning}", file=sys.stderr)
    print(_summary(dataset))


def _summary(dataset: Any) -> str:
    estimate = json.loads(dataset.attrs.get("error_estimate", "{}"))
    errors = ", ".join(f"{name} {100 * value:.2g} %" for name, value in estimate.items())
    step = f", step {dataset.attrs['step']:.4g} s" if "step" in dataset.attrs else ""
    return (
        f"{dataset.attrs['elements']} segments{step}; estimated error: {errors or 'none given'}; "
        f"{dataset.attrs['wall_seconds']:.3g} s"
    )


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
    from riserstudy.numerics import accuracy_cost as requests

    found: list[requests.Price] = []
    for price in requests.prices(file):
        if not found:  # a scene that is refused has no table
            print("asked for  estimated  segments      step   time")
        found.append(price)
        step = f"{price.step:7.3g} s" if price.step else "   none  "
        shares = f"{100 * price.requested:7.3g} %  {100 * price.estimated:7.2g} %"
        print(f"{shares}  {price.elements:8d}  {step}  {price.seconds:.3g} s")
    if plot is not None:
        requests.plot(found, str(file.tree["title"]), plot)


@app.command()
def effects(scene: SceneArgument, settings: SetOption = None) -> None:
    """Say which effects a scene has, because of which line, and what each costs."""
    from rich.console import Console
    from rich.table import Table

    from riserstudy.model.active_effects import ledger
    from riserstudy.numerics.effect_shares import priced

    file = _scene(scene, settings)
    rows = ledger(file.scene())
    price = priced(file)
    table = Table("effect", "", "because of", "time", title=str(file.tree["title"]))
    for row in rows:
        share = price.share.get(row.name)
        spent = f"{100 * share:.1f} %" if share is not None else ""
        style = None if row.on else "dim"
        table.add_row(row.name, "on" if row.on else "off", row.because, spent, style=style)
    console = Console()
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
    found = advice(file)
    columns = ("displacement", "moment", "tension", "run time")
    table = Table("change", *columns, "verdict", title=str(file.tree["title"]))
    for row in found.rows:
        table.add_row(row.label, *row.changes, row.verdict, style=None if row.counts else "dim")
    console = Console()
    console.print(table)
    for line in found.said:
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
    dataset = modes_of(file.scene(), count)
    table = Table("mode", "period (s)", "frequency (Hz)", "motion")
    for k in range(dataset.sizes["mode"]):
        frequency = float(dataset["frequency"][k])
        period = f"{1 / frequency:.5g}" if frequency > 0 else "unstable"
        table.add_row(str(k + 1), period, f"{frequency:.6g}", str(dataset["motion"].values[k]))
    Console().print(table)
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


@app.command()
def results(
    filters: Annotated[
        list[str] | None,
        typer.Argument(help="words that a point must contain", metavar="[FILTER]..."),
    ] = None,
) -> None:
    """List stored points: key, source, engine, time, effects, parameters."""
    from riserstudy.study.store import about_points

    for about in about_points():
        facts = about["facts"]
        line = (
            f"{about['key']}  {about['source']}  engine {about['engine']}  "
            f"{facts['wall_seconds']:.3g} s  {', '.join(facts['effects'])}"
        )
        text = line + json.dumps(about["scene"])
        if all(word in text for word in filters or []):
            print(line)


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

    found = changes(old, new)
    console = Console()
    if not console.is_terminal:
        console.width = 160  # a file has no width to wrap at
    if found.graded:
        table = Table("number or claim", "", "old", "new")
        for one in found.graded:
            table.add_row(*one)
        console.print(table)
    if found.varied:
        table = Table("dataset", "variable", "largest change", "")
        for name, variable, change, why in found.varied:
            table.add_row(name, variable, "" if why else f"{change:.2g}", why)
        console.print(table)
    print(f"{len({one.item for one in found.graded})} of {found.rows} numbers and claims changed")
    print(
        f"{len(found.varied)} of {found.variables} variables changed, by {found.largest:.2g} at most"
    )
    if found.graded or found.varied:
        raise typer.Exit(1)
