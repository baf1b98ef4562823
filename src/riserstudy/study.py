"""Studies: a scene and the axes it is varied along; planned without numpy, gathered into a dataset."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from riserstudy.errors import InputError
from riserstudy.folders import has_module
from riserstudy.grid import Grid, Point
from riserstudy.numerics.models import Measured
from riserstudy.plots import NEEDS, FigureModel, default_figures
from riserstudy.scene.base import Strict
from riserstudy.scene.check import check
from riserstudy.scene.load import SceneFile, read_scene, read_yaml
from riserstudy.scene.origin import Origin, unwrap
from riserstudy.shown import RunInMotion, SchematicModel
from riserstudy.store import canonical

MOST_VALUES = 1_000_000  # of an axis, and points of a study
#: of papers, datasets and figures, which name files
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,99}$")]
#: of axes, which name dimensions and variables of datasets
AxisName = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,99}$")]
TIERS = ("preview", "standard", "reference")
Tier = Literal["preview", "standard", "reference"]


class Steps(Strict):
    """Evenly spaced values, both ends included."""

    start: float
    stop: float
    step: Annotated[float, Field(gt=0)]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if not 0.0 <= self.stop - self.start <= MOST_VALUES * self.step:
            raise ValueError(f"stop must lie above start, by {MOST_VALUES} steps at most")
        return self

    @property
    def values(self) -> list[float]:
        """The values, free of rounding drift."""
        count = round((self.stop - self.start) / self.step)
        return [round(self.start + k * self.step, 12) for k in range(count + 1)]


class Numbers(Strict):
    """An axis of numbers put at a path of the scene, or at several, with a unit ("1": none).

    On the way a number is multiplied by ``factor`` and ``offset`` is added, where the axis counts in
    another direction or from elsewhere than the path. Absent: as it is.
    """

    path: str | Annotated[list[str], Field(min_length=1)]
    unit: str
    factor: float | None = None
    offset: float | None = None
    values: list[float] | Steps
    preview: list[float] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        numbers = self.numbers("standard")
        if not numbers or len(set(numbers)) != len(numbers):
            raise ValueError("values: must be there, each once")
        if self.preview and not set(self.preview) <= set(numbers):
            raise ValueError("preview: must be some of the values")
        return self

    def numbers(self, tier: Tier) -> list[float]:
        """Values of a tier."""
        every = self.values.values if isinstance(self.values, Steps) else self.values
        return self.preview if tier == "preview" and self.preview else every

    @property
    def paths(self) -> list[str]:
        """Where its numbers are put."""
        return [self.path] if isinstance(self.path, str) else self.path

    def overrides(self, number: float) -> dict[str, Any]:
        """What a value sets."""
        value = number if self.factor is None else number * self.factor
        value += self.offset or 0.0
        text = value if self.unit == "1" else f"{value!r} {self.unit}"
        return dict.fromkeys(self.paths, text)


class Samples(Strict):
    """An axis of samples: every assumption of the scene varied over its range or options at once.

    ``readings`` names readings of the study file that are varied with them, each with equal chance.
    """

    count: dict[Tier, Annotated[int, Field(ge=2, le=MOST_VALUES)]]
    seed: Annotated[int, Field(ge=0)]
    leave: list[str] = Field(default_factory=list)
    readings: list[str] = Field(default_factory=list)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if missing := [tier for tier in TIERS if tier not in self.count]:
            raise ValueError(f"count: no number for {missing[0]}")
        return self


class Derived(Strict):
    """A dataset derived from studies: those that it reads, and what its function is told besides.

    What it is told may say where it comes from, as values of scenes do: ``assumed`` with a range and why.
    """

    reads: list[str]
    settings: dict[str, Any] = Field(default_factory=dict, alias="with")

    @model_validator(mode="after")
    def _origins_are_whole(self) -> Self:
        for path, found, allowed in unwrap(self.settings)[2]:
            raise ValueError(f"with.{path}: {found}; {allowed}")
        return self


def _bare(value: Any) -> Any:
    """A bare list is what a derived dataset reads."""
    return {"reads": value} if isinstance(value, list) else value


Reads = Annotated[Derived, BeforeValidator(_bare, json_schema_input_type=list[str] | Derived)]


Labels = Annotated[dict[str, dict[str, Any]], Field(min_length=1)]
#: an axis over all readings of that name in the study file
Reading = Literal["readings"]


class StudyModel(Strict):
    """One study. Absent set: nothing set on top of the scene; absent keep: all histories are kept."""

    scene: str
    caption: str
    set: dict[str, Any] = Field(default_factory=dict)
    axes: dict[AxisName, Numbers | Samples | Labels | Reading]
    keep: list[str] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if Path(self.scene).is_absolute() or ".." in Path(self.scene).parts:
            raise ValueError("scene: must lie below the folder of the configuration")
        return self


class StudyFile(Strict):
    """Studies of one paper, datasets derived from them, and the figures that read them.

    ``readings``: named ways to read the paper, by what each sets; studies share them as axes or samples.
    ``measured``: datasets about the engine itself; ``in_motion``: the run that the report shows moving;
    ``left_out``: printed figures that are not drawn, and what they show. Absent: none. Absent figures:
    every plot that fits.
    """

    paper: str
    readings: dict[str, Labels] = Field(default_factory=dict)
    studies: dict[Name, StudyModel]
    derived: dict[Name, Reads] = Field(default_factory=dict)
    measured: Measured | None = None
    schematics: dict[Name, SchematicModel] = Field(default_factory=dict)
    figures: dict[Name, FigureModel] = Field(default_factory=dict)
    in_motion: RunInMotion | None = None
    left_out: dict[str, str] = Field(default_factory=dict)

    @property
    def datasets(self) -> list[str]:
        """Names of all datasets: simulated, derived and measured."""
        return [*self.studies, *self.derived, *(self.measured.names if self.measured else [])]


def scene_file(path: Path) -> SceneFile:
    """A scene file, read once as long as it stays the same: many studies share one."""
    try:
        stamp = path.stat().st_mtime_ns
    except OSError:
        stamp = 0  # reading it tells what is wrong
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

    @cached_property
    def base(self) -> SceneFile:
        """The scene with what the study sets on top of it."""
        path = self.config / self.model.scene
        file = scene_file(path).with_values(self.model.set, f"{self.where}.set")
        analysis = file.tree.get("analysis", {})
        if self.accuracy and not ({"mesh", "step", "accuracy"} & set(analysis)):
            file = file.with_values({"analysis.accuracy": self.accuracy}, "config.yaml")
        return file

    @property
    def where(self) -> str:
        """How errors name the study."""
        return f"config/studies/{self.paper}.yaml: studies.{self.name}"

    @cached_property
    def axes(self) -> dict[str, list[tuple[Any, dict[str, Any]]]]:
        """Per axis the coordinate values and what each sets."""
        axes: dict[str, list[tuple[Any, dict[str, Any]]]] = {}
        for name, axis in self.model.axes.items():
            if isinstance(axis, Numbers):
                axes[name] = [(x, axis.overrides(x)) for x in axis.numbers(self.tier)]
            elif isinstance(axis, Samples):
                axes[name] = list(enumerate(self._samples(axis)))
            elif axis == "readings":
                axes[name] = list(self.readings[name].items())
            else:
                axes[name] = list(axis.items())
        return axes

    def assumed(self, axis: Samples) -> list[dict[str, Any]]:
        """What each sample assumes: values by path of the scene, and readings by name."""
        from riserstudy.assumptions import sample

        open_values = {p: o for p, o in self.open_assumptions.items() if p not in axis.leave}
        for name in axis.readings:
            labels = tuple(self.readings[name])
            open_values[name] = Origin("assumed", labels[0], options=labels)
        return sample(open_values, axis.count[self.tier], axis.seed)

    def _samples(self, axis: Samples) -> list[dict[str, Any]]:
        """What each sample sets."""
        samples = []
        for values in self.assumed(axis):
            sets = {path: value for path, value in values.items() if path not in axis.readings}
            for name in axis.readings:
                sets |= self.readings[name][values[name]]
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
        """The scenes of all points.

        Raises
        ------
        InputError
            When there are too many.
        """
        axes = [[sets for _, sets in steps] for steps in self.axes.values()]
        if (points := math.prod(map(len, axes))) > MOST_VALUES:
            raise InputError(self.where, "axes", f"{points} points", f"allowed are {MOST_VALUES}")
        return Grid(self.base, axes, self.where)

    @cached_property
    def plan(self) -> list[Point]:
        """All points, checked; InputError when one cannot be meant."""
        return list(self.grid.points())

    def shard(self, number: int, shards: int) -> list[Point]:
        """Points of one of several jobs, spread over the grid; a job does not plan those of others."""
        if "plan" in self.__dict__:
            return self.plan[number::shards]
        return list(self.grid.points(number, shards))

    @cached_property
    def digest(self) -> str:
        """One string that changes when anything that the dataset depends on changes.

        Titles, origins and captions change no number, but stand in the dataset.
        """
        axes = {name: [value for value, _ in values] for name, values in self.axes.items()}
        about = [canonical(axes), [point.key for point in self.plan], self.model.keep]
        origins = {path: (o.status, o.why) for path, o in self.base.origins.items()}
        about += [self.tier, self.model.caption, canonical(self.base.tree), origins]
        return hashlib.sha256(json.dumps(about).encode()).hexdigest()[:16]


def read_studies(config: Path, paper: str) -> StudyFile:
    """The checked study file of a paper."""
    path = config / "studies" / f"{paper}.yaml"
    file = check(StudyFile, read_yaml(path, keep=True), path)
    for name, model in file.studies.items():
        for axis_name, axis in model.axes.items():
            wanted = axis.readings if isinstance(axis, Samples) else []
            for reading in [axis_name] if axis == "readings" else wanted:
                if reading not in file.readings:
                    where = f"studies.{name}.axes.{axis_name}"
                    raise InputError(path, where, f"no readings {reading!r}", _among(file.readings))
    if file.in_motion and file.in_motion.study not in file.studies:
        found = f"no study {file.in_motion.study!r}"
        raise InputError(path, "in_motion.study", found, _among(file.studies))
    if twice := set(file.schematics) & set(file.figures):
        raise InputError(path, f"schematics.{min(twice)}", "a figure of that name", "name it anew")
    known = set(file.datasets)
    if file.derived and not has_module("derived", paper):
        raise InputError(path, "derived", f"no module derived/{paper}.py", "leave it out")
    for name, derived in file.derived.items():
        for study in derived.reads:
            if study not in file.studies:
                raise InputError(
                    path, f"derived.{name}", f"no study {study!r}", _among(file.studies)
                )
    for name, figure in file.figures.items():
        if not figure.plot and not has_module("figures", paper):
            allowed = "allowed are plot: " + ", ".join(NEEDS)
            raise InputError(path, f"figures.{name}", "nothing says how to draw it", allowed)
        for study in figure.reads:
            axes = file.studies[study].axes if study in file.studies else None
            if figure.plot and axes is not None and len(axes) < (least := NEEDS[figure.plot]):
                has = f"{study!r} has {len(axes)} axes"
                raise InputError(path, f"figures.{name}.plot", has, f"allowed are {least} or more")
            if study not in known:
                raise InputError(
                    path, f"figures.{name}.reads", f"no dataset {study!r}", _among(known)
                )
    if not file.figures:
        moving = {name: _moves(config, model) for name, model in file.studies.items()}
        file = file.model_copy(update={"figures": default_figures(file.studies, moving)})
    return file


def _moves(config: Path, model: StudyModel) -> bool:
    """Whether the runs of a study have a time."""
    file = scene_file(config / model.scene).with_values(model.set, "set")
    analysis = file.tree.get("analysis")
    return isinstance(analysis, dict) and analysis.get("duration") is not None


def _among(names: Any) -> str:
    return "allowed are " + ", ".join(sorted(names))


def study(config: Path, paper: str, name: str, tier: Tier, accuracy: str | None) -> Study:
    """One study of a paper, by name."""
    file = read_studies(config, paper)
    return Study(paper, name, file.studies[name], config, tier, accuracy, file.readings)


def threads_worth(points: int) -> int:
    """Threads that a study of so many points can use; beside few points another study does more good."""
    return max(1, min(8, math.ceil(points / 32)))
