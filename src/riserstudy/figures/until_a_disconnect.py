"""Limits that do not apply to all times that a figure shows, because a disconnect ends their operation."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

import xarray as xr

from riserstudy.dataset.provenance import read_provenance
from riserstudy.errors import InputError
from riserstudy.scene.limits import ends_with_disconnect

#: in what an axis sets, as JSON
SET_BY_AN_AXIS = re.compile(r'"disconnect(\.[^"]*)?": (?!null)')


def limits_of_all_times(dataset: xr.Dataset) -> Iterator[tuple[int, Mapping[str, Any]]]:
    """Number and row of each limit of a dataset that applies to all times of its runs.

    In a study where only some runs disconnect, it must apply to all times of these.
    """
    released = _disconnects(dataset)
    for k, row in enumerate(json.loads(dataset.attrs.get("limits", "[]"))):
        if not (released and ends_with_disconnect(row.get("mode"), row["output"])):
            yield k, row


def _disconnects(dataset: xr.Dataset) -> bool:
    """Whether a run of a dataset has a disconnect, in its scene or by an axis."""
    try:
        scene = read_provenance(dataset)["scene"]
    except InputError:  # of others, without a scene
        return False
    axes = (str(of.attrs.get("sets", "")) for of in dataset.coords.values())
    return bool(scene.get("disconnect")) or any(map(SET_BY_AN_AXIS.search, axes))
