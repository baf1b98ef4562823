"""``seas`` of a study file: workable hours of a record by the limits of a riser, over its settings."""

from __future__ import annotations

from pathlib import PureWindowsPath
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene.units import to_si
from riserstudy.study.axes import Axis, AxisName, Sets
from riserstudy.study.persistence import LEAST_PERSISTENCE, MOST_AHEAD, MOST_PERSISTENCE, PERSISTENCE

OUTSIDE = ("the file is outside the folder of the configuration", "move it below this folder")
HEADING = "heading"  # the axis of headings, to which directions of a record are converted


class SyntheticModel(Strict):
    """A synthetic record: its number of years, and the seed of its generation."""

    years: Annotated[int, Field(ge=1, le=100)]
    seed: Annotated[int, Field(ge=0)]


class HeadingsModel(Strict):
    """Conversion of a record's directions to headings of the scene, in sectors, the first about x.

    ``x_towards``: bearing of the scene's x axis, clockwise from north, such as ``90 deg``.
    """

    sectors: Annotated[int, Field(ge=2, le=36)]
    x_towards: str

    @model_validator(mode="after")
    def _is_an_angle(self) -> Self:
        to_si(self.x_towards, "rad")
        return self


class SeasModel(Strict):
    """Workable hours in a record of sea states, by the limits of a riser, at each point of a grid.

    ``record``: a file in the folder of the configuration (CSV or netCDF), or a synthetic record. ``set``,
    ``limits`` and ``axes`` are as in a study. ``headings``: absent: all seas have the heading of the scene.
    ``sea_limits``: additional limits on the sea, such as ``hs <= 2.5 m``; absent: none. ``seeds``: number of
    runs for each sea state. ``error``: tolerance for the response between sea states, as a share of the
    allowable. ``most``: largest number of sea states for each heading. ``windows``: lengths of continuous
    work, such as ``24 h``; absent: none. ``next_years``: number of future years for which a band is given.
    ``persistence``: Hurst exponent of the yearly shares, which bands assume. ``return_periods``: return
    periods of responses in years; absent: none.
    """

    scene: str
    caption: str
    record: str | SyntheticModel
    set: Sets = Field(default_factory=dict)
    limits: Annotated[list[dict[str, Any]], Field(min_length=1)] | None = None
    axes: dict[AxisName, Axis] = Field(default_factory=dict)
    headings: HeadingsModel | None = None
    sea_limits: list[str] = Field(default_factory=list)
    seeds: Annotated[int, Field(ge=1)] = 5
    error: Annotated[float, Field(ge=0.001, le=0.5)] = 0.05
    most: Annotated[int, Field(ge=20)] = 400
    windows: list[str] = Field(default_factory=list)
    next_years: Annotated[int, Field(ge=1, le=MOST_AHEAD)] = 10
    persistence: Annotated[float, Field(ge=LEAST_PERSISTENCE, le=MOST_PERSISTENCE)] = PERSISTENCE
    return_periods: list[Annotated[int, Field(ge=2, le=10_000)]] = Field(default_factory=list)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.headings and HEADING in self.axes:
            found = "the heading is also given by 'headings'"
            raise Misfit(f"axes.{HEADING}", found, "remove one of the two")
        if isinstance(self.record, str):
            path = PureWindowsPath(self.record)
            if path.anchor or ".." in path.parts:
                raise Misfit("record", *OUTSIDE)
        if len({to_si(text, "s") for text in self.windows}) < len(self.windows):
            raise Misfit("windows", "a length occurs twice", "give each length once, in any unit")
        if len({*self.return_periods}) < len(self.return_periods):
            raise Misfit("return_periods", "a period occurs twice", "give each period once")
        return self
