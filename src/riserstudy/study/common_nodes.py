"""Nodes on which the runs of a study are stored together, if their meshes differ."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from riserstudy.records.arrays import FloatArray

NODE_DIGITS = 6  # nodes that differ by less than a micrometre are one node
_WHOLE = 1e-6  # a number of segments that exceeds an integer by less than this is the integer


def common_nodes(meshes: list[FloatArray]) -> FloatArray:
    """Nodes (m, shape (n,)) that are, at each place, as close as those of the mesh that is finest there.

    Kept are the upper end of each riser, and each node of all risers that reach it, as at the end of a
    section. Where one mesh is the finest between two of these nodes, its nodes are used.

    Parameters
    ----------
    meshes : nodes of each mesh (m, each of shape (its number of nodes,)) from the lower end, which is 0.
    """
    own = [np.unique(mesh.round(NODE_DIGITS)) for mesh in meshes]
    nodes, shared_by = np.unique(np.concatenate(own), return_counts=True)
    spacing = _least_spacing(own, nodes)
    counted = np.concatenate([[0.0], np.cumsum(np.diff(nodes) / spacing)])  # segments below each node
    tops = np.sort([mesh[-1] for mesh in own])
    reached_by = len(tops) - np.searchsorted(tops, nodes)
    kept = np.flatnonzero((shared_by == reached_by) | np.isin(nodes, tops))
    placed = [nodes[:1]]
    for low, high in pairwise(kept.tolist()):
        segments = max(1, int(np.ceil(counted[high] - counted[low] - _WHOLE)))
        at = np.linspace(counted[low], counted[high], segments + 1)[1:]
        placed.append(np.interp(at, counted[low : high + 1], nodes[low : high + 1]).round(NODE_DIGITS))
    return np.unique(np.concatenate(placed))


def _least_spacing(meshes: list[FloatArray], nodes: FloatArray) -> FloatArray:
    """Length (m) of the shortest segment of any mesh between consecutive nodes (all nodes of all meshes)."""
    starts = np.concatenate([np.searchsorted(nodes, mesh[:-1]) for mesh in meshes])
    ends = np.concatenate([np.searchsorted(nodes, mesh[1:]) for mesh in meshes])
    lengths = nodes[ends] - nodes[starts]
    spacing = np.full(len(nodes) - 1, np.inf)
    for k in np.argsort(-lengths, kind="stable").tolist():  # the shortest last
        spacing[starts[k] : ends[k]] = lengths[k]
    return spacing
