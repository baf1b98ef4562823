"""Where the ring is in samples that read the printed length of 533 m in one way or the other."""

from __future__ import annotations

from collections.abc import Sequence

import xarray as xr

RING = 533.0  # m of riser below the ring, as scenes have it
#: the readings of config/studies/liu2020.yaml that put the ring elsewhere
RINGS = {"from the lower to the upper flex joint": 510.5}


def ring_of(runs: xr.Dataset) -> xr.DataArray:
    """Arclength of the ring (m), of every sample; of all runs where the length is not sampled."""
    if "assumed_printed_length" not in runs:
        return xr.DataArray(RING)
    read = runs["assumed_printed_length"]
    return read.copy(data=[RINGS.get(str(name), RING) for name in read.values]).astype(float)


def at_depths(values: xr.DataArray, ring: xr.DataArray, depths: Sequence[float]) -> xr.DataArray:
    """Values at stations below the ring, over ``depth`` (m) in place of ``s``.

    Raises
    ------
    KeyError
        When a run has no station there.
    """
    depth = xr.DataArray(list(depths), dims="depth", coords={"depth": list(depths)})
    below: xr.DataArray = values.sel(s=(ring - depth).round(6))
    return below.drop_vars("s")


def on_riser(values: xr.DataArray, ring: xr.DataArray, along: str = "s") -> xr.DataArray:
    """Values from the lower end to the ring, NaN above it."""
    return values.where(values[along] <= ring + 1e-6)


def first_at(history: xr.DataArray, share: float) -> xr.DataArray:
    """Time at which a history first leaves zero by a share of its largest size; as its times (s)."""
    size = abs(history)
    there = size >= share * size.max("time")
    return there["time"].isel(time=there.argmax("time")).drop_vars("time")
