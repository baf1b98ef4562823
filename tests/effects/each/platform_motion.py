"""Platform motion: a case, the plain version, an oscillator, encountered waves, even acceleration.

tests/model/test_rao.py and tests/simulation/test_prescribed_run.py have motions of whole scenes.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import bodies
from surroundings import Case

from riserstudy.effects.platform_motion import Cruise, Encountered, Harmonic, Position, Series
from riserstudy.solve.evaluate import one_call


def splines(d: int) -> Series:
    coefficient = np.random.default_rng(3).normal(size=(4, 5)) * [[1e-3], [1e-2], [0.1], [1.0]]
    return Series(2, np.array([0.0, 2.0, 3.0, 5.5, 8.0, 10.0]), coefficient)


def position(record, t):
    return record.displacement


def harmonic(record, t):
    out = np.zeros(6)
    ramp = np.where(record.ramp > 0.0, record.ramp, 1e-300)
    grown = np.where(t < ramp, 0.5 * (1.0 - np.cos(np.pi * np.minimum(t / ramp, 1.0))), 1.0)
    value = record.amplitude * np.sin(record.frequency * t + record.phase) * grown
    np.add.at(out, record.motion, value)
    return out


def sailed(ramp, t):
    """Distance for a speed of 1 m/s."""
    return 0.5 * t**2 / ramp if t < ramp else t - 0.5 * ramp


def encountered(record, t):
    late = record.phase - record.delay * record.speed * sailed(record.over, t)
    return harmonic(record._replace(phase=late), t)


def cruise(record, t):
    out = np.zeros(6)
    out[record.motion] = record.speed * sailed(record.ramp, t)
    return out


def series(record, t):
    out = np.zeros(6)
    t = np.clip(t, record.time[0], record.time[-1])
    k = min(np.searchsorted(record.time, t, side="right") - 1, len(record.time) - 2)
    out[record.motion] = np.polyval(record.coefficient[:, k], t - record.time[k])
    return out


def motions():
    """Which motion, amplitude, frequency, phase and ramp."""
    return (
        np.array([0, 2, 0]),
        np.array([2.0, 1.0, 0.5]),
        np.array([0.4, 0.6, 1.1]),
        np.array([0.3, 0.0, -1.0]),
        np.array([15.0, 0.0, 3.0]),
    )


CASES = {
    Position: Case(lambda d: Position(np.linspace(0.1, 0.6, 6))),
    Harmonic: Case(lambda d: Harmonic(*motions())),
    Encountered: Case(lambda d: Encountered(*motions(), np.array([0.02, -0.04, 0.12]), 1.5, 12.0)),
    Cruise: Case(lambda d: Cruise(0, 1.5, 12.0)),
    Series: Case(splines),
}

MOTIONS = {Position: position, Harmonic: harmonic, Encountered: encountered, Cruise: cruise, Series: series}

# without a load, in a plane on n segments
UNLOADED = {"platform position": lambda n: Position(np.zeros(6))}


AFTER = np.linspace(15.1, 60.0, 23)  # the ramps (s)


def motions_at(times, *records):
    """Displacement, velocity and acceleration (k, 3, 6) of the platform by some records together."""
    model = bodies(*records, mass=1.0)
    out = []
    for t in times:
        model.s.clock[0] = t
        model.s.platform[:] = 0.0
        one_call(model.programs.value.motion, model.state)
        out.append(model.s.platform.copy())
    return np.array(out)


def single(amplitude=2.0, frequency=0.4, phase=0.3, ramp=15.0):
    return Harmonic(np.array([2]), *(np.array([x]) for x in (amplitude, frequency, phase, ramp)))


def test_after_its_ramp_a_harmonic_motion_is_an_oscillator():
    """x^2 + (v / w)^2 is the square of the amplitude, and the acceleration is - w^2 x; heave alone moves."""
    x, v, a = motions_at(AFTER, single())[:, :, 2].T
    np.testing.assert_allclose(np.hypot(x, v / 0.4), 2.0, rtol=1e-12)
    np.testing.assert_allclose(a, -(0.4**2) * x, atol=1e-12)
    assert not np.delete(motions_at(AFTER, single()), 2, axis=2).any()


def test_a_ramp_begins_at_rest_and_is_halfway_at_half_its_time():
    grown, full = (motions_at([0.0, 7.5], single(ramp=ramp))[:, :, 2] for ramp in (15.0, 0.0))
    np.testing.assert_allclose(grown[0, :2], 0.0, atol=1e-12)
    assert grown[1, 0] == pytest.approx(0.5 * full[1, 0], rel=1e-12)
    # the factor's own slope there: pi / 2 over the ramp
    assert grown[1, 1] == pytest.approx(0.5 * full[1, 1] + np.pi / 30.0 * full[1, 0], rel=1e-12)


@pytest.mark.parametrize("speed", [1.5, -6.0])
def test_a_cruising_platform_meets_a_wave_at_the_frequency_of_encounter(speed):
    """Doppler: w - k U, from where the platform is, half a ramp's way behind one at full speed."""
    frequency, number, over = 0.6, 0.6**2 / 9.81, 12.0
    one = [np.array([x]) for x in (2.0, frequency, 0.3, 15.0)]
    met = Encountered(np.array([2]), *one, np.array([number]), speed, over)
    seen = single(2.0, frequency - number * speed, 0.3 + number * speed * 0.5 * over)
    np.testing.assert_allclose(motions_at(AFTER, met), motions_at(AFTER, seen), atol=1e-12)


