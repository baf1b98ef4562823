"""March through the events of a scene: a time step ends at each event, and the march restarts there."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from riserstudy.model.failing import without_bottles, without_cylinders, without_tension
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.disconnect import let_go
from riserstudy.simulation.time_stepping import march_on
from riserstudy.solve.evaluate import energies
from riserstudy.solve.program import Packed
from riserstudy.solve.record import Record, with_present_envelopes
from riserstudy.solve.sums import DONE, Sums

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts


class Event(NamedTuple):
    """A change of the model at a time."""

    at: float  # s
    change: Callable[[Model], Model]  # returns the changed model in the same state
    releases: bool = False  # whether it releases the lower end


class Marched(NamedTuple):
    """The end of a march."""

    model: Model
    outcome: int  # DONE, or the reason why the march stopped
    taken: float = 0.0  # J, energy that the events removed
    connected: Record | None = None  # with the envelopes until the release of the lower end


def events_of(scene: Resolved, mesh: Mesh, facts: RunFacts) -> Iterator[Event]:
    """The events of a scene; their results and warnings go into the facts."""
    release, loss, rig = scene.disconnect, scene.top.tension_loss, scene.top.tensioners
    if release:
        yield Event(release.at, partial(let_go, scene, mesh, facts), releases=True)
        if release.recoil_valve and (shut := release.recoil_valve.isolation):
            yield Event(release.at + shut.after, partial(without_bottles, volume=shut.volume))
    if loss and loss.over is None:
        yield Event(loss.at, partial(without_tension, share=loss.share))
    if rig and rig.failing:
        left = sum(rig.still_working) / sum(rig.working)
        yield Event(rig.failing.at, partial(without_cylinders, cylinders=rig.failing.cylinders, pistons=left))


def march_through(
    scene: Resolved, model: Model, mesh: Mesh, step: float, record: Packed, sums: Sums, facts: RunFacts
) -> Marched:
    """March by steps of ``step`` (s), from event to event.

    Raises SimulationError when an event is not possible in the present state.
    """
    taken, since, connected = 0.0, 0.0, None
    for event in sorted(events_of(scene, mesh, facts), key=lambda event: event.at):
        if event.at > since:
            outcome = march_on(scene, model, mesh, step, record, sums, since, event.at)
            if outcome != DONE:
                return Marched(model, outcome, taken, connected)
        if event.releases:
            connected = with_present_envelopes(record.value)
        potential, kinetic = energies(model.programs, model.state)
        model = event.change(model)
        still_potential, still_kinetic = energies(model.programs, model.state)
        taken += float(potential - still_potential) + float(kinetic - still_kinetic)
        since = event.at
    return Marched(model, march_on(scene, model, mesh, step, record, sums, since), taken, connected)
