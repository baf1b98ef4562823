"""Warnings about loads and motions that no rig meets, typically by an error of unit or of a prefix.

The ranges are so wide that real rigs and models at 1:50 are within them. Waves are judged by their steepness,
which is equal for a rig and its model.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from riserstudy.model.steep_waves import highest, waves_of
from riserstudy.records.warning import RunWarning, Value, warning
from riserstudy.scene.forcing import TILTS, TRANSLATIONS, Current, Harmonic, TimeSeries
from riserstudy.scene.rao import SHIFTS
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm, Swell, WindDrift
from riserstudy.scene.units import GRAVITY

FASTEST_CURRENT = 12.0  # m/s; the fastest tidal streams reach about 10
SLOWEST_CURRENT = 5e-4  # m/s, in every part of a profile; a model at 1:50 of 0.01 m/s has 0.0014
FASTEST_WIND = 120.0  # m/s; the fastest gust on record is 113
FASTEST_SHIP = 40.0  # m/s
FASTEST_MOTION = 60.0  # m/s, amplitude times angular frequency
FLATTEST = 5e-5  # steepness, height over length of deep-water waves; 0.1 m at 25 s has twice as much
LONGEST, SHORTEST = 120.0, 0.1  # periods of waves (s); swell has up to 30, a model at 1:50 of 2 s has 0.28
LARGEST_SHIFT, SMALLEST_SHIFT = 20.0, 1e-3  # m/m, largest translation of all operators
LARGEST_TILT = math.radians(75.0)  # of roll and pitch; rigs capsize at less
LARGEST_HEAVE = 60.0  # m
OPERATORS = "platform.response.operators"


def unusual_loads(scene: Resolved) -> list[RunWarning]:
    """Warnings about loads and motions beyond those of any rig."""
    return [
        *(one for path, sea in waves_of(scene).items() for one in _wave(path, scene, sea)),
        *(_current(scene.current) if scene.current else ()),
        *_winds(scene),
        *_motions(scene),
        *_operators(scene),
    ]


def _wave(path: str, scene: Resolved, sea: Swell | Storm) -> Iterator[RunWarning]:
    """Warnings about heights that waves do not have at their period, and about periods of no wave."""
    if isinstance(sea, Storm):
        name, height, period = "significant height", sea.significant_height, sea.peak_period
    else:
        name, height, period = "height", sea.wave_height, sea.period
    if not SHORTEST <= period <= LONGEST:
        text = f"waves have periods of {SHORTEST:g} s to {LONGEST:g} s, not of {{period:.3g}} s"
        yield _doubt("unusual_wave_period", f"{{path}}: {text}", path=path, period=period)
        return
    about: dict[str, Value] = {"path": path, "name": name, "height": height, "period": period}
    flat = FLATTEST * (scene.gravity or GRAVITY) * period**2 / math.tau
    if height < flat:
        text = (
            "is too small for waves of {period:.3g} s; in a sea or a basin, they have more than {flat:.2g} m"
        )
        yield _doubt("flat_waves", f"{{path}}: a {{name}} of {{height:.3g}} m {text}", **about, flat=flat)
    # regular waves have a warning of their own
    if isinstance(sea, Storm) and height > (most := highest(scene, period)):
        text = "is above {most:.3g} m, at which waves of {period:.3g} s break"
        yield _doubt("breaking_sea", f"{{path}}: a {{name}} of {{height:.3g}} m {text}", **about, most=most)


def _current(current: Current) -> Iterator[RunWarning]:
    """Warnings about speeds of a current."""
    points = current.profile if isinstance(current.profile, list) else []
    shapes = [part.surface_speed for part in current.parts if not isinstance(part, WindDrift)]
    speeds = [abs(speed) for speed in (*(point.speed for point in points), *shapes)]
    fastest = max(speeds, default=0.0)
    if fastest > FASTEST_CURRENT:
        text = "current.profile: {speed:.3g} m/s; the fastest tidal streams have about 10 m/s"
        yield _doubt("fast_current", text, speed=fastest)
    elif 0.0 < fastest < SLOWEST_CURRENT:
        text = "current.profile: at most {speed:.3g} m/s, which causes almost no drag"
        yield _doubt("slow_current", text, speed=fastest)


def _winds(scene: Resolved) -> Iterator[RunWarning]:
    """Warnings about speeds of winds, and of a cruise."""
    vessel, platform, parts = scene.vessel, scene.platform, scene.current.parts if scene.current else []
    winds = [("vessel.wind.speed", vessel.wind.speed)] if vessel and vessel.wind else []
    winds += [("current.profile", part.wind_speed) for part in parts if isinstance(part, WindDrift)]
    for path, speed in winds:
        if abs(speed) > FASTEST_WIND:
            text = "{path}: a wind of {speed:.3g} m/s; the fastest gust on record had 113 m/s"
            yield _doubt("fast_wind", text, path=path, speed=abs(speed))
    if platform and platform.cruise and abs(platform.cruise.speed) > FASTEST_SHIP:
        text = "platform.cruise.speed: {speed:.3g} m/s is faster than any ship"
        yield _doubt("fast_cruise", text, speed=abs(platform.cruise.speed))


def _motions(scene: Resolved) -> Iterator[RunWarning]:
    """Warnings about motions and positions of the platform, however they are given."""
    if scene.platform is None:
        return
    length = sum(section.total_length for section in scene.riser)
    largest = dict.fromkeys(("surge", "sway"), length) | {"heave": LARGEST_HEAVE}
    largest |= dict.fromkeys(("roll", "pitch"), LARGEST_TILT) | {"yaw": math.tau}
    for name in (*TRANSLATIONS, *TILTS):
        motion = getattr(scene.platform, name)
        harmonics = motion if isinstance(motion, list) else [motion]
        sizes = [one.amplitude for one in harmonics if isinstance(one, Harmonic)]
        if isinstance(motion, TimeSeries):
            values = [point.value for point in motion.points]
            sizes.append(0.5 * (max(values) - min(values)))
        size = max(sizes, default=0.0)
        if size > largest[name]:
            why = "the length of the riser" if name in ("surge", "sway") else "motions of floating platforms"
            kind, unit = ("large_tilt", "deg") if name in TILTS else ("large_shift", "m")
            text = f"platform.{{name}}: an amplitude of {{size:.4g}} {unit} is beyond {{why}}"
            yield _doubt(kind, text, name=name, size=math.degrees(size) if unit == "deg" else size, why=why)
        for one in harmonics:
            if isinstance(one, Harmonic) and name in TRANSLATIONS:
                speed = one.amplitude * math.tau / one.period
                if speed > FASTEST_MOTION:
                    text = "platform.{name}: moves at up to {speed:.3g} m/s, which no platform does"
                    yield _doubt("fast_motion", text, name=name, speed=speed)


def _operators(scene: Resolved) -> Iterator[RunWarning]:
    """Warnings about translations per wave amplitude, of which the largest of all operators counts."""
    response = scene.platform and scene.platform.response
    if not response:
        return
    shifts = {
        name: max(getattr(row, name) for row in response.operators)
        for name in SHIFTS
        if name in response.moving
    }
    name = max(shifts, key=lambda one: shifts[one], default="")
    size = shifts.get(name, 0.0)
    if size > LARGEST_SHIFT:
        text = f"is up to {{size:.3g}} m/m; near resonance platforms have less than {LARGEST_SHIFT:g} m/m"
        yield _doubt("large_operators", f"{OPERATORS}: {{name}} {text}", name=name, size=size)
    elif 0.0 < size < SMALLEST_SHIFT:
        text = "no translation is above {size:.3g} m/m, so the platform hardly moves"
        yield _doubt("small_operators", f"{OPERATORS}: {text}", size=size)


def _doubt(kind: str, text: str, **values: Value) -> RunWarning:
    return warning(kind, f"{text}. Check the unit", values)
