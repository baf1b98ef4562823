"""Whether the scene can be run: its duration, its start, and the places of its outputs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.scene.analysis import MOST_PERIODS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from riserstudy.scene.parts import Parts


def stations(scene: Parts) -> Iterator[Misfit]:
    """Stations of time histories must be on the riser."""
    joint = scene.top.telescopic_joint
    length = sum(section.total_length for section in scene.riser) + (joint.length if joint else 0.0)
    places = (scene.analysis.output and scene.analysis.output.stations) or []
    for s in places:
        if not 0.0 <= s <= length * (1.0 + 1e-9):
            remedy = f"give arclengths from 0 m to {length:g} m"
            yield Misfit("analysis.output.stations", f"{s:g} m is not on the riser", remedy, ("riser",))


def sees_the_disconnect(scene: Parts) -> Iterator[Misfit]:
    """Output must begin at the release or before: lift and clearance are measured from the release on."""
    release, output = scene.disconnect, scene.analysis.output
    start = (output and output.start) or 0.0
    if release and start > release.at:
        found = f"{start:g} s is after the disconnect, so lift and clearance before that time are lost"
        remedy = f"give at most the time of the disconnect, {release.at:g} s"
        yield Misfit("analysis.output.start", found, remedy, ("disconnect.at",))


def gauge(scene: Parts) -> Iterator[Misfit]:
    """The output of stress requires a section with a wall."""
    section = scene.analysis.output and scene.analysis.output.stress_in
    walls = [s.name for s in scene.riser if s.young_modulus]
    if section and section not in walls:
        found = f"{section!r} is not a section with young_modulus and diameters, which stress requires"
        remedy = "remove stress_in, or give a section these inputs"
        allowed = f"use one of {', '.join(map(repr, walls))}" if walls else remedy
        yield Misfit("analysis.output.stress_in", found, allowed, ("riser",))


def ends(scene: Parts) -> Iterator[Misfit]:
    """A run must have a feasible number of the shortest periods, if the engine chooses the time step.

    The engine chooses a fraction of the shortest period, so too many periods would never be completed.
    """
    duration, shortest = scene.analysis.duration, scene.shortest_period
    if duration is None or shortest is None or scene.analysis.step is not None:
        return
    if duration / MOST_PERIODS > shortest:
        found = (
            f"{duration:g} s contains more than {MOST_PERIODS} periods of {shortest:g} s, the shortest "
            "period of platform and waves"
        )
        remedy = "give a shorter duration or a longer period"
        yield Misfit("analysis.duration", found, remedy, ("platform", "wave"))


def starts_unstretched(scene: Parts) -> Iterator[Misfit]:
    """A riser between two held ends cannot start unstretched: their distance is not its own length."""
    free = scene.bottom.hold == "free" or scene.top.z == "free" or scene.top.telescopic_joint
    if scene.analysis.start == "unstretched" and not free:
        found = "'unstretched' requires a riser end that is free in z, or a telescopic joint"
        yield Misfit("analysis.start", found, "write 'start: equilibrium'", ("top.z", "bottom.hold"))


def starts_gently(scene: Parts) -> Iterator[Misfit]:
    """A tolerance is refused where a release or an end's motion starts as a step, without enough damping.

    A step sends waves of all lengths along the riser. Without damping, no mesh converges.
    """
    a = scene.analysis
    if a.duration is None or a.mesh is not None or not any(s.mass for s in scene.riser):
        return
    damped = all(s.structural_damping for s in scene.riser)
    release, later = scene.disconnect, a.output and a.output.start
    if release and release.over is None and not damped:
        yield Misfit(
            "disconnect",
            "the connector opens without a ramp on a riser without structural damping, so peaks of tension "
            "do not converge on any mesh",
            "give disconnect.over or structural_damping, or set analysis.mesh and step yourself",
        )
    if scene.platform is None or (damped and later):
        return
    for line, motion in scene.platform.sudden:
        if (scene.top.z if motion == "heave" else scene.top.x) in ("platform", "vessel"):
            yield Misfit(
                f"platform.{line}",
                "the motion starts with a jump in velocity, so peaks of moment and tension do not converge "
                "on any mesh",
                "give the motion a ramp, or give structural_damping and a later analysis.output.start, or "
                "set analysis.mesh and step yourself",
            )
