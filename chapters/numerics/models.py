"""What the studies of the engine itself run, as data: below ``measured`` in the study file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from chapters.numerics.reference.folder import references
from chapters.numerics.scenes import bases, case_file, in_tier
from riserstudy.inputs.strict import Strict
from riserstudy.scene.base import Positive
from riserstudy.scene.load import SceneFile
from riserstudy.study.measured import MeasuredModel, Setting

Tiers = Literal["preview", "standard", "reference"]
Pair = Annotated[list[Positive], Field(min_length=2, max_length=2)]
Factors = Annotated[list[Positive], Field(min_length=1)]


class EngineStudy(MeasuredModel):
    """What is run on scenes: ``cases_in`` is the field of the cases.

    ``references``: folder of the reference solutions that the cases are compared with. Empty: none.
    """

    cases_in: ClassVar[str] = "cases"
    references: ClassVar[str] = ""

    def scene_files(self, setting: Setting) -> Iterator[tuple[str, SceneFile]]:
        """Name and scene of each case of the tier."""
        for name, case in in_tier(getattr(self, self.cases_in), setting.tier).items():
            yield name, case_file(setting.config, name, case)

    def data_files(self, setting: Setting) -> list[Path]:
        """Files of the reference solutions."""
        return references(setting.config, self.references) if self.references else []


class Case(Strict):
    """A hard case: a scene, what is set on top of it, and what a sound engine makes of it.

    ``expect``: ``accurate`` to 1 %; ``unstable``, refused as physically unstable; ``told``, for cases that
    prescribe a bad step, mesh or scheme: refused, or with an estimate above 1 % where the error is.
    Absent set: the scene as it is. Absent preview: not part of that tier. ``family``: what it is hard by.
    """

    scene: str
    about: str
    family: str
    expect: Literal["accurate", "unstable", "told"]
    because: str | None = None
    set: dict[str, Any] = Field(default_factory=dict)
    preview: bool | None = None


class Method(Strict):
    """A way to step through time: what it sets in a scene. Absent preview: not part of that tier.

    ``only``: the one tier that it is part of. Absent: all, but preview where that is not set.
    ``integrator``: one from outside the engine. Absent: the engine's own. ``tolerances``: those of an
    integrator that chooses its steps, in place of the ladder's steps.
    """

    set: dict[str, Any]
    integrator: Literal["Radau", "semi-implicit Euler"] | None = None
    tolerances: list[Positive] | None = None
    preview: bool | None = None
    only: Literal["reference"] | None = None


class StabilityStudy(EngineStudy):
    """Every case by every method over a ladder of steps, as factors on what the default chooses.

    ``explicit_ladder`` counts in predicted stable steps instead. ``budget``: node-steps that a run may
    take; more count as refused, so that nothing hangs. Explicit methods get ``explicit_budget``.
    """

    references = "stability"

    methods: dict[str, Method]
    ladder: dict[Tiers, Factors]
    explicit_ladder: Factors
    budget: Positive
    explicit_budget: Positive
    cases: dict[str, Case]


class LimitStudy(EngineStudy):
    """Predicted against measured stable step of explicit stepping, over variants of scenes."""

    cases_in = "variants"

    duration: str
    variants: dict[str, LimitCase]


class LimitCase(Strict):
    """A scene varied for the stable step. Absent set: as it is; absent preview: not part of that tier."""

    scene: str
    elements: Annotated[list[int], Field(min_length=1)]
    set: dict[str, Any] = Field(default_factory=dict)
    preview: bool | None = None


class EffectsStudy(EngineStudy):
    """Every change of effects that fits, on every kind of scene of the other chapters.

    ``repeats``: rounds of runs, of which the shortest time counts. ``budget``: node-steps that a scene may
    take; longer ones are cut short. ``left_out``: changes that a tier does not make. ``scenes``: with effects
    that no other chapter has. Absent: none.
    """

    timed = True
    cases_in = "scenes"

    repeats: dict[Tiers, Annotated[int, Field(ge=1)]]
    budget: dict[Tiers, Positive]
    left_out: dict[Tiers, list[str]] = Field(default_factory=dict)
    scenes: dict[str, Family] = Field(default_factory=dict)

    def scene_files(self, setting: Setting) -> Iterator[tuple[str, SceneFile]]:
        """The study's own scenes, which compile what no other does, and every kind that studies vary."""
        yield from super().scene_files(setting)
        yield from bases(setting.studies, setting.tier)


class Ladder(Strict):
    """A scene with its meshes and steps, from coarse to fine. Absent preview: not part of that tier.

    ``stored``: history of another code to measure errors by. Absent: a fine run of our own.
    """

    scene: str
    stored: str | None = None
    set: dict[str, Any] = Field(default_factory=dict)
    elements: Annotated[list[int], Field(min_length=1)]
    steps: Factors
    preview: bool | None = None


