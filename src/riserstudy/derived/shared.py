"""What chapters share: amplitudes over last periods, scenes behind points, how datasets are described."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.dataset.variables import attributes
from riserstudy.scene.load import SceneFile
from riserstudy.scene.models import Scene


def described(dataset: xr.Dataset, paper: str, title: str) -> xr.Dataset:
    """The dataset with CF attributes; coordinates that are no dimensions are left out."""
    for name in dataset.variables:
        kept = {k: v for k, v in dataset[name].attrs.items() if str(name).startswith("assumed_")}
        dataset[name].attrs = attributes(str(name)) | kept
    dataset.attrs = {"Conventions": "CF-1.11", "paper": paper, "title": f"{paper}: {title}"}
    return dataset.drop_vars([n for n in dataset.coords if n not in dataset.dims])


def half_swing(history: xr.DataArray, period: str | float, back: int = 0) -> xr.DataArray:
    """Half of (largest - smallest) over one period, the last or one ``back`` from it.

    Parameters
    ----------
    history : over ``time`` (s).
    period : in seconds, or a dimension of the history whose values are periods.
    """
    return _by_period(history, period, back, lambda h, _: 0.5 * (h.max("time") - h.min("time")))


def first_harmonic(history: xr.DataArray, period: str | float) -> xr.DataArray:
    """Complex amplitude of exp(2 pi i t / period) over the last period."""

    def harmonic(part: xr.DataArray, seconds: float) -> xr.DataArray:
        turn = np.exp(-2j * np.pi * part["time"] / seconds)
        return 2.0 * (part * turn).mean("time")

    return _by_period(history, period, 0, harmonic)


def settling(history: xr.DataArray, period: str | float) -> xr.DataArray:
    """Relative change of the half swing from the last period but one to the last."""
    last, before = half_swing(history, period), half_swing(history, period, back=1)
    return abs(last / before - 1.0)


def _by_period(
    history: xr.DataArray,
    period: str | float,
    back: int,
    measure: Callable[[xr.DataArray, float], xr.DataArray],
) -> xr.DataArray:
    end = float(history["time"][-1])

    def of(part: xr.DataArray, seconds: float) -> xr.DataArray:
        time = part["time"]
        inside = (time > end - (back + 1) * seconds + 1e-6) & (time <= end - back * seconds + 1e-6)
        return measure(part.isel(time=inside.values), seconds)

    if not isinstance(period, str):
        return of(history, period)
    parts = [of(history.sel({period: value}), float(value)) for value in history[period].values]
    joined = xr.concat(parts, history[period])
    return joined.transpose(*(dim for dim in history.dims if dim in joined.dims))


def sampled(source: xr.Dataset) -> dict[str, xr.DataArray]:
    """What each sample assumed."""
    return {str(n): v for n, v in source.data_vars.items() if str(n).startswith("assumed_")}


def scenes_of(dataset: xr.Dataset) -> Iterator[tuple[dict[str, Any], Scene]]:
    """The place on the axes and the scene of every point of a simulated dataset."""
    axes = [str(dim) for dim in dataset["point_key"].dims]
    sets = {axis: json.loads(dataset[axis].attrs["sets"]) for axis in axes}
    base = SceneFile(dataset.attrs["scene_file"], json.loads(dataset.attrs["scene"]))
    for index in np.ndindex(dataset["point_key"].shape):
        place = {axis: dataset[axis].values[k].item() for axis, k in zip(axes, index, strict=True)}
        values: dict[str, Any] = {}
        for axis, value in place.items():
            values |= sets[axis][str(value)]
        yield place, base.with_values(values, "dataset").scene()
