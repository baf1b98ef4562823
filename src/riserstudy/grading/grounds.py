"""The grounds of a verdict as a record: shares of samples, what decides, and further cases. No words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.stats import binomtest

from riserstudy.grading.names import input_name
from riserstudy.grading.sensitivity import deciding, shares_by_option
from riserstudy.grading.sequential import SURE, decided_after
from riserstudy.grading.verdict import ALMOST_ALWAYS, few
from riserstudy.records.graded import Grounds, Influence, Outcome, Settled, Share, Verdict

MANY = 100  # samples from which a share has an interval

Called = (
    Mapping[str, str] | None
)  # what inputs are called, as in ``riserstudy.grading.names.input_name``


def explained(
    grounds: Grounds,
    hits: xr.DataArray,
    about: xr.Dataset,
    verdict: Verdict,
    base: bool,
    called: Called,
) -> Grounds:
    """The grounds with the share of the samples, and where it depends what decides.

    Parameters
    ----------
    hits : where it is met, over samples and cells.
    about : as in ``deciding``.
    base : whether the base case is met.
    """
    grounds = replace(grounds, share=share_of(hits))
    if verdict != "depends":
        return grounds
    if float(hits.mean()) >= ALMOST_ALWAYS:  # whatever else is open, it decides nothing
        short = base and few(hits.sizes.get("sample"))
        return replace(grounds, because="too few samples" if short else "base case")
    found = deciding(hits, about)
    options = shares_by_option(hits, about, found.names)
    influences = [
        Influence(
            name, input_name(name, called), found.total_effects.get(name), options.get(name, {})
        )
        for name in found.names
    ]
    return replace(grounds, because="inputs", decided_by=influences, explained=found.explained)


def outcome_of(
    name: str, value: xr.DataArray, hits: xr.DataArray, about: xr.Dataset, called: Called
) -> Outcome:
    """One further case, of one cell or many; ``hits`` and ``about`` as in ``explained``."""
    low, high = float(value.min()), float(value.max())
    if not hits.ndim:
        return Outcome(name, low, high, bool(hits))
    names = [input_name(path, called) for path in deciding(hits, about).names]
    return Outcome(name, low, high, bool(hits.all()), share_of(hits), names)


def share_of(hits: xr.DataArray) -> Share:
    """How many samples are hits, with the 95 % interval of the share of many samples.

    By Wilson; too wide for evenly spread ones. All cells of a sample count as one draw.
    """
    share = Share(int(hits.sum()), hits.size, hits.sizes.get("sample"))
    if share.draws is None or share.draws < MANY:
        return share
    true = round(float(hits.mean()) * share.draws)
    band = binomtest(true, share.draws).proportion_ci(method="wilson")
    return replace(share, low=float(band.low), high=float(band.high))


def settled(hits: NDArray[np.bool_]) -> Settled:
    """When the verdict was certain; ``hits`` as in ``decided_after``."""
    return Settled(decided_after(hits), len(hits), SURE)
