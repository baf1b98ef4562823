"""Settings of the computation: duration, mesh, method and output."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.percent import Percent
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, WHOLE

USE_IMPLICIT = "choose an implicit analysis.method, such as TR-BDF2, or remove analysis.method"
MOST_OUTPUTS = 1_000_000
MOST_STEPS = 1_000_000_000
# largest number of periods of the shortest motion, each of 24 time steps or more
MOST_PERIODS = 40_000_000
MOST_VALUES = 300_000_000  # largest number of values of a history over all times and places: 2.4 GB


class Layers(Strict):
    """Length of the layer of short segments at each end of the riser.

    A suitable length of a layer is sqrt(EI/T), with the bending stiffness EI and the effective tension T.
    """

    bottom: Annotated[u.Length, POSITIVE] | None = None
    top: Annotated[u.Length, POSITIVE] | None = None


class Mesh(Strict):
    """Mesh of the riser with at least ``elements`` segments.

    The segments of a mesh have equal lengths within each riser section.

    With the key ``layers``, the number of segments of a mesh is approximate, and segments become shorter
    towards a riser end that has a layer.
    """

    elements: Annotated[int, Field(ge=1, le=20000), WHOLE]
    layers: Layers | None = None


class GeneralisedAlpha(Strict):
    """Implicit time integration (generalised-alpha) with the spectral radius rho_inf at high frequency.

    If ``rho_inf`` is 1, the generalised-alpha method dissipates no energy. With a smaller ``rho_inf``, the
    generalised-alpha method damps motions that are too fast for the time step.
    """

    rho_inf: Annotated[float, Field(ge=0, le=1)]


class Newmark(Strict):
    """Newmark's implicit time integration, with its parameters beta and gamma."""

    beta: Annotated[float, Field(ge=0.001, le=1)]
    gamma: Annotated[float, Field(ge=0, le=1)]


class Output(Strict):
    """Times and places of time histories, by default from the start of the run and at all nodes.

    The key ``interval`` is the time between two stored values of a time history. The engine evaluates
    extremes and limits from the time ``start`` on. The key ``stations`` lists the arclengths at which time
    histories are stored. If the key ``stress_in`` names a section of the riser, the time histories include
    the largest stress at the outer surface of this section.
    """

    interval: Annotated[u.Time, POSITIVE]
    start: Annotated[u.Time, NOT_NEGATIVE] | None = None
    stations: Annotated[list[u.Length], Field(min_length=1)] | None = None
    stress_in: str | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if any(a >= b for a, b in pairwise(self.stations or [])):
            raise Misfit(
                "", "the stations do not increase", "list the arclengths from the lowest to the highest"
            )
        return self


class Analysis(Strict):
    """Settings of the simulation.

    Without ``duration``, the engine computes only the static equilibrium, with the platform at its
    ``position`` and the current at its full speed. Without ``duration``, a warning lists the parts of the
    scene that have no effect, such as motions, waves and thrusters. By default, the simulation starts from
    the static equilibrium. With ``start: undeflected``, the simulation starts from the equilibrium without
    current. With ``start: unstretched``, the simulation starts from the shape of the static equilibrium, but
    with unstretched segments. If mesh and time step are not given, the engine chooses a mesh and a time step
    with which the tolerance ``accuracy`` is met. The default of the tolerance ``accuracy`` is 0.2 % for
    displacement, 1 % for moment and tension, and 5 % for fatigue damage. The default method of time
    integration is generalised-alpha with a spectral radius of 0.8. In a scene with a sudden event (a
    disconnect, a tension loss without ``over``, or ``failing`` cylinders), the default method of time
    integration is ESDIRK4. The default solver uses lumped masses; ``solver: hermite`` uses beam elements for
    small slopes. Newton's iteration (the solution of nonlinear equations in each time step) ends when the
    correction of positions is smaller than ``newton_tolerance`` times the length of the riser. The default of
    ``newton_tolerance`` is 1e-9. A smaller ``newton_tolerance`` reduces the limits for corrections of
    positions and of moments by one common factor.
    """

    duration: Annotated[u.Time, POSITIVE] | None = None
    output: Output | None = None
    solver: Literal["hermite"] | None = None
    start: Literal["equilibrium", "unstretched", "undeflected"] | None = None
    mesh: Mesh | None = None
    step: Annotated[u.Time, POSITIVE] | None = None
    accuracy: Annotated[Percent, Field(gt=0, lt=1)] | None = None
    method: Literal["explicit", "TR-BDF2", "ESDIRK4"] | GeneralisedAlpha | Newmark | None = None
    newton_tolerance: Annotated[float, Field(gt=0, le=1e-3)] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.duration is None) != (self.output is None):
            raise Misfit(
                "",
                "only one of duration and output is given",
                "give both (dynamic run) or neither (static run)",
            )
        if self.accuracy is not None and (self.mesh or self.step):
            raise Misfit(
                "", "accuracy is given together with mesh or step", "give accuracy alone, or mesh and step"
            )
        if self.duration is not None and (self.mesh is None) != (self.step is None):
            raise Misfit("", "only one of mesh and step is given", "give both, or neither")
        if self.duration is None and (self.step or self.method):
            raise Misfit(
                "", "step and method apply to dynamic runs only", "add duration and output, or remove them"
            )
        if self.method == "explicit" and self.mesh is None:
            raise Misfit("", "'method: explicit' requires mesh and step", "add both")
        if self.solver and self.mesh is None:
            raise Misfit("", "'solver: hermite' requires a mesh", "add mesh, and for a dynamic run also step")
        if self.duration is not None and self.output is not None:
            self._fits_in_time(self.duration, self.output)
        return self

    def _fits_in_time(self, duration: float, output: Output) -> None:
        start = output.start or 0.0
        if start > duration:
            raise Misfit(
                "",
                f"output.start {start:g} s is after the end of the run at {duration:g} s",
                "give an earlier start or a longer duration",
            )
        if output.interval > duration:
            raise Misfit(
                "",
                f"output.interval {output.interval:g} s is longer than the duration of the run",
                f"give at most {duration:g} s",
            )
        if (duration - start) / output.interval > MOST_OUTPUTS:
            raise Misfit(
                "",
                f"output.interval {output.interval:g} s gives more than {MOST_OUTPUTS} outputs",
                "give a longer interval",
            )
        places = len(output.stations or []) or (self.mesh.elements if self.mesh else 1)
        if places * (duration - start) / output.interval > MOST_VALUES:
            raise Misfit(
                "",
                f"outputs at {places} places every {output.interval:g} s are more than {MOST_VALUES} values",
                "give a longer output.interval, or fewer output.stations",
            )
        if self.step is not None and duration / self.step > MOST_STEPS:
            raise Misfit(
                "",
                f"step {self.step:g} s gives more than {MOST_STEPS} time steps in this duration",
                "give a longer step",
            )
