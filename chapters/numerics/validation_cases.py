"""Results of the engine, compared with closed forms, second methods and conservation laws.

Each case runs the engine and names its references, which ``closed_forms`` computes without the engine. A
tolerance covers the effects that the closed form neglects, or the error of the mesh; each row states which.
"""

from __future__ import annotations

from chapters.numerics.validation_forces import gas, morison, terminal, two_chambers
from chapters.numerics.validation_modes import bar, chain, pendulum, taut_beam
from chapters.numerics.validation_motion import decay, energy, hermite, methods, wave
from chapters.numerics.validation_row import Case
from chapters.numerics.validation_statics import (
    cable,
    cantilever,
    column,
    current,
    loaded_beam,
    own_weight,
    towed,
)

CASES: tuple[Case, ...] = (
    taut_beam, own_weight, chain, bar, column, pendulum, loaded_beam, cantilever, cable, current, towed,
    wave, decay, gas, two_chambers, morison, terminal, methods, hermite, energy,
)  # fmt: skip
