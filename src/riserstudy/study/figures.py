"""Figures of a study file, drawn by a function of the chapter or by a plot that fits any grid."""

from __future__ import annotations

from typing import Any, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict

Plot = Literal["lines", "heat map", "utilisation", "envelope", "time series", "workable hours"]
#: number of axes that each plot requires
NEEDS: dict[Plot, int] = {
    "lines": 1,
    "heat map": 2,
    "utilisation": 1,
    "envelope": 0,
    "time series": 0,
    "workable hours": 0,
}
#: plots that are only for datasets below ``seas``
OF_SEAS: frozenset[Plot] = frozenset(("workable hours",))


class FigureModel(Strict):
    """A figure: its caption, the datasets that it reads, and the function or plot that draws it.

    ``plot``: a plot that fits any grid: lines over an axis, a heat map over two axes, the utilisation of a
    study's limits over one or two axes, an envelope along the riser, or time series. For a dataset below
    ``seas``, it is workable hours. Absent: the chapter's function with the name of the figure. ``of``: the
    quantities to plot. Absent: the most important of the available quantities. ``claims``: IDs of the
    published values and claims that the figure is about. Absent: those of the published figure that it
    repeats, or those that use the datasets that it reads. ``with``: further arguments of the function;
    ``{printed: N1}`` is a published value of the paper.
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
            raise Misfit("plot", "a plot shows exactly one dataset", "give one name in reads")
        if self.of and not self.plot:
            raise Misfit("of", "has no effect without plot", "add plot, or remove it")
        if self.of and self.plot == "utilisation":
            found = "has no effect on this plot, which shows all limits of the study"
            raise Misfit("of", found, "remove it")
        if self.of and self.plot in OF_SEAS:
            found = f"has no effect on the plot {self.plot!r}, which shows all modes of operation"
            raise Misfit("of", found, "remove it")
        if self.settings and self.plot:
            raise Misfit("with", "has no effect on a plot, which has no arguments", "remove it")
        return self
