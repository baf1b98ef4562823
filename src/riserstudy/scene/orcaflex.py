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
LINKED = "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionzRelativeTo"
STRETCHING = {"None": "none", "Vertical stretching": "constant", "Wheeler stretching": "stretched"}


class Imported(NamedTuple):
    """A scene as a plain tree, and what of the deck is not in it."""

    tree: dict[str, Any]
    left_out: list[str]


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
    line = deck.only("Lines")
    surface = sea.number("WaterSurfaceZ")
    depth = sea.number("WaterDepth")
    density = 1000.0 * sea.number("Density")
    top, bottom = _ends(line, surface, depth)
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
    vessels = {vessel.text("Name"): vessel for vessel in deck.parts("Vessels")}
    tree["top"] = _top(deck, line, top, bottom, vessels)
    if current := _current(sea):
        tree["current"] = current
    if wave := _wave(sea, ramp):
        tree["wave"] = wave
    if top.to in vessels:
        tree["platform"] = platform_of(deck, vessels[top.to], ramp if wave else None, bool(wave))
    tree["analysis"] = analysis
    SceneFile(str(path), unwrap(tree)[0]).scene()
    return Imported(tree, deck.unused())


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
    if lower.to not in ("Anchored", "Fixed"):
        raise line.refused(ENDS, f"lower end on {lower.to!r}", "allowed are Anchored and Fixed")
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
        section = _properties(types[name], density)
        called = name if names.count(name) == 1 else f"{name} {names[: k + 1].count(name)}"
        if contents and section["inner_diameter"] != "0 m":
            section["contents"] = {"density": _q(1000.0 * float(contents), "kg/m^3")}
        yield {"name": called, "length": _q(float(row[1]), "m"), **section}


def _properties(kind: Part, density: float) -> dict[str, Any]:
    outer, inner = kind.number("OD"), kind.number("ID")
    area = 0.25 * math.pi * (outer**2 - inner**2)
    fields: dict[str, Any] = {"outer_diameter": _q(outer, "m"), "inner_diameter": _q(inner, "m")}
    if kind.text("Category") == "Homogeneous pipe":
        mass = 1000.0 * kind.number("MaterialDensity") * area
        fields["young_modulus"] = _q(kind.number("E"), "kN/m^2")
        fields["mass"] = {"derived": _q(mass, "kg/m"), "from": "MaterialDensity and diameters"}
    elif kind.text("Category") == "General":
        mass = 1000.0 * kind.number("MassPerUnitLength")
        kind.alike("EIx", "EIy")
        fields["bending_stiffness"] = _q(kind.number("EIx"), "kN*m^2")
        fields["axial_stiffness"] = _q(kind.number("EA"), "kN")
        fields["mass"] = _q(mass, "kg/m")
    else:
        raise kind.refused(
            "Category", kind.text("Category"), "allowed are General, Homogeneous pipe"
        )
    wet = (mass - density * 0.25 * math.pi * outer**2) * GRAVITY
    fields["submerged_weight"] = {
        "derived": _q(wet, "N/m"), "from": "mass per length less the water that OD displaces",
    }  # fmt: skip
    kind.alike("Cdx", "Cdy")
    kind.alike("Cax", "Cay")
    drag, added = kind.optional("Cdx"), kind.optional("Cax")
    wide = kind.optional("NormalDragLiftDiameter")
    if drag:
        fields["drag"] = {"coefficient": float(drag), "diameter": _q(float(wide or outer), "m")}
    if added:
        fields["added_mass"] = {"coefficient": float(added), "diameter": _q(outer, "m")}
    return fields


