"""config/studies/<paper>.yaml as a model: studies, derived datasets, figures and schematics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from riserstudy.dataset.variables import OF_RUNS, of_points, of_runs
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.origin import unwrap
from riserstudy.study.axes import Labels, Samples, Sets
from riserstudy.study.figures import NEEDS, OF_SEAS, FigureModel
from riserstudy.study.measured import MeasuredModel
from riserstudy.study.seas_model import SeasModel
from riserstudy.study.study_model import StudyModel

RENAME = "give one of them another name"
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

    ``title``, ``reference``, ``about``: title, full reference and description of the paper, for the report.
    ``short``: name for tables and figures of the report; absent: the title. ``finding``: the published value
    or claim that the report gives first. Absent: the title is the name of the file, and the others are
    omitted. ``readings``: named interpretations of the paper, by the
    values that each sets; studies use them as axes or samples. ``seas``: datasets of workable hours of a
    record of sea states. ``measured``: datasets that code of the chapter measures. ``in_motion``: the run
    that the report shows in motion. ``left_out``: published figures that are not drawn, and their content.
    Absent: none. Absent ``figures``: every plot that fits.
    """

    paper: str
    title: str = ""
    short: str = ""
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
