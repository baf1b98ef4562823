"""Import of an OrcaFlex text model of a vertical riser as a scene; everything left out is reported.

Nothing is guessed. An entry that a scene cannot describe is refused if the riser would be another one without
it, else it is reported as left out. Units are OrcaFlex's SI units: tonne, kN, m, s, kN m/deg.
"""

from __future__ import annotations

import io
import warnings
from pathlib import Path
from typing import Any, NamedTuple

from ruamel.yaml.error import MantissaNoDotYAML1_1Warning

from riserstudy.errors import InputError, InputErrors, on_one_line
from riserstudy.importers.orcaflex.chain import Bearings, Roles, leave_out_points, roles
from riserstudy.importers.orcaflex.constraints import turns_in
from riserstudy.importers.orcaflex.deck import Part, q
from riserstudy.importers.orcaflex.ends import GROUND, PLACE, rotation, upright
from riserstudy.importers.orcaflex.left_out import left_out
from riserstudy.importers.orcaflex.meeting import meet
from riserstudy.importers.orcaflex.sea import Sea, current_of, sea_of, wave_of
from riserstudy.importers.orcaflex.soil import same_soil, soil_of
from riserstudy.importers.orcaflex.string import sections
from riserstudy.importers.orcaflex.tensioners import fastened
from riserstudy.importers.orcaflex.top import top_of
from riserstudy.importers.orcaflex.vessel import platform_of
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import unwrap
from riserstudy.scene.units import GRAVITY

#: lists of objects that are left out whole if none of their entries was read
OBJECTS = (
    "VesselTypes", "LineTypes", "Vessels", "Lines", "6DBuoys", "3DBuoys", "Constraints", "Links",
    "Winches", "Shapes", "P-yModels",
)  # fmt: skip


class Imported(NamedTuple):
    """A scene as a plain tree, and the entries of the deck that it lacks."""

    tree: dict[str, Any]
    left_out: list[str]


class Foot(NamedTuple):
    """The lower end of the riser: its elevation (m) and its rotation."""

    elevation: float
    rotation: Any


