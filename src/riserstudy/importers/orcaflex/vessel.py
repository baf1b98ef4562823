"""A vessel of a deck as the platform of a scene: response amplitude operators (RAOs), with conventions."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any, NamedTuple

from riserstudy.importers.orcaflex.deck import EMPTY, Part, q
from riserstudy.importers.orcaflex.sea import Sea
from riserstudy.model.sea import wave_number
from riserstudy.scene.rao import MOTIONS

TABLE = (
    "RAOPeriodOrFrequency",
    *(f"RAO{name.capitalize()}{part}" for name in MOTIONS for part in ("Amp", "Phase")),
)
BY = {
    "period (s)": ("period", "s"),
    "frequency (rad/s)": ("frequency", "rad/s"),
    "frequency (Hz)": ("frequency", "Hz"),
}
#: positive direction of each motion in a scene: x ahead, y to port, z up, rotations right-handed
POSITIVE = {
    "surge": ("SurgePositive", "forward", "aft"),
    "sway": ("SwayPositive", "port", "starboard"),
    "heave": ("HeavePositive", "up", "down"),
    "roll": ("RollPositiveStarboard", "down", "up"),
    "pitch": ("PitchPositiveBow", "down", "up"),
    "yaw": ("YawPositiveBow", "port", "starboard"),
}
SYMMETRY = {"None": None, "xz plane": "sides", "xz and yz planes": "sides and ends"}
ANGLES = {"degrees": "deg", "radians": "rad"}
#: lag of each moment in a wave behind its crest (deg)
FROM = {"crest": 0.0, "zero down-crossing": 90.0, "trough": 180.0}  # codespell:ignore trough
FROM["zero up-crossing"] = 270.0
TURN = 2.0 * math.pi
WAY = "RAODirection"
SAME = 1e-4  # largest difference of directions that count as equal (deg)
CLOSE = 1e-6  # largest relative difference of periods or frequencies that count as equal


#: columns of a motion that is given for each stage
STAGES = (
    "PrescribedMotionMode",
    "PrescribedMotionSpeedValue",
    "PrescribedMotionDirectionRelativeTo",
    "PrescribedMotionDirectionValue",
    "PrescribedMotionRateOfTurn",
)


class Crest(NamedTuple):
    """Distance between the places of the vessel to which the phases of a scene and of a deck refer (m)."""

    table: Part
    x: float
    y: float
    sea: Sea

    def lead(self, heading: float, frequency: float) -> float:
        """Return the phase lead (rad) due to the distance, at a heading (rad) and a frequency (rad/s)."""
        along = self.x * math.cos(heading) + self.y * math.sin(heading)
        depth = self.sea.surface - self.sea.seabed
        return along * wave_number(frequency, depth, self.sea.gravity) if along else 0.0

    def check(self, symmetry: str | None) -> None:
        """Refuse symmetric RAOs whose phases at mirrored headings would need another shift.

        Raises InputError when the RAOs have such a symmetry.
        """
        if (symmetry and self.y) or (symmetry == "sides and ends" and self.x):
            found = f"the origin is {-self.x:g}, {-self.y:g} m from the upper end of the riser"
            allowed = (
                "write the RAOs of all headings with Symmetry: None, since mirrored RAOs are not symmetric "
                "at the upper end of the riser"
            )
            self.table.note(self.table.refused("PhaseOrigin", found, allowed))


def platform_of(
    deck: Part, vessel: Part, stages: list[float], sea: Sea | None, offset: float
) -> dict[str, Any]:
    """Return the platform: at rest without waves, else with the RAOs of its type; and its cruise.

    Parameters
    ----------
    stages : durations of the stages (s), the first of which is the build-up; empty in statics.
    sea : the water, if the deck has waves.
    offset : x of the riser's upper end on the vessel (m), to which the phases of a scene refer.
    """
    x, y, height = vessel.vector("InitialPosition")
    platform: dict[str, Any] = {}
    if x or y:
        platform["position"] = {"surge": q(x, "m"), "sway": q(y, "m")}
        platform["position"] = {k: v for k, v in platform["position"].items() if v != "0 m"}
    with deck.noting():
        if cruise := _cruise(vessel, stages):
            platform["cruise"] = cruise
    moves = _answers(vessel)
    if (moves and sea) or any(vessel.data.get(key) not in EMPTY for key in ("Orientation", "InitialHeading")):
        with deck.noting():
            _bow_along_x(vessel)
    with deck.noting():
        if moves and sea:
            origin, response = _operators(deck, vessel, sea, offset)
            if response:
                aside = {name: q(at, "m") for name, at in zip("xy", origin, strict=False) if at}
                centre = aside | {"elevation": q(height + origin[2], "m")}
                ramp = {"ramp": q(stages[0], "s")} if stages else {}
                platform |= {"centre_of_rotation": centre, "response": response | ramp}
    return platform


def _answers(vessel: Part) -> bool:
    """Return whether a vessel moves by displacement RAOs; in earlier versions: if it has no other motion.

    Another superimposed motion is recorded as an error.
    """
    reported = vessel.optional("SuperimposedMotion")
    motion = vessel.optional("PrimaryMotion")
    if motion not in (None, "None", "Prescribed"):
        found = f"the import cannot convert the motion {motion}"
        vessel.note(vessel.refused("PrimaryMotion", found, "write None or Prescribed"))
    if reported is not None and str(reported) != "None" and "RAO" not in str(reported):
        found = f"the import cannot convert the motion {reported}"
        vessel.note(vessel.refused("SuperimposedMotion", found, "use None or displacement RAOs"))
    if "harmonic" in str(reported):
        for key in vessel.data:
            if str(key).startswith("HarmonicMotion"):
                vessel.idle(str(key))
    return reported is None or "RAO" in str(reported)


def _bow_along_x(vessel: Part) -> None:
    """Check that the vessel is upright and along x."""
    if "Orientation" in vessel.data:
        turned = list(vessel.vector("Orientation"))
        key = "Orientation"
    else:
        turned = [vessel.number("InitialHeading")]
        key = "InitialHeading"
    if any(turned):
        found = ", ".join(f"{angle:g}" for angle in turned)
        allowed = "turn the model to 0, since a scene has the bow along x and an even keel"
        vessel.note(vessel.refused(key, found, allowed))


def _cruise(vessel: Part, stages: list[float]) -> dict[str, Any] | None:
    """Return the cruise of a vessel: from rest to a speed in the first stage, or at a constant speed."""
    if vessel.optional("PrimaryMotion") != "Prescribed" or not stages or not vessel.has(*STAGES):
        return None
    rows = vessel.table(*STAGES)
    figures = vessel.figures(STAGES[1], STAGES[3], of=STAGES[4:], idle=STAGES)
    speed, ramp = 0.0, None
    for k, (value, _, turn) in enumerate(figures):
        mode = rows[k][0]
        changes = mode == "Speed change"
        if turn or (k and ((changes and value) or (not changes and value != speed))):
            found = f"in stage {k}, the motion is {mode} {value}, turning {turn}"
            allowed = "give one speed from the first stage on, without turning"
            raise vessel.refused(STAGES[0], found, allowed)
        speed = value if k == 0 else speed
        ramp = stages[0] if k == 0 and changes else ramp
    if not speed:
        return None
    headings = sorted({angle for _, angle, _ in figures})
    if len(headings) > 1:
        found = f"the vessel moves in the directions {', '.join(f'{angle:g}' for angle in headings)}"
        raise vessel.refused(STAGES[3], found, "give one direction for all stages")
    heading = headings[0]
    cruise = {"speed": q(speed, "m/s")} | ({"ramp": q(ramp, "s")} if ramp else {})
    return cruise | ({"heading": q(heading, "deg")} if heading else {})


def _operators(
    deck: Part, vessel: Part, sea: Sea, offset: float
) -> tuple[list[float], dict[str, Any] | None]:
    """Return the origin of a vessel's RAOs (m), and the response that they describe, if there is any."""
    kinds = deck.named("VesselTypes")
    name = vessel.text("VesselType")
    if name not in kinds:
        allowed = f"use one of {', '.join(kinds)}"
        raise vessel.refused("VesselType", f"the model has no vessel type {name!r}", allowed)
    length = vessel.optional("Length")
    if length not in (None, kinds[name].data.get("Length")):
        found = f"{length} is not the length of the vessel type, so OrcaFlex scales its RAOs"
        vessel.note(vessel.refused("Length", found, "write ~, and give a vessel type of this length"))
    draughts = {one.name: one for one in kinds[name].parts("Draughts")}
    draught = vessel.text("Draught")
    if draught not in draughts:
        allowed = f"use one of {', '.join(draughts)}"
        raise vessel.refused("Draught", f"the vessel type has no draught {draught!r}", allowed)
    table = draughts[draught].part("DisplacementRAOs")
    origin = list(table.vector("RAOOrigin"))
    x, y = _phase_origin(table, origin)
    crest = Crest(table, offset - x, -y, sea)
    return origin, _response(kinds[name], table, crest)


