"""How figures look, and plots that fit any grid."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from riserstudy.study.figures import FigureModel


def module_of_plot(plot: str) -> str:
    """The module that draws a plot for any grid, by a function of its own name."""
    return f"riserstudy.figures.{plot.replace(' ', '_')}"


def draw_plot(model: FigureModel, dataset: xr.Dataset) -> Figure:
    """A figure that names a plot for any grid."""
    module = import_module(module_of_plot(str(model.plot)))
    figure: Figure = getattr(module, module.__name__.rpartition(".")[2])(dataset, model.of)
    return figure


def save(figure: Figure, *targets: Path) -> None:
    """Write a figure in the formats of the targets' endings, each whole or not at all."""
    for target in targets:
        target.parent.mkdir(parents=True, exist_ok=True)
        partial = target.with_name(f".{target.stem}.partial{target.suffix}")
        metadata = {"CreationDate": None} if target.suffix == ".pdf" else None
        figure.savefig(partial, metadata=metadata)
        partial.replace(target)
        figure.set_layout_engine("none")  # the next format is laid out as this one
