"""A scene from an OrcaFlex text model of a vertical riser: what has a counterpart, with all else named.

Nothing is guessed: what cannot be said in a scene is refused where the riser would be another one without it,
and named as left out otherwise. Units are those of OrcaFlex's SI: tonne, kN, m, s, kN m/deg.
"""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from ruamel.yaml.error import MantissaNoDotYAML1_1Warning

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile, read_yaml
from riserstudy.scene.orcaflex_deck import Part
from riserstudy.scene.orcaflex_pipe import bending_stiffness, properties
from riserstudy.scene.orcaflex_soil import soil_of
from riserstudy.scene.orcaflex_top import (
    LINKED,
    WINCHED,
    Anchorage,
    ring_of,
    slides_in,
    tensioners,
    turns_in,
)
from riserstudy.scene.orcaflex_vessel import platform_of
from riserstudy.scene.origin import unwrap

GRAVITY = 9.80665  # m/s2, of OrcaFlex's SI
ENDS = (
    "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionAzimuth, ConnectionDeclination, "
    "ConnectionGamma, ConnectionReleaseStage, ConnectionzRelativeTo"
)
BENDING = "ConnectionxBendingStiffness, ConnectionyBendingStiffness"
SECTIONS = "LineType, Length, TargetSegmentLength"
CURRENT = "CurrentDepth, CurrentFactor, CurrentRotation"
SPECTRA = ("JONSWAP", "ISSC")  # of Pierson and Moskowitz, with any height, is the latter
STRETCHING = {"None": "none", "Vertical stretching": "constant", "Wheeler stretching": "stretched"}


class Imported(NamedTuple):
    """A scene as a plain tree, and what of the deck is not in it."""

    tree: dict[str, Any]
    left_out: list[str]


class Lines(NamedTuple):
    """The riser, what slides in its upper end, and all line types."""

    riser: Part
    barrel: Part | None
    types: dict[str, Part]


class Top(NamedTuple):
    """The upper end of a scene, and the vessel that it moves with."""

    tree: dict[str, Any]
    vessel: Part | None


class End(NamedTuple):
    """One end of the line: what it is connected to, and where (m): in the deck's axes, or the vessel's."""

    to: str
    x: float
    y: float
    z: float
    rotation: Any


