"""Bodies and loads at the riser's ends: masses, constant tension and its loss, a lateral force."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from riserstudy.effects.dead_load import DeadLoad
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.tension_loss import TensionLoss
from riserstudy.model.layout import Layout
from riserstudy.model.model import Effect
from riserstudy.scene.ends import Areas, Body, BodyAddedMass


def ends(of: Layout) -> Iterator[Effect]:
    """Effects of bodies and loads at the ends."""
    bottom, top, ring = of.scene.bottom, of.scene.top, of.mesh.ring
    if bottom.body and bottom.body.reach:
        low = (bottom.body.centre_below or 0.0) / bottom.body.reach
        yield body(of, bottom.body, 0, low, "bottom.body")
        yield body(of, bottom.body, of.mesh.foot(1), 1.0 - low, "bottom.body")
    elif bottom.body:
        yield body(of, bottom.body, 0, 1.0, "bottom.body")
    if top.body:
        yield body(of, top.body, ring, 1.0, "top.body")
    if top.tension:
        load = np.zeros(of.d)
        load[-1] = top.tension
        yield Effect("constant tension", DeadLoad(ring, load), "top.tension")
        if (loss := top.tension_loss) and loss.over:
            lost = TensionLoss(ring, -loss.share * load, loss.at, loss.over)
            yield Effect("tension loss", lost, "top.tension_loss")
    if top.lateral_force and of.d > 1:
        load = np.zeros(of.d)
        load[0] = top.lateral_force
        yield Effect("lateral force", DeadLoad(ring, load), "top.lateral_force")


def body(of: Layout, body: Body, node: int, share: float, why: str) -> Effect:
    """The effect of a share of a body, at a node."""
    extra = body.added_mass or BodyAddedMass()
    area = body.drag_area or Areas()
    added = np.full(of.d, extra.horizontal or 0.0)
    added[-1] = extra.vertical or 0.0
    mass, displaced = body.mass + added, body.displaced(of.gravity, of.density) + added
    drag = 0.5 * of.density * np.array([area.horizontal or 0.0, area.vertical or 0.0])
    weight = body.weight(of.gravity, of.density)
    record = EndMass(node, share * weight, share * mass, share * drag, share * displaced)
    return Effect("end mass", record, why)
