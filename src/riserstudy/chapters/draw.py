"""Draw a figure of a chapter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from riserstudy.chapters import function_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def draw(
    paper: str, name: str, datasets: dict[str, xr.Dataset], settings: dict[str, Any] | None = None
) -> Figure:
    """Figure ``name`` of a paper, by the function of that name in its chapter's figures.

    ``settings`` are what the study file tells it besides the datasets.
    """
    figure: Figure = function_of(paper, "figures", name)(**datasets, **(settings or {}))
    return figure