def read_deck(path: Path) -> Imported:
    """Read the text model of a vertical riser.

    Raises
    ------
    InputError
        When it is no such model, or says what a scene cannot.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MantissaNoDotYAML1_1Warning)  # 250e3, as OrcaFlex writes it
        data = read_yaml(path)
    if not isinstance(data, dict) or "Lines" not in data or "LineTypes" not in data:
        allowed = "allowed is an OrcaFlex text model (.yml) with LineTypes and Lines"
        raise InputError(path, "", "no deck of a riser", allowed)
    deck = Part(data, "", path)
    general, sea = deck.part("General"), deck.part("Environment")
    general.demand("UnitsSystem", "SI")
    lines = _lines(deck)
    line = lines.riser
    surface = sea.number("WaterSurfaceZ")
    depth = sea.number("WaterDepth")
    density = 1000.0 * sea.number("Density")
    top, bottom = _on_ground(deck, line, _ends(line, surface, depth), surface - depth)
    ramp, analysis = _analysis(general)
    tree: dict[str, Any] = {
        "title": f"{line.text('Name')}, from {path.name}",
        "gravity": f"{GRAVITY} m/s^2",
        "water": {
            "density": _q(density, "kg/m^3"),
            "surface": _q(surface, "m"),
            "seabed": _q(surface - depth, "m"),
        },
        "riser": [*_sections(deck, line, density)],
        "bottom": {"hold": "wellhead", "elevation": _q(bottom.z, "m"), "rotation": bottom.rotation},
    }
    ground = soil_of(deck, line, surface - depth, GRAVITY)
    if ground:
        tree["bottom"]["hold"] = "foot"
        tree["soil"] = ground
    made = _top(deck, lines, (top, bottom), sea)
    tree["top"] = made.tree
    if current := _current(sea):
        tree["current"] = current
    wave, doubts = _wave(sea, ramp)
    if wave:
        tree["wave"] = wave
    if made.vessel:
        tree["platform"] = platform_of(deck, made.vessel, ramp if wave else None, bool(wave))
    tree["analysis"] = analysis
    SceneFile(str(path), unwrap(tree)[0]).scene()
    return Imported(tree, [*doubts, *deck.unused()])


def _q(value: float, unit: str) -> str:
    return f"{value:.10g} {unit}"


def _ends(line: Part, surface: float, depth: float) -> tuple[End, End]:
    """Upper and lower end."""
    rows, bending = line.rows(ENDS, 4), line.rows(BENDING, 1)
    if len(rows) != 2 or len(bending) != 2:
        raise line.refused(ENDS, f"{len(rows)} ends", "allowed are two, with bending stiffness")
    ends = []
    for row, stiff in zip(rows, bending, strict=True):
        to, x, y, z = str(row[0]), *(float(v) for v in row[1:4])
        z += surface - depth if to == "Anchored" else 0.0
        rotation = _rotation(line, stiff)
        leaning = [a for a in row[5:6] if a not in (0, 180, None)]
        if rotation != "free" and leaning:
            found_ = f"declination {leaning[0]} of an end that resists turning"
            raise line.refused(ENDS, found_, "allowed are 0 and 180: the end stands upright")
        ends.append(End(to, x, y, z, rotation))
    top = line.text("TopEnd")
    upper, lower = ends if top == "End A" else ends[::-1]
    return upper, lower


def _lines(deck: Part) -> Lines:
    """The riser, and the inner barrel of a telescopic joint where there is one."""
    types = {kind.text("Name"): kind for kind in deck.parts("LineTypes")}
    sliding = {one.text("Name"): one for one in deck.parts("Constraints")}
    lines = deck.parts("Lines")
    barrels = [line for line in lines if _ends(line, 0.0, 0.0)[1].to in sliding]
    barrels = [] if len(lines) < 2 else barrels
    if len(barrels) != 1 or len(lines) != 2:
        return Lines(deck.only("Lines"), None, types)
    (barrel,) = barrels
    (riser,) = (line for line in lines if line is not barrel)
    slides_in(sliding[_ends(barrel, 0.0, 0.0)[1].to], _ends(riser, 0.0, 0.0)[0].to)
    return Lines(riser, barrel, types)


def _on_ground(deck: Part, line: Part, ends: tuple[End, End], seabed: float) -> tuple[End, End]:
    """The ends, the lower of which stands on the ground, or on a constraint that is its flex joint."""
    upper, lower = ends
    joints = {one.text("Name"): one for one in deck.parts("Constraints")}
    if lower.to in joints:
        if lower.rotation != "fixed" or lower.x or lower.y or lower.z:
            allowed = "allowed is an end that is clamped to the constraint, at its origin"
            raise line.refused(BENDING, f"{lower.rotation}", allowed)
        to, z, rotation = turns_in(joints[lower.to])
        lower = End(to, 0.0, 0.0, z + (seabed if to == "Anchored" else 0.0), rotation)
    if lower.to not in ("Anchored", "Fixed"):
        allowed = "allowed are Anchored, Fixed, and a constraint that stands there"
        raise line.refused(ENDS, f"lower end on {lower.to!r}", allowed)
    return upper, lower


def _rotation(line: Part, stiff: list[Any]) -> Any:
    """What an end's bending stiffness is in a scene; both directions alike."""
    if len(stiff) > 1 and stiff[1] not in (None, "~", stiff[0]):
        raise line.refused(
            BENDING, f"{stiff[0]} and {stiff[1]}", "allowed is one for both directions"
        )
    if stiff[0] == "Infinity":
        return "fixed"
    return {"stiffness": _q(float(stiff[0]), "kN*m/deg")} if float(stiff[0]) else "free"


def _sections(deck: Part, line: Part, density: float) -> Iterator[dict[str, Any]]:
    """Sections from the lowest to the highest."""
    types = {kind.text("Name"): kind for kind in deck.parts("LineTypes")}
    rows = line.rows(SECTIONS, 2)
    contents = line.optional("ContentsDensity")
    if contents is not None:
        line.demand("ContentsMethod", "Uniform")
    names = [str(row[0]) for row in rows]
    numbered = list(enumerate(rows))
    for k, row in numbered[::-1] if line.text("TopEnd") == "End A" else numbered:
        name = names[k]
        if name not in types:
            raise line.refused(
                SECTIONS, f"no line type {name!r}", f"allowed are {', '.join(types)}"
            )
        section = properties(types[name], density, GRAVITY)
        called = name if names.count(name) == 1 else f"{name} {names[: k + 1].count(name)}"
        if contents and section["inner_diameter"] != "0 m":
            section["contents"] = {"density": _q(1000.0 * float(contents), "kg/m^3")}
        yield {"name": called, "length": _q(float(row[1]), "m"), **section}


