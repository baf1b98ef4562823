"""What chapters share: amplitudes over the last periods of a history, and how datasets are described."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

from riserstudy.simulation import attributes


def described(dataset: xr.Dataset, paper: str, title: str) -> xr.Dataset:
    """The dataset with CF attributes; coordinates that are no dimensions are left out."""
    for name in dataset.variables:
        kept = {k: v for k, v in dataset[name].attrs.items() if str(name).startswith("assumed_")}
        dataset[name].attrs = attributes(str(name)) | kept
    dataset.attrs = {"Conventions": "CF-1.11", "paper": paper, "title": f"{paper}: {title}"}
    return dataset.drop_vars([n for n in dataset.coords if n not in dataset.dims])


def half_swing(history: xr.DataArray, period: str, back: int = 0) -> xr.DataArray:
    """Half of (largest - smallest) over one period, the last or one ``back`` from it.

    Parameters
    ----------
    history : over ``time`` (s), and over the dimension ``period`` whose values are periods (s).
    """
    return _by_period(history, period, back, lambda h: 0.5 * (h.max("time") - h.min("time")))


def first_harmonic(history: xr.DataArray, period: str) -> xr.DataArray:
    """Complex amplitude of exp(2 pi i t / period) over the last period."""

    def harmonic(part: xr.DataArray) -> xr.DataArray:
        turn = np.exp(-2j * np.pi * part["time"] / float(part[period]))
        return 2.0 * (part * turn).mean("time")

    return _by_period(history, period, 0, harmonic)


def settling(history: xr.DataArray, period: str) -> xr.DataArray:
    """Relative change of the half swing from the last period but one to the last."""
    last, before = half_swing(history, period), half_swing(history, period, back=1)
    return abs(last / before - 1.0)


def _by_period(
    history: xr.DataArray,
    period: str,
    back: int,
    measure: Callable[[xr.DataArray], xr.DataArray],
) -> xr.DataArray:
    end = float(history["time"][-1])
    parts = []
    for value in history[period].values:
        part = history.sel({period: value})
        inside = (part["time"] > end - (back + 1) * value + 1e-6) & (
            part["time"] <= end - back * value + 1e-6
        )
        parts.append(measure(part.isel(time=inside.values)))
    joined = xr.concat(parts, history[period])
    return joined.transpose(*(dim for dim in history.dims if dim in joined.dims))
