"""Sliding tension: a case, the plain version, and a body that it pulls back.

tests/verification/test_collapse_of_a_joint.py presses a telescopic joint on its stop.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from plain import along
from surroundings import L0, Case, N, nodes

from riserstudy.effects.sliding_tension import SlidingTension


def sliding_tension(record, s):
    length, tangent = along(s)
    pulls = np.zeros(len(length))
    own = length[record.segment]
    beyond = own - np.clip(own, record.shortest, record.longest)
    pulls[record.segment] = record.tension + record.stiffness * beyond
    return {"force": nodes(pulls * tangent)}


CASES = {SlidingTension: Case(lambda d: SlidingTension(N - 1, 2e6, L0[-1] - 1.0, 1.0, 3e6))}

PLAIN = {SlidingTension: [("string", sliding_tension)]}


AXIS = np.array([0.48, 0.64, 0.6])


@pytest.mark.parametrize("speed", [2.0, -3.0], ids=["outer", "inner"])
def test_a_body_moves_until_pull_and_stop_have_its_energy(speed):
    """m v^2 / 2 = T x + k (x - gap)^2 / 2 where it turns, x from the start; the pull drives it inwards."""
    mass, pull, stiffness, gap = 5e3, 2e4, 4e5, 0.25
    joint = SlidingTension(0, pull, 1.0 + gap, 1.0 - gap, stiffness)
    model = bodies(joint, mass=mass)
    model.s.r[:, UPPER] = AXIS
    model.s.v[:, UPPER] = speed * AXIS
    before = energy(model)
    found = motion(model, 0.5, 4000)
    away = np.sign(speed) * (found.place[..., UPPER] @ AXIS - 1.0)
    against = np.sign(speed) * pull
    beyond = np.roots([0.5 * stiffness, against, against * gap - 0.5 * mass * speed**2]).max()
    # the turn falls within a step: an error of the acceleration times its square
    assert away.max() == pytest.approx(gap + beyond, rel=1e-4)
    assert energy(model) == pytest.approx(before, rel=1e-3)


def test_between_its_stops_the_joint_accelerates_a_body_evenly():
    mass, pull = 5e3, 2e4
    model = bodies(SlidingTension(0, pull, np.inf, 0.0, 4e5), mass=mass)
    model.s.r[:, UPPER] = AXIS
    found = motion(model, 0.6, 100)
    moved = np.outer(1.0 - 0.5 * pull / mass * found.time**2, AXIS)
    np.testing.assert_allclose(found.place[..., UPPER], moved, atol=1e-9)


@pytest.mark.parametrize("moved", [0.35, -0.35])
def test_a_joint_at_its_stop_has_the_work_of_pull_and_stop(moved):
    """The pull works all the way, the stop over the last 0.1 m of it, with half of its largest force."""
    pull, stiffness, gap = 2e4, 4e5, 0.25
    model = bodies(SlidingTension(0, pull, 1.0 + gap, 1.0 - gap, stiffness))
    still = energy(model)
    model.s.r[:, UPPER] = (1.0 + moved) * AXIS
    assert energy(model) - still == pytest.approx(pull * moved + 0.5 * stiffness * 0.1**2, rel=1e-9)
