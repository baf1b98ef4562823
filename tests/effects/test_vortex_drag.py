"""In-line excitation of a rigid cylinder: closed forms, and the same equations solved by others."""

from functools import partial

import numpy as np
import pytest
from each.vortex_drag import SHED
from each.vortex_lift import rate
from rig import Rig, dense_tangent, differences
from scipy.integrate import solve_ivp
from test_vortex_lift import C_D, MASS, OWN, RHO, STIFF, D, motion, settled

from riserstudy.effects.current import Current
from riserstudy.effects.drag import Drag
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.guide import Guide
from riserstudy.effects.vortex_drag import VortexDrag
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.sums import GIVEN, LOST

C_X = 0.5
SPRING = (2.0 * np.pi * OWN) ** 2 * MASS


def cylinder(speed, stiffness=SPRING, drag=C_D, ramp=1e-9, begin=0.3, turned=False):
    """A metre of upright cylinder on springs, in a current along x, or y; it moves along that alone."""
    heading = np.array([0.0, 1.0]) if turned else np.array([1.0, 0.0])
    lift, pressed = np.array([0.5 * RHO * C_X * D]), np.array([0.5 * RHO * drag * D])
    effects = [
        Current(np.array([0.0, 1.0]), np.full(2, speed), heading, np.zeros(2, np.int64), 0.0),
        *(EndMass(i, 0.0, np.full(3, 0.5 * MASS), np.zeros(2), np.zeros(3)) for i in range(2)),
        *(Guide(i, 0.5 * stiffness) for i in range(2)),
        Drag(pressed, pressed, np.zeros((3, 2)), 0),
        VortexDrag(lift, lift, np.zeros((3, 2)), np.full(2, D), np.repeat(SHED[:, None], 2, 1), ramp, 0,
                   np.zeros((3, 2))),
    ]  # fmt: skip
    held = [(i, c) for i in range(2) for c in ((0, 2) if turned else (1, 2))]
    model = Model(
        Unknowns(np.ones(1), 3, 0, internal=3), [Effect(type(e).__name__, e, "") for e in effects], held
    )  # fmt: skip
    model.s.r[2] = 0.0, 1.0
    model.s.internal[0] = begin
    return model


def at_rest(model, speed, turned=False):
    """The model where the mean drag leaves it, so that nothing but vortices moves it."""
    model.s.r[int(turned)] = 0.5 * RHO * D * C_D * speed**2 / SPRING
    return model


moved = partial(motion, axis=0)  # times, places along x, and sums


@pytest.mark.long
def test_a_cylinder_at_rest_feels_drag_that_varies_at_the_free_frequency():
    speed = 0.7
    held = cylinder(speed, stiffness=STIFF, drag=1e-9, ramp=5.0)
    times, place, _ = moved(held, 300.0 * D / speed, D / speed / 200.0, damping=0.5)
    amplitude, frequency = settled(times, place)
    assert frequency == pytest.approx(SHED[0] * speed / D, rel=1e-3)
    assert amplitude * STIFF == pytest.approx(0.5 * RHO * D * C_X * speed**2, rel=2e-3)


@pytest.mark.parametrize("speed", [0.2, 0.28, 0.4])
def test_motion_in_line_is_that_of_the_same_equations_solved_apart(speed):
    ramp = 1.5

    def slope(t, x):
        y, v, phase, mean_v, mean_a = x
        past = speed - v
        grown = np.sin(0.5 * np.pi * min(1.0, t / ramp)) ** 2
        pressed = 0.5 * RHO * D * (C_D + grown * C_X * np.cos(phase)) * abs(past) * past
        a = (pressed - SPRING * y) / MASS
        turning = rate(phase, (abs(past), D), v, a, mean_v, mean_a, SHED)
        pace = abs(past) / (SHED[3] * D)
        return [v, a, turning, pace * (v**2 - mean_v), pace * (a**2 - mean_a)]

    times = np.linspace(0.0, 8.0, 161)
    at = 0.5 * RHO * D * C_D * speed**2 / SPRING
    begin, how = [at, 0.0, 0.3, 0.0, 0.0], {"rtol": 1e-9, "atol": 1e-11, "method": "Radau"}
    apart = solve_ivp(slope, (0.0, 8.0), begin, t_eval=times, **how)
    size = np.ptp(apart.y[0])
    errors = []
    for step in (0.005, 0.0025, 0.00125):
        model = at_rest(cylinder(speed, ramp=ramp), speed)
        _, place, _ = moved(model, 8.0, step, round(0.05 / step))
        errors.append(abs(place - apart.y[0]).max() / size)
    assert size > 0.02 * D
    assert errors[-1] < 1e-3
    assert np.log2(errors[0] / errors[1]) > 1.7


