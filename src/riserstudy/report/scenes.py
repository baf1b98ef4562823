"""Tables of the scenes of a figure: every value, its origin, and the inputs that are varied."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.grading.models import PrintedInput
from riserstudy.grading.printed import printed_as, printed_inputs
from riserstudy.records.units import after_number
from riserstudy.records.words import counted, listed
from riserstudy.report.set_by_options import set_by_options
from riserstudy.scene.origin import CALLED
from riserstudy.scene.paths import and_above, last_name, within_any
from riserstudy.study.axes import Numbers
from riserstudy.study.models import StudyFile
from riserstudy.study.study import scene_file

if TYPE_CHECKING:
    import xarray as xr

Printed = Callable[[str], list[PrintedInput]]  # the inputs that the file of a paper lists

MOST_PARTS = 12  # most parts of a list that is shown in full
FEW = 4  # of more datasets with the same value, the most frequent value names none


class Value(NamedTuple):
    """One value of a scene; ``where`` names the datasets in which it holds."""

    value: str
    status: str
    why: str
    where: str


class SceneTable(NamedTuple):
    """A scene: its title, the datasets that simulate it, the inputs they vary, and its values by path."""

    title: str
    datasets: list[str]
    varied: list[str]
    rows: list[tuple[str, list[Value]]]

    def anchor(self, paper: str) -> str:
        """Return its anchor on the page."""
        return f"scene-{paper}-{re.sub(r'[^a-z0-9]+', '-', self.title.lower()).strip('-')}"

    def studies(self, paper: str) -> set[str]:
        """Return the studies that simulate it, with their names in the database."""
        return {f"{paper}/{name}" for name in self.datasets}


def scene_tables(datasets: dict[str, xr.Dataset], file: StudyFile, config: Path) -> list[SceneTable]:
    """Return one table for each scene; datasets that set values of a common scene share its table."""
    inputs = cache(partial(printed_inputs, config))
    scenes: dict[str, dict[str, xr.Dataset]] = {}
    for name, dataset in datasets.items():
        title = json.loads(dataset.attrs["scene"])["title"]
        scenes.setdefault(title, {})[name] = dataset
    return [_table(title, members, file, config, inputs) for title, members in scenes.items()]


def _table(
    title: str, datasets: dict[str, xr.Dataset], file: StudyFile, config: Path, inputs: Printed
) -> SceneTable:
    values = {name: _values(name, dataset, file, config, inputs) for name, dataset in datasets.items()}
    paths = dict.fromkeys(path for parameters in values.values() for path in parameters)
    rows = []
    for path in paths:
        by_value: dict[tuple[str, str, str], list[str]] = {}
        for name, parameters in values.items():
            by_value.setdefault(parameters.get(path, ("no value", "absent", "")), []).append(name)
        rows.append((path, [Value(*v, w) for v, w in _where(by_value).items()]))
    varied = dict.fromkeys(
        f"In the dataset {name}, {text}" for name, dataset in datasets.items() for text in _varied(dataset)
    )
    return SceneTable(title, list(datasets), list(varied), rows)


def _where(by_value: dict[tuple[str, str, str], list[str]]) -> dict[tuple[str, str, str], str]:
    """Return in words in which datasets each value of a path holds; the value of most of many comes last."""
    most = max(by_value, key=lambda value: len(by_value[value]))
    if len(by_value) == 1:
        return {most: "all"}
    words = {value: listed(names) for value, names in by_value.items()}
    if len(by_value[most]) > FEW:
        del words[most]
        words[most] = "all others"
    return words


def _values(
    name: str, dataset: xr.Dataset, file: StudyFile, config: Path, inputs: Printed
) -> dict[str, tuple[str, str, str]]:
    """Return value, status and evidence of every path of a dataset's scene."""
    of = set_by_options(dataset)
    tree, origins = of.file.tree, of.file.origins
    listed = inputs(tree["paper"]) if tree.get("paper") else []
    plain = "published" if tree.get("paper") else "given"
    study = file.studies[name]
    written = flat(scene_file(config / study.scene).tree)
    numbers = {label: axis for label, axis in study.axes.items() if isinstance(axis, Numbers)}
    varied = {path: axis for path in flat(tree) if (axis := of.varied_by(path))}
    varied |= {path: label for label, axis in numbers.items() for path in axis.paths}
    values = {}
    for path, value in flat(tree).items():
        if last_name(path) in CALLED:
            continue
        origin = next((origins[place] for place in and_above(path) if place in origins), None)
        printed = printed_as(listed, path, value)
        if path in varied:
            values[path] = ("varied", "axis", varied[path])
        elif origin is not None:
            values[path] = (value, origin.status, origin.why or "")
        elif alone := of.axis_of_one(path):
            values[path] = (value, "axis", alone)
        elif printed is not None:
            values[path] = (value, plain, printed.where)
        elif within_any(path, study.on_top):
            values[path] = (value, "chosen", "set by the study")
        elif path not in written:
            values[path] = (value, "chosen", f"set by the tier {dataset.attrs['tier']}")
        else:
            values[path] = (value, plain, "")
    return values


def flat(tree: Any, path: str = "") -> dict[str, str]:
    """Return a nested scene as one value per path; short lists stay whole."""
    if isinstance(tree, dict):
        parts = [(f"{path}.{key}" if path else key, value) for key, value in tree.items()]
    elif isinstance(tree, list) and len(tree) > MOST_PARTS:
        return {path: f"{len(tree)} entries"}
    elif isinstance(tree, list) and any(isinstance(value, dict) for value in tree):
        parts = [(f"{path}[{k}]", value) for k, value in enumerate(tree)]
    else:
        text = ", ".join(map(_in_words, tree)) if isinstance(tree, list) else _in_words(tree)
        return {path: text}
    joined: dict[str, str] = {}
    for below, value in parts:
        joined |= flat(value, below)
    return joined


def _in_words(value: Any) -> str:
    """Return a value of a scene in words: None becomes "none", True and False become "yes" and "no"."""
    plain = {None: "none", True: "yes", False: "no"}
    return plain[value] if value is None or isinstance(value, bool) else str(value)


def _varied(dataset: xr.Dataset) -> list[str]:
    """Return the axes of a dataset in words."""
    words = []
    for axis in dataset["point_key"].dims:
        values = dataset[axis].values
        name = str(axis).replace("_", " ")
        if values.dtype.kind == "f":
            of = str(dataset[axis].attrs.get("units", ""))
            two = len(values) == 2
            ends = (" and " if two else " to ").join(
                dict.fromkeys((f"{values.min():g}", f"{values.max():g}"))
            )
            has = {1: "the value", 2: "the values"}.get(len(values), f"{len(values)} values, from")
            words.append(f"“{name}” has {has} {ends}{after_number(of)}.")
        elif values.dtype.kind in "iu":
            are = "is" if len(values) == 1 else "are"
            words.append(f"{counted(len(values), 'sample')} of the unspecified inputs {are} simulated.")
        else:
            options = "; ".join(f"“{value}”" for value in values)
            has = "is" if len(values) == 1 else f"has {len(values)} options:"
            words.append(f"“{name}” {has} {options}.")
    return words
