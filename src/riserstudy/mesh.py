"""Where the nodes are: equal segments, or base segments graded towards held ends, halved per level."""

from __future__ import annotations

import math
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

    def foot(self, section: int) -> int:
        """Lowest segment of a section, and the node at its lower end."""
        return int(np.searchsorted(self.section, section))

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


class Layer(NamedTuple):
    """Where bending is confined to a length sqrt(EI/T): at an end, or around a joint."""

    place: float  # arclength (m)
    length: float  # (m), infinite where nothing is confined


def graded(
    scene: Scene,
    layers: list[Layer],
    elements: int = COARSEST,
    longest: dict[int, float] | None = None,
) -> Mesh:
    """Segments of about equal length, finer towards places where bending is confined to a layer.

    ``longest``: length of segments (m), at most, in some sections.
    """
    lengths = [section.total_length for section in scene.riser]
    total = sum(lengths)
    pieces, owner = [], []
    start = 0.0
    for k, length in enumerate(lengths):
        nodes = [0.0]
        while nodes[-1] < length - 1e-9 * total:
            below = start + nodes[-1]
            size = min(total / elements, (longest or {}).get(k, math.inf))
            for layer in layers:
                away = below - layer.place
                growth = GROWTH - 1.0 if away >= 0.0 else 1.0 / GROWTH - 1.0
                size = min(size, LAYER * layer.length + growth * away)
            nodes.append(nodes[-1] + size)
        cuts = np.array(nodes) * (length / nodes[-1])
        pieces.append(np.diff(cuts))
        owner.append(np.full(len(cuts) - 1, k))
        start += length
    return _with_joint(scene, np.concatenate(pieces), np.concatenate(owner))


def blend_by_weight(blend: NDArray[np.float64], mesh: Mesh, weight: NDArray[np.float64]) -> None:
    """Share of the segment above in the tension at nodes where sections of different weight meet.

    Tension has a corner there, and lies between those of its segments by their weights.

    Parameters
    ----------
    blend : (n+1,) shares, changed where sections meet.
    weight : (n,) weight in water per length (N/m).
    """
    heavy = np.abs(weight) * mesh.l0
    for i in range(1, mesh.ring):
        if mesh.section[i - 1] != mesh.section[i] and heavy[i - 1 : i + 1].min() > 0.0:
            blend[i] = heavy[i - 1] / heavy[i - 1 : i + 1].sum()
