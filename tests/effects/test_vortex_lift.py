"""Vortex-induced vibration of a rigid cylinder: closed forms, and the same equations solved by others."""

import numpy as np
import pytest
from each.vortex_lift import rate
from rig import Rig, dense_tangent, differences
from scipy.integrate import solve_ivp

from riserstudy.effects.current import Current
from riserstudy.effects.drag import Drag
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.guide import Guide
from riserstudy.effects.vortex_lift import VortexLift
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.evaluate import forces_and_tangent
from riserstudy.solve.implicit import Method, generalised_alpha, march
from riserstudy.solve.newton import Tolerance
from riserstudy.solve.record import new_record
from riserstudy.solve.sums import DONE, GIVEN, LOST, new_sums

RHO, D, C_V, C_D, C_A, RATIO = 1000.0, 0.1, 1.2, 1.1, 1.0, 2.6
SHED = np.array([0.18, 0.07, 0.08, 20.0])
WATER = 0.25 * np.pi * RHO * D * D  # displaced (kg)
MASS = (RATIO + C_A) * WATER
STIFF = 1e10  # (N/m)
OWN = 1.0  # natural frequency in water (Hz)


def cylinder(speed, stiffness=(2.0 * np.pi * OWN) ** 2 * MASS, drag=C_D, ramp=1e-9, begin=0.3):
    """A metre of upright cylinder on springs, in a current along x; it moves along y alone."""
    half = np.full(3, 0.5 * MASS)
    nodes = 2
    shed = np.repeat(SHED[:, np.newaxis], nodes, axis=1)
    lift = np.array([0.5 * RHO * C_V * D])
    pressed = np.array([0.5 * RHO * drag * D])
    flow = Current(np.array([0.0, 1.0]), np.full(2, speed), np.array([1.0, 0.0]), np.zeros(2, np.int64), 0.0)
    effects = [
        flow,
        *(EndMass(i, 0.0, half, np.zeros(2), np.zeros(3)) for i in range(nodes)),
        *(Guide(i, 0.5 * stiffness) for i in range(nodes)),
        Drag(pressed, pressed, np.zeros((3, nodes)), 0),
        VortexLift(lift, lift, np.zeros((3, nodes)), np.full(nodes, D), shed, ramp, 0, np.zeros((3, nodes))),
    ]  # fmt: skip
    held = [(i, c) for i in range(nodes) for c in ((0, 1, 2) if stiffness == np.inf else (0, 2))]
    model = Model(
        Unknowns(np.ones(1), 3, 0, internal=3), [Effect(type(e).__name__, e, "") for e in effects], held
    )  # fmt: skip
    model.s.r[2] = 0.0, 1.0
    model.s.internal[0] = begin
    return model


def motion(model, duration, step, every=1, damping=1.0, axis=1):
    """Times and places across the flow, or along another axis, and sums."""
    steps = round(duration / step)
    times = np.arange(0, steps + 1, every) * step
    record, sums = new_record(times, [0], model.s), new_sums()
    method = Method(*generalised_alpha(damping), step, steps, Tolerance(1e-13, 1e-4), 20, 6, 0)
    assert march(model.programs, model.state, model.spare, method, model.fixed, record, sums) == DONE
    return times, record.value.history[:, axis, 0], sums


def settled(times, place, share=0.5):
    """Amplitude and frequency (Hz) of the later part of a motion."""
    late = times >= share * times[-1]
    t, y = times[late], place[late] - place[late].mean()
    up = np.flatnonzero((y[:-1] < 0.0) & (y[1:] >= 0.0))
    zero = t[up] - y[up] * (t[up + 1] - t[up]) / (y[up + 1] - y[up])
    return np.sqrt(2.0 * np.mean(y**2)), (len(zero) - 1) / (zero[-1] - zero[0])


