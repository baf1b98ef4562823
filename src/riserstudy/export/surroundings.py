"""Water, current, waves, soil and the motion of the platform in a deck."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np

from riserstudy.export.deck import Deck
from riserstudy.export.topside import VESSEL, held
from riserstudy.model.sea import current_velocity
from riserstudy.scene.rao import MOTIONS
from riserstudy.scene.sea import RegularWave
from riserstudy.scene.soil import Matlock
from riserstudy.scene.water import Water

VERTICAL = "Vertical stretching"
STRETCHING = {"none": VERTICAL, "constant": VERTICAL, "stretched": "Wheeler stretching"}
SAME = 1e-6  # share of a wave period that counts as none
STRAIGHT = 1e-3  # largest error of a thinned current table, as a share of its greatest speed


def environment(deck: Deck, water: Water) -> dict[str, Any]:
    """Return levels, density, current and wave of a deck."""
    surface, seabed = water.surface, water.seabed
    if surface is None or seabed is None:
        name = "water.surface" if surface is None else "water.seabed"
        found = "missing, but OrcaFlex requires the elevations of water surface and seabed"
        raise deck.refused(name, found, "add this elevation to the scene")
    deck.carried |= {"water"}
    made: dict[str, Any] = {
        "WaterSurfaceZ": surface, "KinematicViscosity": 1.35e-6, "VerticalDensityVariation": "Constant",
        "Density": 1e-3 * water.density, "SeabedType": "Flat", "SeabedOrigin": [0, 0],
        "WaterDepth": surface - seabed, "SeabedSlope": 0, "SeabedNormalStiffness": 100,
        "SeabedShearStiffness": 100,
    }  # fmt: skip
    return made | _waves(deck) | _current(deck, surface)


def _current(deck: Deck, surface: float) -> dict[str, Any]:
    flow = deck.scene.current
    if flow is None:
        return {"RefCurrentSpeed": 0}
    deck.carried |= {f"current.{name}" for name in ("profile", "heading", "headings", "beyond")}
    z, velocity = current_velocity(flow, deck.scene.water)
    if z[-1] > surface:
        z, velocity = _below(surface, z, velocity)
        deck.otherwise["current.profile"] = "above the water surface, OrcaFlex has the current at the surface"
    given, keep = len(z), _needed(z, velocity)
    z, velocity = z[keep][::-1], velocity[:, keep][:, ::-1]
    reference = flow.towards if not flow.turns else 0.0
    along = np.array([math.cos(reference), math.sin(reference)])
    if flow.turns:
        z, factor, turn = _turning_points(z, velocity)
        turn = np.degrees(turn)
    else:
        factor, turn = along @ velocity, np.zeros(len(z))
    if len(z) != given:
        deck.otherwise.setdefault(
            "current.profile",
            f"a table of {len(z)} points, with errors of at most {100.0 * STRAIGHT:g} % of the largest speed",
        )
    rows = [[float(surface - level), float(f), float(t)] for level, f, t in zip(z, factor, turn, strict=True)]
    return {
        "CurrentModel": "Variation scheme", "CurrentRamped": flow.ramp is not None,
        "VerticalCurrentVariationMethod": "Interpolated", "RefCurrentSpeed": 1,
        "RefCurrentDirection": math.degrees(reference),
        "CurrentDepth, CurrentFactor, CurrentRotation": rows,
    }  # fmt: skip


def _below(surface: float, z: np.ndarray, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the table of a current up to the surface: elevations (m), (k,), and velocities (m/s), (2, k).

    A deck counts depths from the surface (m) down, so its table cannot begin above the surface.
    """
    inside = int(np.searchsorted(z, surface, side="right"))
    if inside and z[inside - 1] == surface:
        return z[:inside], velocity[:, :inside]
    top = [[np.interp(surface, z, part)] for part in velocity]
    return np.append(z[:inside], surface), np.hstack([velocity[:, :inside], top])


