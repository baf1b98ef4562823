"""The record of draining contents: the column over time, and the arrays of other effects that it writes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.draining import Draining
from riserstudy.effects.weight import Weight
from riserstudy.model.hydrodynamics import over
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect, Model
from riserstudy.model.mud_column import Column, Flow, flow
from riserstudy.scene.resolve import Resolved


def draining(scene: Resolved, mesh: Mesh, model: Model) -> Iterator[Effect]:
    """The effect of draining contents, in the released model."""
    column = flow_of(scene)
    if scene.disconnect is None or column is None:
        return
    contents = next(s.contents for s in scene.riser if s.contents)
    full = over(mesh, [s.contents_mass for s in scene.riser])
    weight = next(e.record for e in model.effects if e.because == "riser.submerged_weight")
    inside = next((e.record for e in model.effects if e.because == "riser.contents"), None)
    if not isinstance(weight, Weight):
        raise TypeError("contents without weight")  # the scene has gravity
    bore = full / (contents.density * mesh.l0)
    steps = np.zeros(len(full) + 1)
    filled = int((bore > 0.0).sum())  # from the lower end upwards
    steps[1:filled] = 1.0 / bore[: filled - 1] - 1.0 / bore[1:filled]
    moving = (inside.mass, inside.minus) if isinstance(inside, AddedMass) else np.zeros((2, len(full)))
    record = Draining(
        time=scene.disconnect.at + column.time,
        acceleration=column.acceleration,
        square=column.rate**2,
        top=column.top,
        water=column.water,
        foot=np.concatenate([[0.0], np.cumsum(mesh.l0)[:-1]]),
        bore=bore,
        steps=steps,
        densities=(contents.density, scene.water.density if scene.water else 0.0),
        gravity=scene.gravity or 0.0,
        mass=full.copy(),
        change=np.zeros(len(full)),
        full=full,
        load=weight.load,
        dead=weight.load.copy(),
        inside=moving[0],
        minus=moving[1],
        level=weight.level,
    )
    yield Effect("draining contents", record, "disconnect.drain")


def flow_of(scene: Resolved) -> Flow | None:
    """The flow of a scene's contents as they drain; None where they do not drain.

    Raises SimulationError when all contents drain before the end of the run.
    """
    release, water, end = scene.disconnect, scene.water, scene.analysis.duration
    if release is None or release.drain is None or end is None:
        return None
    filled = [s for s in scene.riser if s.contents]
    contents = filled[0].contents
    if contents is None or water is None or water.surface is None:
        raise TypeError("nothing to drain")  # refused by the scene
    foot = scene.bottom.elevation or 0.0
    top = sum(s.total_length for s in filled) if contents.level is None else contents.level - foot
    ends = np.cumsum([s.total_length for s in filled[:-1]])
    column = Column(
        length=top,
        depth=water.surface - foot,
        bore=tuple(s.inner_diameter or 0.0 for s in filled),
        contents=contents.density,
        sea=water.density,
        gravity=scene.gravity or 0.0,
        friction=release.drain.friction,
        losses=release.drain.losses or 0.0,
        ends=tuple(ends.tolist()),
    )
    return flow(column, end - release.at)
