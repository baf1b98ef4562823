"""Sea states of a record as points of height and period, each with the rows that have it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.records.words import counted

if TYPE_CHECKING:
    import xarray as xr

NEEDED = ("significant_wave_height", "peak_period")
CALM = 0.001  # m: significant height that represents a calm sea, which a scene cannot have


class SeaStates(NamedTuple):
    """The distinct sea states of a record."""

    states: FloatArray  # (n, 2): significant height (m), peak period (s)
    rows: NDArray[np.int64]  # (n,) number of selected rows that have it
    # (rows,) index of the sea state; -1 for rows without height or period, or not selected
    state_of_row: NDArray[np.int64]

    def among(self, rows: NDArray[np.bool_], others: Sequence[int] = ()) -> SeaStates:
        """The sea states of some rows of the record, (rows,), and others by their indices, without rows."""
        of = np.where(rows, self.state_of_row, -1)
        counts = np.bincount(of[of >= 0], minlength=len(self.states))
        there = counts > 0
        there[list(others)] = True
        number = np.where(there, np.cumsum(there) - 1, -1)
        return SeaStates(self.states[there], counts[there], np.where(of >= 0, number[of], -1))


def without_waves(record: xr.Dataset) -> NDArray[np.bool_]:
    """For each row of a record, whether its significant height is zero, (rows,); false without heights."""
    if "significant_wave_height" not in record:
        return np.zeros(record.sizes["time"], bool)
    return np.asarray(record["significant_wave_height"].values == 0.0)


def with_calm_periods(record: xr.Dataset) -> xr.Dataset:
    """The record with the median peak period of the other rows in rows without waves that lack a period.

    Records of buoys leave out the period of a calm sea. Without these rows, the share of all other sea states
    would be too large.
    """
    if "peak_period" not in record:
        return record
    period = record["peak_period"]
    calm = without_waves(record) & ~np.isfinite(period.values)
    known = period.values[~calm & np.isfinite(period.values)]
    if not calm.any() or not known.size:
        return record
    filled = period.copy(data=np.where(calm, np.median(known), period.values))
    note = f"{counted(int(calm.sum()), 'row')} without waves or a period: set to the median of the other rows"
    filled.attrs["comment"] = "; ".join(filter(None, (period.attrs.get("comment"), note)))
    return record.assign(peak_period=filled)


def sea_states(record: xr.Dataset) -> SeaStates:
    """The sea states of a record (`riserstudy.seas.record.read_record`).

    Calm rows, without waves, may lack a period; they have the median period of the other rows. Raises
    InputError when it has no heights and periods.
    """
    for name in NEEDED:
        if name not in record:
            there = ", ".join(sorted(map(str, record.data_vars)))
            found = f"the record has no such column; it has {there}"
            raise InputError("RECORD", name, found, "add this column")
    if np.isfinite(_values(record)).all(axis=1).sum() < 2:
        found = "fewer than two rows have both values"
        raise InputError("RECORD", " and ".join(NEEDED), found, "add rows with both values")
    values = _values(with_calm_periods(record))
    known = np.isfinite(values).all(axis=1)
    values[known, 0] = np.maximum(values[known, 0], CALM)
    states, of, rows = np.unique(values[known], axis=0, return_inverse=True, return_counts=True)
    state_of_row = np.full(len(values), -1)
    state_of_row[known] = of.ravel()
    return SeaStates(states, rows, state_of_row)


def _values(record: xr.Dataset) -> FloatArray:
    """Height and period of each row, (rows, 2)."""
    return np.column_stack([record[name].values for name in NEEDED]).astype(float)
