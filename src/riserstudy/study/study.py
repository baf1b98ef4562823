"""A study of a tier: a scene and the axes of its variation, planned without numpy."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import combinations, product
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError
from riserstudy.files.cache import remembered
from riserstudy.files.digests import dependencies, digest, engine_digest
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.origin import Origin, unwrap
from riserstudy.scene.paths import as_name, last_name, meets, within_any
from riserstudy.scene.replaced_values import set_later
from riserstudy.scene.tables import names_of_tables, texts_of_tables
from riserstudy.simulation.kernel_groups import group_of, group_of_modes
from riserstudy.study.axes import MOST_VALUES, Labels, Numbers, Samples, Tier
from riserstudy.study.grid import Grid, Index, Point
from riserstudy.study.store import canonical, key_of
from riserstudy.study.study_model import StudyModel, TuneAt

# number of points for tuning; number of points of a study below which one point is used
TUNED_AT, FEW = 12, 1000
ALL_OF = 16  # number of values of an axis up to which every value is examined for its kernels


def scene_file(path: Path) -> SceneFile:
    """A scene file, reread only if it has changed, because many studies share one scene."""
    try:
        stamp = path.stat().st_mtime_ns
    except OSError:
        stamp = 0  # reading the file then raises the error
    return _scene_file(path, stamp)


@cache
def _scene_file(path: Path, stamp: int) -> SceneFile:
    return read_scene(path, keep=True)


@dataclass(frozen=True)
class Study:
    """A study of a tier, ready to be planned."""

    paper: str
    name: str
    model: StudyModel
    config: Path
    tier: Tier
    accuracy: str | None = None
    readings: dict[str, Labels] = field(default_factory=dict)
    estimates: bool = True  # whether runs on a prescribed mesh estimate their errors
    # largest errors (1) by quantity, of all points of the study that this is a part of; None: of its points
    largest_errors: Mapping[str, float] | None = None

    @cached_property
    def base(self) -> SceneFile:
        """The scene with the values that the study sets."""
        path = self.config / self.model.scene
        file = scene_file(path).with_values(self.model.on_top, f"{self.where}.set")
        if self.tier == "preview":
            file = file.with_values(self.model.preview, f"{self.where}.preview")
        analysis = file.tree.get("analysis", {})
        if self.accuracy and not ({"mesh", "step", "accuracy"} & set(analysis)):
            file = file.with_values({"analysis.accuracy": self.accuracy}, "config/config.yaml: tiers")
        return file

    @property
    def where(self) -> str:
        """Name of the study in errors."""
        return f"config/studies/{self.paper}.yaml: studies.{self.name}"

    @cached_property
    def axes(self) -> dict[str, list[tuple[Any, dict[str, Any]]]]:
        """For each axis, its coordinate values, each with the values that it sets.

        Raises InputError when samples leave an assumption that the scene does not have.
        """
        axes: dict[str, list[tuple[Any, dict[str, Any]]]] = {}
        for name, axis in self.model.axes.items():
            if isinstance(axis, Numbers):
                axes[name] = [(x, axis.overrides(x)) for x in axis.numbers(self.tier)]
            elif isinstance(axis, Samples):
                self._refuse_unknown(axis.leave, name)
                axes[name] = list(enumerate(self._samples(axis)))
            elif axis == "readings":
                axes[name] = list(self.readings[name].items())
            else:
                axes[name] = list(axis.items())
        return axes

    @property
    def _sets(self) -> list[list[dict[str, Any]]]:
        """For each axis, the values that each of its values sets."""
        return [[sets for _, sets in steps] for steps in self.axes.values()]

    def place(self, index: Index) -> str:
        """A point by its value on each axis, with the unit: ``offset = 10 m, current = half``."""
        words = []
        for (name, values), k in zip(self.axes.items(), index, strict=True):
            axis, value = self.model.axes[name], values[k][0]
            number = f"{value:g}" if isinstance(value, float) else f"{value}"
            unit = f" {axis.unit}" if isinstance(axis, Numbers) and axis.unit != "1" else ""
            words.append(f"{name} = {number}{unit}")
        return ", ".join(words)

    def assumed(self, axis: Samples) -> list[dict[str, Any]]:
        """The assumptions of each sample: values by path of the scene, and interpretations by name.

        Raises InputError when an interpretation has the name of the variable of another assumption.
        """
        from riserstudy.study.sampling import sample

        open_values = {p: o for p, o in self.open_assumptions.items() if p not in axis.leave}
        for name in axis.readings:
            labels = tuple(self.readings[name])
            open_values[name] = Origin("assumed", labels[0], options=labels)
        names: dict[str, str] = {}
        for path in open_values:
            if (other := names.setdefault(as_name(path), path)) != path:
                found = f"{other!r} and {path!r} would both be named assumed_{as_name(path)} in results"
                raise InputError(self.where, "axes", found, "give one of them another name")
        return sample(open_values, axis.count[self.tier], axis.seed)

    def _refuse_unknown(self, leave: list[str], axis: str) -> None:
        """Refuse assumptions to leave out that the scene does not have, since all would be varied."""
        assumed = {*self.base.assumed, *self.model.preview}
        if unknown := [path for path in leave if path not in assumed]:
            allowed = f"use one of {', '.join(sorted(self.open_assumptions))}"
            found = f"{unknown[0]!r} is not an assumption of the scene"
            raise InputError(self.where, f"axes.{axis}.leave", found, allowed)

    def _samples(self, axis: Samples) -> list[dict[str, Any]]:
        """Values that each sample sets; those of an interpretation replace assumptions at and below them."""
        samples = []
        for values in self.assumed(axis):
            sets = {path: value for path, value in values.items() if path not in axis.readings}
            for name in axis.readings:
                sets = set_later(sets, self.readings[name][values[name]])
            samples.append(sets)
        return samples

    @property
    def open_assumptions(self) -> dict[str, Origin]:
        """Assumptions of the scene that have a range or options."""
        return {
            path: origin
            for path, origin in self.base.origins.items()
            if origin.status == "assumed" and (origin.range or origin.options)
        }

    @cached_property
    def grid(self) -> Grid:
        """The scenes of all points. Raises InputError when there are too many."""
        axes = self._sets
        if (points := math.prod(map(len, axes))) > MOST_VALUES:
            found = f"the axes give {points} points"
            raise InputError(self.where, "axes", found, f"give at most {MOST_VALUES} points")
        return Grid(self.base, axes, self.where)

    @cached_property
    def plan(self) -> list[Point]:
        """All points, checked; InputError if one is invalid.

        Checking 40 000 points takes ten seconds, so the result is cached by all inputs that it depends on.
        """
        keys = remembered(f"plans/{self.plan_digest}", lambda: [p.key for p in self.grid.points()])
        every = product(*(range(len(axis)) for axis in self.grid.axes))
        return [Point(index, key) for index, key in zip(every, keys, strict=True)]

    @cached_property
    def end_keys(self) -> frozenset[str]:
        """Keys of the first and the last point, in a preview only of the last.

        Points that differ only in limits have equal keys.
        """
        ends = self.grid.ends[1:] if self.tier == "preview" else self.grid.ends
        return frozenset(key_of(self.grid.file(index).resolved()) for index in ends)

    @cached_property
    def kernel_groups(self) -> list[str]:
        """Groups of kernels that its points need, from scenes with the value of one axis changed."""

        def find_groups() -> list[str]:
            lengths = [len(axis) for axis in self.grid.axes]
            ends = [range(n) if n <= ALL_OF else (n - 1,) for n in lengths]
            scenes = [self.grid.file(place).resolved() for place in self.grid.near_first(ends)]
            kinds = [group_of, *([group_of_modes] if self.model.modes else [])]
            return sorted({group(scene) for group in kinds for scene in scenes})

        modes = "-modes" if self.model.modes else ""
        return list(remembered(f"groups{modes}/{self.plan_digest}", find_groups))

    @property
    def tuned_at(self) -> tuple[int, int]:
        """Number of points for tuning (one for a small study), and the seed of their draw."""
        at = self.model.settings
        if isinstance(at, TuneAt):
            return at.points, at.seed
        return 1 if len(self.grid) < FEW else TUNED_AT, 1

    @property
    def tables(self) -> dict[str, str]:
        """Texts of the tables that its scenes refer to, by name."""
        folder, held = Path(self.base.source).parent, self.base.held
        return texts_of_tables([self.base.tree, *self._set_trees], folder, held)

    @property
    def plan_digest(self) -> str:
        """Digest of scene, axes, their tables, and the code that checks them."""
        code = [engine_digest(), digest(dependencies(Grid.__module__))]
        about = [code, canonical(self.base.tree), canonical(self._sets), self._contents_of_tables]
        return hashlib.sha256(json.dumps(about).encode()).hexdigest()[:32]

    @property
    def _contents_of_tables(self) -> dict[str, str]:
        """Digests of the tables that its scenes refer to, by name."""
        folder, held = Path(self.base.source).parent, self.base.held
        names = sorted({*names_of_tables([self.base.tree, *self._set_trees])})
        return {name: _content(folder, name, held) for name in names}

    @property
    def _set_trees(self) -> Iterator[dict[str, Any]]:
        """Values that values of axes set, without their origins, each below the last name of its path.

        The last name may be ``file``, as in ``current.profile.file``.
        """
        for axis in self._sets:
            for sets in axis:
                yield from ({last_name(path): unwrap(value)[0]} for path, value in sets.items())

    def shard(self, number: int, shards: int) -> list[Point]:
        """Points of one of several jobs, spread over the grid; a job does not plan the points of others.

        ``number``: number of the job, counted from 1.
        """
        if "plan" in self.__dict__:
            return self.plan[number - 1 :: shards]
        return list(self.grid.points(number - 1, shards))

    @cached_property
    def digest(self) -> str:
        """A text that changes with every input of the dataset.

        Keys of points exclude limits, titles, notes and origins, which change no run. The dataset contains
        them, though, and limits determine its verdicts. The digest therefore includes the values of axes as
        written.
        """
        model = self.model
        axes = [[name, self._about_axis(name)] for name in self.axes]
        origins = {path: (o.status, o.why) for path, o in self.base.origins.items()}
        about = [axes, [point.key for point in self.plan], model.keep, model.error_because]
        about += [self.tier, model.caption, self.base.source, canonical(self.base.tree), origins]
        about += [self._contents_of_tables, model.modes, model.settings and self.tuned_at]
        return hashlib.sha256(json.dumps(about, sort_keys=True).encode()).hexdigest()[:16]

    def _about_axis(self, name: str) -> list[Any]:
        """Attributes of an axis: its unit, and the inputs that each value sets or each sample assumes."""
        axis = self.model.axes[name]
        if isinstance(axis, Samples):
            return [canonical(self.axes[name]), canonical(self.assumed(axis))]
        unit = axis.unit if isinstance(axis, Numbers) else ""
        return [unit, canonical([[value, _in_order(sets)] for value, sets in self.axes[name]])]


def set_by_all(steps: list[tuple[Any, dict[str, Any]]], path: str) -> bool:
    """Whether every value of an axis sets a path, or a part of the scene that contains it."""
    return all(within_any(path, sets) for _, sets in steps)


def _in_order(sets: dict[str, Any]) -> Any:
    """Values that a value of an axis sets; their order is kept, because one path may be below another."""
    return [*sets.items()] if any(meets(*two) for two in combinations(sets, 2)) else sets


def _content(folder: Path, name: str, held: Mapping[str, str] | None) -> str:
    """Digest of a table; "" if it cannot be read as one, which planning reports."""
    try:
        (text,) = texts_of_tables({"file": name}, folder, held).values()
    except InputError:
        return ""
    return hashlib.sha256(text.encode()).hexdigest()


def settings_path(results: Path, paper: str, study: str) -> Path:
    """Path of the file with the tuned settings of a study."""
    return results / paper / f"{study}.settings.json"


def threads_worth(points: int) -> int:
    """Number of useful threads for a study; with few points, other studies run in parallel instead."""
    return max(1, min(8, math.ceil(points / 32)))
