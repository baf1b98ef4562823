"""Simulate a scene, and rerun a point of a dataset."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.cli.check import show_limits
from riserstudy.cli.shared import (
    AccuracyOption,
    AtOption,
    DatasetArgument,
    SceneArgument,
    SetOption,
    announce,
    check_targets,
    compile_as_needed,
    compile_kernels,
    place_of,
    print_warnings,
    save_dataset,
    scene_of,
    wrote,
)
from riserstudy.cli.targets import ForceOption, Writes, check_output
from riserstudy.dataset.unit_systems import UnitSystem
from riserstudy.records.numerals import percent

SAME_AS_STORED = 1e-9  # relative tolerance for values that are stored with ten digits

if TYPE_CHECKING:
    import xarray as xr


def run(
    scene: SceneArgument,
    output: Annotated[
        Path,
        typer.Option(
            "-o",
            "--output",
            help="dataset to write (netCDF), or CSV table of time series (of a static run: extremes)",
            metavar="OUT.nc",
        ),
        Writes("dataset", "table"),
    ],
    settings: SetOption = None,
    accuracy: AccuracyOption = None,
    patience: Annotated[
        str | None,
        typer.Option(
            help="time limit, after which the best result so far is written, such as 30 (in seconds) "
            "or '10 min'",
            metavar="SECONDS",
        ),
    ] = None,
    force: ForceOption = False,
    units: Annotated[
        UnitSystem | None,
        typer.Option(help="units of limits (default: kN and MPa) and of a CSV file (default: SI)"),
    ] = None,
) -> None:
    """Simulate a scene and write its dataset.

    If the tolerance is not reached within the time limit --patience, ``run`` writes the best result so
    far, with its estimated error and a warning. If a result is written, the exit status is 0. If no run is
    complete within the time limit, ``run`` writes nothing and the exit status is 3.
    """
    from riserstudy.simulation.simulate import seconds

    seconds(patience)
    file = scene_of(scene, settings, accuracy)
    check_output(output, ("dataset", "table"), file.files, force)
    compile_kernels(file.resolved())
    from riserstudy.simulation.simulate import simulate

    if patience is None:
        announce(file)
    dataset = simulate(file, patience=patience)
    _write(dataset, output, units or UnitSystem.SI)
    print_warnings(dataset)
    print(_summary(dataset))
    for line in _recoil(file, dataset):
        print(line)
    show_limits(dataset, units or UnitSystem.FIELD)
    wrote(output)


def _write(dataset: xr.Dataset, output: Path, units: UnitSystem) -> None:
    """Write a run as a dataset, or as a table in some units."""
    if output.suffix == ".csv":
        from riserstudy.dataset import tables

        kind = "time-series" if "time" in dataset else "extremes"
        made = tables.table_of(kind, None, dataset)
        tables.write_csv(tables.in_units(made, units), output)
        return
    from riserstudy.dataset.write_dataset import write_dataset

    write_dataset(dataset, output)


def _recoil(file: Any, dataset: Any) -> list[str]:
    """The outcome of a disconnect, if there is one."""
    from riserstudy.dataset import recoil_table
    from riserstudy.dataset.tables import in_columns

    if not recoil_table.disconnects(dataset):
        return []
    return in_columns(recoil_table.recoil(file.resolved(), dataset))


def _summary(dataset: Any) -> str:
    from riserstudy.records.numerals import duration

    estimate = json.loads(dataset.attrs.get("error_estimate", "{}"))
    errors = ", ".join(f"{name.replace('_', ' ')} {percent(value)}" for name, value in estimate.items())
    step = f", step {dataset.attrs['step']:.4g} s" if "step" in dataset.attrs else ""
    return (
        f"{dataset.attrs['elements']} segments{step}; estimated error: {errors or 'none given'}; "
        f"{duration(dataset.attrs['wall_seconds'], 3)}"
    )


def rerun(
    dataset: DatasetArgument,
    at: AtOption = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="also write the complete dataset of the run", metavar="OUT.nc"),
        Writes("dataset"),
    ] = None,
    force: ForceOption = False,
) -> None:
    """Rerun one point from its dataset and compare the new results with the stored results.

    The option -o writes the complete run, including outputs that the study does not keep. The exit status is
    1 if a variable changed by more than 1e-9 of its largest magnitude. Smaller changes are ignored, because
    large time histories are stored with only ten digits.
    """
    from riserstudy.dataset.open import open_dataset

    place = place_of(at)
    old = open_dataset(dataset)
    check_targets([dataset], force, output=output)
    compile_as_needed()
    from riserstudy.study.repeat_point import rerun as run_anew

    outcome = run_anew(old, place)
    for name, change in sorted(outcome.changes.items(), key=lambda item: -item[1]):
        print(f"{change:9.2g}  {name}")
    save_dataset(outcome.run, output)
    changed = sum(change > SAME_AS_STORED for change in outcome.changes.values())
    where = ", ".join(f"{axis}={value}" for axis, value in outcome.place.items())
    print(f"{changed} of {len(outcome.changes)} variables changed{' at ' if where else ''}{where}")
    if outcome.engines[0] != outcome.engines[1]:
        print(f"made by engine {outcome.engines[0]}, rerun by {outcome.engines[1]}")
    if changed:
        raise typer.Exit(1)
