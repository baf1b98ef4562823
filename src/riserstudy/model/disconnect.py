"""The model after a disconnect: the same state, with the lower end released."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from riserstudy.effects.dead_load import DeadLoad
from riserstudy.effects.fading_moment import FadingMoment
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.lift_gauge import LiftGauge
from riserstudy.effects.stack_contact import StackContact
from riserstudy.effects.support import Support
from riserstudy.effects.tension_loss import TensionLoss
from riserstudy.effects.torsion import Torsion
from riserstudy.model.layout import Layout
from riserstudy.model.model import Effect, Model, Report
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.evaluate import forces_and_tangent, shape_of

LIFT = ("lift", "lift_rate", "lift_aside")  # quantities that the gauge reports


def lift_gauge(of: Layout, report: Report) -> Iterator[Effect]:
    """The gauge that reports the position of the lower end relative to the stack."""
    if of.scene.disconnect:
        yield Effect("lift gauge", LiftGauge(of.bottom, report(*LIFT)), "disconnect")


def stack_contact(scene: Resolved) -> Iterator[Effect]:
    """The contact of the lower end with the stack below it."""
    if scene.disconnect and (stack := scene.disconnect.stack):
        contact = StackContact(scene.bottom.elevation or 0.0, stack.stiffness)
        yield Effect("stack contact", contact, "disconnect.stack")


def released(model: Model, more: Sequence[Effect] = ()) -> Model:
    """The model in the same state with its lower end free, and with moments that fit this end.

    ``more``: effects that act from the release on, such as the fading force of the connector.
    """
    kept = [e for e in model.effects if not _at_the_lower_end(e.record)] + list(more)
    moments = range(model.unknowns.moments)
    above = [(node, u) for node, u in model.pairs if node > 0]
    freed = model.changed(kept, [*above, *((0, u) for u in moments)])
    if not freed.has(FadingMoment):
        _settle_moments(freed)
    return freed


def fading(model: Model, at: float, over: float) -> list[Effect]:
    """Force and moment of the connector, which decrease to zero from the time ``at`` within ``over`` (s)."""
    forces_and_tangent(model.programs, model.state)
    load = -model.s.force[:, 0]
    moment = model.s.moment[:, 0].copy()
    turned = [FadingMoment(moment, at, over)] if moment.any() else []
    return [
        Effect("constant tension", DeadLoad(0, load.copy()), "disconnect.over"),
        Effect("tension loss", TensionLoss(0, -load, at, over), "disconnect.over"),
        *(Effect("fading moment", record, "disconnect.over") for record in turned),
    ]


def _at_the_lower_end(record: object) -> bool:
    return isinstance(record, Torsion) or (isinstance(record, Support | FlexJoint) and record.node == 0)


def _settle_moments(model: Model) -> None:
    """Compute the moments from the shape: solve the flexibility matrix for the turning angles, theory (2)."""
    from scipy.linalg import solve

    s = model.s
    if not len(s.moment):
        return
    s.moment[:] = 0.0
    shape_of(model.programs, model.state)
    carried = ~model.hinged[: len(s.flex)]
    flexibility = np.diag(s.flex) + np.diag(s.flex_up, 1) + np.diag(s.flex_up, -1)
    inner = np.ix_(carried, carried)
    columns = np.flatnonzero(carried)
    s.moment[:, columns] = solve(flexibility[inner], s.turn[:, columns].T, assume_a="sym").T