def read_deck(path: Path) -> Imported:
    """Read the text model of a vertical riser.

    Raises InputError when it is not such a model, or a scene cannot describe it; the error lists all causes
    together.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MantissaNoDotYAML1_1Warning)  # OrcaFlex writes 250e3
        data = read_yaml(path)
    if not isinstance(data, dict) or "Lines" not in data or "LineTypes" not in data:
        allowed = "give an OrcaFlex text data file (.yml) with LineTypes and Lines"
        raise InputError(path, "", "this is not an OrcaFlex model of a riser", allowed)
    deck = Part(data, "", path)
    tree: dict[str, Any] = {}
    with deck.noting():
        tree = _tree(deck, path)
    if deck.faults:
        raise InputErrors(deck.faults)
    for key in OBJECTS:
        for part in deck.parts(key):
            if not part.apart and not part.taken - {"Name"} and not part.below:
                part.apart = "no part of the riser refers to it"
    SceneFile(str(path), unwrap(tree)[0]).resolved()
    return Imported(tree, left_out(deck))


def _tree(deck: Part, path: Path) -> dict[str, Any]:
    """Return the scene without the parts that have errors; errors are recorded."""
    general, environment = deck.part("General"), deck.part("Environment")
    general.demand("UnitsSystem", "SI")
    sea = sea_of(environment, GRAVITY)
    stages, analysis = _analysis(general)
    wave = None
    with deck.noting():
        wave = wave_of(environment, stages[0] if stages else None, sea)
    current = None
    with deck.noting():
        current = current_of(environment)
    cast = roles(deck, _bearings(deck))
    meet(cast)
    leave_out_points(deck, cast.nodes[1:-1])
    foot = _foot(deck, cast, sea)
    made = top_of(deck, cast, foot.elevation, sea)
    bottom: dict[str, Any] = {"hold": "wellhead", "elevation": q(foot.elevation, "m")}
    tree: dict[str, Any] = {
        "title": f"{cast.riser[0].name}, from {path.name}",
        "gravity": f"{GRAVITY} m/s^2",
        "water": {
            "density": q(sea.density, "kg/m^3"),
            "surface": q(sea.surface, "m"),
            "seabed": q(sea.seabed, "m"),
        },
        "riser": sections(deck, cast, foot.elevation, sea),
        "bottom": bottom | {"rotation": foot.rotation},
    }
    same_soil([line.part for line in reversed(cast.riser)], foot.elevation, sea.seabed)
    if ground := soil_of(deck, cast.riser[-1].part, sea.seabed, GRAVITY):
        tree["bottom"]["hold"] = "foot"
        tree["soil"] = ground
    tree["top"] = made.tree
    tree |= {name: part for name, part in (("current", current), ("wave", wave)) if part}
    if made.vessel:
        offset = float(made.tree.get("offset", "0 m").removesuffix(" m"))
        tree["platform"] = platform_of(deck, made.vessel, stages, sea if wave else None, offset)
    return tree | {"analysis": analysis}


def _bearings(deck: Part) -> Bearings:
    """Return the objects that lines may hang on."""
    vessels = set(deck.named("Vessels"))
    ground = set(GROUND)
    sliding: dict[str, str] = {}
    for name, constraint in deck.named("Constraints").items():
        inside = str(constraint.data.get("InFrameConnection"))
        if inside in GROUND:
            ground.add(name)
        sliding[name] = inside
    pulled = set()
    for part in [*deck.parts("Links"), *deck.parts("Winches")]:
        with deck.noting():
            ends = set(fastened(part))
            pulled |= ends - vessels - set(GROUND) if ends & (vessels | set(GROUND)) else set()
    return Bearings(ground, vessels, pulled, sliding)


def _foot(deck: Part, cast: Roles, sea: Sea) -> Foot:
    """Return the lower end, which is on the ground or on a constraint that is its flex joint."""
    line, end = cast.riser[-1], cast.riser[-1].lower
    if not end.on_axis:
        allowed = "move the model to x = y = 0, since the lower end of the riser of a scene is on the z axis"
        deck.note(line.part.refused(PLACE[1], f"the lower end is at {end.x:g}, {end.y:g} m", allowed))
    joints = deck.named("Constraints")
    if end.to in joints:
        if rotation(end.stiffness) != "fixed" or end.z:
            allowed = "clamp the lower end to this constraint at z = 0 of its frame"
            found = f"the lower end is connected to {end.to!r} at z = {end.z:g} m, or is not clamped to it"
            deck.note(line.part.refused(PLACE[0], found, allowed))
        upright(line, end)
        to, z, turning = turns_in(joints[end.to])
        return Foot(z + (sea.seabed if to == "Anchored" else 0.0), turning)
    upright(line, end)
    low = end.z + (sea.seabed if end.to == "Anchored" else 0.0)
    return Foot(low, rotation(end.stiffness))


def _analysis(general: Part) -> tuple[list[float], dict[str, Any]]:
    """Return the durations of the stages (s), and the analysis, which is static without stages."""
    stages = general.numbers("StageDuration")
    if not stages:
        return stages, {}
    every = q(general.number("TargetLogSampleInterval"), "s")
    return stages, {"duration": q(sum(stages), "s"), "output": {"interval": every}}


def as_text(found: Imported, deck: Path) -> str:
    """Return the scene as the text of a file; its head lists everything that was left out."""
    from ruamel.yaml import YAML

    out = io.StringIO()
    writer = YAML()
    writer.width = 120
    writer.dump(found.tree, out)
    head = [f"# Made from {on_one_line(deck.name)} by `riserstudy import`. Of the deck is not in it:"]
    head += [f"#   {line}" for line in found.left_out] or ["#   nothing"]
    return "\n".join([*head, out.getvalue()])
