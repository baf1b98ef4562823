"""config/studies/<paper>.yaml as models: studies and their axes, derived datasets, figures and schematics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from graphlib import CycleError, TopologicalSorter
from itertools import combinations
from pathlib import Path, PureWindowsPath
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from riserstudy.dataset.variables import DIMENSIONS, OF_MODES, OF_RUNS, about_points, of_points, of_runs
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.origin import unwrap
from riserstudy.scene.paths import within
from riserstudy.study.axes import Axis, AxisName, Labels, Numbers, Samples, Sets
from riserstudy.study.figures import NEEDS, OF_SEAS, FigureModel
from riserstudy.study.measured import MeasuredModel
from riserstudy.study.seas_model import OUTSIDE, SeasModel

MOST_MODES = 1000
#: settings of the analysis that may be coarser in a preview
SETTINGS = ("analysis.accuracy", "analysis.mesh", "analysis.method", "analysis.step")
RENAME = "give one of them another name"
NEW_NAME = "give the axis another name"
#: names of papers, datasets and figures, which become names of files
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,99}$")]


class Derived(Strict):
    """A dataset derived from others: the studies and derived datasets that it reads, and further arguments.

    Arguments may state their origin, like values of scenes: ``assumed`` with a range and a reason, or
    ``{printed: N1}`` for a published value of the paper.
    """

    reads: list[str]
    settings: dict[str, Any] = Field(default_factory=dict, alias="with")

    @model_validator(mode="after")
    def _origins_are_whole(self) -> Self:
        for path, fault, allowed in unwrap(self.settings)[2]:
            raise Misfit(f"with.{path}", f"{fault}", allowed)
        return self


def _bare(value: Any) -> Any:
    """Read a bare list as the datasets that a derived dataset reads."""
    return {"reads": value} if isinstance(value, list) else value


Reads = Annotated[Derived, BeforeValidator(_bare, json_schema_input_type=list[str] | Derived)]


class TunedModel(Strict):
    """How `riserstudy tune` found mesh, time step and method of a study, with their error and cost.

    ``accuracy``: the tolerance. ``points``: number of points for tuning; ``held_out``: number of other points
    for the check. ``error``: largest error at all these points, divided by the tolerance. ``work``: segments
    times Newton iterations, divided by the same product for runs with the tolerance at each point.
    """

    accuracy: str
    on: str
    points: Annotated[int, Field(ge=1)]
    held_out: Annotated[int, Field(ge=0)]
    seed: Annotated[int, Field(ge=0)]
    error: Annotated[float, Field(ge=0)]
    work: Annotated[float, Field(gt=0)]


class TuneAt(Strict):
    """Number of points at which a job tunes mesh, step and method of a study, and the seed of their draw."""

    points: Annotated[int, Field(ge=2, le=256)]
    seed: Annotated[int, Field(ge=0)]


class StudyModel(Strict):
    """One study. Without ``set``, the scene is not changed; without ``keep``, all histories are kept.

    ``limits``: limits for every point, as in scenes; absent: the limits of the scene. ``preview``: coarser
    settings of the analysis for the preview tier, by path; absent: as in other tiers. ``modes``: number of
    natural modes for each point, about its static equilibrium; absent: none. ``error_because``: reason why
    points with a prescribed mesh and step may have an error of more than 1 %. ``settings``: ``tuned``, or the
    points for tuning: a job tunes mesh, step and method to the tolerance, and all points are run with them;
    absent: as in the scene and ``set``. ``tuned``: record of `riserstudy tune` about mesh, step and method
    that it wrote. Absent: none.
    """

    scene: str
    caption: str
    set: Sets = Field(default_factory=dict)
    preview: Sets = Field(default_factory=dict)
    limits: Annotated[list[dict[str, Any]], Field(min_length=1)] | None = None
    axes: dict[AxisName, Axis]
    keep: list[str] | None = None
    modes: Annotated[int, Field(ge=1, le=MOST_MODES)] | None = None
    error_because: str | None = None
    settings: Literal["tuned"] | TuneAt | None = None
    tuned: TunedModel | None = None

    @property
    def on_top(self) -> dict[str, Any]:
        """Values that the study sets in the scene, limits included."""
        return self.set | ({"limits": self.limits} if self.limits else {})

    @property
    def _numbers(self) -> dict[str, list[str]]:
        """Paths that axes of numbers set, by axis."""
        return {name: axis.paths for name, axis in self.axes.items() if isinstance(axis, Numbers)}

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if PureWindowsPath(self.scene).anchor or ".." in PureWindowsPath(self.scene).parts:
            raise Misfit("scene", *OUTSIDE)
        if "\\" in self.scene:
            found = "the path contains a backslash"
            raise Misfit("scene", found, "write / between folders, also on Windows")
        for name in self.keep or []:
            if not of_runs(name):
                allowed = "use " + ", ".join(sorted(OF_RUNS)) + ", each also with an ending such as _max"
                raise Misfit("keep", f"{name!r} is not an output of a run", allowed)
        if self.settings and self.tuned:
            raise Misfit("settings", "settings and tuned are both given", "remove one of them")
        self._only_coarser()
        if self.limits and any(within(path, "limits") for path in self.set):
            raise Misfit("limits", "'set' of the study also sets limits", "remove one of the two")
        for name in self.axes:
            ours = name in DIMENSIONS or name in about_points()
            if ours or of_runs(name) or name.endswith(("_of_limit", "_of_statistic")):
                raise Misfit(f"axes.{name}", "this is also the name of an output", NEW_NAME)
            if self.modes and name in OF_MODES:
                raise Misfit(f"axes.{name}", "this is also the name of an output of modes", NEW_NAME)
            if name.startswith("assumed_"):
                found = "names that start with 'assumed_' are reserved for samples"
                raise Misfit(f"axes.{name}", found, NEW_NAME)
        for (one, first), (other, second) in combinations(self._numbers.items(), 2):
            for path in first:
                if any(meets(path, own) for own in second):
                    found = f"sets {path!r}, which axis {one!r} also sets"
                    raise Misfit(f"axes.{other}", found, "give each axis a different path")
        self._keep_apart()
        return self

    def _only_coarser(self) -> None:
        """Refuse preview settings that change more than the analysis, or that an axis would replace."""
        for path in self.preview:
            if not any(within(path, setting) for setting in SETTINGS):
                allowed = "set only " + ", ".join(SETTINGS)
                raise Misfit("preview", f"sets {path!r}, which is not a setting of the analysis", allowed)
            for name, axis in self.axes.items():
                if any(meets(path, own) for own in _paths_of(axis)):
                    found = f"sets {path!r}, which axis {name!r} also sets"
                    raise Misfit("preview", found, f"remove {path!r} from preview")

    def _keep_apart(self) -> None:
        """Refuse labels that replace a value which an earlier axis sets.

        Labels may remove a part explicitly, such as ``wave: null``.
        """
        before: dict[str, str] = {}
        for name, axis in self.axes.items():
            if isinstance(axis, Numbers):
                before |= dict.fromkeys(axis.paths, f"axis {name!r} has its numbers")
                continue
            labels = axis.items() if isinstance(axis, dict) else ()
            put = [(label, path) for label, sets in labels for path in sets if sets[path] is not None]
            for label, path in put:
                for own, there in before.items():
                    if own == path or own.startswith((f"{path}.", f"{path}[")):
                        found = f"sets {path!r}, where {there}"
                        allowed = f"put axis {name!r} first, or set the path in one of the two axes only"
                        raise Misfit(f"axes.{name}.{label}", found, allowed)
            before |= {path: f"axis {name!r} has its own" for _, path in put}


def _paths_of(axis: Axis) -> Iterable[str]:
    """Paths of the scene that values of an axis set, if the study file states them."""
    if isinstance(axis, Numbers):
        return axis.paths
    return {path for sets in axis.values() for path in sets} if isinstance(axis, dict) else ()


def meets(one: str, other: str) -> bool:
    """Whether two paths of a scene are equal, or one is below the other."""
    short, long = sorted((one, other), key=len)
    return long == short or long.startswith((f"{short}.", f"{short}["))


class SchematicModel(Strict):
    """A scene drawn to scale, with the changes in ``set``. Absent: no changes.

    ``cylinders``: whether tensioners without an arrangement are drawn hanging from the platform above the
    ring, or standing on it below the ring; the equations are the same. Absent: hanging. ``remarks``: text
    after the labels of parts, by path. Absent: none.
    """

    caption: str
    scene: str
    set: Sets = Field(default_factory=dict)
    cylinders: Literal["hanging", "standing"] = "hanging"
    remarks: dict[str, str] = Field(default_factory=dict)

    def file(self, config: Path) -> SceneFile:
        """The scene to draw."""
        return read_scene(config / self.scene).with_values(self.set, "schematics.set")


class RunInMotion(Strict):
    """A run that the report shows in motion, by its point on the axes, and the quantity of the colours."""

    study: str
    at: dict[str, str | float] = Field(default_factory=dict)
    colour: Literal["bending_moment", "effective_tension"]


class StudyFile(Strict):
    """Studies of one paper, datasets derived from them, and the figures that read them.

    ``title``, ``reference``, ``about``: short name, full reference and description of the paper, for the
    report. ``finding``: the published value or claim that the report gives first. Absent: the title is the
    name of the file, and the others are omitted. ``readings``: named interpretations of the paper, by the
    values that each sets; studies use them as axes or samples. ``seas``: datasets of workable hours of a
    record of sea states. ``measured``: datasets that code of the chapter measures. ``in_motion``: the run
    that the report shows in motion. ``left_out``: published figures that are not drawn, and their content.
    Absent: none. Absent ``figures``: every plot that fits.
    """

    paper: str
    title: str = ""
    reference: str = ""
    about: str = ""
    finding: str = ""
    readings: dict[str, Labels] = Field(default_factory=dict)
    studies: dict[Name, StudyModel]
    derived: dict[Name, Reads] = Field(default_factory=dict)
    seas: dict[Name, SeasModel] = Field(default_factory=dict)
    measured: dict[Name, MeasuredModel] = Field(default_factory=dict)
    schematics: dict[Name, SchematicModel] = Field(default_factory=dict)
    figures: dict[Name, FigureModel] = Field(default_factory=dict)
    in_motion: RunInMotion | None = None
    left_out: dict[str, str] = Field(default_factory=dict)

    @property
    def datasets(self) -> list[str]:
        """Names of all datasets: simulated, derived, measured, and those of seas."""
        return [*self.studies, *self.seas, *self.derived, *self.measured]

    @model_validator(mode="after")
    def _names_are_known(self) -> Self:
        for fault in self._unknown_names():
            raise fault
        return self

    def _unknown_names(self) -> Iterator[Misfit]:
        """Faults of names that the file does not define."""
        every: dict[str, StudyModel | SeasModel] = {f"studies.{n}": m for n, m in self.studies.items()}
        every |= {f"seas.{n}": m for n, m in self.seas.items()}
        for name, model in every.items():
            for axis_name, axis in model.axes.items():
                wanted = axis.readings if isinstance(axis, Samples) else []
                for reading in [axis_name] if axis == "readings" else wanted:
                    if reading not in self.readings:
                        where = f"{name}.axes.{axis_name}"
                        found = f"the file has no readings {reading!r}"
                        yield Misfit(where, found, _among(self.readings))
        if self.in_motion and self.in_motion.study not in self.studies:
            found = f"the file has no study {self.in_motion.study!r}"
            yield Misfit("in_motion.study", found, _among(self.studies))
        for name in sorted(set(self.schematics) & set(self.figures)):
            yield Misfit(f"schematics.{name}", "a figure has the same name", RENAME)
        for name in sorted(n for n in set(self.datasets) if self.datasets.count(n) > 1):
            yield Misfit(name, "two datasets have this name", RENAME)
        known = [*self.studies, *self.seas, *self.derived]
        for name, derived in self.derived.items():
            for source in sorted(set(derived.reads).difference(known)):
                found = f"the file has no study or derived dataset {source!r}"
                yield Misfit(f"derived.{name}", found, _among(known))
        try:
            [*TopologicalSorter({n: d.reads for n, d in self.derived.items()}).static_order()]
        except CycleError as error:
            ring = " reads ".join(reversed(error.args[1]))
            found = f"datasets depend on each other in a circle: {ring}"
            yield Misfit("derived", found, "remove one of these names from reads")
        for name, figure in self.figures.items():
            for dataset in set(figure.reads).difference(self.datasets):
                found = f"the file has no dataset {dataset!r}"
                yield Misfit(f"figures.{name}.reads", found, _among(self.datasets))
            if figure.plot and (figure.plot in OF_SEAS) != (figure.reads[0] in self.seas):
                plots = OF_SEAS if figure.reads[0] in self.seas else set(NEEDS) - OF_SEAS
                found = f"the plot {figure.plot!r} cannot show the dataset {figure.reads[0]!r}"
                yield Misfit(f"figures.{name}.plot", found, _among(plots))
            for quantity in figure.of or [] if set(figure.reads) <= set(self.studies) else []:
                if not (of_runs(quantity) or of_points(quantity)):
                    found = f"{quantity!r} is not an output of a study"
                    yield Misfit(f"figures.{name}.of", found, _among(OF_RUNS))
            for study in set(figure.reads).intersection(self.studies):
                count, least = len(self.studies[study].axes), NEEDS.get(figure.plot or "lines", 0)
                if figure.plot and count < least:
                    found = f"the plot requires a study with {least} axes or more, but {study!r} has {count}"
                    yield Misfit(f"figures.{name}.plot", found, "choose another plot, or add an axis")


def _among(names: Iterable[str]) -> str:
    return "use one of " + ", ".join(sorted(names))