class AccuracyStudy(EngineStudy):
    """Error against time, every method on every rung of a scene's ladder, and requested accuracy.

    ``budget``: node-steps that a run may take; more are left out. ``patience``: seconds that a request for an
    accuracy may take; one beyond it is a row that says so. ``peers``: by scene and other simulator, errors of
    displacement and its time divided by the time of riserstudy's cheapest run with the same error, as
    `make bench` found them last.
    Absent: none.
    """

    timed = True
    cases_in = "scenes"
    references = "accuracy"

    patience: Positive
    peers: dict[str, dict[str, list[Pair]]] = Field(default_factory=dict)
    repeats: dict[Tiers, Annotated[int, Field(ge=1)]]
    budget: Positive
    requested: dict[Literal["preview", "standard", "reference"], list[float]]
    methods: dict[str, Method]
    scenes: dict[str, Ladder]

    def data_files(self, setting: Setting) -> list[Path]:
        """Files of the reference solutions, of other codes too."""
        stored = [setting.config / one.stored for one in self.scenes.values() if one.stored]
        return [*super().data_files(setting), *stored]


class Family(Strict):
    """Scenes of one kind: a scene, values set on it, and ranges to draw from in addition to its assumptions.

    Absent preview: not part of that tier.
    """

    scene: str
    set: dict[str, Any] = Field(default_factory=dict)
    vary: dict[str, Annotated[list[str | float], Field(min_length=2, max_length=2)]] = Field(
        default_factory=dict
    )
    preview: bool | None = None


class RandomStudy(EngineStudy):
    """Scenes drawn at random, so many a family, and the accuracy asked of each.

    ``patience``: seconds a request may take; a scene beyond it is a row that says so.
    """

    cases_in = "families"
    references = "random_scenes"

    accuracy: str
    seed: int
    count: dict[Tiers, Annotated[int, Field(ge=2)]]
    patience: dict[Tiers, Positive]
    families: dict[str, Family]

    @property
    def share(self) -> float:
        """The relative accuracy, 0.01 for 1 %."""
        return float(self.accuracy.removesuffix("%")) / 100.0


class OwnSetting(Strict):
    """Mesh, step and method that a paper itself used."""

    elements: Annotated[int, Field(ge=1)]
    step: Positive
    set: dict[str, Any]


class LongCase(Strict):
    """A long simulation and the candidates to do it by: meshes, steps, methods.

    ``graded``: how many meshes of those that a refinement would try. ``own``: the paper's setting; absent:
    none. ``published_seconds``, ``target_seconds``: absent: none named. ``preview``: set in that tier;
    absent: not part of it.
    """

    scene: str
    set: dict[str, Any] = Field(default_factory=dict)
    preview: dict[str, Any] | None = None
    published_seconds: Positive | None = None
    target_seconds: Positive | None = None
    own: OwnSetting | None = None
    methods: dict[str, dict[str, Any]]
    elements: Annotated[list[int], Field(min_length=1)]
    graded: Annotated[int, Field(ge=0)]
    steps: Factors


class LongStudy(EngineStudy):
    """Long simulations, each candidate timed so many times."""

    timed = True
    references = "long_runs"

    repeats: Annotated[int, Field(ge=1)]
    wanted: Positive
    cases: dict[str, LongCase]


class EnergyCase(Strict):
    """A scene on even segments with one step. Absent set: as it is; absent preview: not in that tier."""

    scene: str
    set: dict[str, Any] = Field(default_factory=dict)
    elements: Annotated[int, Field(ge=1)]
    step: Positive
    duration: Positive
    preview: bool | None = None


class EnergyStudy(EngineStudy):
    """Where energy goes over time, at so many instants, by every method."""

    instants: dict[Tiers, Annotated[int, Field(ge=1)]]
    methods: dict[str, Method]
    cases: dict[str, EnergyCase]


class TiersStudy(EngineStudy):
    """Scenes behind published numbers at the accuracy of each tier; ``default`` is that of no accuracy.

    ``patience``: seconds a run may take; one beyond it is a row that says so.
    """

    timed = True
    cases_in = "scenes"
    references = "tiers"

    patience: dict[Tiers, Positive]
    accuracies: dict[Tiers, str]
    scenes: dict[str, Family]


class ValidationStudy(EngineStudy):
    """Closed forms, second methods and conservation laws against the engine, on these scenes and its own.

    ``stored``: of some of the scenes, the file of a history that another program made.
    """

    cases_in = "scenes"

    scenes: dict[str, Family]
    stored: dict[str, str] = Field(default_factory=dict)

    def data_files(self, setting: Setting) -> list[Path]:
        """The histories."""
        return [setting.config / path for path in self.stored.values()]


#: by the name of the dataset
MODELS: dict[str, type[EngineStudy]] = {
    "stability": StabilityStudy,
    "stable_step": LimitStudy,
    "effects": EffectsStudy,
    "accuracy": AccuracyStudy,
    "random_scenes": RandomStudy,
    "long_runs": LongStudy,
    "tiers": TiersStudy,
    "energy": EnergyStudy,
    "validation": ValidationStudy,
}

EffectsStudy.model_rebuild()
LimitStudy.model_rebuild()
