"""Bodies on some effects, moved by the solver of runs: what closed forms of bodies are compared with.

Two point masses, a metre above each other, are joined by a segment that exerts no force.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from riserstudy.effects.cylinder import Upright
from riserstudy.effects.end_mass import EndMass
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.evaluate import energies, shape_of
from riserstudy.solve.implicit import Method, generalised_alpha, march
from riserstudy.solve.newton import Tolerance
from riserstudy.solve.record import new_record
from riserstudy.solve.sums import DONE, GIVEN, LOST, new_sums

LOWER, UPPER = 0, 1  # nodes
DIRECTIONS = 3


def on_two_cylinders() -> Upright:
    """Two upright cylinders at the upper body, at mid-stroke at an elevation of 1 m; their deck rests."""
    return Upright(UPPER, np.ones(2), np.zeros(3), np.zeros((3, 3)))


def bodies(
    *records: Any,
    mass: float = 0.0,
    weight: float = 0.0,
    free: Sequence[int] = (UPPER,),
    held: Sequence[tuple[int, int]] = (),
    yaw: bool = False,
    **sizes: Any,
) -> Model:
    """A model in space at rest, whose free nodes have a mass (kg), unless a record brings its own.

    Parameters
    ----------
    weight : of each body that has this mass (N).
    held : (node, direction) pairs in which a free node is held.
    yaw : whether there is a loose node, which moves in the last direction alone, as that of a vessel.
    sizes : further sizes of `Unknowns`.
    """
    loose = int(yaw)
    every = [*records]
    if mass:
        every += [
            EndMass(node, weight, np.full(DIRECTIONS, mass), np.zeros(2), np.zeros(DIRECTIONS))
            for node in free
        ]
    fixed = [(node, k) for node in (LOWER, UPPER) if node not in free for k in range(DIRECTIONS)]
    fixed += [(UPPER + 1, k) for k in range(DIRECTIONS - 1)] * loose
    effects = [Effect(type(record).__name__, record, "") for record in every]
    model = Model(Unknowns(np.ones(1), DIRECTIONS, 0, loose=loose, **sizes), effects, [*fixed, *held])
    model.s.r[-1, UPPER] = 1.0
    return model


class Motion(NamedTuple):
    """How the bodies moved, and what that took."""

    time: np.ndarray  # (k,) s
    place: np.ndarray  # (k, 3, 2) m
    supplied: float  # J
    dissipated: float  # J


def motion(model: Model, duration: float, steps: int) -> Motion:
    """Motion over a time (s) in equal steps, by the trapezoidal rule, which dissipates nothing itself."""
    step = duration / steps
    times = np.arange(steps + 1) * step
    record, sums = new_record(times, [LOWER, UPPER], model.s), new_sums()
    method = Method(*generalised_alpha(1.0), step, steps, Tolerance(1e-12, 1e-4), 20, 6, 0)
    assert march(model.programs, model.state, model.spare, method, model.fixed, record, sums) == DONE
    place = record.value.history[:, :DIRECTIONS]
    return Motion(times, place, sums.work[GIVEN], sums.work[LOST])


def energy(model: Model) -> float:
    """Potential and kinetic energy (J) of a model in its present state."""
    shape_of(model.programs, model.state)
    return float(sum(energies(model.programs, model.state)))
