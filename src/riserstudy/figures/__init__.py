"""Figures: functions from datasets to matplotlib figures, one module a paper; and plots for any grid."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from riserstudy.study.figures import FigureModel


def draw(paper: str, name: str, datasets: dict[str, xr.Dataset]) -> Figure:
    """Figure ``name`` of a paper, by the function of that name in the paper's module."""
    figure: Figure = getattr(import_module(f"riserstudy.figures.{paper}"), name)(**datasets)
    return figure


def draw_plot(model: FigureModel, dataset: xr.Dataset) -> Figure:
    """A figure that names a plot for any grid."""
    kind = str(model.plot).replace(" ", "_")
    module = import_module(f"riserstudy.figures.generic.{kind}")
    figure: Figure = getattr(module, kind)(dataset, model.of)
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
