"""Stack contact: a case, the plain version, and a body that bounces.

tests/verification/test_recoil.py lets a bar fall on the stack, which then pushes with impedance times speed.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import LOWER, bodies, energy, motion
from surroundings import Case

from riserstudy.effects.stack_contact import StackContact


def stack_contact(record, s):
    out = np.zeros_like(s.force)
    below = record.elevation - s.r[-1, 0]
    out[-1, 0] = record.stiffness * below if below > 0.0 else 0.0
    return {"force": out}


CASES = {StackContact: Case(lambda d: StackContact(1.0, 3e6))}

PLAIN = {StackContact: [("device", stack_contact)]}

# without a load, in a plane on n segments
UNLOADED = {"stack contact": lambda n: StackContact(-1e9, 1e6)}


def test_a_body_bounces_off_the_stack_after_half_a_period_as_fast_as_it_came():
    """It touches for pi sqrt(m / k), and presses the stack by v sqrt(m / k)."""
    mass, stiffness, speed, gap = 5e4, 2e7, 1.5, 0.3
    model = bodies(StackContact(-gap, stiffness), mass=mass, free=(LOWER,))
    model.s.v[-1, LOWER] = -speed
    found = motion(model, 0.8, 4000)
    slowness = np.sqrt(mass / stiffness)
    height = found.place[:, -1, LOWER]
    # of second order in steps of 2e-4 s, also where the touch falls within a step
    assert -gap - height.min() == pytest.approx(speed * slowness, rel=1e-4)
    free = gap / speed + np.pi * slowness
    later = found.time > free + 1e-3
    np.testing.assert_allclose(height[later], speed * (found.time[later] - free) - gap, atol=1e-4 * gap)
    assert energy(model) == pytest.approx(0.5 * mass * speed**2, rel=1e-4)


def test_the_stack_has_the_energy_where_the_body_turns():
    mass, stiffness, speed = 5e4, 2e7, 1.5
    model = bodies(StackContact(0.0, stiffness), mass=mass, free=(LOWER,))
    model.s.v[-1, LOWER] = -speed
    motion(model, 0.5 * np.pi * np.sqrt(mass / stiffness), 1000)
    assert abs(model.s.v[-1, LOWER]) < 1e-3 * speed
    assert energy(model) == pytest.approx(0.5 * mass * speed**2, rel=1e-5)
