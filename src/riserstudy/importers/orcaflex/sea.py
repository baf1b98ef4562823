"""Water of a deck: levels, current, and one wave or a sea with a spectrum."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any, NamedTuple

from riserstudy.importers.orcaflex.deck import Part, q
from riserstudy.model.sea import wave_number

SPECTRA = ("JONSWAP", "ISSC")  # ISSC: a Pierson-Moskowitz spectrum of any height
AIRY = ("Airy", "Single Airy")
STEEP = ("Dean stream", "Stokes' 5th", "Cnoidal")
STRETCHING = {"Vertical stretching": "constant", "Wheeler stretching": "stretched"}
SAME = 0.01  # relative difference of two periods of one sea, which are rounded
CURVED = 1e-3  # largest error of a turning current, as a share of its greatest speed
SMALL = 0.1  # largest second harmonic that is left out, as a share of the wave's amplitude


class Sea(NamedTuple):
    """Elevations of the water's surface and the seabed (m), density (kg/m3) and gravity (m/s2)."""

    surface: float
    seabed: float
    density: float
    gravity: float


def sea_of(environment: Part, gravity: float) -> Sea:
    """Return levels (m) and constant density (kg/m3) of the water, with the given gravity (m/s2)."""
    surface = environment.number("WaterSurfaceZ")
    depth = environment.number("WaterDepth", "SeabedOriginDepth")
    for key in ("SeabedSlope", "VerticalDensityVariation"):
        environment.idle(key, "Constant")
    return Sea(surface, surface - depth, 1000.0 * environment.number("Density"), gravity)


def current_of(sea: Part) -> dict[str, Any] | None:
    """Return the current; None without one. Raises InputError where the deck has several."""
    sea.idle("MultipleCurrentDataCanBeDefined", "No")
    speed = sea.given("RefCurrentSpeed")
    if not speed:
        return None
    towards = sea.number("RefCurrentDirection")
    sea.demand("VerticalCurrentVariationMethod", "Interpolated")
    sea.idle("CurrentModel", "Variation scheme")
    rows = sea.figures("CurrentDepth", "CurrentFactor", of=("CurrentRotation",))
    if any(turn for *_, turn in rows):
        made: list[dict[str, Any]] = []
        for depth, factor, turn in _with_turning_points(sea, rows):
            made.append({"depth": q(depth, "m"), "speed": q(speed * factor, "m/s")})
            made[-1]["direction"] = q(math.remainder(towards + turn, 360.0), "deg")
        return {"profile": made, "beyond": "hold"}
    points = [{"depth": q(depth, "m"), "speed": q(speed * factor, "m/s")} for depth, factor, _ in rows]
    heading = {"heading": q(math.remainder(towards, 360.0), "deg")} if towards else {}
    return {"profile": points, "beyond": "hold"} | heading


def _with_turning_points(sea: Part, rows: list[list[float]]) -> list[list[float]]:
    """Return rows of depth (m), factor (1) and rotation (deg), with rows between those that turn far.

    OrcaFlex interpolates factor and rotation, a scene the components of the velocity. A current that turns by
    half a turn at one speed would come to rest in a scene.
    """
    made, largest = rows[:1], max(abs(factor) for _, factor, _ in rows)
    for row, after in pairwise(rows):
        turn, change = math.radians(after[2] - row[2]), (after[1] - row[1]) / (largest or 1.0)
        # the curve of a velocity that turns is a chord in a scene: its sagitta, in two directions
        parts = math.ceil(math.sqrt(max(turn**2 / 8.0, abs(turn * change) / 4.0) / CURVED))
        parts = max(parts, 1) if after[0] > row[0] else 1
        for k in range(1, parts):
            made.append([a + (b - a) * k / parts for a, b in zip(row, after, strict=True)])
        made.append(after)
    if len(made) > len(rows):
        sea.otherwise["CurrentRotation"] = (
            f"{len(made) - len(rows)} points are added to the profile, because OrcaFlex interpolates the "
            "direction over depth, but a scene the components of the velocity"
        )
    return made


def wave_of(environment: Part, ramp: float | None, sea: Sea) -> dict[str, Any] | None:
    """Return the wave or sea, which grows over a ramp (s); None without one.

    Raises InputError when a scene cannot describe it.
    """
    trains = environment.parts("WaveTrains")
    if not trains:
        return None
    train = trains[0]
    kind = train.text("WaveType")
    if len(trains) > 1 or kind not in (*AIRY, *STEEP, *SPECTRA):
        found = f"the model has {len(trains)} wave trains, the first of the type {kind}"
        allowed = f"give one wave train of a type from {', '.join((AIRY[0], *STEEP, *SPECTRA))}"
        raise train.refused("WaveType", found, allowed)
    if kind in SPECTRA:
        wave = _spectrum(train, kind)
    elif not train.number("WaveHeight"):
        return None
    else:
        period = train.number("WavePeriod")
        wave = {"height": q(train.number("WaveHeight"), "m"), "period": q(period, "s")}
        if ramp and period > 0.0 and min(ramp % period, -ramp % period) > 1e-6 * period:
            train.otherwise["WavePeriod"] = (
                "a crest is at the origin at t = 0 of the scene, when the build-up begins, not when it "
                f"ends: the wave is {360.0 * (ramp % period) / period:.0f}° earlier than in the deck"
            )
    if kind in STEEP:
        _made_linear(train, kind, sea)
        wave["above_mean_level"] = "stretched"
    else:
        method = environment.text("KinematicStretchingMethod")
        if method not in STRETCHING:
            allowed = f"use one of {', '.join(STRETCHING)}"
            found = f"the import cannot convert the method {method}"
            raise environment.refused("KinematicStretchingMethod", found, allowed)
        wave["above_mean_level"] = STRETCHING[method]
    towards = train.number("WaveDirection")
    wave |= {"heading": q(towards, "deg")} if towards else {}
    return wave | ({"ramp": q(ramp, "s")} if ramp else {})


