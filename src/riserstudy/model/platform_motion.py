"""The records of a platform's position and motion."""

from __future__ import annotations

import math
from collections.abc import Iterator
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.platform_motion import Cruise, Encountered, Harmonic, Position, Series
from riserstudy.effects.registry import ROLES
from riserstudy.model.model import Effect
from riserstudy.model.rao import harmonics
from riserstudy.model.sea import components_of, wave_numbers
from riserstudy.scene.forcing import TILTS, TRANSLATIONS, Platform, TimeSeries
from riserstudy.scene.forcing import Position as Rest
from riserstudy.scene.rao import Response
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm, Swell

MOTIONS = (*TRANSLATIONS, *TILTS)
PLACES = 8  # number of places in an interval of a time series at which its speed is evaluated
DIRECTIONS = 36  # number of directions in half a turn in which a speed is evaluated


def motions(scene: Resolved) -> Iterator[Effect]:
    """Effects that displace and move the platform of a scene, in the scene's wave if it has one."""
    platform = scene.platform
    if platform is None:
        return
    if platform.position:
        away = np.array([getattr(platform.position, name) or 0.0 for name in MOTIONS])
        yield Effect("platform position", Position(away), "platform.position")
    for k, name in enumerate(MOTIONS):
        motion = getattr(platform, name)
        if isinstance(motion, TimeSeries):
            from scipy.interpolate import CubicSpline  # loaded where it is needed: it takes long

            times = np.array([p.time for p in motion.points])
            spline = CubicSpline(times, np.array([p.value for p in motion.points]))
            series = Series(k, times, np.ascontiguousarray(spline.c))
            yield Effect("platform motion", series, f"platform.{name}")
    rows = platform.harmonics
    if rows:
        harmonic = Harmonic(
            np.array([MOTIONS.index(name) for name, _ in rows]),
            np.array([motion.amplitude for _, motion in rows]),
            np.array([2.0 * math.pi / motion.period for _, motion in rows]),
            np.array([motion.phase or 0.0 for _, motion in rows]),
            np.array([motion.ramp or 0.0 for _, motion in rows]),
        )
        names = ", ".join(dict.fromkeys(f"platform.{name}" for name, _ in rows))
        yield Effect("platform motion", harmonic, names)
    if platform.response:
        yield _response(scene, platform.response)
    if platform.cruise:
        cruise = platform.cruise
        heading = cruise.heading or 0.0
        for k, share in ((0, math.cos(heading)), (1, math.sin(heading))):
            if abs(share) > 1e-12:
                record: NamedTuple = Cruise(k, share * cruise.speed, cruise.ramp or 0.0)
                yield Effect("platform motion", record, "platform.cruise")


