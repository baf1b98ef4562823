"""Meshes: equal segments, or segments graded towards bending layers; each refinement halves them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.space_out import joint_of
from riserstudy.scene.resolve import Resolved

GROWTH = 0.15  # increase of the segment length per metre of distance from a bending layer
# first segment of a layer on the coarsest mesh, as a share of the layer length sqrt(EI/T)
LAYER = 0.5
COARSEST = 8  # segments of the coarsest mesh
GRADED = 16  # segments of a graded mesh before its grading
# shortest segments that halving makes, as a share of the riser's length: rounding changes the moments between
# two much shorter ones, while a short section as one segment gives no such moments
SHORTEST = 5e-6
FINE = 4000  # points of the mapping that a graded mesh follows


class Mesh(NamedTuple):
    """Unstretched segment lengths (m) and the section that each segment belongs to.

    A telescopic joint is one additional segment at the top, with a separate section number; it is never
    divided. If the lowest section represents a body that turns with the riser's end, it is never divided
    either. A graded mesh keeps its mapping, one array of positions for each section; finer meshes therefore
    have the same smooth grading.
    """

    l0: NDArray[np.float64]
    section: NDArray[np.int64]
    joint: bool = False
    mapping: tuple[NDArray[np.float64], ...] = ()
    body: bool = False

    @property
    def s(self) -> NDArray[np.float64]:
        """Unstretched arclength of the nodes from the bottom, (n + 1,), m."""
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
        """The mesh with twice the number of segments in the riser, but none shorter than `SHORTEST`."""
        if not self.mapping:
            cuts = np.where(self.l0 >= 2.0 * SHORTEST * self.riser_length, 2, 1)
            cuts[self.ring :] = 1
            cuts[: int(self.body)] = 1
            return self._replace(l0=np.repeat(self.l0 / cuts, cuts), section=np.repeat(self.section, cuts))
        return self._scaled(2.0)

    def _scaled(self, times: float) -> Mesh:
        """The graded mesh with ``times`` the number of segments in the riser."""
        natural = np.bincount(self.section[: self.ring])
        lengths = np.bincount(self.section[: self.ring], self.l0[: self.ring])
        most = np.maximum(lengths / (SHORTEST * self.riser_length), natural)
        counts = np.maximum(1, np.minimum(np.round(times * natural), most).astype(int))
        counts[: int(self.body)] = 1
        l0, section = _laid(self.mapping, list(counts))
        return self._replace(
            l0=np.append(l0, self.l0[self.ring :]), section=np.append(section, self.section[self.ring :])
        )

    def with_about(self, elements: int) -> Mesh:
        """The graded mesh with about ``elements`` segments, graded in the same way."""
        return self._scaled(elements / self.ring)


def _laid(
    mapping: tuple[NDArray[np.float64], ...], counts: list[int]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Segment lengths and their sections, by the number of segments and the mapping of each section."""
    share = np.linspace(0.0, 1.0, FINE + 1)
    pieces = [
        np.diff(np.interp(np.linspace(0.0, 1.0, k + 1), share, place))
        for k, place in zip(counts, mapping, strict=True)
    ]
    return np.concatenate(pieces), np.repeat(np.arange(len(counts)), counts)


def lowest_leaning(scene: Resolved, mesh: Mesh) -> int:
    """The lowest node above which a riser is inclined: at its inner flex joint, the ground, or its end."""
    lowest = scene.lowest_riser_section or int(scene.soil is not None)
    return min(mesh.foot(lowest), len(mesh.l0) - 1)


def prescribed(scene: Resolved, elements: int) -> Mesh:
    """The mesh that the scene prescribes, equal or with layers, but with ``elements`` segments."""
    layers = scene.analysis.mesh and scene.analysis.mesh.layers
    if not layers:
        return even(scene, elements)
    length = sum(section.total_length for section in scene.riser)
    ends = [Layer(0.0, layers.bottom or math.inf), Layer(length, layers.top or math.inf)]
    return graded(scene, ends).with_about(elements)


def own_mesh(scene: Resolved) -> Mesh | None:
    """The mesh that the scene prescribes; None without one."""
    return prescribed(scene, scene.analysis.mesh.elements) if scene.analysis.mesh else None


