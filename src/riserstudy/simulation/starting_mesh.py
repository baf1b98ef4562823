"""The mesh and time step from which a refinement starts."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import SimulationError
from riserstudy.model.layout import stiffness
from riserstudy.model.mesh import COARSEST, Layer, Mesh, even, graded
from riserstudy.model.model import Model
from riserstudy.model.sea import current_velocity, depth_of_action
from riserstudy.model.soil import pile_length
from riserstudy.model.vortices import shortest_shedding_period
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.half_waves import half_wave

LONG = 80.0  # riser length, in layer lengths, from which on an even mesh is too coarse at ends
# factor on the period of vortices, which 20 steps resolve, while other periods require 24
VORTEX = 1.2
OF_HALF_A_WAVE = 3  # segments of the coarsest mesh in half a wave of vortices
# deviation of the speed from a straight line over two bending layers, as a share of the largest speed, from
# which on a current loads the riser like a concentrated force
SUDDEN = 0.1
QUIET = 20.0  # period (s) from which the time step is chosen if the scene has no period


def coarsest_mesh(scene: Resolved) -> Mesh:
    """Coarse mesh, graded where held ends confine bending to a layer sqrt(EI/T), and under waves.

    With vortices, it resolves the waves that they send along the riser.
    """
    if not scene.lateral:
        return even(scene, len(scene.riser) if massless(scene) else COARSEST)
    model, probe = _at_rest(scene)
    layers = _end_layers(scene, model, probe)
    if scene.wave and scene.water:
        layers[1] = min(layers[1], depth_of_action(scene.wave, scene.water, scene.gravity or 0.0))
    fine = [Layer(0.0, layers[0]), Layer(probe.riser_length, layers[1])]
    body = scene.bottom.body
    for k, section in enumerate(scene.riser):
        if section.corner_below or (k == 1 and body and body.reach):
            e = probe.foot(k)
            layer = _layer(stiffness(section).bending, _tension(model, e))
            fine.append(Layer(float(probe.s[e]), layer))
    fine += _thin_layers(scene, model, probe)
    waves = half_wave(scene, probe, _tensions(model))
    longest = {k: length / OF_HALF_A_WAVE for k, length in waves.items()}
    if scene.soil:
        for k, section in enumerate(scene.riser[: max(scene.lowest_riser_section, 1)]):
            if k == 0 or _below_mudline(scene, k):
                bending = stiffness(section).bending
                size = 0.5 * pile_length(scene.soil, section, bending)
                longest[k] = min(longest.get(k, math.inf), size)
    confined = longest or any(layer.length < math.inf for layer in fine)
    return graded(scene, fine, longest=longest) if confined else probe


def _thin_layers(scene: Resolved, model: Model, probe: Mesh) -> list[Layer]:
    """Places at which the current changes much within a bending layer of the riser, as at a jump."""
    if scene.current is None:
        return []
    z, velocity = current_velocity(scene.current, scene.water)
    bending = [stiffness(scene.riser[k]).bending for k in probe.section[: probe.ring]]
    tension = np.abs(_tensions(model)[: probe.ring])
    layer = np.array([_layer(*pair) for pair in zip(bending, tension.tolist(), strict=True)])
    nodes = np.maximum.accumulate(model.s.r[-1, : probe.ring + 1])
    inside = np.flatnonzero((z > nodes[0]) & (z < nodes[-1]))
    length = layer[np.searchsorted(nodes[1:-1], z[inside])]
    below, above = (
        np.array([np.interp(z[inside] + side * length, z, part) for part in velocity]) for side in (-1.0, 1.0)
    )
    off = np.linalg.norm(velocity[:, inside] - 0.5 * (below + above), axis=0)
    sudden = (off > SUDDEN * np.linalg.norm(velocity, axis=0).max()) & (length < math.inf)
    places = np.interp(z[inside], nodes, probe.s[: probe.ring + 1])
    return [Layer(float(s), float(a)) for s, a in zip(places[sudden], length[sudden], strict=True)]


def _below_mudline(scene: Resolved, k: int) -> bool:
    """Whether the lower end of a section is in the soil."""
    if scene.soil is None or scene.bottom.elevation is None:
        return False
    below = sum(section.total_length for section in scene.riser[:k])
    return scene.bottom.elevation + below < scene.soil.mudline


def end_layers(scene: Resolved) -> tuple[float, float]:
    """Bending layers at the lower and the upper end (m); infinite where an even mesh is sufficient.

    Raises SimulationError when no equilibrium is found.
    """
    if not scene.lateral:
        return math.inf, math.inf
    low, high = _end_layers(scene, *_at_rest(scene))
    return low, high


def _end_layers(scene: Resolved, model: Model, probe: Mesh) -> list[float]:
    return [_end_layer(scene, model, probe, end) for end in (0, probe.ring - 1)]


def _at_rest(scene: Resolved) -> tuple[Model, Mesh]:
    """The scene in equilibrium on a coarse even mesh.

    On such a mesh, there may be no equilibrium, or an unstable one in parts under compression.
    """
    probe = even(scene, COARSEST)
    for _ in range(4):
        try:
            return settle(scene, probe)[0], probe
        except SimulationError:
            probe = probe.halved()
    return settle(scene, probe)[0], probe


def _end_layer(scene: Resolved, model: Model, probe: Mesh, end: int) -> float:
    """Bending layer (m) at an end, from its end segment; infinite where an even mesh is sufficient."""
    rotation = (scene.bottom if end == 0 else scene.top).rotation
    held = rotation not in (None, "free") or (end > 0 and probe.joint)
    flex = model.s.flex_up[end]
    share = 6.0 if held else 12.0  # divisor of a segment's flexibility, see `bending`
    layer = _layer(probe.l0[end] / (share * flex) if flex > 0.0 else 0.0, _tension(model, end))
    # for an end that rotates freely, the even mesh of a short riser is fine enough, and of higher order
    return layer if held or probe.riser_length > LONG * layer else math.inf


def _tensions(model: Model) -> NDArray[np.float64]:
    """Tensions of all segments, (n,), N."""
    return np.asarray((model.s.segment * model.s.tangent).sum(axis=0))


def _tension(model: Model, segment: int) -> float:
    """Magnitude of a segment's axial force (N)."""
    return abs(float(model.s.segment[:, segment] @ model.s.tangent[:, segment]))


def _layer(bending: float, tension: float) -> float:
    """Length over which the bending at an end decays (m); infinite for a string."""
    return math.sqrt(bending / tension) if bending > 0.0 and tension > 0.0 else math.inf


def massless(scene: Resolved) -> bool:
    """Whether the string is a massless spring, which one segment represents exactly."""
    bare = all(s.mass is None and s.submerged_weight is None for s in scene.riser)
    return bare and not scene.lateral


def period(scene: Resolved) -> float:
    """Period that a time step must resolve (s): the shortest of the scene, or a fraction of the run."""
    shortest = scene.shortest_period or min(QUIET, 0.25 * (scene.analysis.duration or math.inf))
    return min(shortest, VORTEX * shortest_shedding_period(scene))
