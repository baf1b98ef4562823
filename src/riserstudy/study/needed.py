"""Arrays of a run that a study needs: kept quantities, extremes, and data to interpolate to other nodes."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

#: coordinates, and arrays that give corners and the number of cylinders
ALWAYS = frozenset(("time", "s", "s_node", "mesh_corner", "tensioner_force_static"))
PLACES = frozenset("xyz")
#: arrays for interpolation of moments and positions to other nodes, since moments bend a segment
MOMENTS = frozenset(("bending_moment", "mesh_moment", "mesh_above_ring"))
BENDS = PLACES | MOMENTS | {"mesh_flexibility"}


def needed(shapes: Mapping[str, Sequence[int]], keep: Collection[str] | None) -> frozenset[str]:
    """Names of the arrays of a run from which the quantities ``keep`` are computed; None: all.

    ``shapes``: shapes of the arrays of the run by name; ``time``, ``s`` and ``s_node`` are required.
    """
    if keep is None:
        return frozenset(shapes)
    if "time" not in shapes:  # static arrays also have short names
        keep = {*keep, *(f"{name}_static" for name in keep)}
    wanted = ALWAYS.union(with_envelopes(keep))
    at_nodes = "time" in shapes and shapes["s"] == shapes["s_node"]
    if at_nodes and PLACES.intersection(keep):
        wanted |= BENDS
    if at_nodes and MOMENTS.intersection(keep):
        wanted |= MOMENTS
    return wanted.intersection(shapes)


def with_envelopes(keep: Collection[str]) -> list[str]:
    """Quantities to keep, and the envelopes of their histories over all time steps and nodes."""
    return [*keep, *(f"{name}{end}" for name in keep for end in ("_max", "_min"))]
