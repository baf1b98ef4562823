"""The grounds of a verdict as a record, without text: shares of samples, deciding inputs, further cases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from riserstudy.errors import SimulationError
from riserstudy.grading.confidence import share_with_interval
from riserstudy.grading.found import NO_DIFFERENCE
from riserstudy.grading.names import input_name
from riserstudy.grading.sensitivity import deciding, shares_by_option
from riserstudy.grading.sequential import SURE, decided_after
from riserstudy.grading.verdict import ALMOST_ALWAYS, few
from riserstudy.records.graded import Grounds, Influence, Kind, Outcome, Reading, Settled, Verdict

Called = Mapping[str, str] | None  # names of inputs, as in ``riserstudy.grading.names.input_name``


def explained(
    grounds: Grounds, found: xr.DataArray, about: xr.Dataset, verdict: Verdict, base: bool, called: Called
) -> Grounds:
    """The grounds, with the deciding inputs: interpretations if their answers differ, else other inputs.

    Parameters
    ----------
    found : whether it is met, over samples and cells; as ``riserstudy.grading.found.answers``.
    about : as in ``deciding``.
    verdict : verdict of the cases with a result.
    base : whether the base case meets it.
    """
    if verdict != "depends":
        return grounds
    shares = [reading.share for reading in grounds.readings] or [share_with_interval(found)]
    if not any(share.met for share in shares):  # of a number that the base case alone meets
        return replace(grounds, because="base case")
    if all(share.met / share.samples >= ALMOST_ALWAYS for share in shares):
        # no other unspecified input decides
        short = base and any(few(share.draws) for share in shares)
        return replace(grounds, because="too few samples" if short else "base case")
    if len({reading.answer for reading in grounds.readings}) > 1:
        return replace(grounds, because="inputs", decided_by=_axes(grounds.readings, called))
    decides = deciding(found, about)
    options = shares_by_option(found, about, decides.names)
    influences = [
        Influence(name, input_name(name, called), decides.total_effects.get(name), options.get(name, {}))
        for name in decides.names
    ]
    return replace(grounds, because="inputs", decided_by=influences, explained=decides.explained)


def _axes(readings: Sequence[Reading], called: Called) -> list[Influence]:
    """The axes on which interpretations differ; for a single axis with the share for each option."""
    axes = [*readings[0].place]
    options = {str(r.place[axes[0]]): r.share.met / r.share.samples for r in readings}
    by_option = options if len(axes) == 1 else {}
    return [Influence(axis, input_name(axis, called), None, by_option) for axis in axes]


def outcome_of(
    name: str,
    value: xr.DataArray,
    found: xr.DataArray,
    about: xr.Dataset,
    called: Called,
    readings: Sequence[Reading] = (),
) -> Outcome:
    """One further case with one or many cells; ``found`` and ``about`` as in ``explained``.

    ``readings``: its results with each interpretation, if there are several. Raises SimulationError when it
    has no result in any cell.
    """
    low, high = float(value.min()), float(value.max())
    if not bool(found.notnull().any()):
        raise SimulationError(
            f"{name}: the check returns no result in any case; correct the check or its data"
        )
    if not found.ndim:
        return Outcome(name, low, high, bool(found > 0.0), same=bool(found == NO_DIFFERENCE))
    every = bool((found > 0.0).all())
    if readings:
        return Outcome(name, low, high, every, readings=[*readings])
    names = [input_name(path, called) for path in deciding(found, about).names]
    return Outcome(name, low, high, every, share_with_interval(found), names)


def settled(hits: NDArray[np.bool_], kind: Kind, base: bool) -> Settled:
    """Number of samples until the verdict was certain; arguments as in ``decided_after``."""
    return Settled(decided_after(hits, kind, base), len(hits), SURE)
