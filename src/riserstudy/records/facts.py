"""Facts about a run in addition to its arrays, and the facts that studies hold for each point.

A new fact requires one field here, and the code that sets it. If the field has a `Column`, datasets of
studies, the results database, plots and reruns include it automatically.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Literal, TypedDict, get_type_hints

from riserstudy.records.warning import RunWarning, sentences

Kind = Literal["real", "integer", "text"]


@dataclass(frozen=True)
class Column:
    """A fact in studies: a variable over their points, and a column in the database's table of points.

    Attributes
    ----------
    long_name, unit : as in CF; no unit for text.
    name : name of the variable. Absent: name of the fact.
    part : key of the value to use, if the fact is a mapping. Absent: the whole value.
    of : function that computes it from the facts. Absent: the value, or nan; the lines or keys of text.
    repeats : whether a second run of the point gives the same value.
    optional : whether datasets have it only if one of their runs has it.
    in_database : whether the table of points has it.
    """

    long_name: str
    unit: str | None = None
    name: str = ""
    part: str = ""
    kind: Kind = "real"
    of: Callable[[RunFacts], Any] | None = None
    repeats: bool = True
    optional: bool = False
    in_database: bool = True


class EnergyAudit(TypedDict, total=False):
    """Balance of energy (J), and its residual as a share of the energy exchanged (1): theory (11)."""

    work_of_supports: float
    made_by_exchange: float
    work_of_water_and_devices: float
    dissipated: float
    numerically_dissipated: float
    stored: float
    exchanged: float
    unexplained: float
    unexplained_share: float


#: relative errors by quantity
ErrorEstimate = dict[str, float]
_ERROR, _NOT_LIMITED = "estimated relative error of ", ", which the tolerance does not limit"


class _Rare(TypedDict):
    optional: bool
    in_database: bool


_RARE: _Rare = {"optional": True, "in_database": False}


def _sampling(quantity: str, part: str) -> Column:
    """The standard error of a quantity of a vibration, and the part of the fact that holds it."""
    words = f"relative standard error of the vibration's {quantity}, due to the finite length of the run"
    return Column(words, "1", name=f"sampling_error_{part}", part=part, **_RARE)


class RunFacts(TypedDict, total=False):
    """Facts about one run, which has only some of them; stored as JSON in the store and in attributes."""

    wall_seconds: Annotated[float, Column("elapsed time of the simulation", "s", repeats=False)]
    solve_seconds: Annotated[
        float, Column("elapsed time of the run and of its refinements", "s", repeats=False)
    ]
    elements: Annotated[int, Column("number of segments of the riser", "1", kind="integer")]
    step: Annotated[float, Column("time step", "s")]
    newton_iterations: Annotated[
        int, Column("number of Newton iterations of the riser in all time steps", "1", kind="integer")
    ]
    error_estimate: Annotated[
        ErrorEstimate,
        Column(
            "1 if the error was estimated at this point, otherwise 0",
            "1",
            name="error_estimated",
            kind="integer",
            of=lambda facts: int(bool(facts.get("error_estimate"))),
        ),
        Column(_ERROR + "displacement", "1", name="error_displacement", part="displacement"),
        Column(_ERROR + "bending moment", "1", name="error_moment", part="moment"),
        Column(_ERROR + "tension", "1", name="error_tension", part="tension"),
        Column(
            _ERROR + "upper flex joint angle" + _NOT_LIMITED, "1", name="error_ufj_angle", part="ufj_angle"
        ),
        Column(
            _ERROR + "lower flex joint angle" + _NOT_LIMITED, "1", name="error_lfj_angle", part="lfj_angle"
        ),
        Column(_ERROR + "shear force" + _NOT_LIMITED, "1", name="error_shear", part="shear"),
        Column(_ERROR + "strokes" + _NOT_LIMITED, "1", name="error_stroke", part="stroke", optional=True),
        Column(
            _ERROR + "tensioner forces" + _NOT_LIMITED,
            "1",
            name="error_tensioner_force",
            part="tensioner_force",
            optional=True,
        ),
        Column(
            _ERROR + "overpull" + _NOT_LIMITED, "1", name="error_overpull", part="overpull", optional=True
        ),
        Column(
            _ERROR + "lift and clearance" + _NOT_LIMITED, "1", name="error_lift", part="lift", optional=True
        ),
        Column(_ERROR + "fatigue damage", "1", name="error_damage", part="damage", optional=True),
    ]
    audit: Annotated[
        EnergyAudit,
        Column(
            "energy residual, divided by the exchanged energy or the change of stored energy, "
            "whichever is larger",
            "1",
            name="unexplained_energy",
            part="unexplained_share",
        ),
    ]
    smallest_tension: Annotated[float, Column("smallest effective tension of the riser", "N")]
    smallest_tension_s: float
    largest_bending_moment: Annotated[
        float, Column("largest magnitude of the bending moment, also between nodes", "N m")
    ]
    largest_displacement: float  # m, of a node from where it is in an upright riser
    largest_bending_moment_s: Annotated[
        float, Column("arclength, from the bottom, at which the bending moment is largest", "m")
    ]
    warnings: Annotated[
        list[RunWarning],
        Column(
            "warnings of the run, one per line",
            kind="text",
            of=lambda facts: "\n".join(sentences(facts.get("warnings", ()))),
            repeats=False,
        ),
        Column(
            "warnings of the run as JSON: kind, text with places, and values",
            name="warning_records",
            kind="text",
            of=lambda facts: json.dumps(facts.get("warnings", [])),
            repeats=False,
        ),
    ]
    #: effects by name, each with the input that includes it
    effects: Annotated[
        dict[str, str],
        Column("simulated effects, one per line", kind="text", repeats=False, in_database=False),
    ]
    vibration_since: float  # s
    vibration_above: float  # Hz, lowest frequency that counts as vibration
    vibration_rms: Annotated[
        float, Column("root mean square of the vibration, over time and riser", "m", **_RARE)
    ]
    vibration_rms_max: Annotated[
        float, Column("largest root mean square of the vibration along the riser", "m", **_RARE)
    ]
    vibration_rms_max_s: Annotated[
        float, Column("arclength, from the bottom, at which the vibration is largest", "m", **_RARE)
    ]
    vibration_frequency: Annotated[
        float, Column("frequency at the place where the vibration is largest", "Hz", **_RARE)
    ]
    vibration_scatter: Annotated[
        float,
        Column(
            "root mean square along the riser of the difference between the vibration's root mean squares in "
            "the first and in the second half of the time, divided by the root mean square of the vibration",
            "1",
            **_RARE,
        ),
    ]

    #: standard errors of a vibration's statistics due to the limited evaluated time
    sampling_error: Annotated[
        ErrorEstimate,
        _sampling("displacement", "displacement"),
        _sampling("bending moment", "moment"),
        _sampling("tension", "tension"),
        _sampling("upper flex joint angle", "ufj_angle"),
        _sampling("lower flex joint angle", "lfj_angle"),
        _sampling("strokes", "stroke"),
        _sampling("tensioner forces", "tensioner_force"),
        _sampling("fatigue damage", "damage"),
    ]

    statistics: dict[str, Any]  # statistics of a vibration, for runs that are kept for comparisons

    lower_joint_until: float  # s, time at which a disconnect opens the lower flex joint
    directions: int  # number of directions in which the riser can move
    statics_iterations: int
    steps: int
    halved_steps: int
    stable_step: float  # s, limit of the explicit method
    coupling: dict[str, Any]  # facts about the exchange of a vessel and its riser
    #: cost of each run of a refinement, and the reason for its end
    refinements: list[dict[str, Any]]
    ended_by: str
    #: rows from `simulation.extremes`, of the run and until a disconnect
    extremes: list[dict[str, Any]]
    extremes_connected: list[dict[str, Any]]
    #: the times at which limits are first reached, in the order of limits
    limits_reached: list[float | str]
    limits_reached_error: list[float]  # s, due to the interval of outputs along the riser
    largest_stroke: float  # m
    # of a disconnect
    taken_by_the_release: float  # J
    overpull: float  # N
    lift_max: float  # m
    lift_rate_max: float  # m/s
    clearance_min: float  # m
    clearance_time: float  # s
    clearance_aside: float  # m
    recontact_time: float  # s
    recontact_aside: float  # m, largest distance
    contents_speed_max: float  # m/s
    contents_top_min: float  # m
    fatigue: list[dict[str, Any]]  # rows of a scene's details
    # of runs that are timed alternately
    wall_seconds_min: float
    cpu_seconds: float


@dataclass(frozen=True)
class PointColumn:
    """A `Column` with the name of its fact."""

    fact: str
    about: Column

    @property
    def name(self) -> str:
        """Name of the variable and of the column."""
        return self.about.name or self.fact

    def is_in(self, facts: RunFacts) -> bool:
        """Whether a run has it."""
        value: Any = facts.get(self.fact)
        return value is not None and (not self.about.part or self.about.part in value)

    def value(self, facts: RunFacts) -> Any:
        """Value of a run in a dataset: a number, nan if the run has none, or lines of text."""
        if self.about.of is not None:
            return self.about.of(facts)
        value: Any = facts.get(self.fact)
        if self.about.kind == "text":
            return "\n".join(value or ())
        if self.about.part:
            value = (value or {}).get(self.about.part)
        return math.nan if value is None else value

    @property
    def attributes(self) -> dict[str, str]:
        """CF attributes."""
        labels = {"units": self.about.unit, "long_name": self.about.long_name}
        return {name: text for name, text in labels.items() if text}


def columns_of(record: type) -> tuple[PointColumn, ...]:
    """Columns of the facts in a class, in the order of its fields."""
    return tuple(
        PointColumn(fact, about)
        for fact, hint in get_type_hints(record, include_extras=True).items()
        for about in getattr(hint, "__metadata__", ())
        if isinstance(about, Column)
    )


@cache
def point_columns() -> tuple[PointColumn, ...]:
    """Columns that studies hold for each point."""
    return columns_of(RunFacts)
