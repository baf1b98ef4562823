"""Analysis of a scene: cost, effects, advise, modes."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer

from riserstudy.cli.shared import (
    PlotOption,
    SceneArgument,
    SetOption,
    check_targets,
    compile_as_needed,
    compile_kernels,
    recipe_lines,
    save_dataset,
    scene_of,
    wrote,
)
from riserstudy.cli.targets import ForceOption, Writes


def cost(
    scene: SceneArgument, settings: SetOption = None, plot: PlotOption = None, force: ForceOption = False
) -> None:
    """Estimate the run time of a scene for tolerances of 5, 1, 0.2 and 0.05 %.

    The command ``cost`` prints one row per tolerance. The row ``default`` is for the default tolerances
    of 0.2 % in displacement, and 1 % in moment and tension. If the scene has an irregular sea of more
    than 20 min, ``cost`` adds advice on long simulations.
    """
    file = scene_of(scene, settings)
    check_targets(file.files, force, plot=plot)
    compile_kernels(file.resolved())
    from riserstudy.advice import accuracy_cost as requests
    from riserstudy.records.numerals import duration

    prices: list[requests.Price] = []
    for price in requests.prices(file, progress=True):
        if not prices:  # a refused scene has no table
            print("tolerance  estimated  segments  time step   time")
        prices.append(price)
        step = f"{price.step:7.3g} s" if price.step else "   none  "
        requested = "default" if price.requested is None else f"{100 * price.requested:.3g} %"
        shares = f"{requested:>9}  {100 * price.estimated:7.2g} %"
        print(f"{shares}  {price.elements:8d}  {step}  {duration(price.seconds, 3)}", flush=True)
    for line in recipe_lines(file.resolved()):
        print(line)
    if plot is not None:
        requests.plot(prices, str(file.tree["title"]), plot)
        wrote(plot)


def effects(
    scene: SceneArgument,
    settings: SetOption = None,
    every: Annotated[bool, typer.Option("--all", help="also list effects that need further inputs")] = False,
    times: Annotated[
        bool, typer.Option("--times", help="also print the share of each effect in the run time")
    ] = False,
) -> None:
    """List the effects of a scene with the lines that define them, and effects that can be added.

    The command ``advise`` estimates how much each effect changes the results and the run time.
    """
    from rich.console import Console
    from rich.table import Table

    from riserstudy.advice.effect_shares import could_have, priced, solved_for
    from riserstudy.model.active_effects import ledger

    file = scene_of(scene, settings)
    rows, could = ledger(file.resolved()), could_have(file)
    console = Console(markup=False)
    share = {}
    if times:
        compile_kernels(file.resolved())
        price = priced(file)
        share = {name: f"{100 * part:.1f} %" for name, part in price.share.items()}
    table = Table("effect", "", "because of", *(["time"] if times else []))
    table.title = str(file.tree["title"])
    for row in rows:
        word = "on" if row.on else "could be" if row.name in could else "off"
        if every or word != "off":
            because = row.because if row.on else f"needs {row.missing.replace(', and ', ' and ')}"
            cells = (row.name, word, because, *([share.get(row.name, "")] if times else []))
            table.add_row(*cells, style=None if row.on else "dim")
    console.print(table)
    off = sum(not row.on and row.name not in could for row in rows)
    counts = f"{sum(row.on for row in rows)} of {len(rows)} effects are on"
    more = "" if every or not off else f" Use --all to list {off} that need more input."
    console.print(f"{counts}.{more}", highlight=False)
    console.print(f"Degrees of freedom: {solved_for(file)}.", highlight=False)
    for line in price.sentences[:1] if times else []:
        console.print(line, highlight=False)


def advise(scene: SceneArgument, settings: SetOption = None) -> None:
    """Recommend effects to remove from a scene or to add to it, according to its tolerance.

    For each effect, ``advise`` adds or removes this effect alone, and compares displacement, bending
    moment and tension with the results of the unchanged scene. Tension is compared at the riser's upper
    end, and at the place with the smallest tension. An effect is removable if the results change by at
    most the tolerance.
    """
    from rich.console import Console
    from rich.table import Table

    from riserstudy.advice.recommendations import advice
    from riserstudy.simulation.progress_line import progress_line

    file = scene_of(scene, settings)
    compile_as_needed()
    with progress_line(True) as notify:
        given = advice(file, lambda message: notify(message, 0.0) if notify else None)
    console = Console(markup=False)
    for line in given.sentences:
        console.print(line, highlight=False)
    table = Table("change", title=str(file.tree["title"]))
    for name in ("displ.", "moment", "tension", "run time"):
        table.add_column(name, no_wrap=True, justify="right")
    table.add_column("verdict", min_width=15)
    for row in given.rows:
        table.add_row(row.label, *row.changes, row.verdict, style=None if row.counts else "dim")
    console.print(table)
    for row in given.rows:
        if row.because:
            console.print(f"{row.label}: {row.because}", highlight=False, style="dim")


def modes(
    scene: SceneArgument,
    settings: SetOption = None,
    count: Annotated[int, typer.Option(min=1, max=1000, help="number of modes")] = 10,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", help="also write frequencies and shapes to this file (netCDF)", metavar="OUT.nc"
        ),
        Writes("dataset"),
    ] = None,
    force: ForceOption = False,
) -> None:
    """Compute natural frequencies and mode shapes about the static equilibrium.

    If the scene does not prescribe a mesh, the riser has about 200 segments. The command ``modes``
    estimates the errors of the frequencies from two finer meshes, with two and four times as many
    segments. More segments (``analysis.mesh.elements``) give smaller errors. The modes neglect that
    tensioner cylinders also resist a rotation of the tension ring. The estimated errors do not include
    the effect of the cylinders' resistance. For six rigs, the resistance of the cylinders changed the
    frequencies by 0.03 to 0.16 %.
    """
    from rich.console import Console
    from rich.table import Table

    from riserstudy.simulation.labelled_modes import modes as natural_modes

    file = scene_of(scene, settings)
    check_targets(file.files, force, output=output)
    compile_as_needed()
    dataset = natural_modes(file, count)
    table = Table("mode", "period (s)", "frequency (Hz)", "estimated error", "motion")
    for k in range(dataset.sizes["mode"]):
        frequency = float(dataset["frequency"][k])
        period = f"{float(dataset['natural_period'][k]):.4g}" if frequency > 0 else "unstable"
        error = float(dataset["frequency_error"][k])
        estimate = f"{100.0 * error:.2g} %" if math.isfinite(error) else "not estimated"
        table.add_row(str(k + 1), period, f"{frequency:.4g}", estimate, str(dataset["motion"].values[k]))
    Console(markup=False).print(table)
    save_dataset(dataset, output)
