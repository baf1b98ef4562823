"""The upper end of a deck's riser: fixed, on a vessel, on tensioners, or below a telescopic joint.

The ring is a lumped buoy. The joint is a line from a vessel to the ring: it is on a constraint that slides
along the ring, or is axially so soft that it carries no tension.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from riserstudy.importers.orcaflex.chain import Roles, depth
from riserstudy.importers.orcaflex.constraints import guided_by, slides_in
from riserstudy.importers.orcaflex.deck import Part, q
from riserstudy.importers.orcaflex.ends import BENDING, GROUND, PLACE, Line, rotation, upright
from riserstudy.importers.orcaflex.meeting import heights
from riserstudy.importers.orcaflex.pipe import axial, contents_of, flexural, kind_of, lengths_of, mass_of
from riserstudy.importers.orcaflex.sea import Sea
from riserstudy.importers.orcaflex.tensioners import Anchorage, constant, fastened, tensioners
from riserstudy.scene.modules_and_lines import disc

SAME = 1e-6  # largest difference of elevations that count as equal (m)
ALIKE = "give equal products with the coefficient along x and y, since a scene has one horizontal value"
SOFT = 10.0  # largest axial stiffness of a joint with negligible tension (kN/m)


class Top(NamedTuple):
    """The upper end of a scene, and the vessel with which it moves."""

    tree: dict[str, Any]
    vessel: Part | None


def top_of(deck: Part, cast: Roles, bottom: float, sea: Sea) -> Top:
    """Return the upper end of a riser whose lower end has the elevation ``bottom`` (m).

    Raises InputError when a scene cannot describe its support.
    """
    line, node = cast.riser[0], cast.nodes[0]
    vessels = deck.named("Vessels")
    pulling = _pulling(deck, {line.name, node})
    if line.upper.y:
        found = f"y = {line.upper.y:g} m"
        allowed = "write y = 0, since the offset of an upper end in a scene is along x"
        deck.note(line.part.refused(PLACE[2], found, allowed))
    if node not in vessels and line.upper.to not in GROUND:
        return _pulled(deck, cast, bottom, pulling, sea)
    if pulling:
        found = f"{pulling[0].name} pulls at an upper end that is held"
        allowed = "free this end, or delete the links and winches"
        raise pulling[0].refused("Name", found, allowed)
    upright(line, line.upper)
    held = "platform" if node in vessels else "held"
    base = height_of(vessels[node]) if node in vessels else 0.0
    base += sea.seabed if line.upper.to == "Anchored" else 0.0
    offset = {"offset": q(line.upper.x, "m")} if line.upper.x else {}
    tree = {"x": held, "z": held, "elevation": q(line.upper.z + base, "m")}
    tree |= {"rotation": rotation(line.upper.stiffness)} | offset
    return Top(tree, vessels.get(node))


def height_of(vessel: Part) -> float:
    """Return the elevation (m) of a vessel's origin."""
    return vessel.vector("InitialPosition")[2]


def _pulling(deck: Part, ring: set[str]) -> list[Part]:
    """Return links and winches that pull the upper end; those that do not pull the riser are left out."""
    pulling = []
    for part in [*deck.parts("Links"), *deck.parts("Winches")]:
        with deck.noting():
            ends = fastened(part)
            if ring & set(ends):
                pulling.append(part)
            else:
                part.apart = f"it connects {' and '.join(map(repr, ends))}, not the upper end of the riser"
    return pulling


def _pulled(deck: Part, cast: Roles, bottom: float, pulling: list[Part], sea: Sea) -> Top:
    """Return an upper end on tensioners, with ring, guide and telescopic joint if it has them."""
    line, node = cast.riser[0], cast.nodes[0]
    vessels, rings = deck.named("Vessels"), deck.named("6DBuoys")
    if not pulling:
        allowed = "add Links or Winches that pull it upwards"
        raise line.part.refused(PLACE[0], "nothing pulls the free upper end", allowed)
    ring = bottom + sum(map(depth, cast.riser))
    decks = {"Fixed": 0.0} | {name: height_of(vessel) for name, vessel in vessels.items()}
    level = heights(cast).get(node, 0.0)
    anchorage = Anchorage({line.name, node}, line.name, decks, ring, line.part.text("TopEnd"), level=level)
    if node in rings:
        upright(line, line.upper)
    guide = deck.named("Constraints").get(node)
    if guide is not None:
        return _guided(deck, cast, guide, pulling, anchorage, sea)
    body = ring_of(rings[node], sea, ring) if node in rings else None
    if cast.joint is not None:
        return _jointed(deck, cast, pulling, anchorage, body, sea)
    tree: dict[str, Any] = {"x": "free", "z": "free", "rotation": "free"}
    with deck.noting():
        tree["tensioners"] = tensioners(pulling, anchorage)
    on = next((end for part in pulling for end in fastened(part) if end in vessels), "")
    return Top(tree | ({"body": body} if body else {}), vessels.get(on))


