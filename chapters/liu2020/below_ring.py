"""Position of the tension ring in samples and variants, which interpret the length of 533 m differently."""

from __future__ import annotations

from collections.abc import Sequence

import xarray as xr

from riserstudy.dataset.extremes import largest_size, statistic_of

RING = 533.0  # m of riser below the ring, as in the scenes
#: interpretations of the printed length in config/studies/liu2020.yaml with another ring position (m)
RINGS = {"from the lower to the upper flex joint": 510.5, "533 m to the upper flex joint": 510.5}
#: where runs name these interpretations
NAMED = ("assumed_printed_length", "variant")


def ring_of(runs: xr.Dataset) -> xr.DataArray:
    """Arclength of the ring (m) in every sample or variant; one value if the length is not varied."""
    there = [name for name in NAMED if name in runs]
    if not there:
        return xr.DataArray(RING)
    read = runs[there[0]]
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


def largest_moment(runs: xr.Dataset) -> xr.DataArray:
    """Largest magnitude of the bending moment of each run (N m), from the lower end up to the ring.

    Unequal pulls of the cylinders turn the ring. Therefore the moment jumps there, and the telescopic joint
    above the ring may have a larger moment than the riser. A run's own largest moment includes this joint.
    """
    largest, at, ring = runs["largest_bending_moment"], runs["largest_bending_moment_s"], ring_of(runs)
    nodal = _at_nodes(runs, ring)
    return largest.where(at < ring - 1e-6, nodal.where(nodal < largest, largest))


def _at_nodes(runs: xr.Dataset, ring: xr.DataArray) -> xr.DataArray:
    """Largest magnitude of the moment at nodes (N m). At the ring's node it is the moment below the ring."""
    own = largest_size(runs, "bending_moment")
    high, low = (statistic_of(runs, "bending_moment", f"static_{side}") for side in ("max", "min"))
    if own is not None:
        return own
    if high is not None and low is not None:
        return _larger(abs(high), abs(low))
    moving = [f"bending_moment_{side}" for side in ("max", "min")]
    names = moving if set(moving) <= set(runs) else ["bending_moment_static"]
    sizes = [on_riser(abs(runs[name]), ring, "s_node").max("s_node") for name in names]
    return _larger(sizes[0], sizes[-1])


def _larger(one: xr.DataArray, other: xr.DataArray) -> xr.DataArray:
    return xr.concat([one, other], "of").max("of", skipna=False)


def first_at(history: xr.DataArray, share: float) -> xr.DataArray:
    """Time (s) at which the magnitude of a history first reaches a share of its maximum."""
    size = abs(history)
    there = size >= share * size.max("time")
    return there["time"].isel(time=there.argmax("time")).drop_vars("time")
