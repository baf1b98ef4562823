"""What stands within and at the top of the riser string: inner joints, a sliding joint, gauges, a vessel."""

from __future__ import annotations

import math
from collections.abc import Iterator

from riserstudy.effects.inner_flex_joint import InnerFlexJoint
from riserstudy.effects.sliding_tension import SlidingTension
from riserstudy.effects.stress_gauge import StressGauge
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect
from riserstudy.model.soil import springs
from riserstudy.model.vessel import floating
from riserstudy.scene.ends import TelescopicJoint
from riserstudy.scene.models import Scene
from riserstudy.scene.riser import Section


def devices(
    scene: Scene, mesh: Mesh, bottom: float, bends: bool, d: int, probes: list[str]
) -> Iterator[Effect]:
    """Their effects; names of what they report are added to ``probes``."""
    rig, joint, output = scene.top.tensioners, scene.top.telescopic_joint, scene.analysis.output

    def probe(*names: str) -> int:
        """Index of the first of some probes."""
        first = 2 * (rig.count if rig else 0) + len(probes)
        probes.extend(names)
        return first

    for k, section in enumerate(scene.riser):
        if section.flex_joint_below and bends:
            flexibility = 1.0 / section.flex_joint_below.stiffness
            inner = InnerFlexJoint(mesh.foot(k), flexibility, probe("lfj_angle"))
            yield Effect("inner flex joint", inner, f"riser[{k}].flex_joint_below")
    if scene.soil:
        yield Effect("soil", springs(scene.soil, scene.riser[0], mesh, bottom), "soil")
    if joint and joint.tension:
        sliding = sliding_tension(joint, len(mesh.l0) - 1)
        yield Effect("sliding tension", sliding, "top.telescopic_joint.tension")
    if output and output.stress_in:
        k = [section.name for section in scene.riser].index(output.stress_in)
        record = gauge(scene.riser[k], mesh, k, probe("largest_stress"))
        yield Effect("stress gauge", record, "analysis.output.stress_in")
    yield from floating(scene, d, len(mesh.l0), probe)


def gauge(section: Section, mesh: Mesh, k: int, probe: int) -> StressGauge:
    """Gauge along section ``k``."""
    outer, inner = section.outer_diameter or 0.0, section.inner_diameter or 0.0
    fibre = 32.0 * outer / (math.pi * (outer**4 - inner**4))
    first = mesh.foot(k)
    last = first + int((mesh.section == k).sum())
    return StressGauge(first, last, section.wall_area, fibre, probe)


def sliding_tension(joint: TelescopicJoint, segment: int) -> SlidingTension:
    """Constant tension of the telescopic joint, which is one segment."""
    stop = joint.stop
    return SlidingTension(
        segment,
        joint.tension or 0.0,
        joint.length + stop.stroke if stop else math.inf,
        stop.stiffness if stop else 0.0,
    )