@pytest.mark.parametrize("reduced", [2.2, 2.8, 3.5])
def test_it_locks_in_at_half_the_reduced_velocity_of_lift_within_the_limit_of_drag(reduced):
    """Drag that is in phase with velocity gives what mean drag, twice as steep along the flow, takes."""
    speed = reduced * OWN * D
    model = at_rest(cylinder(speed), speed)
    amplitude, frequency = settled(*moved(model, 80.0, 0.005, 4)[:2])
    own = frequency * D / speed
    assert 0.22 < own < 0.52
    assert amplitude / D < 1.03 * C_X / (2.0 * C_D) / (2.0 * np.pi * own)
    assert amplitude / D > 0.02


def energy(model):
    """In springs and motion (J)."""
    x, v = model.s.r[0, 0], model.s.v[0, 0]
    return 0.5 * SPRING * x**2 + 0.5 * MASS * v**2


def test_what_vortices_supply_is_stored_or_taken_by_drag():
    """Built up and steady; drag that presses the cylinder along gives and takes."""
    model = at_rest(cylinder(0.28), 0.28)
    sums, before = [], energy(model)
    for _ in range(2):
        model.s.clock[0] = 60.0 * len(sums)
        sums.append(moved(model, 60.0, 0.0025, 100)[2])
        supplied, taken = sums[-1].work[GIVEN], sums[-1].work[LOST]
        assert supplied - taken == pytest.approx(energy(model) - before, abs=2e-3 * supplied)
        before = energy(model)
    assert sums[-1].work[GIVEN] > 0.0
    assert sums[-1].work[GIVEN] == pytest.approx(sums[-1].work[LOST], rel=0.02)


def test_a_turned_flow_turns_the_motion():
    speed = 0.28
    along = moved(at_rest(cylinder(speed), speed), 20.0, 0.01)[1]
    model = at_rest(cylinder(speed, turned=True), speed, turned=True)
    across = motion(model, 20.0, 0.01)[1]
    np.testing.assert_allclose(across, along, atol=1e-12)


def test_phases_of_drag_follow_acceleration_too():
    """The tangent's part by acceleration, phases included, is the slope of the force."""
    rig = Rig(VortexDrag, 3)
    rig.evaluate()
    still = dense_tangent(rig.s)
    rig.s.rate[:] = 0.0, 9.0
    rig.evaluate()
    moving = dense_tangent(rig.s)
    split = 3 * rig.s.r.shape[1]
    slope = 9.0 * differences(rig.evaluate, rig.s.a, 1e-3)
    found = -(moving - still)[split:, split:]
    assert abs(found - slope[split:]).max() < 1e-7 * abs(slope).max()
    assert abs(slope).max() > 0.0


def test_without_the_mean_drag_motion_has_no_such_limit():
    """What limits the amplitude is drag: a tenth of it lets the cylinder move further."""
    speed = 0.28
    plain = settled(*moved(at_rest(cylinder(speed), speed), 60.0, 0.005, 4)[:2])[0]
    weak = settled(*moved(cylinder(speed, drag=0.1 * C_D), 60.0, 0.005, 4)[:2])[0]
    assert weak > 2.0 * plain