@pytest.mark.long
def test_a_cylinder_at_rest_sheds_at_its_free_frequency_and_is_lifted_by_the_coefficient():
    speed, held = 0.7, cylinder(0.7, stiffness=STIFF, drag=1e-9, ramp=5.0)
    duration = 300.0 * D / speed
    times, place, _ = motion(held, duration, D / speed / 100.0, damping=0.5)
    amplitude, frequency = settled(times, place)
    assert frequency == pytest.approx(SHED[0] * speed / D, rel=1e-3)
    assert amplitude * STIFF == pytest.approx(0.5 * RHO * D * C_V * speed**2, rel=2e-3)


@pytest.mark.parametrize(
    "reduced, amplitude, frequency",
    [(3, 0.12, 0.26), (4, 0.66, 0.25), (5, 0.80, 0.20), (6, 0.84, 0.18), (7, 0.83, 0.16),
     (8, 0.79, 0.15), (9, 0.74, 0.14), (10, 0.69, 0.13)],
)  # fmt: skip
def test_response_over_reduced_velocity(reduced, amplitude, frequency):
    """Values computed apart from this project, for a mass ratio of 2.6 without damping."""
    speed = reduced * OWN * D
    found, beat = settled(*motion(cylinder(speed), 80.0, 0.005, 4)[:2])
    assert found / D == pytest.approx(amplitude, abs=0.012)
    assert beat * D / speed == pytest.approx(frequency, abs=0.006)


def test_the_motion_is_that_of_the_same_equations_solved_apart():
    speed, stiffness, ramp = 0.6, (2.0 * np.pi * OWN) ** 2 * MASS, 1.5

    def slope(t, x):
        y, v, phase, mean_v, mean_a = x
        flow = np.hypot(speed, v)
        # seen from the cylinder water flows with (speed, -v); across it is (v, speed) over its size
        grown = np.sin(0.5 * np.pi * min(1.0, t / ramp)) ** 2
        lift = grown * 0.5 * RHO * D * C_V * flow * speed * np.cos(phase)
        a = (lift - 0.5 * RHO * D * C_D * flow * v - stiffness * y) / MASS
        across, gone = v * speed / flow, a * speed / flow
        pace = flow / (SHED[3] * D)
        turning = rate(phase, (flow, D), across, gone, mean_v, mean_a, SHED)
        return [v, a, turning, pace * (across**2 - mean_v), pace * (gone**2 - mean_a)]

    times = np.linspace(0.0, 6.0, 121)
    begin, how = [0.0, 0.0, 0.3, 0.0, 0.0], {"rtol": 1e-9, "atol": 1e-11, "method": "Radau"}
    apart = solve_ivp(slope, (0.0, 6.0), begin, t_eval=times, **how)
    errors = []
    for step in (0.005, 0.0025, 0.00125):
        _, place, _ = motion(cylinder(speed, ramp=ramp), 6.0, step, round(0.05 / step))
        errors.append(abs(place - apart.y[0]).max() / abs(apart.y[0]).max())
    assert errors[-1] < 1e-3
    assert np.log2(errors[0] / errors[1]) > 1.7


def test_no_amplitude_is_beyond_that_of_lift_in_phase_with_velocity():
    for reduced in (4.0, 5.5, 8.0):
        speed = reduced * OWN * D
        amplitude, frequency = settled(*motion(cylinder(speed), 60.0, 0.005, 4)[:2])
        limit = C_V / C_D / (2.0 * np.pi * frequency * D / speed)
        # drag over a cycle counts by the cube of the whole speed, which a sine's mean has a little less of
        assert amplitude / D < 1.03 * limit


def test_what_the_water_gives_is_what_drag_takes_once_it_is_steady():
    model = cylinder(0.55)
    _, _, early = motion(model, 40.0, 0.005, 100)
    model.s.clock[0] = 40.0
    _, _, late = motion(model, 100.0, 0.005, 100)
    assert late.work[GIVEN] == pytest.approx(late.work[LOST], rel=0.02)
    assert early.work[GIVEN] > 0.0


def test_statics_know_no_lift():
    model = cylinder(0.5, ramp=1.0)
    model.s.clock[0] = 0.0
    forces_and_tangent(model.programs, model.state)
    assert not model.s.force[1].any()


def test_phases_follow_acceleration_too():
    """The tangent's part by acceleration, phases included, is the slope of the force."""
    rig = Rig(VortexLift, 3)
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
