"""A model: the state, the effect records and the programs that a solver needs, kept alive together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.registry import ROLES
from riserstudy.solve.evaluate import Programs, set_compliance
from riserstudy.solve.program import Packed, assemble
from riserstudy.solve.state import OTHER, OWN, State, new_state

#: reserves reported values under the names that an effect gives, and returns the index of the first
Report = Callable[..., int]


class Effect(NamedTuple):
    """One effect of a model, and the input of the scene that includes it."""

    name: str
    record: NamedTuple
    because: str


class Unknowns(NamedTuple):
    """Sizes of a state: segments, unknowns per node, and values that effects report."""

    l0: NDArray[np.float64]  # (n,) unstretched lengths of the segments (m)
    directions: int
    moments: int
    # of a segment's mass that its nodes carry, see `State`
    share: tuple[float, float] = (OWN, OTHER)
    cylinders: int = 0  # number of tensioner cylinders
    probes: Sequence[str] = ()  # names of the values that effects report, without the cylinders'
    loose: int = 0  # number of nodes that do not belong to the riser
    internal: int = 0  # number of internal variables of effects per node of the riser
    ring: int | None = None  # node above which a telescopic joint carries no tension


class Model:
    """State, records and programs of one riser model.

    Parameters
    ----------
    effects : in the order in which they are evaluated.
    fixed : (node, unknown) pairs that the solver does not change; moments are numbered before positions.
    afloat : (node, unknown) pairs that are held in statics only.

    Attributes
    ----------
    state, spare : frozen states: the one that solvers change, and one for separate evaluations.
    programs : frozen programs.
    hinged : (n + 1 + loose,) true for nodes that carry no moment.
    """

    def __init__(
        self,
        unknowns: Unknowns,
        effects: Sequence[Effect],
        fixed: Sequence[tuple[int, int]] = (),
        afloat: Sequence[tuple[int, int]] = (),
    ):
        self.unknowns = unknowns
        self.effects: list[Effect] = list(effects)
        self.fixed = np.array(sorted(fixed), np.int64).reshape(-1, 2)
        self.fixed_at_rest = np.array(sorted([*fixed, *afloat]), np.int64).reshape(-1, 2)
        l0, first = unknowns.l0, 2 * unknowns.cylinders
        self.probes = {name: first + k for k, name in enumerate(unknowns.probes)}
        self.hinged = np.zeros(len(l0) + 1 + unknowns.loose, bool)
        self.hinged[[node for node, unknown in fixed if unknown < unknowns.moments]] = True
        self.state, self.spare = (
            Packed(
                new_state(
                    l0,
                    unknowns.directions,
                    unknowns.moments,
                    unknowns.cylinders,
                    first + len(unknowns.probes),
                    unknowns.share,
                    unknowns.loose,
                    unknowns.internal,
                )
            )
            for _ in range(2)
        )
        for state in (self.state.value, self.spare.value):
            state.blend[1:-1] = l0[:-1] / (l0[:-1] + l0[1:])
            if unknowns.ring is not None:
                state.blend[unknowns.ring] = 0.0
        self.records = [Packed(effect.record) for effect in self.effects]
        self.programs = Packed(Programs(*(self._program(role) for role in Programs._fields)))
        for state in (self.state, self.spare):
            set_compliance(self.programs, state, self.hinged)

    def has(self, kind: type) -> bool:
        """Whether the model has an effect whose record is of this kind."""
        return any(isinstance(effect.record, kind) for effect in self.effects)

    def extended(self, effects: Sequence[Effect], fixed: Sequence[tuple[int, int]]) -> Model:
        """A model in the same state with additional effects and additional fixed (node, unknown) pairs."""
        return self.changed([*self.effects, *effects], [*self.pairs, *fixed])

    def changed(self, effects: Sequence[Effect], fixed: Sequence[tuple[int, int]]) -> Model:
        """A model in the same state with other effects and other fixed (node, unknown) pairs."""
        other = Model(self.unknowns, effects, fixed)
        other.take_state(self)
        return other

    @property
    def pairs(self) -> list[tuple[int, int]]:
        """The (node, unknown) pairs that the solver does not change."""
        return [(int(node), int(unknown)) for node, unknown in self.fixed]

    def take_state(self, other: Model) -> None:
        """Copy positions and motion from another model with the same unknowns."""
        for mine, theirs in ((self.s, other.s), (self.spare.value, other.spare.value)):
            for name in (
                "clock",
                "platform",
                "r",
                "v",
                "a",
                "moment",
                "blend",
                "kink",
                "reach",
                "deck",
                "carried",
                "internal",
                "internal_rate",
                "internal_known",
                "internal_share",
            ):
                getattr(mine, name)[:] = getattr(theirs, name)

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
        """The arrays of the state that solvers change."""
        state: State = self.state.value
        return state
