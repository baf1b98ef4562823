"""Input data of the studies of the engine itself: the section ``measured`` of the study file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from chapters.numerics.reference.folder import references
from chapters.numerics.scenes import bases
from riserstudy.inputs.strict import Strict
from riserstudy.scene.base import Positive
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.study.axes import Tier
from riserstudy.study.measured import MeasuredModel, Setting

Pair = Annotated[list[Positive], Field(min_length=2, max_length=2)]
Factors = Annotated[list[Positive], Field(min_length=1)]

_WHERE = "config/studies/numerics.yaml: measured"


class EngineStudy(MeasuredModel):
    """A study of the engine on scenes: ``cases_in`` is the name of the field that contains the cases.

    ``references``: folder of the reference solutions that the cases are compared with. Empty: none.
    """

    cases_in: ClassVar[str] = "cases"
    references: ClassVar[str] = ""

    def scene_files(self, setting: Setting) -> Iterator[tuple[str, SceneFile]]:
        """Yield name and scene of each case of the tier."""
        for name, case in in_tier(getattr(self, self.cases_in), setting.tier).items():
            yield name, case_file(setting.config, name, case)

    def data_files(self, setting: Setting) -> list[Path]:
        """Return the files of the reference solutions."""
        return references(setting.config, self.references) if self.references else []


class Case(Strict):
    """A hard case: a scene, values set in it, and the outcome expected of a sound engine.

    ``expect``: ``accurate``, to 1 %; ``unstable``, refused as physically unstable; ``reported``, for cases
    that prescribe a bad step, mesh or scheme: refused, accurate, with a warning, or with an estimate above
    1 %.
    Absent set: the scene unchanged. Absent preview: not part of that tier. ``family``: source of difficulty.
    """

    scene: str
    about: str
    family: str
    expect: Literal["accurate", "unstable", "reported"]
    because: str | None = None
    set: dict[str, Any] = Field(default_factory=dict)
    preview: bool | None = None


class Method(Strict):
    """A time-stepping method: the values that it sets in a scene. Absent preview: not part of that tier.

    ``only``: the single tier that it is part of. Absent: all tiers, but preview only if ``preview`` is true.
    ``integrator``: an integrator from outside the engine. Absent: the engine's integrator.
    ``tolerances``: for an integrator that chooses its steps, in place of the steps of the ladder.
    """

    set: dict[str, Any]
    integrator: Literal["Radau", "semi-implicit Euler"] | None = None
    tolerances: list[Positive] | None = None
    preview: bool | None = None
    only: Literal["reference"] | None = None


class StabilityStudy(EngineStudy):
    """Every case by every method with several time steps, ``ladder``: factors on the default step.

    ``explicit_ladder``: factors on the predicted stable step, for explicit methods. ``budget``: largest
    number of node-steps of a run; a longer run counts as refused, so that no run blocks the study.
    ``explicit_budget``: the budget of explicit methods.
    """

    references = "stability"

    methods: dict[str, Method]
    ladder: dict[Tier, Factors]
    explicit_ladder: Factors
    budget: Positive
    explicit_budget: Positive
    cases: dict[str, Case]


class LimitStudy(EngineStudy):
    """Predicted and measured stable step of explicit stepping, over variants of scenes."""

    cases_in = "variants"

    duration: str
    variants: dict[str, LimitCase]


class LimitCase(Strict):
    """A scene varied for the stable step. Absent set: unchanged; absent preview: not part of that tier."""

    scene: str
    elements: Annotated[list[int], Field(min_length=1)]
    set: dict[str, Any] = Field(default_factory=dict)
    preview: bool | None = None


class EffectsStudy(EngineStudy):
    """Every applicable change of effects, on every kind of scene of the other chapters.

    ``repeats``: rounds of runs, of which the shortest time counts. ``budget``: largest number of node-steps
    of a scene; longer scenes are shortened. ``left_out``: changes that a tier omits. ``scenes``: scenes with
    effects that no other chapter has. Absent: none. Other jobs may run at the same time, because a time is
    compared only with times of the same scene, which one process runs within seconds.
    """

    cases_in = "scenes"

    repeats: dict[Tier, Annotated[int, Field(ge=1)]]
    budget: dict[Tier, Positive]
    left_out: dict[Tier, list[str]] = Field(default_factory=dict)
    scenes: dict[str, Family] = Field(default_factory=dict)

    def scene_files(self, setting: Setting) -> Iterator[tuple[str, SceneFile]]:
        """Yield the scenes of this study, with effects of no other, and every kind that studies vary."""
        yield from super().scene_files(setting)
        yield from bases(setting.studies, setting.tier)


class Ladder(Strict):
    """A scene with its meshes and steps, from coarse to fine. Absent preview: not part of that tier.

    ``stored``: history of another code that errors are measured against. Absent: a fine run of riserstudy.
    """

    scene: str
    stored: str | None = None
    set: dict[str, Any] = Field(default_factory=dict)
    elements: Annotated[list[int], Field(min_length=1)]
    steps: Factors
    preview: bool | None = None


class AccuracyStudy(EngineStudy):
    """Error and run time of every method on every mesh and step of a scene, and of requested accuracies.

    ``budget``: largest number of node-steps of a run; longer runs are omitted. ``patience``: largest time
    (s) of a run to a requested accuracy; the row of a longer run states that it exceeded this time.
    ``peers``: by scene and other simulator, pairs of the error of displacement and a ratio of times: the
    simulator's divided by that of riserstudy's cheapest run with an equal error, as `make bench` last
    measured them. Absent: none.
    """

    timed = True
    cases_in = "scenes"
    references = "accuracy"

    patience: Positive
    peers: dict[str, dict[str, list[Pair]]] = Field(default_factory=dict)
    repeats: dict[Tier, Annotated[int, Field(ge=1)]]
    budget: Positive
    requested: dict[Literal["preview", "standard", "reference"], list[float]]
    methods: dict[str, Method]
    scenes: dict[str, Ladder]

    def data_files(self, setting: Setting) -> list[Path]:
        """Return the files of the reference solutions, including those of other codes."""
        stored = [setting.config / one.stored for one in self.scenes.values() if one.stored]
        return [*super().data_files(setting), *stored]


class Family(Strict):
    """Scenes of one kind: a scene, values set in it, and ranges to sample in addition to its assumptions.

    Absent preview: not part of that tier.
    """

    scene: str
    set: dict[str, Any] = Field(default_factory=dict)
    vary: dict[str, Annotated[list[str | float], Field(min_length=2, max_length=2)]] = Field(
        default_factory=dict
    )
    preview: bool | None = None


class RandomStudy(EngineStudy):
    """Random scenes, ``count`` of each family, all run to the tolerance ``accuracy``.

    ``patience``: largest time (s) of a run; the row of a longer run states that it exceeded this time.
    """

    cases_in = "families"
    references = "random_scenes"

    accuracy: str
    seed: int
    count: dict[Tier, Annotated[int, Field(ge=2)]]
    patience: dict[Tier, Positive]
    families: dict[str, Family]

    @property
    def share(self) -> float:
        """The tolerance as a fraction, 0.01 for 1 %."""
        return float(self.accuracy.removesuffix("%")) / 100.0


class OwnSetting(Strict):
    """Mesh, step and method that the paper used."""

    elements: Annotated[int, Field(ge=1)]
    step: Positive
    set: dict[str, Any]


class LongCase(Strict):
    """A long simulation and its candidate meshes, steps and methods.

    ``graded``: number of meshes from the series that a refinement would try. ``published_seconds``,
    ``target_seconds``: absent: not given. ``preview``: values set in that tier; absent: not part of it.
    """

    scene: str
    set: dict[str, Any] = Field(default_factory=dict)
    preview: dict[str, Any] | None = None
    published_seconds: Positive | None = None
    target_seconds: Positive | None = None
    methods: dict[str, dict[str, Any]]
    elements: Annotated[list[int], Field(min_length=1)]
    graded: Annotated[int, Field(ge=0)]
    steps: Factors


class LongStudy(EngineStudy):
    """Long simulations, each candidate timed ``repeats`` times."""

    timed = True
    references = "long_runs"

    repeats: Annotated[int, Field(ge=1)]
    wanted: Positive
    cases: dict[str, LongCase]


class PaperCase(Strict):
    """A long simulation with the setting of its paper. Absent preview: not part of that tier."""

    scene: str
    set: dict[str, Any] = Field(default_factory=dict)
    preview: bool | None = None
    own: OwnSetting


class PaperStudy(EngineStudy):
    """Long simulations with the settings of their papers, compared with the references of the long runs."""

    references = "long_runs"

    cases: dict[str, PaperCase]


class EnergyCase(Strict):
    """A scene on equal segments with one step. Absent set: unchanged; absent preview: not in that tier."""

    scene: str
    set: dict[str, Any] = Field(default_factory=dict)
    elements: Annotated[int, Field(ge=1)]
    step: Positive
    duration: Positive
    preview: bool | None = None


class EnergyStudy(EngineStudy):
    """Energy balance over time, at ``instants`` times, by every method."""

    instants: dict[Tier, Annotated[int, Field(ge=1)]]
    methods: dict[str, Method]
    cases: dict[str, EnergyCase]


class TiersStudy(EngineStudy):
    """Scenes behind published numbers, at each tier's tolerance; ``default``: no tolerance in the scene.

    ``patience``: largest time (s) of a run; the row of a longer run states that it exceeded this time.
    """

    timed = True
    cases_in = "scenes"
    references = "tiers"

    patience: dict[Tier, Positive]
    accuracies: dict[Tier, str]
    scenes: dict[str, Family]


class ValidationStudy(EngineStudy):
    """The engine compared with closed forms, second methods and conservation laws, in given and own scenes.

    ``stored``: for some of the scenes, the file of a history that another program computed.
    """

    cases_in = "scenes"

    scenes: dict[str, Family]
    stored: dict[str, str] = Field(default_factory=dict)

    def data_files(self, setting: Setting) -> list[Path]:
        """Return the files of the histories."""
        return [setting.config / path for path in self.stored.values()]


def in_tier(things: dict[str, Any], tier: str) -> dict[str, Any]:
    """Return the cases, methods or variants of a tier."""
    of = {name: x for name, x in things.items() if getattr(x, "only", None) in (None, tier)}
    return {name: x for name, x in of.items() if tier != "preview" or x.preview}


def case_file(config: Path, name: str, case: Case | LimitCase | Ladder | Family | LongCase) -> SceneFile:
    """Read the scene of a case and set the values of the case in it."""
    return read_scene(config / case.scene, keep=True).with_values(case.set, f"{_WHERE}: {name}.set")


#: by the name of the dataset
MODELS: dict[str, type[EngineStudy]] = {
    "stability": StabilityStudy,
    "stable_step": LimitStudy,
    "effects": EffectsStudy,
    "accuracy": AccuracyStudy,
    "random_scenes": RandomStudy,
    "long_runs": LongStudy,
    "papers_settings": PaperStudy,
    "tiers": TiersStudy,
    "energy": EnergyStudy,
    "validation": ValidationStudy,
}

EffectsStudy.model_rebuild()
LimitStudy.model_rebuild()
