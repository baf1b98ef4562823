"""Which arrays of a run a study needs: what it keeps, its extremes, what lays it on other nodes."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

#: coordinates, and what tells corners and cylinders
ALWAYS = frozenset(("time", "s", "s_node", "mesh_corner", "tensioner_force_static"))
PLACES = frozenset("xyz")
#: what lays moments on other nodes, and positions, since a segment bends by its moments
MOMENTS = frozenset(("bending_moment", "mesh_moment"))
BENDS = PLACES | MOMENTS | {"mesh_flexibility"}


def needed(shapes: Mapping[str, Sequence[int]], keep: Collection[str] | None) -> frozenset[str]:
    """Names of the arrays, out of those of a run, that some quantities are made from; None: all.

    Parameters
    ----------
    shapes : of all arrays of the run by name; of ``time``, ``s`` and ``s_node`` at least.
    """
    if keep is None:
        return frozenset(shapes)
    if "time" not in shapes:  # the state at rest has short names, too
        keep = {*keep, *(f"{name}_static" for name in keep)}
    wanted = ALWAYS.union(with_envelopes(keep))
    at_nodes = "time" in shapes and shapes["s"] == shapes["s_node"]
    if at_nodes and PLACES.intersection(keep):
        wanted |= BENDS
    if at_nodes and MOMENTS.intersection(keep):
        wanted |= MOMENTS
    return wanted.intersection(shapes)


def with_envelopes(keep: Collection[str]) -> list[str]:
    """Quantities to keep, and the envelopes of their histories, which see every step and all nodes."""
    return [*keep, *(f"{name}{end}" for name in keep for end in ("_max", "_min"))]
