"""What a scene is made of and what it costs: cost, effects, advise, modes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from riserstudy.cli.shared import (
    SceneArgument,
    SetOption,
    check_writable,
    compile_kernels,
    scene_of,
)


def cost(
    scene: SceneArgument,
    settings: SetOption = None,
    plot: Annotated[
        Path | None, typer.Option(help="also draw it (PNG or PDF)", metavar="FILE.png")
    ] = None,
) -> None:
    """Say what 5, 1, 0.2 and 0.05 % of error cost for a scene, before a grid of it is launched."""
    file = scene_of(scene, settings)
    if plot is not None:
        check_writable(plot, scene)
    compile_kernels()
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


def effects(scene: SceneArgument, settings: SetOption = None) -> None:
    """Say which effects a scene has, because of which line, and what each costs."""
    from rich.console import Console
    from rich.table import Table

    from riserstudy.model.active_effects import ledger
    from riserstudy.numerics.effect_shares import priced

    file = scene_of(scene, settings)
    rows = ledger(file.scene())
    compile_kernels()
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


def advise(scene: SceneArgument, settings: SetOption = None) -> None:
    """Say which effects a scene could do without at its accuracy, and which missing one would matter."""
    from rich.console import Console
    from rich.table import Table

    from riserstudy.numerics.advice import advice

    file = scene_of(scene, settings)
    compile_kernels()
    given = advice(file)
    columns = ("displacement", "moment", "tension", "run time")
    table = Table("change", *columns, "verdict", title=str(file.tree["title"]))
    for row in given.rows:
        table.add_row(row.label, *row.changes, row.verdict, style=None if row.counts else "dim")
    console = Console(markup=False)
    console.print(table)
    for line in given.said:
        console.print(line, highlight=False)


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

    file = scene_of(scene, settings)
    if output is not None:
        check_writable(output, scene)
    compile_kernels()
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