def _guided(deck: Part, cast: Roles, guide: Part, pulling: list[Part], of: Anchorage, sea: Sea) -> Top:
    """Return an upper end on a constraint that keeps it below a point of the vessel and free vertically."""
    vessels = deck.named("Vessels")
    upright(cast.riser[0], cast.riser[0].upper)
    on, aside = guided_by(guide)
    tree: dict[str, Any] = {"x": "platform" if on in vessels else "held", "z": "free"}
    tree |= {"rotation": rotation(cast.riser[0].upper.stiffness)}
    tree |= {"offset": q(aside, "m")} if aside else {}
    above = of._replace(aside=aside)
    with deck.noting():
        if pull := constant(pulling, above):
            tree["tension"] = q(pull.force, "kN")
        else:
            rig = tensioners(pulling, above)
            if rig["arrangement"]["deck_radius"] == "0 m":
                del rig["arrangement"]
            tree["tensioners"] = rig
    bodies = [one for one in deck.parts("6DBuoys") if one.data.get("Connection") == guide.name]
    if bodies:
        tree["body"] = ring_of(bodies[0], sea, of.ring, on=guide.name)
    return Top(tree, vessels.get(on))


def _jointed(
    deck: Part, cast: Roles, pulling: list[Part], of: Anchorage, body: dict[str, Any] | None, sea: Sea
) -> Top:
    """Return a ring on tensioners below a telescopic joint; a constant tension may pull along the joint."""
    joint, vessels = cast.joint, deck.named("Vessels")
    if joint is None:
        raise TypeError("no joint")  # never happens: the caller has a joint
    on = joint.upper.to
    elevation = joint.upper.z + (height_of(vessels[on]) if on in vessels else 0.0)
    held = "platform" if on in vessels else "held"
    tree: dict[str, Any] = {"x": held, "z": held, "elevation": q(elevation, "m")}
    tree |= {"offset": q(joint.upper.x, "m")} if joint.upper.x else {}
    with deck.noting():
        _clamped(cast.riser[0], joint)
        tree |= _joint(deck, joint, elevation - of.ring)
        body = _carries(deck, cast, body, sea)
    with deck.noting():
        above = of._replace(aside=joint.upper.x)
        pull = constant(pulling, above)
        if pull and abs(pull.height - elevation) < SAME and "telescopic_joint" in tree:
            tree["telescopic_joint"]["tension"] = q(pull.force, "kN")
        else:
            tree["tensioners"] = tensioners(pulling, above)
    return Top(tree | ({"body": body} if body else {}), vessels.get(on))


def _clamped(riser: Line, joint: Line) -> None:
    """Record an error where the riser and the joint above it may turn relative to each other."""
    for line, stiffness in ((riser, riser.upper.stiffness), (joint, joint.lower.stiffness)):
        free = line.upper.to == "Free" if line is riser else line.lower.to == riser.name
        if not free and rotation(stiffness) != "fixed":
            found = f"the stiffness at the tension ring is {stiffness or 0:g} kN m/deg"
            allowed = "write Infinity, since the telescopic joint of a scene is clamped to the riser"
            line.part.note(line.part.refused(BENDING, found, allowed))


def _joint(deck: Part, joint: Line, length: float) -> dict[str, Any]:
    """Return a telescopic joint of the given length (m), and the rotation of its upper end."""
    upright(joint, joint.upper)
    names = {name for name, _ in lengths_of(joint.part)}
    stiff = {flexural(kind_of(deck, joint.part, name)) for name in names}
    if len(stiff) != 1:
        found = f"{', '.join(sorted(names))} have different bending stiffnesses"
        allowed = "write equal values, since a telescopic joint of a scene has one bending stiffness"
        raise joint.part.refused("LineType", found, allowed)
    joint_ = {"length": q(length, "m"), "bending_stiffness": q(stiff.pop(), "kN*m^2")}
    return {"rotation": rotation(joint.upper.stiffness), "telescopic_joint": joint_}


