"""Tune a study: one mesh, step and method for all its points."""

from __future__ import annotations

from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from riserstudy.cli.shared import compile_kernels, notify
from riserstudy.errors import InputError, SimulationError

if TYPE_CHECKING:
    from riserstudy.study.study import Study
    from riserstudy.study.tune import Tuned

FEWEST = 2  # smallest number of points for tuning


def tune(
    studies: Annotated[Path, typer.Argument(help="study file (YAML)", metavar="STUDY.yaml")],
    study: Annotated[
        str | None,
        typer.Argument(
            help="study to tune; may be omitted if the file has only one study", metavar="[STUDY]"
        ),
    ] = None,
    accuracy: Annotated[
        str | None,
        typer.Option(help="tolerance, such as 1%; default: the tolerance of the study", metavar="PERCENT"),
    ] = None,
    points: Annotated[
        int, typer.Option(min=FEWEST, max=256, help="number of points that the search uses")
    ] = 12,
    seed: Annotated[int, typer.Option(min=0, help="seed (start value) of the random draw of points")] = 1,
    write: Annotated[
        bool,
        typer.Option(
            "--write", help="write the mesh, time step and method that were found into the study file"
        ),
    ] = False,
) -> None:
    """Find the cheapest mesh, time step and method with which all points of a study meet a tolerance.

    The command ``tune`` selects mesh, time step and time integration method at a few points (single
    simulations) of the study, and checks the selected settings at further, random points.

    If the study, its scene or its tables change during the tuning, ``tune`` writes nothing, and the exit
    status is 3.
    """
    from riserstudy.study.write_tuned import write_tuned

    one = _study(studies, study)
    begun = one.plan_digest
    from riserstudy.study.tune import check_tunable
    from riserstudy.study.tune import tune as tuned_of

    check_tunable(one, points)
    if write and one.model.settings:
        why = "with the key `settings`, each run of the study also tunes the study"
        remedy = "omit --write, or remove the key from the study"
        raise InputError(studies, f"studies.{one.name}.settings", why, remedy)
    compile_kernels(one.grid.file((0,) * len(one.axes)).resolved())
    found = tuned_of(one, accuracy, points, seed, notify)
    for line in _lines(one, found):
        print(line)
    if write:
        if _study(studies, one.name).plan_digest != begun:
            raise SimulationError(
                f"{studies}: studies.{one.name}, its scene or a table changed during the tuning, so nothing "
                "is written; repeat the command"
            )
        write_tuned(studies, one, found, about(found, seed))
        print(f"{studies}: written into studies.{one.name}")


def _study(path: Path, name: str | None) -> Study:
    """A study of a file in a folder of its configuration."""
    from riserstudy.inputs.plain_yaml import read_yaml
    from riserstudy.inputs.validate import check
    from riserstudy.study.models import StudyFile
    from riserstudy.study.study import Study

    file = check(StudyFile, read_yaml(path), path)
    if name is None and len(file.studies) > 1:
        allowed = f"give the name of one of {', '.join(file.studies)}"
        raise InputError(path, "studies", f"the file has {len(file.studies)} studies", allowed)
    name = name or next(iter(file.studies), "")
    if name not in file.studies:
        allowed = f"use one of {', '.join(file.studies)}" if file.studies else "add a study to the file"
        raise InputError(path, "studies", f"the file has no study {name!r}", allowed)
    config = path.resolve().parent.parent
    return Study(path.stem, name, file.studies[name], config, "standard", None, file.readings)


def about(found: Tuned, seed: int) -> dict[str, Any]:
    """The record of the tuning for the study file."""
    return {
        "accuracy": found.accuracy,
        "on": date.today().isoformat(),
        "points": len(found.points),
        "held_out": len(found.checked),
        "seed": seed,
        "error": float(f"{max(found.error, found.held_out):.2g}"),
        "work": float(f"{found.work:.2g}"),
    }


def _lines(study: Study, found: Tuned) -> list[str]:
    """The setting in the form of a study, with its error and cost."""
    setting = found.setting
    mesh = setting.analysis["mesh"]
    layers = ", ".join(f"{end}: {length}" for end, length in mesh.get("layers", {}).items())
    graded = f", layers: {{{layers}}}" if layers else ""
    method = setting.analysis["method"]
    method = method if isinstance(method, str) else f"{{rho_inf: {method['rho_inf']:g}}}"
    lines = [
        f"analysis.mesh: {{elements: {setting.elements}{graded}}}",
        f"analysis.step: {setting.analysis['step']}",
        f"analysis.method: {method}",
        f"tolerance {found.accuracy}; largest error divided by the tolerance: {found.error:.2f} at "
        f"{len(found.points)} selected points, {found.held_out:.2f} at {len(found.checked)} checked points, "
        f"of {len(study.grid)}",
        f"work: {found.work:.2g} of the work of runs with the tolerance at each point",
    ]
    if found.own:
        _, error, work = found.own
        same = found.own[0] == setting
        lines.append(
            "the study file already contains this setting"
            if same
            else f"present setting in the study file: work {work:.2g}, largest error divided by the "
            f"tolerance {error:.2f}"
        )
    return lines