def _top(deck: Part, lines: Lines, ends: tuple[End, End], sea: Part) -> Top:
    """The upper end: held, on a vessel, under a telescopic joint, or free on tensioners."""
    line, (top, bottom) = lines.riser, ends
    if bottom.x or bottom.y or top.y:
        allowed = "allowed is a lower end at x = y = 0, and an upper end along x"
        raise line.refused(ENDS, "ends that are aside", allowed)
    vessels = {vessel.text("Name"): vessel for vessel in deck.parts("Vessels")}
    pulling = [*deck.parts("Links"), *deck.parts("Winches")]
    rings = {ring.text("Name"): ring for ring in deck.parts("6DBuoys")}
    if top.to == "Free" or top.to in rings:
        return _pulled(lines, ends, vessels, rings, pulling, sea)
    if pulling:
        raise pulling[0].refused(
            "Name", pulling[0].text("Name"), "allowed with a free upper end alone"
        )
    held = "platform" if top.to in vessels else "held"
    if held == "held" and top.to != "Fixed":
        allowed = "allowed are Fixed, Free, a vessel and a lumped buoy that is the tension ring"
        raise line.refused(ENDS, f"upper end on {top.to!r}", allowed)
    z = top.z + (_height(vessels[top.to]) if top.to in vessels else 0.0)
    offset = {"offset": _q(top.x, "m")} if top.x else {}
    tree = {"x": held, "z": held, "elevation": _q(z, "m"), "rotation": top.rotation} | offset
    return Top(tree, vessels.get(top.to))


def _height(vessel: Part) -> float:
    """Elevation (m) of a vessel's origin, which is above the lower end."""
    x, y, height = (float(v) for v in vessel.values("InitialPosition", 3))
    if x or y:
        raise vessel.refused("InitialPosition", f"{x}, {y}", "allowed is x = y = 0")
    return height


def _pulled(
    lines: Lines,
    ends: tuple[End, End],
    vessels: dict[str, Part],
    rings: dict[str, Part],
    pulling: list[Part],
    sea: Part,
) -> Top:
    """An upper end on tensioners, with what there is of ring and telescopic joint."""
    line, (top, bottom) = lines.riser, ends
    if not pulling:
        raise line.refused(ENDS, "a free upper end", "allowed with Links or Winches that pull it")
    ring = bottom.z + sum(float(row[1]) for row in line.rows(SECTIONS, 2))
    decks = {"Fixed": 0.0} | {name: _height(vessel) for name, vessel in vessels.items()}
    rig = tensioners(pulling, Anchorage({line.text("Name"), top.to} - {"Free"}, decks, ring))
    key = LINKED if LINKED in pulling[0].data else WINCHED
    on = str(pulling[0].rows(key, 4)[0][0])
    tree: dict[str, Any] = {"x": "free", "z": "free", "rotation": top.rotation, "tensioners": rig}
    if top.to in rings:
        tree["body"] = ring_of(rings[top.to], GRAVITY, sea.number("WaterSurfaceZ"))
    if lines.barrel is not None:
        upper, _ = _ends(lines.barrel, 0.0, 0.0)
        if upper.to not in vessels:
            allowed = "allowed is that the inner barrel hangs on a vessel"
            raise lines.barrel.refused(ENDS, f"upper end on {upper.to!r}", allowed)
        on = upper.to
        elevation = upper.z + _height(vessels[on])
        joint = {"length": _q(elevation - ring, "m"), "bending_stiffness": _bending(lines)}
        tree |= {"x": "platform", "z": "platform", "elevation": _q(elevation, "m")}
        tree |= {"rotation": upper.rotation, "telescopic_joint": joint}
    return Top(tree, vessels.get(on))


def _bending(lines: Lines) -> str:
    """Bending stiffness of the inner barrel, one along it."""
    barrel = lines.barrel or lines.riser
    names = {str(row[0]) for row in barrel.rows(SECTIONS, 2)}
    stiff = {bending_stiffness(lines.types[name]) for name in names if name in lines.types}
    if len(stiff) != 1:
        allowed = "allowed is one bending stiffness of line types"
        raise barrel.refused(SECTIONS, ", ".join(sorted(names)), allowed)
    return _q(stiff.pop(), "kN*m^2")


def _current(sea: Part) -> dict[str, Any] | None:
    speed = sea.optional("RefCurrentSpeed")
    if not speed:
        return None
    towards = sea.number("RefCurrentDirection")
    sea.demand("VerticalCurrentVariationMethod", "Interpolated")
    rows = [[float(v) for v in row] for row in sea.rows(CURRENT, 3)]
    points = [
        {"depth": _q(depth, "m"), "speed": _q(float(speed) * factor, "m/s")}
        for depth, factor, _ in rows
    ]
    if any(turn for *_, turn in rows):
        for point, (*_, turn) in zip(points, rows, strict=True):
            point["direction"] = _q(towards + turn, "deg")
        return {"profile": points, "beyond": "hold"}
    return {"profile": points, "beyond": "hold"} | (
        {"heading": _q(towards, "deg")} if towards else {}
    )


