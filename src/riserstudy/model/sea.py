"""The sea of a scene as arrays: current over elevation, components of its waves."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import FloatArray
from riserstudy.scene.forcing import Current, Shape
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import IrregularSea, RegularWave, Storm, Swell, WindDrift
from riserstudy.scene.water import Water

PROFILE_POINTS = 2001  # points of a named current profile
SAME = 1e-9  # distance of two elevations that count as one, as a share of the profile's height
# depth below the surface at which its velocity is evaluated, as a share of the profile's height
BELOW = 1e-9

# kd tanh kd below which tanh kd equals kd to twelve digits, and a search for kd would fail
SHALLOW = 1e-12


def current_table(current: Current, water: Water | None) -> tuple[FloatArray, FloatArray]:
    """Rising elevations (m) and speeds (m/s) of a current of one direction, (k,); end values hold beyond."""
    if current.turns:
        raise TypeError("a current whose direction changes is not defined by its speed alone")
    return _ended(current, *_as_table(current, water))


def current_velocity(current: Current, water: Water | None) -> tuple[FloatArray, FloatArray]:
    """Rising elevations (m), (k,), and velocities along x and y (m/s), (2, k); end values hold beyond."""
    if not current.turns:
        z, speed = current_table(current, water)
        return z, np.outer(_unit(current.towards), speed)
    z, speed = _as_table(current, water)
    if isinstance(current.profile, list):
        return _ended(current, z, _unit(np.array(current.directions)) * speed)
    velocity = np.outer(_unit(current.towards), speed)
    for part in current.parts:
        if isinstance(part, WindDrift) and part.component == "both":
            velocity += _spiral(part, levels(part, water), z, current.towards)
    return _ended(current, z, velocity)


def surface_current(current: Current, water: Water | None) -> FloatArray:
    """Velocity of a current at the mean level along x and y (m/s), (2,); at a jump there, just below it.

    Without a level, it is the velocity at the profile's upper end.
    """
    z, velocity = current_velocity(current, water)
    level = float(z[-1]) if water is None or water.surface is None else water.surface
    below = level - BELOW * (z[-1] - z[0])
    return np.array([np.interp(below, z, part) for part in velocity])


def still_surface(scene: Resolved) -> float | None:
    """Elevation of a surface without waves (m); None where there are waves, or the scene has no surface."""
    return scene.water.surface if scene.water and not scene.wave else None


def in_water(scene: Resolved, elevations: FloatArray) -> NDArray[np.bool_]:
    """Which elevations (m) are between the ground and the water's surface, as far as these are known.

    The result has the shape of the elevations.
    """
    surface = scene.water.surface if scene.water else None
    below = np.full(elevations.shape, True) if surface is None else elevations <= surface
    return below if scene.ground is None else below & (elevations >= scene.ground)


def _unit(heading: float | FloatArray) -> FloatArray:
    return np.array([np.cos(heading), np.sin(heading)])


def _ended(current: Current, z: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The table; if the water beyond its ends is still, with jumps to zero at its ends."""
    if current.beyond != "zero":
        return z, values
    low, high = (int(np.any(values[..., end] != 0.0)) for end in (0, -1))
    still = [(0, 0)] * (values.ndim - 1) + [(low, high)]
    return np.pad(z, (low, high), "edge"), np.pad(values, still)


def _as_table(current: Current, water: Water | None) -> tuple[FloatArray, FloatArray]:
    """Elevations and speeds; parts whose direction changes with depth are not included."""
    if isinstance(current.profile, list):
        elevations, speeds = current.table(water)
        return np.array(elevations), np.array(speeds)
    spans = [levels(part, water) for part in current.parts]
    z = _elevations(current, spans)
    speed = np.zeros_like(z)
    for part, span in zip(current.parts, spans, strict=True):
        if not (isinstance(part, WindDrift) and part.component == "both"):
            speed += profile(part, span, z)
    return z, speed