def test_a_cruise_is_evenly_accelerated_over_its_ramp():
    """v^2 = 2 a x, up to the speed; from then on the way is the area below the speed."""
    cruise = Cruise(0, 1.5, 12.0)
    x, v, a = motions_at(np.linspace(0.5, 11.5, 12), cruise)[:, :, 0].T
    np.testing.assert_allclose(v**2, 2.0 * a * x, rtol=1e-12)
    np.testing.assert_allclose(a, 1.5 / 12.0, rtol=1e-12)
    x, v, a = motions_at(AFTER, cruise)[:, :, 0].T
    np.testing.assert_allclose(np.diff(x), 1.5 * np.diff(AFTER), rtol=1e-12)
    assert x[0] == pytest.approx(0.5 * 12.0 * 1.5 + 1.5 * (AFTER[0] - 12.0), rel=1e-12)
    np.testing.assert_allclose(np.array([v, a]).T, [[1.5, 0.0]] * len(AFTER), atol=1e-12)


def test_a_series_through_a_cubic_is_the_cubic_and_rests_after_its_end():
    """Pieces of one polynomial, each by Taylor's series about its knot; beside a position at rest."""
    cubic = np.polynomial.Polynomial([1.0, -2.0, 0.3, 0.05])
    knots = np.array([0.0, 1.0, 2.5, 4.0])
    derivatives = [cubic.deriv(3) / 6.0, cubic.deriv(2) / 2.0, cubic.deriv(1), cubic]
    record = Series(4, knots, np.array([p(knots[:-1]) for p in derivatives]))
    rest = Position(np.linspace(0.1, 0.6, 6))
    times = np.array([0.2, 1.0, 1.7, 2.5, 3.9])
    found = motions_at(times, rest, record)[..., 4]
    np.testing.assert_allclose(found[:, 0], rest.displacement[4] + cubic(times), atol=1e-12)
    np.testing.assert_allclose(found[:, 1], cubic.deriv(1)(times), atol=1e-12)
    np.testing.assert_allclose(found[:, 2], cubic.deriv(2)(times), atol=1e-12)
    [after] = motions_at([9.0], rest, record)[..., 4]
    np.testing.assert_allclose(after, [rest.displacement[4] + cubic(4.0), 0.0, 0.0], atol=1e-12)
