"""A model: the state, the effect records and the programs that a solver needs, kept alive together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.registry import ROLES
from riserstudy.solve.evaluate import Programs, set_compliance
from riserstudy.solve.program import Frozen, assemble
from riserstudy.solve.state import State, new_state


class Effect(NamedTuple):
    """One effect of a model and the reason why it is there."""

    name: str
    record: NamedTuple
    because: str


class Model:
    """State, records and programs of one riser model.

    Parameters
    ----------
    l0 : unstretched segment lengths, shape (n,), m.
    directions, moments : unknown positions and moments a node.
    effects : in the order in which they act.
    fixed : (node, unknown) pairs that the solver leaves alone; moments count before positions.
    share : parts of a segment's mass that its own and its other node carry.
    cylinders : number of tensioner cylinders.
    ring : node of the tension ring, above which a telescopic joint carries no tension; None without.
    probes : names of what effects report beside the cylinders, in their order.
    afloat : (node, unknown) pairs that are held in statics only.
    loose : nodes beyond the riser's.

    Attributes
    ----------
    state, spare : frozen states, the one that solvers move and one for evaluations aside.
    programs : frozen programs.
    hinged : (n + 1 + loose,) true where no moment is carried.
    """

    def __init__(
        self,
        l0: NDArray[np.float64],
        directions: int,
        moments: int,
        effects: list[Effect],
        fixed: list[tuple[int, int]],
        share: tuple[float, float],
        cylinders: int = 0,
        ring: int | None = None,
        probes: Sequence[str] = (),
        afloat: Sequence[tuple[int, int]] = (),
        loose: int = 0,
    ):
        self.effects: list[Effect] = list(effects)
        self.fixed = np.array(sorted(fixed), np.int64).reshape(-1, 2)
        self.fixed_at_rest = np.array(sorted([*fixed, *afloat]), np.int64).reshape(-1, 2)
        self.probes = {name: 2 * cylinders + k for k, name in enumerate(probes)}
        self.hinged = np.zeros(len(l0) + 1 + loose, bool)
        self.hinged[[node for node, unknown in fixed if unknown < moments]] = True
        self.state, self.spare = (
            Frozen(
                new_state(
                    l0, directions, moments, cylinders, 2 * cylinders + len(probes), share, loose
                )
            )
            for _ in range(2)
        )
        for state in (self.state.value, self.spare.value):
            state.blend[1:-1] = l0[:-1] / (l0[:-1] + l0[1:])
            if ring is not None:
                state.blend[ring] = 0.0
        self.records = [Frozen(effect.record) for effect in self.effects]
        self.programs = Frozen(Programs(*(self._program(role) for role in Programs._fields)))
        for state in (self.state, self.spare):
            set_compliance(self.programs, state, self.hinged)

    def extended(self, effects: Sequence[Effect], fixed: Sequence[tuple[int, int]]) -> Model:
        """A model in the same state with more effects, and more (node, unknown) pairs left alone."""
        own = self.s
        cylinders = len(own.reach)
        other = Model(
            own.l0,
            len(own.dim),
            len(own.dof) - len(own.dim),
            [*self.effects, *effects],
            [*((int(node), int(unknown)) for node, unknown in self.fixed), *fixed],
            (float(own.share[0]), float(own.share[1])),
            cylinders,
            probes=list(self.probes),
            loose=own.r.shape[1] - len(own.l0) - 1,
        )
        for mine, theirs in ((own, other.s), (self.spare.value, other.spare.value)):
            for name in ("clock", "r", "v", "a", "moment", "blend", "reach"):
                getattr(theirs, name)[:] = getattr(mine, name)
        return other

    def _program(self, role: str) -> np.ndarray:
        if role == "lump" and self.s.share[1] > 0.0:
            return assemble([], self.state)  # implicit stepping has no use for it
        calls = []
        for effect, record in zip(self.effects, self.records, strict=True):
            functions = ROLES[type(effect.record)]
            if role in functions:
                calls.append((functions[role], record))
        return assemble(calls, self.state)

    @property
    def s(self) -> State:
        """The arrays of the state that solvers move."""
        state: State = self.state.value
        return state