def even(scene: Resolved, elements: int) -> Mesh:
    """Equal segments within each section, about ``elements`` in total."""
    lengths = [section.total_length for section in scene.riser]
    size = sum(lengths) / elements
    counts = [max(1, round(length / size)) for length in lengths]
    counts[0] = 1 if _has_body(scene) else counts[0]
    return _with_joint(
        scene,
        np.concatenate([np.full(k, x / k) for k, x in zip(counts, lengths, strict=True)]),
        np.repeat(np.arange(len(lengths)), counts),
    )


def mesh_of(scene: Resolved, l0: NDArray[np.float64]) -> Mesh:
    """The mesh of a scene with these segment lengths (n,), m, without the mapping of a graded mesh."""
    section = np.searchsorted(scene.borders[1:], np.cumsum(l0) - 0.5 * l0)
    return Mesh(l0, section, joint_of(scene) is not None, body=_has_body(scene))


def _with_joint(scene: Resolved, l0: NDArray[np.float64], section: NDArray[np.int64]) -> Mesh:
    joint, body = joint_of(scene), _has_body(scene)
    if joint is None:
        return Mesh(l0, section, body=body)
    return Mesh(np.append(l0, joint.length), np.append(section, len(scene.riser)), True, body=body)


def _has_body(scene: Resolved) -> bool:
    """Whether the lowest section represents a body that turns with the riser's end."""
    return scene.bottom.body is not None and scene.bottom.body.reach > 0.0


class Layer(NamedTuple):
    """A bending layer: bending is confined to a length sqrt(EI/T), at an end or around a joint."""

    place: float  # arclength (m)
    length: float  # (m), infinite where nothing is confined


def graded(
    scene: Resolved, layers: list[Layer], elements: int = GRADED, longest: dict[int, float] | None = None
) -> Mesh:
    """Segments of about equal length, finer towards places where bending is confined to a layer.

    ``longest``: largest segment length (m), by index of the section.
    """
    lengths = [section.total_length for section in scene.riser]
    total = sum(lengths)
    mapping, counts = [], []
    start = 0.0
    for k, length in enumerate(lengths):
        s = np.linspace(0.0, length, FINE + 1)
        size = np.full(FINE + 1, min(total / elements, (longest or {}).get(k, math.inf)))
        for layer in layers:
            away = np.abs(start + s - layer.place)
            size = np.minimum(size, LAYER * layer.length + GROWTH * away)
        count = np.concatenate([[0.0], np.cumsum(0.5 * (1.0 / size[1:] + 1.0 / size[:-1]) * np.diff(s))])
        whole = k == 0 and _has_body(scene)
        counts.append(1 if whole else max(1, round(count[-1])))
        mapping.append(np.interp(np.linspace(0.0, count[-1], FINE + 1), count, s))
        start += length
    l0, section = _laid(tuple(mapping), counts)
    return _with_joint(scene, l0, section)._replace(mapping=tuple(mapping))


def blend_by_weight(
    blend: NDArray[np.float64], kink: NDArray[np.float64], mesh: Mesh, weight: NDArray[np.float64]
) -> None:
    """Set how the tension at nodes where sections of different weight meet follows from both segments.

    The tension has a corner there. If both segments are heavy, or both are buoyant, it is a mean of the
    tensions of both segments, by their weights. Otherwise the tension has an extreme there, which may be
    outside the range of these tensions: their mean by lengths, plus a constant force. Below a telescopic
    joint, the tension continues that of the two highest segments; a constant force corrects it if they differ
    in weight. Above a body that turns with the riser's end the tension jumps, and the tension of the riser is
    used.

    Parameters
    ----------
    blend : (n+1,) shares of the upper segment, changed where sections meet.
    kink : (n+1,) forces (N), changed where sections meet.
    weight : (n,) weight in water per length (N/m).
    """
    heavy = weight * mesh.l0
    for i in range(1, mesh.ring):
        below, above = heavy[i - 1 : i + 1].tolist()
        if mesh.section[i - 1] == mesh.section[i]:
            continue
        if below * above > 0.0:
            blend[i] = below / (below + above)
        else:
            kink[i] = 0.5 * (below - float(blend[i]) * (below + above))
    if mesh.body:
        blend[1], kink[1] = 1.0, 0.0
    if mesh.joint and mesh.ring > 1 and mesh.section[mesh.ring - 1] != mesh.section[mesh.ring - 2]:
        last = slice(mesh.ring - 2, mesh.ring)
        mean = float(heavy[last].sum() / mesh.l0[last].sum())
        kink[mesh.ring] = 0.5 * float(mesh.l0[mesh.ring - 1] * (weight[mesh.ring - 1] - mean))