def _carries(deck: Part, cast: Roles, body: dict[str, Any] | None, sea: Sea) -> dict[str, Any] | None:
    """Return the ring with its part of the joint's mass: half of a soft joint, none of a sliding one."""
    joint, node = cast.joint, cast.nodes[0]
    if joint is None:
        return body
    constraints = deck.named("Constraints")
    if joint.lower.to in constraints:
        slides_in(constraints[joint.lower.to], node)
        return body
    mass, outside = 0.0, 0.0
    inside = 1000.0 * contents_of(joint.part)
    flexible = 0.0
    for name, length in lengths_of(joint.part):
        kind = kind_of(deck, joint.part, name)
        mass += length * (mass_of(kind) + inside * disc(kind.number("ID")))
        outside += length * disc(kind.number("OD"))
        stiffness = axial(kind)
        flexible += length / stiffness if stiffness else math.inf
    if SOFT * flexible < 1.0:
        found = f"the line on {node!r} is stiffer than {SOFT:g} kN/m along its axis"
        allowed = (
            "place the telescopic joint, which slides, on a constraint that is free along z, "
            f"or use at most {SOFT:g} kN/m"
        )
        raise joint.part.refused(PLACE[0], found, allowed)
    made = body or {"name": joint.name, "mass": "0 t"}
    own = float(_plain(made["mass"]).split()[0])
    reason = f"{own:g} t of its own and half of {joint.name!r} with its contents"
    made["mass"] = {"derived": q(own + 0.0005 * mass, "t"), "from": reason}
    if "displaced_volume" in made:
        volume = float(str(made["displaced_volume"]).split()[0]) + 0.5 * outside
        made["displaced_volume"] = {"derived": q(volume, "m^3"), "from": reason}
    else:
        weight = (own + 0.0005 * mass) * sea.gravity
        made["submerged_weight"] = {"derived": q(weight, "kN"), "from": "mass, above the water"}
    return made


def _plain(value: Any) -> str:
    return str(value["derived"] if isinstance(value, dict) else value)


def _products(buoy: Part, key: str, coefficient: str) -> list[float]:
    """A size times its coefficient along x, y and z, equal along x and y."""
    size = buoy.components(key)
    if not any(size):
        return size
    factor = buoy.vector(coefficient)
    products = [s * c for s, c in zip(size, factor, strict=True)]
    if products[0] != products[1]:
        raise buoy.refused(key, f"the values {size} differ along x and y", ALIKE)
    return products


def ring_of(buoy: Part, sea: Sea, elevation: float, on: str = "Free") -> dict[str, Any]:
    """Return the tension ring as a body at the riser's end, from a lumped buoy with mass, volume and drag.

    Parameters
    ----------
    elevation : elevation of the riser's upper end (m). The initial position of a free buoy is only where the
        statics of a deck begin.
    on : object that the buoy is connected to.
    """
    buoy.demand("BuoyType", "Lumped buoy")
    buoy.demand("Connection", on)
    mass, volume = buoy.number("Mass"), buoy.number("Volume")
    if any(place := buoy.vector("InitialPosition")) and on != "Free":
        found = f"the buoy is at x, y, z = {', '.join(f'{one:g}' for one in place)} m of {on!r}"
        allowed = "write 0, since the body of a scene is at the upper end of the riser"
        buoy.note(buoy.refused("InitialPosition", found, allowed))
    body: dict[str, Any] = {"name": buoy.text("Name"), "mass": q(mass, "t")}
    if elevation >= sea.surface:
        weight = q(mass * sea.gravity, "kN")
        body["submerged_weight"] = {"derived": weight, "from": "its mass: it is above the water"}
        return body
    body["displaced_volume"] = q(volume, "m^3")
    drag = _products(buoy, "DragArea", "DragForceCoefficient")
    if any(drag):
        body["drag_area"] = {"horizontal": q(drag[0], "m^2"), "vertical": q(drag[2], "m^2")}
    added = _products(buoy, "HydrodynamicMass", "AddedMassCoefficient")
    if any(added):
        body["added_mass"] = {"horizontal": q(added[0], "t"), "vertical": q(added[2], "t")}
    return body
