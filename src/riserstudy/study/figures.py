"""Figures that a study file asks for: drawn by a function of the chapter, or by a plot that fits any grid."""

from __future__ import annotations

from typing import Any, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict

Plot = Literal["lines", "heat map", "utilisation", "envelope", "time series", "workable hours"]
#: axes that a grid needs
NEEDS: dict[Plot, int] = {
    "lines": 1,
    "heat map": 2,
    "utilisation": 1,
    "envelope": 0,
    "time series": 0,
    "workable hours": 0,
}
#: plots of datasets below ``seas``, and of no others
OF_SEAS: frozenset[Plot] = frozenset(("workable hours",))


class FigureModel(Strict):
    """A figure: its caption, the datasets it reads, and what draws it.

    ``plot``: one that fits any grid: lines over an axis, a heat map over two axes, the utilisation of a
    study's limits over one or two, an envelope along the riser, time series; or workable hours, of a dataset
    below ``seas``. Absent: the function of the figure's name in its chapter's figures.
    ``of``: the quantities to plot. Absent: those that matter most among what there is.
    ``claims``: IDs of the numbers and claims that it is about. Absent: those of the printed figure that it
    repeats, or those that rest on what it reads.
    ``with``: further arguments of the function, ``{printed: N1}`` for a printed number of the paper.
    """

    caption: str
    reads: list[str] = Field(min_length=1)
    plot: Plot | None = None
    of: list[str] | None = Field(default=None, min_length=1)
    claims: list[str] = Field(default_factory=list)
    settings: dict[str, Any] = Field(default_factory=dict, alias="with")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.plot and len(self.reads) != 1:
            raise Misfit("plot", "does not have one dataset", "give one name in reads")
        if self.of and not self.plot:
            raise Misfit("of", "has an effect only with plot", "add plot, or leave it out")
        if self.of and self.plot == "utilisation":
            raise Misfit(
                "of", "not with this plot, which shows all limits of the study", "leave it out"
            )
        if self.of and self.plot in OF_SEAS:
            raise Misfit("of", f"not with {self.plot!r}, which shows all modes", "leave it out")
        if self.settings and self.plot:
            raise Misfit("with", "not with plot, which has no arguments", "leave it out")
        return self
