"""Builds the model of a scene on a mesh: its effects, their records and the reason for each."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.synchronisation import VARIABLES
from riserstudy.effects.vortex_drag import VortexDrag
from riserstudy.effects.vortex_lift import VortexLift
from riserstudy.model.disconnect import lift_gauge
from riserstudy.model.ends import ends
from riserstudy.model.hydrodynamics import current, hydrodynamics, wave
from riserstudy.model.initial_shape import above_ground, between_ends, under_a_joint
from riserstudy.model.joints import between_sections, sliding_joint, stress_gauge
from riserstudy.model.layout import AXES, Layout, directions, layout_of
from riserstudy.model.mesh import Mesh, blend_by_weight, lowest_leaning
from riserstudy.model.model import Effect, Model, Report, Unknowns
from riserstudy.model.platform_motion import motions
from riserstudy.model.riser import riser
from riserstudy.model.soil import soil
from riserstudy.model.supports import afloat, first_order, fixed, supports
from riserstudy.model.tensioners import tensioners
from riserstudy.model.vessel import floating
from riserstudy.model.vortices import first_phases
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.state import OTHER, OWN

TAUT = 1e-6  # strain of a hanging riser in the initial shape


def build(scene: Resolved, mesh: Mesh, ring_elevation: float | None = None, d: int | None = None) -> Model:
    """Model of a scene on a mesh.

    Parameters
    ----------
    ring_elevation : elevation of the riser's top from an earlier static solution (m), at which it is held.
    d : number of directions, if more than the scene needs (modes, stability).
    """
    of = layout_of(scene, mesh, ring_elevation, d or directions(scene))
    cylinders = scene.top.tensioners.count if scene.top.tensioners else 0
    probes: list[str] = []

    def report(*names: str) -> int:
        """Reserve reported values under some names; returns the index of the first."""
        probes.extend(names)
        return 2 * cylinders + len(probes) - len(names)

    effects = list(effects_of(of, report))
    unknowns = Unknowns(
        mesh.l0,
        of.d,
        of.m,
        share=(0.5, 0.0) if scene.analysis.method == "explicit" else (OWN, OTHER),
        cylinders=cylinders,
        probes=probes,
        loose=of.loose,
        internal=sum(VARIABLES for effect in effects if isinstance(effect.record, VortexLift | VortexDrag)),
        ring=mesh.ring if mesh.joint else None,
    )
    model = Model(unknowns, effects, fixed(of), afloat(of))
    model.s.r[:, : of.last + 1] = first_shape(of)
    first_phases(scene, mesh, model)
    for state in (model.s, model.spare.value):
        blend_by_weight(state.blend, state.kink, mesh, of.weight)
    return model


def effects_of(of: Layout, report: Report) -> Iterator[Effect]:
    """All effects of a scene, in the order in which they are evaluated."""
    yield from motions(of.scene)
    yield from supports(of)
    yield from first_order(of, report)
    yield from current(of)
    yield from wave(of)
    yield from riser(of)
    yield from hydrodynamics(of)
    yield from ends(of)
    yield from tensioners(of)
    yield from between_sections(of, report)
    yield from soil(of)
    yield from sliding_joint(of)
    yield from stress_gauge(of, report)
    yield from lift_gauge(of, report)
    yield from floating(of.scene, of.d, of.last, report)


def first_shape(of: Layout) -> NDArray[np.float64]:
    """The shape that statics start from, (d, n + 1), m."""
    scene, mesh = of.scene, of.mesh
    total = float(mesh.l0.sum())
    offset = (scene.top.offset or 0.0) if of.d > 1 else 0.0
    rise = total if of.top is None else of.top - of.bottom
    foot = lowest_leaning(scene, mesh)
    if joint := scene.top.telescopic_joint:
        strain = (joint.tension or 0.0) / of.axial[:-1]
        shape = under_a_joint(mesh, foot, strain, offset, rise)
    elif scene.soil:
        shape = above_ground(mesh, foot, offset, rise)
    else:
        weight = float(of.weight @ mesh.l0)
        shape = between_ends(mesh, offset, rise, weight, float(of.axial.min()))
    shape[2] += of.bottom
    if scene.bottom.hold == "free":  # without tension, a straight riser has no lateral stiffness
        shape[2] -= TAUT * (total - mesh.s)
    return shape[AXES[of.d]]
