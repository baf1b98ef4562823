"""The mesh and step that a refinement starts from, and what of them a scene without its own gets."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import SimulationError
from riserstudy.model.layout import stiffness
from riserstudy.model.mesh import COARSEST, Layer, Mesh, even, graded
from riserstudy.model.model import Model
from riserstudy.model.sea import depth_of_action
from riserstudy.model.soil import pile_length
from riserstudy.model.vortices import shedding_period
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.half_waves import half_wave

LONG = 80.0  # risers, in layer lengths, whose even mesh would be too coarse at ends
VORTEX = 1.2  # of the shortest period of vortices, which 20 steps resolve where others take 24
OF_HALF_A_WAVE = 3  # segments of the coarsest mesh in half a wave of vortices
QUIET = 20.0  # step is chosen as for this period where nothing in the scene has one (s)


def coarsest_mesh(scene: Resolved) -> Mesh:
    """Coarse mesh, graded where held ends confine bending to a layer sqrt(EI/T), and under waves.

    Where vortices are shed, it resolves the waves that they send along the riser.
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


def _below_mudline(scene: Resolved, k: int) -> bool:
    """Whether the lower end of a section is in the soil."""
    if scene.soil is None or scene.bottom.elevation is None:
        return False
    below = sum(section.total_length for section in scene.riser[:k])
    return scene.bottom.elevation + below < scene.soil.mudline


def end_layers(scene: Resolved) -> tuple[float, float]:
    """Layers of bending at the lower and the upper end (m), infinite where an even mesh will do.

    Raises
    ------
    SimulationError
        When no equilibrium is found.
    """
    if not scene.lateral:
        return math.inf, math.inf
    low, high = _end_layers(scene, *_at_rest(scene))
    return low, high


def _end_layers(scene: Resolved, model: Model, probe: Mesh) -> list[float]:
    return [_end_layer(scene, model, probe, end) for end in (0, probe.ring - 1)]


def _at_rest(scene: Resolved) -> tuple[Model, Mesh]:
    """The scene in equilibrium on few even segments.

    So coarse a mesh may have none, or one that is unstable where the riser stands.
    """
    probe = even(scene, COARSEST)
    for _ in range(4):
        try:
            return settle(scene, probe)[0], probe
        except SimulationError:
            probe = probe.halved()
    return settle(scene, probe)[0], probe


def _end_layer(scene: Resolved, model: Model, probe: Mesh, end: int) -> float:
    """Layer of bending at an end, in the segment there; infinite where an even mesh will do."""
    rotation = (scene.bottom if end == 0 else scene.top).rotation
    held = rotation not in (None, "free") or (end > 0 and probe.joint)
    flex = model.s.flex_up[end]
    share = 6.0 if held else 12.0  # of a segment's flexibility, see `bending`
    layer = _layer(probe.l0[end] / (share * flex) if flex > 0.0 else 0.0, _tension(model, end))
    # a short riser's even mesh is fine enough for an end that turns freely, and of higher order
    return layer if held or probe.riser_length > LONG * layer else math.inf


def _tensions(model: Model) -> NDArray[np.float64]:
    """Of all segments, (n,), N."""
    return np.asarray((model.s.segment * model.s.tangent).sum(axis=0))


def _tension(model: Model, segment: int) -> float:
    """Size of a segment's force along itself (N)."""
    return abs(float(model.s.segment[:, segment] @ model.s.tangent[:, segment]))


def _layer(bending: float, tension: float) -> float:
    """Length over which a bent end straightens (m), infinite in a string."""
    return math.sqrt(bending / tension) if bending > 0.0 and tension > 0.0 else math.inf


def massless(scene: Resolved) -> bool:
    """Whether the string is a mere spring, which one segment represents exactly."""
    bare = all(s.mass is None and s.submerged_weight is None for s in scene.riser)
    return bare and not scene.lateral


def period(scene: Resolved) -> float:
    """What a step must resolve (s): the shortest period of the scene, a fraction of the run without one."""
    shortest = scene.shortest_period or min(QUIET, 0.25 * (scene.analysis.duration or math.inf))
    return min(shortest, VORTEX * shedding_period(scene))