def _turning_points(z: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """Return elevations (m), speeds (m/s) and directions (rad) of a current, (3, k).

    The table has the points that interpolation of speed and direction needs: interpolated so, the velocity
    has an error of at most a share ``STRAIGHT`` of the greatest speed. Water at rest has the direction of the
    point below.
    """
    allowed = STRAIGHT * float(np.hypot(*velocity).max())
    rest = [(float(a), complex(u, v)) for a, u, v in zip(z, *velocity, strict=True)][::-1]
    low, v = rest.pop()
    made = [(low, abs(v), cmath.phase(next((w for _, w in [(low, v), *rest[::-1]] if w), 1.0)))]
    while rest:
        (low, slow, angle), (high, w) = made[-1], rest[-1]
        turned = angle + (cmath.phase(w * cmath.exp(-1j * angle)) if w else 0.0)
        between = cmath.rect(0.5 * (slow + abs(w)), 0.5 * (angle + turned))
        straight = 0.5 * (cmath.rect(slow, angle) + w)
        if low != high and abs(between - straight) > allowed:
            rest.append((0.5 * (low + high), straight))
        else:
            rest.pop()
            made.append((high, abs(w), turned))
    return np.array(made).T


def _needed(z: np.ndarray, velocity: np.ndarray) -> list[int]:
    """Return the points of a table that linear interpolation needs, within a share of its greatest speed."""
    if len(z) < 100:
        return list(range(len(z)))
    allowed = STRAIGHT * float(np.abs(velocity).max())
    keep, rest = [0, len(z) - 1], [(0, len(z) - 1)]
    while rest:
        low, high = rest.pop()
        inner = np.arange(low + 1, high)
        if not len(inner):
            continue
        straight = [np.interp(z[inner], z[[low, high]], part[[low, high]]) for part in velocity]
        off = np.abs(velocity[:, inner] - straight).max(axis=0)
        worst = int(np.argmax(off))
        if off[worst] > allowed:
            keep.append(int(inner[worst]))
            rest += [(low, int(inner[worst])), (int(inner[worst]), high)]
    return sorted(keep)


def _waves(deck: Deck) -> dict[str, Any]:
    wave = deck.scene.wave
    if wave is None:
        calm = {"Name": "Wave1", "WaveType": "Airy", "WaveDirection": 0, "WaveHeight": 0, "WavePeriod": 10}
        return {"KinematicStretchingMethod": VERTICAL, "WaveTrains": [calm]}
    deck.carried |= {f"wave.{n}" for n in ("heading", "above_mean_level", "height", "amplitude", "period")}
    if wave.above_mean_level == "none":
        deck.otherwise["wave.above_mean_level"] = (
            f"{VERTICAL}, since every method of OrcaFlex has velocities above the mean level"
        )
    train: dict[str, Any] = {"Name": "Wave1", "WaveDirection": math.degrees(wave.heading or 0.0)}
    if isinstance(wave, RegularWave):
        height = wave.wave_height
        train = {**train, "WaveType": "Airy", "WaveHeight": height, "WavePeriod": wave.period}
    else:
        deck.carried |= {f"wave.{n}" for n in ("significant_height", "peak_period", "peak_enhancement")}
        deck.carried |= {"wave.components", "wave.seed"}
        deck.otherwise["wave.seed"] = "the sea record differs, because OrcaFlex generates other random phases"
        train |= {
            "WaveType": "JONSWAP", "WaveJONSWAPParameters": "Partially specified",
            "WaveHs": wave.significant_height, "WaveTp": wave.peak_period,
            "WaveGamma": wave.peak_enhancement, "WaveNumberOfSpectralDirections": 1,
            "WaveNumberOfComponents": wave.components, "WaveSeed": wave.seed,
        }  # fmt: skip
    return {"KinematicStretchingMethod": STRETCHING[wave.above_mean_level], "WaveTrains": [train]}


def stages(deck: Deck) -> dict[str, Any]:
    """Return the general data: durations of the build-up stage and the next one; none in statics."""
    scene, a = deck.scene, deck.scene.analysis
    made: dict[str, Any] = {"UnitsSystem": "SI"}
    deck.carried |= {"gravity", "analysis.duration", "analysis.output.interval"}
    if a.duration is None:
        return made
    response = scene.platform and scene.platform.response
    cruise = scene.platform and scene.platform.cruise
    ramps = {
        path: ending.ramp
        for path, ending in (
            ("wave.ramp", scene.wave), ("platform.response.ramp", response), ("platform.cruise.ramp", cruise),
        )
        if ending
    }  # fmt: skip
    longest = max((ramp for ramp in ramps.values() if ramp), default=0.0)
    first = min(longest or 0.1 * a.duration, a.duration)
    for path, ramp in ramps.items():
        deck.carried.add(path)
        if ramp != first:
            reason = "none" if ramp is None else f"{ramp:g} s"
            deck.otherwise[path] = f"{reason}; the OrcaFlex model builds up over its first stage, {first:g} s"
    wave = scene.wave
    if isinstance(wave, RegularWave) and min(first % wave.period, -first % wave.period) > SAME * wave.period:
        deck.otherwise["wave.period"] = (
            "in OrcaFlex a crest is at the origin when the build-up ends, not at its start: the wave of the "
            f"deck is {360.0 * (first % wave.period) / wave.period:.0f}° later"
        )
    made["StageDuration"] = [first, a.duration - first] if a.duration > first else [first]
    every = a.output.interval if a.output else 0.1
    return made | {"TargetLogSampleInterval": every, "ImplicitConstantTimeStep": a.step or 0.1}


def vessel(deck: Deck) -> None:
    """Write the vessel with which the upper end moves, with its operators and its speed."""
    platform = deck.scene.platform
    if held(deck) != VESSEL:
        return
    place = platform and platform.position
    at = [(place.surge or 0.0), (place.sway or 0.0), (place.heave or 0.0)] if place else [0, 0, 0]
    deck.carried |= {f"platform.position.{name}" for name in ("surge", "sway", "heave")}
    turned = place and [getattr(place, name) for name in ("roll", "pitch", "yaw")]
    response, cruise = (platform.response, platform.cruise) if platform else (None, None)
    entry: dict[str, Any] = {
        "Name": VESSEL, "VesselType": "Vessel type", "Draught": "Draught", "Length": None,
        "Connection": "Free",
        "InitialPosition": at, "Orientation": [0, 0, 0], "IncludedInStatics": "None",
        "PrimaryMotion": "Prescribed" if cruise else "None",
        "SuperimposedMotion": "RAOs + harmonics" if response else "None",
    }  # fmt: skip
    if response and deck.scene.wave is None:
        deck.otherwise["platform.response.wave"] = (
            "the operators are written, but not the wave, because it moves only the platform: the sea is calm"
        )
        deck.otherwise["platform.centre_of_rotation"] = "written as the origin of these operators"
    if turned and any(turned):
        deck.otherwise["platform.position"] = "roll, pitch and yaw are left out"
    if cruise:
        deck.carried |= {"platform.cruise.speed", "platform.cruise.heading"}
        heading = math.degrees(cruise.heading or 0.0)
        modes = ["Speed change", "Constant speed"]
        entry[
            "PrescribedMotionMode, PrescribedMotionSpeedValue, PrescribedMotionDirectionRelativeTo, "
            "PrescribedMotionDirectionValue, PrescribedMotionRateOfTurn"
        ] = [[mode, cruise.speed, "Vessel heading", heading, 0] for mode in modes]
    deck.add("Vessels", entry)
    deck.add("VesselTypes", _vessel_type(deck))


def _vessel_type(deck: Deck) -> dict[str, Any]:
    platform = deck.scene.platform
    response = platform.response if platform else None
    centre = platform.centre_of_rotation if platform else None
    made: dict[str, Any] = {
        "Name": "Vessel type", "Length": 100, "RAOResponseUnits": "radians", "RAOWaveUnit": "amplitude",
        "WavesReferredToBy": "frequency (rad/s)", "RAOPhaseConvention": "lags",
        "RAOPhaseUnitsConvention": "radians", "RAOPhaseRelativeToConvention": "crest",
        "SurgePositive": "forward", "SwayPositive": "port", "HeavePositive": "up",
        "RollPositiveStarboard": "down", "PitchPositiveBow": "down", "YawPositiveBow": "port",
        "Symmetry": "None",
    }  # fmt: skip
    tables: list[dict[str, Any]] = []
    origin = [0.0, 0.0, 0.0]
    if response:
        deck.carried |= {f"platform.response.{n}" for n in ("operators", "phases", "headings", "symmetry")}
        deck.carried |= {"platform.response.motions", "platform.centre_of_rotation"}
        made["RAOPhaseConvention"] = "leads" if response.phases == "lead" else "lags"
        origin = [centre.x or 0.0, centre.y or 0.0, centre.elevation] if centre else origin
        names = ["RAOPeriodOrFrequency"]
        names += [f"RAO{name.capitalize()}{ending}" for name in MOTIONS for ending in ("Amp", "Phase")]
        tables = [
            {
                "RAODirection": math.degrees(heading or 0.0),
                ", ".join(names): [_operator(row, response.moving) for row in rows],
            }
            for heading, rows in response.by_heading.items()
        ]
        if None in response.by_heading:
            deck.otherwise["platform.response.operators"] = "written as operators for waves along x"
    if not tables:
        still = [[w, *[0.0] * 12] for w in (0.1, 10.0)]
        names = ["RAOPeriodOrFrequency"]
        names += [f"RAO{name.capitalize()}{ending}" for name in MOTIONS for ending in ("Amp", "Phase")]
        tables = [{"RAODirection": 0, ", ".join(names): still}]
    place = [deck.scene.top.offset or 0.0, 0.0]  # the phases of a scene refer to it
    crest = [None, None, None] if origin[:2] == place else [*place, None]
    raos = {"RAOOrigin": origin, "PhaseOrigin": crest, "RAOs": tables}
    return made | {"Draughts": [{"Name": "Draught", "DisplacementRAOs": raos}]}


def _operator(row: Any, moving: list[str]) -> list[float]:
    cells = [row.circular]
    for name in MOTIONS:
        given = name in moving
        cells += [getattr(row, name) or 0.0, getattr(row, f"{name}_phase") or 0.0] if given else [0.0, 0.0]
    return cells


def soil(deck: Deck) -> str | None:
    """Write the soil; return the name of its model, None without soil.

    Raises InputError when such a deck cannot describe the soil.
    """
    ground = deck.scene.soil
    if ground is None:
        return None
    clay = ground.resistance
    if not isinstance(clay, Matlock) or clay.strength_gradient:
        found = "only soft clay with the same strength at all depths can be exported to OrcaFlex"
        allowed = "remove 'soil:' from the scene and write P-yModels into the OrcaFlex model by hand"
        raise deck.refused("soil.resistance", found, allowed)
    if ground.damping and ground.damping.ratio:
        allowed = "remove soil.damping from the scene"
        raise deck.refused("soil.damping", "damping of the soil cannot be exported to OrcaFlex", allowed)
    if deck.scene.water and deck.scene.water.seabed != ground.mudline:
        deck.otherwise["soil.mudline"] = "replaced by the seabed"
    deck.carried |= {"soil"}
    deck.otherwise["soil.resistance.straight_up_to"] = (
        "not written: OrcaFlex defines the start of the p-y curve itself"
    )
    curve = {
        "DepthBelowSeabedFrom": 0, "ModelType": "API RP 2A soft clay",
        "EffectiveUnitSoilDensity": 1e-3 * clay.submerged_unit_weight / 9.80665,
        "UndrainedShearStrength": 1e-3 * clay.strength_at_mudline, "J": clay.depth_factor,
        "Epsilonc": 100.0 * clay.strain_at_half_strength,
    }  # fmt: skip
    deck.add("P-yModels", {"Name": "Clay", "PyCurves": [curve]})
    return "Clay"
