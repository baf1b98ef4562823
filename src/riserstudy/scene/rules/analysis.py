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
            remedy = f"allowed is from 0 to {length:g} m"
            yield Misfit("analysis.output.stations", f"{s:g} m is not on the riser", remedy, ("riser",))


def sees_the_disconnect(scene: Parts) -> Iterator[Misfit]:
    """Output must begin at the release or before: lift and clearance are measured from the release on."""
    release, output = scene.disconnect, scene.analysis.output
    start = (output and output.start) or 0.0
    if release and start > release.at:
        found = f"{start:g} s is after the disconnect, and misses lift and clearance before that time"
        remedy = f"allowed is up to {release.at:g} s"
        yield Misfit("analysis.output.start", found, remedy, ("disconnect.at",))


def gauge(scene: Parts) -> Iterator[Misfit]:
    """The output of stress requires a section with a wall."""
    section = scene.analysis.output and scene.analysis.output.stress_in
    walls = [s.name for s in scene.riser if s.young_modulus]
    if section and section not in walls:
        found = f"no section {section!r} with young_modulus and diameters"
        remedy = "leave it out: no section has them"
        allowed = f"allowed are {', '.join(map(repr, walls))}" if walls else remedy
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
            f"{duration:g} s contains more than {MOST_PERIODS} periods of {shortest:g} s, the shortest of "
            "platform and waves"
        )
        remedy = "give a shorter duration or a longer period"
        yield Misfit("analysis.duration", found, remedy, ("platform", "wave"))


def starts_unstretched(scene: Parts) -> Iterator[Misfit]:
    """A riser between two held ends cannot start unstretched: their distance is not its own length."""
    free = scene.bottom.hold == "free" or scene.top.z == "free" or scene.top.telescopic_joint
    if scene.analysis.start == "unstretched" and not free:
        found = "'unstretched' needs an end that is free in z, or a telescopic joint"
        yield Misfit("analysis.start", found, "choose another start", ("top.z", "bottom.hold"))


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
            "opens the connector without a ramp, and the riser has no structural damping: peaks of tension "
            "then converge on no mesh",
            "give disconnect.over, structural_damping, or analysis.mesh and step",
        )
    if scene.platform is None or (damped and later):
        return
    for line, motion in scene.platform.sudden:
        if (scene.top.z if motion == "heave" else scene.top.x) in ("platform", "vessel"):
            yield Misfit(
                f"platform.{line}",
                "starts with a jump in velocity: peaks of moment and tension then converge on no mesh",
                "give it a ramp, or structural_damping and a later analysis.output.start, or analysis.mesh "
                "and step",
            )