def _phase_origin(table: Part, origin: list[float]) -> tuple[float, float]:
    """Return the phase origin of a vessel (m); an empty coordinate equals that of the RAO origin."""
    given = table.optional("PhaseOrigin") or []
    numbers = table.numbers("PhaseOrigin")
    empty = [k >= len(given) or given[k] in EMPTY for k in range(2)]
    x, y = (origin[k] if empty[k] else numbers[k] for k in range(2))
    return x, y


def _response(kind: Part, table: Part, crest: Crest) -> dict[str, Any] | None:
    """Return the RAOs in the conventions of scenes, from the conventions of the deck.

    Motions that are zero in all waves are left out, because they would make a riser in a plane one in space.
    """
    kind.demand("RAOWaveUnit", "amplitude")
    by = _choice(kind, "WavesReferredToBy", BY)
    turns = _choice(kind, "RAOResponseUnits", ANGLES)
    phases = _choice(kind, "RAOPhaseUnitsConvention", ANGLES)
    half = 180.0 if phases == "deg" else 3.141592653589793
    lead = _choice(kind, "RAOPhaseConvention", {"leads": "lead", "lags": "lag"})
    sign = (1.0 if lead == "lead" else -1.0) * half / math.pi
    since = -sign * math.radians(_choice(kind, "RAOPhaseRelativeToConvention", FROM))
    symmetry = _choice(kind, "Symmetry", SYMMETRY)
    crest.check(symmetry)
    flipped = {}
    for motion, (key, along, against) in POSITIVE.items():
        flipped[motion] = _choice(kind, key, {along: 0.0, against: half})
    operators = []
    tables = _even({one: one.figures(*TABLE, endless=TABLE[0]) for one in table.parts("RAOs")})
    moving = [k for k in range(len(MOTIONS)) if any(row[1 + 2 * k] for of in tables.values() for row in of)]
    for one, rows in tables.items():
        heading = one.number(WAY)
        for row in rows:
            period = row[0]
            if not 0.0 < period < math.inf:
                one.otherwise[TABLE[0]] = f"its row at {period:g} is left out: no wave has this period"
                continue
            circular = TURN / period if by[1] == "s" else period * (TURN if by[1] == "Hz" else 1.0)
            later = since + sign * crest.lead(math.radians(heading), circular)
            operator: dict[str, Any] = {"heading": q(heading, "deg"), by[0]: q(period, by[1])}
            for k in moving:
                motion, unit = MOTIONS[k], "m/m" if k < 3 else f"{turns}/m"
                phase = row[2 + 2 * k] + flipped[motion] + later
                operator |= {motion: q(row[1 + 2 * k], unit), f"{motion}_phase": q(phase, phases)}
            operators.append(operator)
    if not moving:
        return None
    response: dict[str, Any] = {"operators": operators, "phases": lead, "headings": "towards"}
    return response | ({"symmetry": symmetry} if symmetry else {})


