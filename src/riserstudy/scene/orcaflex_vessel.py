"""A vessel of a deck as the platform of a scene: response amplitude operators with their conventions."""

from __future__ import annotations

from typing import Any

from riserstudy.scene.orcaflex_deck import Part
from riserstudy.scene.rao import MOTIONS

TABLE = ", ".join(
    ["RAOPeriodOrFrequency"]
    + [f"RAO{name.capitalize()}{what}" for name in MOTIONS for what in ("Amp", "Phase")]
)
BY = {
    "period (s)": ("period", "s"),
    "frequency (rad/s)": ("frequency", "rad/s"),
    "frequency (Hz)": ("frequency", "Hz"),
}
#: which way each motion is positive in a scene: x ahead, y to port, z up, turns by the right hand
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
FROM = {"crest": 0.0, "trough": 180.0}  # codespell:ignore trough


def platform_of(deck: Part, vessel: Part, ramp: float | None, waves: bool) -> dict[str, Any]:
    """The platform: at rest without waves, else by the operators of its type.

    Parameters
    ----------
    ramp : time over which motion grows (s).
    waves : whether the deck has any.
    """
    height = float(vessel.values("InitialPosition", 3)[2])
    if not waves:
        return {"position": {"surge": "0 m"}}
    if heading := vessel.number("InitialHeading"):
        raise vessel.refused("InitialHeading", f"{heading:g}", "allowed is 0: the bow along x")
    kinds = {kind.text("Name"): kind for kind in deck.parts("VesselTypes")}
    name = vessel.text("VesselType")
    if name not in kinds:
        raise vessel.refused("VesselType", name, f"allowed are {', '.join(kinds)}")
    kind = kinds[name]
    draughts = {one.text("Name"): one for one in kind.parts("Draughts")}
    draught = vessel.text("Draught")
    if draught not in draughts:
        raise vessel.refused("Draught", draught, f"allowed are {', '.join(draughts)}")
    table = draughts[draught].part("DisplacementRAOs")
    origin = [float(v) for v in table.values("RAOOrigin", 3)]
    phase_origin = [v for v in table.values("PhaseOrigin", 3) if v not in (None, "~")]
    if origin[0] or origin[1] or any(float(v) for v in phase_origin[:2]):
        raise table.refused(
            "RAOOrigin", f"{origin}", "allowed is above the lower end, phases there too"
        )
    response = _response(kind, table) | ({"ramp": f"{ramp:.10g} s"} if ramp else {})
    return {
        "centre_of_rotation": {"elevation": f"{height + origin[2]:.10g} m"},
        "response": response,
    }


def _response(kind: Part, table: Part) -> dict[str, Any]:
    """Operators in the conventions of scenes, whatever those of the deck."""
    kind.demand("RAOWaveUnit", "amplitude")
    by = _choice(kind, "WavesReferredToBy", BY)
    turns = _choice(kind, "RAOResponseUnits", ANGLES)
    phases = _choice(kind, "RAOPhaseUnitsConvention", ANGLES)
    half = 180.0 if phases == "deg" else 3.141592653589793
    later = _choice(kind, "RAOPhaseRelativeToConvention", FROM) / 180.0 * half
    lead = _choice(kind, "RAOPhaseConvention", {"leads": "lead", "lags": "lag"})
    flipped = {}
    for motion, (key, along, against) in POSITIVE.items():
        flipped[motion] = _choice(kind, key, {along: 0.0, against: half})
    operators = []
    for one in table.parts("RAOs"):
        heading = one.number("RAODirection")
        for row in one.rows(TABLE, 13):
            period = row[0]
            if period in ("Infinity", 0):
                raise one.refused(
                    TABLE, f"a row at {period}", "allowed are waves of some length; take it out"
                )
            operator: dict[str, Any] = {
                "heading": f"{heading:.10g} deg",
                by[0]: f"{period} {by[1]}",
            }
            for k, motion in enumerate(MOTIONS):
                unit = "m/m" if k < 3 else f"{turns}/m"
                phase = float(row[2 + 2 * k]) + flipped[motion] + later
                operator |= {
                    motion: f"{row[1 + 2 * k]} {unit}",
                    f"{motion}_phase": f"{phase:.10g} {phases}",
                }
            operators.append(operator)
    response: dict[str, Any] = {"operators": operators, "phases": lead, "headings": "towards"}
    symmetry = _choice(kind, "Symmetry", SYMMETRY)
    return response | ({"symmetry": symmetry} if symmetry else {})


def _choice(part: Part, key: str, of: dict[str, Any]) -> Any:
    """What one of a few words of a deck stands for."""
    entry = part.value(key)
    if entry not in of:
        raise part.refused(key, str(entry), f"allowed are {', '.join(of)}")
    return of[entry]