def _top(deck: Part, line: Part, top: End, bottom: End, vessels: dict[str, Part]) -> dict[str, Any]:
    """The upper end: held, on a vessel, or free on springs between it and deck points."""
    if bottom.x or bottom.y or top.y:
        allowed = "allowed is a lower end at x = y = 0, and an upper end along x"
        raise line.refused(ENDS, "ends that are aside", allowed)
    offset = {"offset": _q(top.x, "m")} if top.x else {}
    links = deck.parts("Links")
    if top.to == "Free":
        if not links:
            raise line.refused(ENDS, "a free upper end", "allowed with Links that pull it")
        length = sum(float(row[1]) for row in line.rows(SECTIONS, 2))
        rig = _tensioners(line.text("Name"), links, bottom.z + length)
        return {"x": "free", "z": "free", "rotation": top.rotation, "tensioners": rig}
    if links:
        raise links[0].refused("Name", links[0].text("Name"), "allowed with a free upper end alone")
    z = top.z
    if top.to in vessels:
        x, y, height = (float(v) for v in vessels[top.to].values("InitialPosition", 3))
        if x or y:
            raise vessels[top.to].refused("InitialPosition", f"{x}, {y}", "allowed is x = y = 0")
        z += height
    elif top.to != "Fixed":
        raise line.refused(ENDS, f"upper end on {top.to!r}", "allowed are Fixed, Free and a vessel")
    held = "platform" if top.to in vessels else "held"
    return {"x": held, "z": held, "elevation": _q(z, "m"), "rotation": top.rotation} | offset


def _tensioners(line: str, links: list[Part], top: float) -> dict[str, Any]:
    """Equal linear springs to fixed points around the upper end, which is at an elevation (m) unstretched."""
    places, pulls = [], set()
    for link in links:
        link.demand("LinkType", "Spring/Damper")
        link.demand("LinearSpring", True)
        if link.optional("Damping"):
            raise link.refused("Damping", str(link.optional("Damping")), "allowed is 0")
        deck, ring = link.rows(LINKED, 4)
        if deck[0] != "Fixed" or ring[0] != line or any(float(v) for v in ring[1:4]):
            found = f"from {deck[0]!r} to {ring[0]!r}"
            raise link.refused(LINKED, found, "allowed is from Fixed to the line's upper end")
        x, y, z = (float(v) for v in deck[1:4])
        away = math.hypot(x, y)
        length = math.hypot(away, z - top)
        stiffness = link.number("Stiffness")
        pull = stiffness * (length - link.number("UnstretchedLength"))
        places.append((round(away, 6), round(z, 6), math.degrees(math.atan2(y, x)) % 360.0))
        pulls.add((round(pull, 6), stiffness))
    count = len(places)
    bearings = sorted(place[2] for place in places)
    even = all(abs(b - bearings[0] - 360.0 * k / count) < 1e-3 for k, b in enumerate(bearings))
    if len({place[:2] for place in places}) > 1 or len(pulls) > 1 or (places[0][0] and not even):
        found = "links that differ, or are not evenly around the line"
        raise links[0].refused(LINKED, found, "allowed are equal ones, evenly on a circle")
    ((pull, stiffness),) = pulls
    return {
        "count": count,
        "mid_stroke": "riser unstretched",
        "linear": {
            "tension": {"derived": _q(pull, "kN"), "from": "stretch of a link, the riser unstretched"},
            "stiffness": _q(stiffness, "kN/m"),
        },
        "arrangement": {
            "ring_radius": "0 m",
            "deck_radius": _q(places[0][0], "m"),
            "deck_elevation": _q(places[0][1], "m"),
            "first_bearing": _q(bearings[0], "deg"),
        },
    }  # fmt: skip


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


def _wave(sea: Part, ramp: float | None) -> dict[str, Any] | None:
    trains = sea.parts("WaveTrains")
    if not trains:
        return None
    train = trains[0]
    if len(trains) > 1 or train.text("WaveType") not in ("Airy", "Single Airy"):
        found = f"{len(trains)} wave trains, {train.text('WaveType')}"
        raise train.refused(
            "WaveType", found, "allowed is one of Airy; components of seas are drawn otherwise"
        )
    if not train.number("WaveHeight"):
        return None
    method = sea.text("KinematicStretchingMethod")
    if method not in STRETCHING:
        raise sea.refused(
            "KinematicStretchingMethod", method, f"allowed are {', '.join(STRETCHING)}"
        )
    towards = train.number("WaveDirection")
    return (
        {
            "height": _q(train.number("WaveHeight"), "m"),
            "period": _q(train.number("WavePeriod"), "s"),
            "above_mean_level": STRETCHING[method],
        }
        | ({"heading": _q(towards, "deg")} if towards else {})
        | ({"ramp": _q(ramp, "s")} if ramp else {})
    )


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