def _wave(sea: Part, ramp: float | None) -> tuple[dict[str, Any] | None, list[str]]:
    """The wave or sea, and what of it is another."""
    trains = sea.parts("WaveTrains")
    if not trains:
        return None, []
    train = trains[0]
    kind = train.text("WaveType")
    if len(trains) > 1 or kind not in ("Airy", "Single Airy", *SPECTRA):
        found = f"{len(trains)} wave trains, {kind}"
        raise train.refused("WaveType", found, f"allowed is one of Airy, {', '.join(SPECTRA)}")
    if kind in SPECTRA:
        wave, doubts = _spectrum(train, kind)
    else:
        doubts = []
        if not train.number("WaveHeight"):
            return None, []
        wave = {
            "height": _q(train.number("WaveHeight"), "m"),
            "period": _q(train.number("WavePeriod"), "s"),
        }
    method = sea.text("KinematicStretchingMethod")
    if method not in STRETCHING:
        raise sea.refused(
            "KinematicStretchingMethod", method, f"allowed are {', '.join(STRETCHING)}"
        )
    wave["above_mean_level"] = STRETCHING[method]
    towards = train.number("WaveDirection")
    wave |= {"heading": _q(towards, "deg")} if towards else {}
    wave |= {"ramp": _q(ramp, "s")} if ramp else {}
    return wave, doubts


def _spectrum(train: Part, kind: str) -> tuple[dict[str, Any], list[str]]:
    """A sea by its spectrum: the same height, period and shape, but not the same record."""
    if kind == "JONSWAP":
        train.demand("WaveJONSWAPParameters", "Partially specified")
    if train.optional("WaveNumberOfSpectralDirections") not in (None, 1):
        found = str(train.optional("WaveNumberOfSpectralDirections"))
        raise train.refused("WaveNumberOfSpectralDirections", found, "allowed is 1")
    enhancement = train.number("WaveGamma") if kind == "JONSWAP" else 1.0
    peak: Any = train.optional("WaveTp")
    crossing = train.optional("WaveTz")
    if peak is not None:
        peak = _q(float(peak), "s")
    elif crossing is not None:
        period = float(crossing) * peak_over_zero_crossing(enhancement)
        peak = {"derived": _q(period, "s"), "from": "WaveTz and the moments of the spectrum"}
    else:
        raise train.refused("WaveTp", "missing, as WaveTz is", "allowed is one of them")
    wave = {
        "significant_height": _q(train.number("WaveHs"), "m"),
        "peak_period": peak,
        "peak_enhancement": enhancement,
        "components": int(train.number("WaveNumberOfComponents")),
        "seed": abs(int(train.number("WaveSeed"))),
    }
    told = "the record is another: components and their phases are drawn otherwise"
    return wave, [f"{train.path}.WaveSeed: {told}"]


def peak_over_zero_crossing(enhancement: float) -> float:
    """Peak period over zero-crossing period of a JONSWAP spectrum, a share: root of m2 / m0."""
    import numpy as np
    from wavespectra.construct.frequency import jonswap

    w = np.geomspace(0.2, 200.0, 400_001)
    density = np.asarray(jonswap(w, 1.0, gamma=enhancement))
    zeroth, second = (float(np.trapezoid(density * w**n, w)) for n in (0, 2))
    return math.sqrt(second / zeroth)


def _analysis(general: Part) -> tuple[float | None, dict[str, Any]]:
    """The ramp (s), and what is computed: statics alone without stages."""
    stages = general.optional("StageDuration")
    if not stages:
        return None, {}
    times = [float(t) for t in stages]
    every = general.number("TargetLogSampleInterval")
    return times[0], {"duration": _q(sum(times), "s"), "output": {"interval": _q(every, "s")}}


def as_text(found: Imported, deck: Path) -> str:
    """The scene as a file, with what was left out as its head."""
    from ruamel.yaml import YAML

    out = io.StringIO()
    writer = YAML()
    writer.width = 120
    writer.dump(found.tree, out)
    head = [f"# Made from {deck.name} by `riserstudy import`. Of the deck is not in it:"]
    head += [f"#   {line}" for line in found.left_out] or ["#   nothing"]
    return "\n".join([*head, out.getvalue()])
