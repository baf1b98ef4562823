"""Quantities of a study that plots can show, known before any run."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from riserstudy.dataset.variables import of_points, quantity_of
from riserstudy.errors import InputError
from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.limits import SIGNED
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.scene.resolve import Resolved
from riserstudy.study.axes import Numbers, Samples
from riserstudy.study.figures import FigureModel, Plot
from riserstudy.study.limits import limited
from riserstudy.study.study import Study

ALONG = tuple(name for name, of in QUANTITIES.items() if of.along)
#: default statistic of a quantity in a heat map
EXTREMES = {
    "bending_moment": "_absmax",
    "effective_tension": "_min",
    "x": "_absmax",
    "ufj_angle": "_absmax",
    "stroke": "_max",
    "z": "_max",
}
#: default quantities of each plot, in order of preference; a plot shows fewer of them
USUAL: dict[Plot, tuple[str, ...]] = {
    "lines": ("x", "bending_moment", "effective_tension", "ufj_angle", "stroke", "z"),
    "heat map": tuple(EXTREMES),
    "utilisation": (),
    "envelope": ("x", "y", "bending_moment", "effective_tension", "z"),
    "time series": ("x", "bending_moment", "effective_tension", "ufj_angle", "stroke", "z"),
    "workable hours": (),
}
SIDES = ("_max", "_min", "_absmax")
ANOTHER = "choose another quantity or plot"


class Reason(NamedTuple):
    """Why a plot cannot show a quantity, and what it can show."""

    why: str
    allowed: str = ANOTHER


def faults(figure: FigureModel, studies: dict[str, Study]) -> Iterator[Misfit]:
    """Faults of a figure whose plot cannot show its quantities; empty if only runs can decide."""
    (name, *_) = figure.reads
    if figure.plot is None or name not in studies:
        return
    wanted = figure.of or []
    for quantity in wanted:
        if reason := reason_to_leave_out(figure.plot, quantity, studies[name]):
            yield Misfit("of", f"{quantity!r} {reason.why}", reason.allowed)
    if not wanted and not shows(figure.plot, studies[name]):
        found = f"the runs of {name!r} return nothing that {_a(figure.plot)} shows"
        yield Misfit("of", found, ANOTHER)


def shows(plot: Plot, study: Study) -> bool:
    """Whether a plot can show default quantities of a study."""
    if plot == "utilisation":
        return limited(study)
    return any(not reason_to_leave_out(plot, quantity, study) for quantity in USUAL[plot])


def reason_to_leave_out(plot: Plot, quantity: str, study: Study) -> Reason | None:
    """Why a plot cannot show a quantity of a study; None if it can, or if only runs can decide."""
    stem = quantity_of(quantity) or quantity
    of = QUANTITIES.get(stem)
    over_grid = plot in ("lines", "heat map")
    if of_points(quantity):
        return None if over_grid else Reason(f"is a single number per point, which {_a(plot)} does not show")
    if plot == "envelope" and stem not in ALONG:
        return Reason("has no values along the riser", f"use one of {', '.join(ALONG)}")
    if plot == "time series" and (quantity != stem or (of and not of.history)):
        return Reason("has no time history", "choose plot 'lines' or 'envelope', which show extremes")
    if quantity.endswith("_static") and of and not of.at_rest:
        return Reason("has no value in static equilibrium")
    if plot == "envelope" and quantity.endswith("_absmax") and stem not in SIGNED:
        return Reason("has no magnitude along the riser, since its sign has a meaning")
    if not _is_kept(plot, quantity, stem, study):
        kept = study.model.keep
        if not kept:
            return Reason("has no extremes, since the runs are static")
        return Reason("is not stored", f"add it to keep of {study.name!r}, which has {', '.join(kept)}")
    return _reason_not_returned(plot, stem, study)


def _is_kept(plot: Plot, quantity: str, stem: str, study: Study) -> bool:
    """Whether a study keeps the data from which a plot computes a quantity; static runs have no extremes."""
    keep = study.model.keep
    moves = study.base.tree.get("analysis", {}).get("duration") is not None

    def there(*names: str) -> bool:
        return any((keep is None or n in keep) and (moves or not n.endswith(SIDES)) for n in names)

    sides = [stem + side for side in SIDES]
    if plot == "time series" or quantity.endswith("_static"):
        return there(quantity)
    if plot == "envelope":
        return there(quantity) if quantity != stem else there(*sides, *([] if moves else [stem]))
    if quantity == stem and plot == "heat map":
        quantity += EXTREMES.get(stem, "_max")
    if quantity.endswith("_absmax") or (quantity == stem and stem in SIGNED):
        return there(stem, *sides)
    if quantity == stem:
        return there(stem) or (there(stem + "_max") and there(stem + "_min"))
    return there(quantity, stem)


def _reason_not_returned(plot: Plot, stem: str, study: Study) -> Reason | None:
    """Why no run of a study returns a quantity; None if a run may return it."""
    scenes = [*_scenes(study)]
    if scenes and plot == "time series" and all(s.analysis.duration is None for s in scenes):
        return Reason(f"has no time history, since the runs of {study.name!r} are static")
    of = QUANTITIES.get(stem)
    lacks = [of.lacks(scene) for scene in scenes] if of else []
    if lacks and all(lacks):
        return Reason(f"is not returned by runs of {study.name!r}, whose scene has no {lacks[0]}")
    return None


def _scenes(study: Study) -> Iterator[Resolved]:
    """Scenes of a study with different parts; empty if one of them is invalid.

    All numbers of an axis give the same parts as its first number; samples may add and remove parts.
    """
    axes = study.model.axes
    if any(isinstance(axis, Samples) for axis in axes.values()):
        return
    labels = [
        () if isinstance(axis, Numbers) else range(len(study.axes[name])) for name, axis in axes.items()
    ]
    try:
        scenes = [study.grid.file(place).resolved() for place in study.grid.near_first(labels)]
    except InputError:  # planning reports the fault
        return
    yield from scenes


def _a(plot: Plot) -> str:
    return {"envelope": "an envelope", "heat map": "a heat map"}.get(plot, plot)
