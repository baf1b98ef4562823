"""Effects within and at the top of the riser string: inner joints, guides, a telescopic joint, a gauge.

A new effect between sections needs a generator here, and a line in `between_sections`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from riserstudy.effects.guide import Guide
from riserstudy.effects.inner_flex_joint import InnerFlexJoint
from riserstudy.effects.sliding_tension import SlidingTension
from riserstudy.effects.stress_gauge import StressGauge
from riserstudy.model.layout import Layout
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect, Report
from riserstudy.model.space_out import joint_of
from riserstudy.scene.ends import TelescopicJoint
from riserstudy.scene.riser import Section

#: quantities that an inner flex joint in space reports after its angle: its rotation about x, y and z
TURNS = tuple(f"lfj_angle about {axis}" for axis in "xyz")


def between_sections(of: Layout, report: Report) -> Iterator[Effect]:
    """Effects at the nodes between sections."""
    yield from inner_joints(of, report)
    yield from guides(of)


def inner_joints(of: Layout, report: Report) -> Iterator[Effect]:
    """Flex joints below sections."""
    for k, section in enumerate(of.scene.riser if of.m else []):
        joint = section.flex_joint_below
        if joint is None:
            continue
        flexibility = 1.0 / joint.stiffness
        names = ["lfj_angle", *(TURNS if of.d == 3 else ())]
        record = InnerFlexJoint(of.mesh.foot(k), flexibility, report(*names))
        yield Effect("inner flex joint", record, f"{section.line}.flex_joint_below")


def guides(of: Layout) -> Iterator[Effect]:
    """Guides below sections: springs towards the vertical through the well."""
    for k, section in enumerate(of.scene.riser if of.d > 1 else []):
        if section.guide_below:
            record = Guide(of.mesh.foot(k), section.guide_below.stiffness)
            yield Effect("guide", record, f"{section.line}.guide_below")


def sliding_joint(of: Layout) -> Iterator[Effect]:
    """A telescopic joint under its own constant tension, or with stops."""
    joint = joint_of(of.scene)
    if joint and (joint.tension or joint.stop):
        record = sliding_tension(joint, of.last - 1)
        line = "tension" if joint.tension else "stop"
        yield Effect("sliding tension", record, f"top.telescopic_joint.{line}")


def stress_gauge(of: Layout, report: Report) -> Iterator[Effect]:
    """The gauge that reports the largest stress in a section."""
    output = of.scene.analysis.output
    if output and output.stress_in:
        k = [section.name for section in of.scene.riser].index(output.stress_in)
        record = gauge(of.scene.riser[k], of.mesh, k, report("largest_stress"))
        yield Effect("stress gauge", record, "analysis.output.stress_in")


def gauge(section: Section, mesh: Mesh, k: int, probe: int) -> StressGauge:
    """Gauge along section ``k``."""
    outer, inner = section.outer_diameter or 0.0, section.inner_diameter or 0.0
    fibre = 32.0 * outer / (math.pi * (outer**4 - inner**4))
    first = mesh.foot(k)
    last = first + int((mesh.section == k).sum())
    axial, bending = section.pipe_shares
    return StressGauge(first, last, section.wall_area / axial, bending * fibre, probe)


def sliding_tension(joint: TelescopicJoint, segment: int) -> SlidingTension:
    """Constant tension and stops of the telescopic joint, which is one segment."""
    shortest, longest = joint.reach
    stiffness = joint.stop.stiffness if joint.stop else 0.0
    return SlidingTension(segment, joint.tension or 0.0, longest, shortest, stiffness)
