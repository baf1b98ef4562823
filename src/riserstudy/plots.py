"""Figures that a study file asks for: drawn by a function of ours, or by a plot that fits any grid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Self

from pydantic import Field, model_validator

from riserstudy.scene.base import Strict

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.study import StudyModel

Plot = Literal["lines", "heat map", "envelope", "time series"]
#: axes that a grid needs
NEEDS: dict[Plot, int] = {"lines": 1, "heat map": 2, "envelope": 0, "time series": 0}


class FigureModel(Strict):
    """A figure: its caption, the datasets it reads, and what draws it.

    ``plot``: one that fits any grid: lines over an axis, a heat map over two axes, an envelope along the
    riser, time series. Absent: the function of the figure's name in riserstudy/figures/<paper>.py.
    ``of``: the quantities to plot. Absent: those that matter most among what there is.
    """

    caption: str
    reads: list[str] = Field(min_length=1)
    plot: Plot | None = None
    of: list[str] | None = Field(default=None, min_length=1)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.plot and len(self.reads) != 1:
            raise ValueError("plot: reads one dataset")
        if self.of and not self.plot:
            raise ValueError("of: needs a plot to show them in")
        return self


def default_figures(
    studies: dict[str, StudyModel], moving: dict[str, bool]
) -> dict[str, FigureModel]:
    """Figures of a study file that asks for none: every plot that fits each of its grids.

    Parameters
    ----------
    moving : whether a study's runs have a time.
    """
    return {
        f"{name}_{plot.replace(' ', '_')}": FigureModel(
            caption=f"{model.caption}: {said}", reads=[name], plot=plot
        )
        for name, model in studies.items()
        for plot, said in _fitting(len(model.axes), moving[name])
    }


def _fitting(axes: int, moving: bool) -> Iterator[tuple[Plot, str]]:
    if axes == 1:
        yield "lines", "extremes over the axis"
    if axes > 1:
        yield "heat map", "extremes over the axes"
    yield "envelope", "envelopes along the riser" if moving else "state along the riser"
    if moving:
        yield "time series", "histories where they vary most"
