"""Draw a figure of a chapter."""

from __future__ import annotations

import re
from traceback import walk_tb
from typing import TYPE_CHECKING, Any

from riserstudy.chapters import function_of
from riserstudy.errors import InputError

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_QUOTED = re.compile(r"'([^']+)'")


def draw(
    paper: str, name: str, datasets: dict[str, xr.Dataset], settings: dict[str, Any] | None = None
) -> Figure:
    """Draw figure ``name`` of a paper, by the function of that name in its chapter's figures.

    ``settings`` are further arguments from the study file. Raises InputError when datasets lack a variable
    that the function reads; it names figure, dataset and variable.
    """
    function = function_of(paper, "figures", name)
    try:
        figure: Figure = function(**datasets, **(settings or {}))
    except (KeyError, AttributeError) as error:
        variable = _looked_up(error)
        names = {one: {*of.variables, *of.dims} for one, of in datasets.items()}
        lacking = [one for one in names if variable not in names[one]]
        if variable is None or not lacking:
            raise
        there = [(one, sorted(map(str, datasets[one].data_vars))) for one in lacking]
        has = "use one of these: " + "; ".join(f"{one} has {', '.join(of)}" for one, of in there)
        found = f"the figure draws {variable!r}, which is not in {' or '.join(lacking)}"
        raise InputError(f"{paper}, figure {name}", "", found, has) from error
    return figure


def _looked_up(error: KeyError | AttributeError) -> str | None:
    """Return the name that xarray did not find; None if the error is not from xarray."""
    if isinstance(error, AttributeError):
        return error.name if type(error.obj).__module__.startswith("xarray.") else None
    modules = [str(frame.f_globals.get("__name__")) for frame, _ in walk_tb(error.__traceback__)]
    quoted = _QUOTED.search(str(error))  # libraries quote the missing name
    return quoted[1] if quoted and modules[-1].startswith("xarray.") else None