def _made_linear(train: Part, kind: str, sea: Sea) -> None:
    """Report the harmonics that an Airy wave lacks; refuse a wave whose second harmonic is large."""
    amplitude, period = 0.5 * train.number("WaveHeight"), train.number("WavePeriod")
    if not (period > 0.0 and sea.surface > sea.seabed):
        allowed = "give a wave period and a water depth above 0"
        raise train.refused("WavePeriod", f"the wave period is {period:g} s", allowed)
    second = second_harmonic(amplitude, period, sea.surface - sea.seabed, sea.gravity)
    if second > SMALL:
        found = f"the {kind} wave has a second harmonic of {100.0 * second:.0f} % of its amplitude"
        allowed = (
            f"use an Airy wave, or a less steep wave with at most {100.0 * SMALL:.0f} %, since a scene has "
            "only Airy waves"
        )
        raise train.refused("WaveType", found, allowed)
    train.otherwise["WaveType"] = (
        f"{kind} is an Airy wave of the same height and period, stretched to the surface; "
        f"its second harmonic, {100.0 * second:.1f} % of the amplitude, and those above are left out"
    )


def second_harmonic(amplitude: float, period: float, depth: float, gravity: float) -> float:
    """Return the amplitude of Stokes' second harmonic, as a share (1) of the first.

    Parameters
    ----------
    amplitude, period : of the wave (m, s).
    depth, gravity : of the water (m, m/s2).
    """
    k = wave_number(2.0 * math.pi / period, depth, gravity)
    kd = min(k * depth, 20.0)  # above 20 the result does not change
    steep = math.cosh(kd) * (2.0 + math.cosh(2.0 * kd)) / math.sinh(kd) ** 3
    return 0.25 * k * amplitude * steep


def _spectrum(train: Part, kind: str) -> dict[str, Any]:
    """Return a sea with the same height, period and shape of its spectrum, but another record."""
    if kind == "JONSWAP":
        train.demand("WaveJONSWAPParameters", "Partially specified")
    if train.optional("WaveNumberOfSpectralDirections") not in (None, 1):
        found = f"the sea has {train.optional('WaveNumberOfSpectralDirections')} directions"
        allowed = "write 1, since all waves of a scene have one direction"
        raise train.refused("WaveNumberOfSpectralDirections", found, allowed)
    enhancement = train.number("WaveGamma") if kind == "JONSWAP" else 1.0
    peak: Any = train.optional("WaveTp")
    crossing = train.optional("WaveTz")
    if peak is not None:
        peak = q(train.number("WaveTp"), "s")
        _check_crossing(train, enhancement)
    elif crossing is not None:
        period = train.number("WaveTz") * peak_over_zero_crossing(enhancement)
        peak = {"derived": q(period, "s"), "from": "WaveTz and the moments of the spectrum"}
    else:
        allowed = "write one of them into the model"
        raise train.refused("WaveTp", "WaveTp and WaveTz are missing", allowed)
    wave: dict[str, Any] = {
        "significant_height": q(train.number("WaveHs"), "m"),
        "peak_period": peak,
        "peak_enhancement": enhancement,
        "components": train.whole("WaveNumberOfComponents"),
        "seed": abs(train.whole("WaveSeed")),
    }
    reason = "the sea record differs: the random phases and the components are generated differently"
    train.otherwise["WaveSeed"] = reason
    return wave


def _check_crossing(train: Part, enhancement: float) -> None:
    """Refuse a zero-crossing period that is not that of the peak period. A deck may give both."""
    if train.optional("WaveTz") is None:
        return
    period = train.number("WaveTz") * peak_over_zero_crossing(enhancement)
    if abs(period - train.number("WaveTp")) > SAME * period:
        found = f"{train.number('WaveTz'):g} s means a peak period of {period:.4g} s, but WaveTp is "
        found += f"{train.number('WaveTp'):g} s"
        allowed = "remove one of the two"
        raise train.refused("WaveTz", found, allowed)


def peak_over_zero_crossing(enhancement: float) -> float:
    """Return peak period over zero-crossing period of a JONSWAP spectrum (1): the root of m2 / m0."""
    import numpy as np
    from wavespectra.construct.frequency import jonswap

    w = np.geomspace(0.2, 200.0, 400_001)
    density = np.asarray(jonswap(w, 1.0, gamma=enhancement))
    zeroth, second = (float(np.trapezoid(density * w**n, w)) for n in (0, 2))
    return math.sqrt(second / zeroth)
