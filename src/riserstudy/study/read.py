"""Read a study file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError
from riserstudy.files.chapters import chapter_modules
from riserstudy.files.digests import defining
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.validate import check, refuse_other_paper
from riserstudy.study.arguments import refuse_arguments
from riserstudy.study.axes import Tier
from riserstudy.study.figures import NEEDS, FigureModel, Plot
from riserstudy.study.limits import limited
from riserstudy.study.measured import measured_models
from riserstudy.study.models import StudyFile
from riserstudy.study.plots import faults
from riserstudy.study.study import Study, scene_file
from riserstudy.study.study_model import StudyModel


def read_studies(config: Path, paper: str) -> StudyFile:
    """The checked study file of a paper.

    Raises InputError when the file is invalid, or requires code that does not exist.
    """
    path = config / "studies" / f"{paper}.yaml"
    file = check(StudyFile, _with_models(read_yaml(path, keep=True), path, paper), path)
    refuse_other_paper(file.paper, path)
    _refuse_calls(file, path, paper)
    studies = {
        name: Study(paper, name, model, config, "standard", None, file.readings)
        for name, model in file.studies.items()
    }
    if not file.figures:
        moving = {name: _moves(config, model) for name, model in file.studies.items()}
        every = default_figures(file.studies, moving, {n for n, one in studies.items() if limited(one)}) | {
            f"{name}_workable_hours": FigureModel(
                caption=f"{model.caption}: workable hours", reads=[name], plot="workable hours"
            )
            for name, model in file.seas.items()
        }
        figures = {name: one for name, one in every.items() if not [*faults(one, studies)]}
        return file.replaced(figures=figures)
    for name, figure in file.figures.items():
        for fault in faults(figure, studies):
            raise InputError(path, f"figures.{name}.{fault.path}", fault.found, fault.allowed)
    return file


def _with_models(tree: Any, path: Path, paper: str) -> Any:
    """The content of a study file, with checked models in place of the entries below ``measured``."""
    trees = tree.get("measured") if isinstance(tree, dict) else None
    if not isinstance(trees, dict):
        return tree
    return tree | {"measured": measured_models(path, paper, trees)}


def _refuse_calls(file: StudyFile, path: Path, paper: str) -> None:
    """Refuse derived datasets and figures whose functions do not exist or have other arguments."""
    for name, derived in file.derived.items():
        if defining(chapter_modules(paper, "derived"), name) is None:
            _refuse_absent(path, f"derived.{name}", paper)
            found = f"chapters/{paper}/derived.py defines no function {name}"
            raise InputError(path, f"derived.{name}", found, "define the function, or remove this entry")
        given = [*derived.reads, *derived.settings]
        refuse_arguments(path, f"derived.{name}", paper, "derived", name, given)
    for name, figure in file.figures.items():
        if figure.plot:
            continue
        if defining(chapter_modules(paper, "figures"), name) is None:
            _refuse_absent(path, f"figures.{name}", paper)
            found = f"the figure has no plot, and chapters/{paper}/figures.py defines no function {name}"
            raise InputError(path, f"figures.{name}", found, "add 'plot:' with one of " + ", ".join(NEEDS))
        given = [*figure.reads, *(figure.settings or {})]
        refuse_arguments(path, f"figures.{name}", paper, "figures", name, given)


def _refuse_absent(path: Path, field: str, paper: str) -> None:
    """Refuse a function of a chapter if the present folder has no chapters."""
    if not Path("chapters").is_dir():
        found = f"requires a function in chapters/{paper}, but the present folder has no chapters"
        raise InputError(path, field, found, "run the command in the folder that contains `chapters`")


def read_study(config: Path, paper: str, name: str, tier: Tier, accuracy: str | None) -> Study:
    """One study of a paper, by name."""
    file = read_studies(config, paper)
    return Study(paper, name, file.studies[name], config, tier, accuracy, file.readings)


def default_figures(
    studies: dict[str, StudyModel], moving: dict[str, bool], with_limits: set[str]
) -> dict[str, FigureModel]:
    """Figures of a study file without ``figures``: every plot that fits each of its grids.

    ``moving``: whether the runs of each study are dynamic. ``with_limits``: studies whose points have limits.
    """
    return {
        f"{name}_{plot.replace(' ', '_')}": FigureModel(
            caption=f"{model.caption}: {text}", reads=[name], plot=plot
        )
        for name, model in studies.items()
        for plot, text in _fitting(len(model.axes), moving[name], name in with_limits)
    }


def _fitting(axes: int, moving: bool, has_limits: bool) -> Iterator[tuple[Plot, str]]:
    if axes == 1:
        yield "lines", "extremes over the axis"
    if axes > 1:
        yield "heat map", "extremes over the axes"
    if axes and has_limits:
        yield "utilisation", "use of limits over the axes"
    yield "envelope", "envelopes along the riser" if moving else "state along the riser"
    if moving:
        yield "time series", "histories where they vary most"


def _moves(config: Path, model: StudyModel) -> bool:
    """Whether the runs of a study are dynamic."""
    file = scene_file(config / model.scene).with_values(model.set, "set")
    analysis = file.tree.get("analysis")
    return isinstance(analysis, dict) and analysis.get("duration") is not None