def _even(tables: dict[Part, list[list[float]]]) -> dict[Part, list[list[float]]]:
    """Return tables of RAOs by direction, without a direction that repeats another after a full turn.

    Raises InputError when tables of one direction differ, amplitudes are negative, or waves are not the same.
    """
    kept: dict[Part, list[list[float]]] = {}
    for one, rows in tables.items():
        for row in rows:
            if low := next((k for k in range(1, len(TABLE), 2) if row[k] < 0.0), 0):
                allowed = "write the amplitude without its sign, and add half a turn to the phase"
                raise one.refused(TABLE[low], f"the amplitude is {row[low]:g}", allowed)
        waves, first = (_waves(of) for of in (rows, next(iter(tables.values()))))
        if any(math.isclose(a, b, rel_tol=CLOSE) for a, b in pairwise(waves)):
            raise one.refused(TABLE[0], "a wave occurs twice", "give each wave once")
        same = len(waves) == len(first)
        if not (same and all(math.isclose(a, b, rel_tol=CLOSE) for a, b in zip(waves, first, strict=True))):
            found = f"the waves are {', '.join(f'{wave:g}' for wave in waves)}"
            allowed = f"give those of the first direction, {', '.join(f'{wave:g}' for wave in first)}"
            raise one.refused(TABLE[0], found, allowed)
        apart = [math.remainder(one.number(WAY) - other.number(WAY), 360.0) for other in kept]
        twin = next((other for other, turn in zip(kept, apart, strict=True) if abs(turn) < SAME), None)
        if twin is None:
            kept[one] = rows
        elif sorted(kept[twin]) == sorted(rows):
            one.apart = f"its direction is {twin.number(WAY):g} deg, too, with the same RAOs"
        else:
            found = f"its direction is {twin.number(WAY):g} deg, too, but its RAOs differ"
            raise one.refused(WAY, found, "delete one of the two")
    return kept


def _waves(rows: list[list[float]]) -> list[float]:
    """Return the periods or frequencies of the waves of a table, in rising order."""
    return sorted(row[0] for row in rows if 0.0 < row[0] < math.inf)


def _choice(part: Part, key: str, of: dict[str, Any]) -> Any:
    """Return the meaning of a keyword; an unknown keyword is recorded as an error and read as the first."""
    with part.noting():
        entry = part.text(key)
        if entry in of:
            return of[entry]
        found = f"the import cannot convert {entry}"
        raise part.refused(key, found, f"use one of {', '.join(of)}")
    return next(iter(of.values()))