def _elevations(current: Current, spans: list[tuple[float, float]]) -> FloatArray:
    """Even elevations over the spans of all parts, with those at which a part has a kink."""
    low, high = min(low for low, _ in spans), max(high for _, high in spans)
    kinks = [end for span in spans for end in span]
    for part, (_, top) in zip(current.parts, spans, strict=True):
        if isinstance(part, Shape) and part.shape == "layer":
            kinks += [top - depth for depth in (part.layer or 0.0, part.vanishes or 1.0)]
    even = np.linspace(low, high, PROFILE_POINTS)
    inside = np.unique([kink for kink in kinks if low <= kink <= high])
    near = abs(even[:, None] - inside).min(axis=1) < SAME * (high - low)
    return np.sort(np.concatenate([even[~near], inside]))


def _spiral(part: WindDrift, span: tuple[float, float], z: FloatArray, wind: float) -> FloatArray:
    """Ekman's drift under a wind that blows to a heading (rad), along x and y (m/s), (2, k)."""
    drift, angle = _drift(part, span, np.clip(z, *span))
    side = -1.0 if part.hemisphere == "northern" else 1.0  # from x towards y is to the left
    return drift * _unit(wind + side * angle)


def _drift(part: WindDrift, span: tuple[float, float], inside: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Speed of the drift (m/s), and its angle from the wind (rad): 45 degrees at the surface, more below."""
    strength = part.wind_speed / math.sqrt(math.sin(part.latitude))
    fall = math.pi * (inside - span[1]) / (part.depth_factor * strength)
    return part.surface_factor * strength * np.exp(fall), 0.25 * math.pi - fall


def levels(part: Shape | WindDrift, water: Water | None) -> tuple[float, float]:
    """Elevations of the seabed and the surface that a profile extends between (m)."""
    own = (part.seabed, part.surface) if isinstance(part, Shape) else (None, None)
    of_water = (water.seabed, water.surface) if water else (None, None)
    low, high = (a if a is not None else b for a, b in zip(own, of_water, strict=True))
    if low is None or high is None:
        raise TypeError("a profile without seabed or surface")  # refused by the scene
    return low, high


def profile(part: Shape | WindDrift, span: tuple[float, float], z: FloatArray) -> FloatArray:
    """Speed of one named profile (m/s), in the shape of the elevations (m); end values hold beyond its span.

    References
    ----------
    Ekman 1905, On the influence of the earth's rotation on ocean currents, Arkiv för Matematik, Astronomi och
    Fysik 2(11): the drift of deep water, whose transport is all across the wind.
    """
    low, high = span
    inside = np.clip(z, low, high)
    if isinstance(part, WindDrift):
        drift, angle = _drift(part, span, inside)
        turned = {
            "along the wind": np.cos(angle),
            "across the wind": np.sin(angle),
            "magnitude": np.ones_like(angle),
        }[part.component]
        return np.asarray(drift * turned)
    share = {
        "uniform": lambda: np.ones_like(z),
        "power": lambda: ((inside - low) / (high - low)) ** (part.power or 1.0),
        "exponential": lambda: np.exp((inside - high) / (part.scale or 1.0)),
        "layer": lambda: np.interp(high - inside, (part.layer or 0.0, part.vanishes or 1.0), (1, 0)),
    }[part.shape]()
    return np.asarray(part.surface_speed * share)


def wave_number(frequency: float, depth: float, gravity: float) -> float:
    """Wave number k (rad/m) of w^2 = g k tanh(k d)."""
    from scipy.optimize import brentq  # loading it takes longer than most runs

    shape = frequency**2 * depth / gravity  # kd tanh kd
    if shape < SHALLOW:
        return math.sqrt(shape) / depth
    high = max(shape, math.sqrt(shape)) + 1.0
    return float(brentq(lambda kd: kd * math.tanh(kd) - shape, 0.0, high, xtol=1e-14)) / depth


def wave_numbers(frequency: FloatArray, water: Water, gravity: float) -> FloatArray:
    """Wave numbers (rad/m) of the components of a wave or sea, (components,), for frequencies in rad/s."""
    depth = (water.surface or 0.0) - (water.seabed or 0.0)
    return np.array([wave_number(w, depth, gravity) for w in frequency])


def depth_of_action(sea: RegularWave | IrregularSea, water: Water, gravity: float) -> float:
    """Depth 1/k (m) over which the motion of the shortest relevant waves decays by a factor of e."""
    frequency = 2.0 * math.pi / sea.shortest_period
    return 1.0 / wave_number(frequency, (water.surface or 0.0) - (water.seabed or 0.0), gravity)


def speed_at_crest(sea: Swell | Storm, water: Water, gravity: float, elevations: FloatArray) -> FloatArray:
    """Horizontal speed (m/s) of the water at the crest of a wave, by linear theory, at elevations (m), (k,).

    Of a sea, it is twice the standard deviation, like the significant height. Above the mean level, it is the
    speed at the mean level.
    """
    surface, seabed = water.surface or 0.0, water.seabed or 0.0
    amplitude, frequency, _ = components_of(sea)
    k = wave_numbers(frequency, water, gravity)
    depth = np.maximum(surface - elevations, 0.0)[:, None]
    above_bed = np.maximum(surface - seabed - depth, 0.0)
    # cosh k(z - seabed) / sinh k(surface - seabed), without large exponentials
    share = np.exp(-k * depth) * (1.0 + np.exp(-2.0 * k * above_bed))
    share /= 1.0 - np.exp(-2.0 * k * (surface - seabed))
    squares = ((amplitude * frequency * share) ** 2).sum(axis=1)
    return np.asarray(np.sqrt(squares) if len(k) == 1 else np.sqrt(2.0 * squares))


def components_of(sea: Swell | Storm) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Amplitudes (m), frequencies (rad/s) and phases (rad) of a wave or sea, each (components,)."""
    if isinstance(sea, Swell):
        numbers = (0.5 * sea.wave_height, 2.0 * math.pi / sea.period, sea.phase or 0.0)
        one, two, three = (np.array([x]) for x in numbers)
        return one, two, three
    frequency, amplitudes = components(sea)
    random = np.random.default_rng(sea.seed)
    return amplitudes, frequency, random.uniform(0.0, 2.0 * math.pi, sea.components)


def components(sea: Storm) -> tuple[FloatArray, FloatArray]:
    """Frequencies (rad/s) and amplitudes (m), (components,), that share the energy of the sea equally.

    Each frequency is at the middle of its share of the energy. The frequencies are therefore incommensurate,
    and the record does not repeat.
    """
    from scipy.integrate import cumulative_trapezoid

    peak = 2.0 * math.pi / sea.peak_period
    w = peak * np.geomspace(0.4, 10.0, 20001)
    energy = cumulative_trapezoid(jonswap(w, peak, sea.peak_enhancement), w, initial=0.0)
    shares = (np.arange(sea.components) + 0.5) / sea.components
    frequency = np.interp(shares * energy[-1], energy, w)
    amplitude = sea.significant_height / math.sqrt(8.0 * sea.components)  # Hs = 4 sqrt(sum a^2 / 2)
    return frequency, np.full(sea.components, amplitude)


def jonswap(w: FloatArray, peak: float, enhancement: float) -> FloatArray:
    """JONSWAP spectrum except for its scale, at frequencies ``w`` (rad/s), in their shape; the peak in rad/s.

    References
    ----------
    Hasselmann et al. 1973, Measurements of wind-wave growth and swell decay during the Joint North Sea
    Wave Project, Deutsche Hydrographische Zeitschrift A8(12), equation 2.4.1.
    """
    # Brings dask with it, half a second to import: a scene without a sea does not wait for it.
    from wavespectra.construct.frequency import jonswap as spectrum

    return np.asarray(spectrum(w, peak, gamma=enhancement))
