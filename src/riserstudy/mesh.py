"""Where the nodes are: equal segments, or base segments graded towards held ends, halved per level."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.scene.models import Scene

GROWTH = 1.7  # ratio of neighbouring segments in a graded layer
LAYER = 0.7  # first segment of a layer, in layer lengths sqrt(EI/T)
COARSEST = 8  # segments over the riser before grading


class Mesh(NamedTuple):
    """Unstretched segment lengths (m) and the section that each segment belongs to.

    A telescopic joint is one more segment at the top, of a section of its own, never cut.
    """

    l0: NDArray[np.float64]
    section: NDArray[np.int64]
    joint: bool = False

    @property
    def s(self) -> NDArray[np.float64]:
        """Unstretched arclength of the nodes from the bottom (m)."""
        return np.concatenate([[0.0], np.cumsum(self.l0)])

    @property
    def ring(self) -> int:
        """Node of the tension ring: the riser's top, below the telescopic joint if there is one."""
        return len(self.l0) - int(self.joint)

    @property
    def riser_length(self) -> float:
        """Unstretched length of the riser up to the tension ring (m)."""
        return float(self.l0[: self.ring].sum())

    def halved(self) -> Mesh:
        """Every segment of the riser cut in two."""
        cuts = np.full(len(self.l0), 2)
        cuts[self.ring :] = 1
        return Mesh(np.repeat(self.l0 / cuts, cuts), np.repeat(self.section, cuts), self.joint)


def even(scene: Scene, elements: int) -> Mesh:
    """Equal segments within each section, ``elements`` in all or a few more."""
    lengths = [section.total_length for section in scene.riser]
    size = sum(lengths) / elements
    counts = [max(1, round(length / size)) for length in lengths]
    return _with_joint(
        scene,
        np.concatenate([np.full(k, x / k) for k, x in zip(counts, lengths, strict=True)]),
        np.repeat(np.arange(len(lengths)), counts),
    )


def _with_joint(scene: Scene, l0: NDArray[np.float64], section: NDArray[np.int64]) -> Mesh:
    joint = scene.top.telescopic_joint
    if joint is None:
        return Mesh(l0, section)
    return Mesh(np.append(l0, joint.length), np.append(section, len(scene.riser)), True)


def graded(scene: Scene, layers: tuple[float, float], elements: int = COARSEST) -> Mesh:
    """Segments of about equal length, finer towards ends where bending is confined to a layer.

    ``layers``: lengths sqrt(EI/T) at bottom and tension ring (m), infinite where there is none.
    """
    lengths = [section.total_length for section in scene.riser]
    total = sum(lengths)
    pieces, owner = [], []
    start = 0.0
    for k, length in enumerate(lengths):
        nodes = [0.0]
        while nodes[-1] < length - 1e-9 * total:
            below = start + nodes[-1]
            size = min(
                total / elements,
                LAYER * layers[0] + (GROWTH - 1.0) * below,
                LAYER * layers[1] + (1.0 - 1.0 / GROWTH) * max(total - below, 0.0),
            )
            nodes.append(nodes[-1] + size)
        cuts = np.array(nodes) * (length / nodes[-1])
        pieces.append(np.diff(cuts))
        owner.append(np.full(len(cuts) - 1, k))
        start += length
    return _with_joint(scene, np.concatenate(pieces), np.concatenate(owner))
