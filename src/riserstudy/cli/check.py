"""Check a scene against its limits."""

from __future__ import annotations

import json
from typing import Any

import typer

from riserstudy.cli.shared import (
    AccuracyOption,
    SceneArgument,
    SetOption,
    UnitsOption,
    require_limits,
    scene_of,
    simulated,
)
from riserstudy.dataset.unit_systems import UnitSystem

NEAR = 0.8  # utilisation from which on the line of a limit is coloured


def check(
    scene: SceneArgument,
    settings: SetOption = None,
    accuracy: AccuracyOption = None,
    units: UnitsOption = UnitSystem.FIELD,
) -> None:
    """Check a scene against its limits.

    For each limit, the table gives the computed value, the allowable value, the utilisation, the place and
    the time. The utilisation is the computed value divided by the allowable value. For a smallest allowed
    value above zero, the utilisation is the allowable value divided by the computed value. The first row is
    the governing limit, which is exceeded most or is closest to being exceeded.

    The exit status is 1 if a limit is exceeded. If no limit is exceeded, but a limit could not be evaluated,
    the exit status is 4.
    """
    file = scene_of(scene, settings, accuracy)
    require_limits(file)
    dataset = simulated(file)
    from riserstudy.dataset.limits import EXCEEDED, UNKNOWN

    show_limits(dataset, units)
    verdicts = {row["verdict"] for row in json.loads(dataset.attrs["limits"])}
    if verdicts & {EXCEEDED, UNKNOWN}:
        raise typer.Exit(1 if EXCEEDED in verdicts else 4)


def show_limits(dataset: Any, units: UnitSystem = UnitSystem.FIELD) -> None:
    """Print the limits of the scene as a table, the governing limit first; on terminals in colours."""
    rows = json.loads(dataset.attrs.get("limits", "[]"))
    if not rows:
        return
    from rich.console import Console

    from riserstudy.dataset.limit_lines import lines
    from riserstudy.dataset.provenance import first_scene
    from riserstudy.study.in_sea import one_sea

    console = Console(markup=False, highlight=False, soft_wrap=True)
    for line in lines(rows, units):
        style = "bold red" if line.use > 1.0 else "yellow" if line.use > NEAR else None
        console.print(line.text, style=style)
    start = float(dataset["time"][0]) if "time" in dataset.coords else 0.0
    if start > 0.0:
        console.print(f"counted from t = {start:g} s on, because of analysis.output.start")
    if chance := one_sea(first_scene(dataset)):
        console.print(chance)
