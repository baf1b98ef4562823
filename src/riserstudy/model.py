"""A model: the state, the effect records and the programs that a solver needs, kept alive together."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.roles import ROLES
from riserstudy.solve.evaluate import Programs, set_compliance
from riserstudy.solve.program import Frozen, assemble, freeze
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
    """

    def __init__(self, l0, directions, moments, effects, fixed, share, cylinders=0):
        self.effects: list[Effect] = list(effects)
        self.fixed = np.array(sorted(fixed), np.int64).reshape(-1, 2)
        self.hinged = np.zeros(len(l0) + 1, bool)
        for node, unknown in fixed:
            if unknown < moments:
                self.hinged[node] = True
        probes = 2 * cylinders

        def state() -> State:
            return new_state(l0, directions, moments, cylinders, probes, share)

        self._frozen = [freeze(state()), freeze(state())]
        records = [(effect, freeze(effect.record)) for effect in self.effects]
        self.records = [record for _, record in records]
        self.programs = Programs(
            *(
                assemble(
                    [
                        (ROLES[type(effect.record)][role], record)
                        for effect, record in records
                        if role in ROLES[type(effect.record)]
                    ],
                    self._frozen[0],
                )
                for role in Programs._fields
            )
        )
        for frozen in self._frozen:
            set_compliance(self.programs, frozen.value, frozen.address)

    @property
    def frozen(self) -> Frozen:
        """The state as compiled code reads it."""
        return self._frozen[0]

    @property
    def state(self) -> State:
        """The state that the solvers move."""
        return self._frozen[0].value

    @property
    def address(self) -> int:
        """Its address."""
        return self._frozen[0].address

    @property
    def spare(self) -> tuple[State, int]:
        """A second state with its address, for evaluations aside."""
        return self._frozen[1].value, self._frozen[1].address