def _response(scene: Resolved, response: Response) -> Effect:
    wave = response.wave or scene.wave
    if wave is None:
        raise TypeError("a response without wave")  # refused by the scene
    parts = harmonics(response, wave, 0.0 if response.wave else _phase_lag(scene, wave))
    ramp = np.full(len(parts.motion), response.ramp or 0.0)
    index = np.array([MOTIONS.index(name) for name in parts.motion])
    rows = (index, parts.amplitude, parts.frequency, parts.phase, ramp)
    cruise = scene.platform and scene.platform.cruise
    if cruise and not response.wave:
        apart = (cruise.heading or 0.0) - (getattr(wave, "heading", None) or 0.0)
        per_metre = math.cos(apart) * _wave_numbers(scene, wave)
        delay = np.tile(per_metre, len(parts.motion) // len(per_metre))
        met = Encountered(*rows, delay, cruise.speed, cruise.ramp or 0.0)
        return Effect("platform motion", met, "platform.response")
    return Effect("platform motion", Harmonic(*rows), "platform.response")


def _wave_numbers(scene: Resolved, wave: Swell | Storm) -> NDArray[np.float64]:
    """Wave number of each component of the scene's wave (rad/m); zero without water or gravity."""
    _, frequency, _ = components_of(wave)
    if scene.gravity is None or scene.water is None:
        return np.zeros(len(frequency))
    return wave_numbers(frequency, scene.water, scene.gravity)


def _phase_lag(scene: Resolved, wave: Swell | Storm) -> NDArray[np.float64] | float:
    """Phase by which the scene's wave is later at the platform's position than at the origin (rad)."""
    position, heading = scene.platform and scene.platform.position, getattr(wave, "heading", None)
    x = (scene.top.offset or 0.0) + ((position and position.surge) or 0.0)
    y = (position and position.sway) or 0.0
    along = x * math.cos(heading or 0.0) + y * math.sin(heading or 0.0)
    return along * _wave_numbers(scene, wave) if along else 0.0


def displacement(scene: Resolved, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Surge, sway, heave (m), roll, pitch and yaw (rad) at times (s), shape (times, 6)."""
    effects = list(motions(scene))
    rows = []
    for time in times:
        state = SimpleNamespace(clock=np.array([time]), platform=np.zeros((3, 6)))
        for effect in effects:
            drive = ROLES[type(effect.record)]["motion"]
            # as plain Python: compiling would take longer than a few hundred calls
            getattr(drive, "py_func", drive)(effect.record, state)
        rows.append(state.platform[0])
    return np.array(rows)


def largest_speed(scene: Resolved, place: NDArray[np.float64]) -> float:
    """Largest horizontal speed (m/s) of a point of the platform in its prescribed motion, without cruise.

    Motions of one frequency are added with their phases, and time series at each time. In each direction, the
    speeds of different frequencies, of the time series and of the response are then summed; of the response
    to a sea, it is twice the standard deviation. Motions have their full size, as after their ramps, and
    rotations are small, apart from those at rest.

    ``place``: position of the point with the platform upright above the well, (3,), m.
    """
    platform = scene.platform
    if platform is None:
        return 0.0
    angle = np.linspace(0.0, math.pi, DIRECTIONS, endpoint=False)
    levers = np.stack([np.cos(angle), np.sin(angle)], axis=1) @ _levers(platform, place)
    records = [(effect.because, effect.record) for effect in motions(scene)]
    total = _of_series(levers, [of for _, of in records if isinstance(of, Series)])
    response = platform.response and (platform.response.wave or scene.wave)
    for because, of in records:
        if isinstance(of, Harmonic | Encountered):
            each = _by_frequency(levers, of)
            irregular = because == "platform.response" and isinstance(response, Storm)
            total += np.sqrt(2.0 * (each**2).sum(axis=1)) if irregular else each.sum(axis=1)
    return float(total.max())


def _levers(platform: Platform, place: NDArray[np.float64]) -> NDArray[np.float64]:
    """Horizontal speed of a point per speed of each motion, (2, 6), m/s per m/s or rad/s.

    ``place``: as in `largest_speed`.
    """
    levers = np.zeros((3, 6))
    levers[:, :3] = np.eye(3)
    arm, at_rest = place - centre(platform), platform.position or Rest()
    tilts = [getattr(at_rest, name) or 0.0 for name in TILTS]
    axes = np.eye(3)  # of roll, pitch and yaw, one a row
    if any(tilts):
        from scipy.spatial.transform import Rotation  # loaded where it is needed: it takes long

        arm = Rotation.from_euler("xyz", tilts).apply(arm)
        axes[0] = Rotation.from_euler("yz", tilts[1:]).apply(axes[0])
        axes[1] = Rotation.from_euler("z", tilts[2]).apply(axes[1])
    levers[:, 3:] = np.cross(axes, arm).T
    return levers[:2]


def _of_series(levers: NDArray[np.float64], series: list[Series]) -> NDArray[np.float64]:
    """Largest speeds (m/s) in directions of a point that moves by time series, (directions,).

    ``levers``: speed in each direction per speed of each motion, (directions, 6), m/s per m/s or rad/s.
    """
    if not series:
        return np.zeros(len(levers))
    knots = np.unique(np.concatenate([of.time for of in series]))
    count = PLACES * (len(knots) - 1) + 1
    times = np.interp(np.linspace(0.0, len(knots) - 1.0, count), np.arange(len(knots)), knots)
    rates = np.zeros((6, count))
    for of in series:
        k = np.clip(np.searchsorted(of.time, times, side="right") - 1, 0, len(of.time) - 2)
        c, since = of.coefficient[:, k], times - of.time[k]
        rate = (3.0 * c[0] * since + 2.0 * c[1]) * since + c[2]
        rates[of.motion] = np.where((times >= of.time[0]) & (times <= of.time[-1]), rate, 0.0)
    return np.array([np.abs(row @ rates).max() for row in levers])


def _by_frequency(levers: NDArray[np.float64], of: Harmonic | Encountered) -> NDArray[np.float64]:
    """Amplitudes of a point's speed (m/s) in directions at each frequency, (directions, frequencies).

    ``levers``: as in `_of_series`.
    """
    frequency = of.frequency
    if isinstance(of, Encountered):
        frequency = frequency - of.delay * of.speed
    _, at = np.unique(frequency, return_inverse=True)
    each = levers[:, of.motion] * (of.amplitude * frequency * np.exp(1j * of.phase))
    summed = np.zeros((at.max() + 1, len(levers)), complex)
    np.add.at(summed, at, each.T)
    return np.asarray(np.abs(summed.T))


def centre(platform: Platform | None) -> NDArray[np.float64]:
    """The centre of rotation of the platform at rest, (3,), m; arbitrary if the platform does not rotate."""
    about = platform.centre_of_rotation if platform else None
    if about is None:
        return np.zeros(3)
    return np.array([about.x or 0.0, about.y or 0.0, about.elevation])
