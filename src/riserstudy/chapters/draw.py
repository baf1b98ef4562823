"""Draw a figure of a chapter."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.chapters import function_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def draw(paper: str, name: str, datasets: dict[str, xr.Dataset]) -> Figure:
    """Figure ``name`` of a paper, by the function of that name in its chapter's figures."""
    figure: Figure = function_of(paper, "figures", name)(**datasets)
    return figure
