"""One study of config/studies/<paper>.yaml as a model: its scene, axes and settings."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from pathlib import PureWindowsPath
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from riserstudy.dataset.variables import (
    DIMENSIONS,
    OF_MODES,
    OF_RUNS,
    about_points,
    arrays_of,
    of_runs,
    quantity_of,
)
from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene.paths import meets, within, within_any
from riserstudy.study.axes import Axis, AxisName, Numbers, Sets
from riserstudy.study.seas_model import OUTSIDE

MOST_MODES = 1000
#: settings of the analysis that may be coarser in a preview
SETTINGS = ("analysis.accuracy", "analysis.mesh", "analysis.method", "analysis.step")
NEW_NAME = "give the axis another name"


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
            of = quantity_of(name)
            if of not in OF_RUNS or name not in arrays_of(of):
                names = arrays_of(of) if of in OF_RUNS else sorted(OF_RUNS)
                also = "" if of in OF_RUNS else ", many of them also with an ending such as _max"
                raise Misfit("keep", f"{name!r} is not an output of a run", f"use {', '.join(names)}{also}")
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
            if not within_any(path, SETTINGS):
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
                    if within(own, path):
                        found = f"sets {path!r}, where {there}"
                        allowed = f"put axis {name!r} first, or set the path in one of the two axes only"
                        raise Misfit(f"axes.{name}.{label}", found, allowed)
            before |= {path: f"axis {name!r} has its own" for _, path in put}


def _paths_of(axis: Axis) -> Iterable[str]:
    """Paths of the scene that values of an axis set, if the study file states them."""
    if isinstance(axis, Numbers):
        return axis.paths
    return {path for sets in axis.values() for path in sets} if isinstance(axis, dict) else ()
