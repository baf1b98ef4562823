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
from riserstudy.scene.rao import Response
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm, Swell

MOTIONS = (*TRANSLATIONS, *TILTS)
PLACES = 8  # number of places in an interval of a time series at which its speed is evaluated


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


def largest_speed(scene: Resolved, elevation: float) -> float:
    """Largest horizontal speed (m/s) of a point of the platform in its prescribed motion, without cruise.

    It is the sum of the speeds of all motions; of the response to a sea, twice their standard deviation.
    ``elevation``: elevation of the point (m).
    """
    platform = scene.platform
    if platform is None:
        return 0.0
    lever = abs(elevation - float(centre(platform)[2]))
    arms = np.array([1.0, 1.0, 0.0, lever, lever, 0.0])
    response = platform.response and (platform.response.wave or scene.wave)
    total = 0.0
    for effect in motions(scene):
        of = effect.record
        if isinstance(of, Series):
            time = np.linspace(of.time[0], of.time[-1], PLACES * len(of.time))
            k = np.clip(np.searchsorted(of.time, time) - 1, 0, len(of.time) - 2)
            c, since = of.coefficient[:, k], time - of.time[k]
            total += arms[of.motion] * float(np.abs((3 * c[0] * since + 2 * c[1]) * since + c[2]).max())
        elif isinstance(of, Harmonic | Encountered):
            each = arms[of.motion] * np.abs(of.amplitude * of.frequency)
            if effect.because == "platform.response" and isinstance(response, Storm):
                total += sum(math.sqrt(2.0 * (each[of.motion == k] ** 2).sum()) for k in range(len(arms)))
            else:
                total += float(each.sum())
    return total


def centre(platform: Platform | None) -> NDArray[np.float64]:
    """The centre of rotation of the platform at rest, (3,), m; arbitrary if the platform does not rotate."""
    about = platform.centre_of_rotation if platform else None
    if about is None:
        return np.zeros(3)
    return np.array([about.x or 0.0, about.y or 0.0, about.elevation])
