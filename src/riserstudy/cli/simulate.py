"""Simulate a scene: run, check, rerun."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from riserstudy.cli.shared import (
    AtOption,
    SceneArgument,
    SetOption,
    check_writable,
    compile_kernels,
    place_of,
    say_warnings,
    scene_of,
    tell_of_kernels,
)
from riserstudy.errors import InputError

WORTH_TELLING = 10.0  # seconds of a run, from which on it is announced

SAME_AS_STORED = 1e-9  # relative, of what is stored to ten digits


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
    file = scene_of(scene, settings, accuracy)
    check_writable(output, scene)
    compile_kernels(file.scene())
    from riserstudy.simulation.simulate import simulate
    from riserstudy.study.collect import write_dataset

    if output.suffix not in (".nc", ".csv"):
        allowed = "allowed are .nc (netCDF) and .csv (time series, or the state at rest's extremes)"
        if output.suffix in (".xlsx", ".xls"):
            allowed += "; workbooks need a library that riserstudy does not bring"
        raise InputError("--output", str(output), f"no dataset {output.suffix!r}", allowed)
    if patience is None:
        _announce(file)
    dataset = simulate(file, patience=patience)
    if output.suffix == ".csv":
        from riserstudy.dataset import tables

        kind = "time-series" if "time" in dataset else "extremes"
        tables.write_csv(tables.table_of(kind, None, dataset), output)
    else:
        write_dataset(dataset, output)
    say_warnings(dataset)
    print(_summary(dataset))
    for line in _limits(dataset):
        print(line)


def _announce(file: Any) -> None:
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


def _limits(dataset: Any) -> list[str]:
    """A line a limit of the scene."""
    from riserstudy.dataset.tables import as_lines

    return as_lines(json.loads(dataset.attrs.get("limits", "[]")))


def _summary(dataset: Any) -> str:
    estimate = json.loads(dataset.attrs.get("error_estimate", "{}"))
    errors = ", ".join(f"{name} {100 * value:.2g} %" for name, value in estimate.items())
    step = f", step {dataset.attrs['step']:.4g} s" if "step" in dataset.attrs else ""
    return (
        f"{dataset.attrs['elements']} segments{step}; estimated error: {errors or 'none given'}; "
        f"{dataset.attrs['wall_seconds']:.3g} s"
    )


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
    file = scene_of(scene, settings, accuracy)
    if "limits" not in file.tree:
        allowed = "allowed is a list such as {output: lfj_angle, largest: 4 deg, mode: drilling}"
        raise InputError(file.source, "limits", "missing", allowed)
    compile_kernels(file.scene())
    from riserstudy.dataset.limits import EXCEEDED, UNKNOWN
    from riserstudy.simulation.simulate import simulate

    _announce(file)
    dataset = simulate(file)
    say_warnings(dataset)
    for line in _limits(dataset):
        print(line)
    verdicts = {row["verdict"] for row in json.loads(dataset.attrs["limits"])}
    if verdicts & {EXCEEDED, UNKNOWN}:
        raise typer.Exit(1 if EXCEEDED in verdicts else 4)


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
    more than 1e-9 of its largest magnitude; of large histories ten digits are stored.
    """
    from riserstudy.dataset.diff import opened

    place = place_of(at)
    old = opened(dataset)
    if output is not None:
        check_writable(output, dataset)
    tell_of_kernels()
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
