"""Answers by interpretation: a share counts samples within one interpretation, never interpretations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.grading.cases import places_of
from riserstudy.grading.confidence import share_with_interval
from riserstudy.grading.names import input_name
from riserstudy.grading.sensitivity import deciding
from riserstudy.grading.verdict import ALMOST_ALWAYS, ALMOST_NEVER
from riserstudy.records.graded import Kind, Place, Reading, ReadingAnswer, Share


def axes_of_readings(found: xr.DataArray) -> list[str]:
    """Axes on which every value is an interpretation: all except samples."""
    return [str(dim) for dim in found.dims if dim != "sample" and found.sizes[dim] > 1]


def readings_of(
    kind: Kind, found: xr.DataArray, about: xr.Dataset, called: Mapping[str, str] | None
) -> list[Reading]:
    """Results with each interpretation; empty if there is only one.

    Without samples, interpretations are distinguished on the fewest axes that determine the answer.

    Parameters
    ----------
    found : as ``riserstudy.grading.found.answers``.
    about : as in ``riserstudy.grading.sensitivity.deciding``.
    """
    axes = axes_of_readings(found)
    if axes and "sample" not in found.dims:
        axes = _deciding_axes(found, axes)
        found = found.max([dim for dim in found.dims if dim not in axes])  # all known ones are equal
    return [*_each(kind, found, axes, about, called)] if axes else []


def _each(
    kind: Kind, found: xr.DataArray, axes: Sequence[str], about: xr.Dataset, called: Mapping[str, str] | None
) -> Iterator[Reading]:
    beginnings = found.isel({dim: 0 for dim in found.dims if dim not in axes}, drop=True)
    for _, place in places_of(beginnings.transpose(*axes)):
        here = found.sel(place)
        if not bool(here.notnull().any()):
            continue
        share = share_with_interval(here)
        answer = answer_of(kind, share)
        names: list[str] = []
        if answer == "depends":
            names = [input_name(path, called) for path in deciding(here, about).names]
        yield Reading(place, answer, share, names)


def answer_of(kind: Kind, share: Share) -> ReadingAnswer:
    """The answer of a share of samples: the answer of almost all samples, or "depends"."""
    true, same = share.met / share.samples, share.same / share.samples
    if true >= ALMOST_ALWAYS:
        return "true"
    if same >= ALMOST_ALWAYS:
        return "no difference"
    never = share.met == 0 if kind == "number" else true <= ALMOST_NEVER
    return "false" if never else "depends"


def base_share(found: xr.DataArray, base: Place) -> Share | None:
    """The share of samples with the interpretation of the base case, if both exist."""
    axes = axes_of_readings(found)
    if "sample" not in found.dims or any(axis not in base for axis in axes):
        return None
    return share_with_interval(found.sel({axis: base[axis] for axis in axes}))


def _deciding_axes(found: xr.DataArray, axes: Sequence[str]) -> list[str]:
    """The fewest axes whose values alone determine the answer."""
    if float(found.max()) == float(found.min()):
        return [*axes]
    for count in range(1, len(axes)):
        for some in combinations(axes, count):
            others = [axis for axis in axes if axis not in some]
            spread: Any = found.max(others) - found.min(others)
            if not bool(np.any(spread.values > 0.0)):
                return [*some]
    return [*axes]
