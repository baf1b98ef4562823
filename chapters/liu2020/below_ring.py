"""Position of the tension ring in samples, which interpret the printed length of 533 m differently."""

from __future__ import annotations

from collections.abc import Sequence

import xarray as xr

RING = 533.0  # m of riser below the ring, as in the scenes
#: interpretations of the printed length in config/studies/liu2020.yaml with another ring position (m)
RINGS = {"from the lower to the upper flex joint": 510.5}


def ring_of(runs: xr.Dataset) -> xr.DataArray:
    """Arclength of the ring (m) in every sample; one value for all runs if the length is not sampled."""
    if "assumed_printed_length" not in runs:
        return xr.DataArray(RING)
    read = runs["assumed_printed_length"]
    return read.copy(data=[RINGS.get(str(name), RING) for name in read.values]).astype(float)


def at_depths(values: xr.DataArray, ring: xr.DataArray, depths: Sequence[float]) -> xr.DataArray:
    """Values at stations below the ring, with the dimension ``depth`` (m) instead of ``s``.

    Raises
    ------
    KeyError
        If a run has no station at one of the depths.
    """
    depth = xr.DataArray(list(depths), dims="depth", coords={"depth": list(depths)})
    below: xr.DataArray = values.sel(s=(ring - depth).round(6))
    return below.drop_vars("s")


def on_riser(values: xr.DataArray, ring: xr.DataArray, along: str = "s") -> xr.DataArray:
    """Values from the lower end to the ring, and NaN above the ring."""
    return values.where(values[along] <= ring + 1e-6)


def first_at(history: xr.DataArray, share: float) -> xr.DataArray:
    """Time (s) at which the magnitude of a history first reaches a share of its maximum."""
    size = abs(history)
    there = size >= share * size.max("time")
    return there["time"].isel(time=there.argmax("time")).drop_vars("time")
