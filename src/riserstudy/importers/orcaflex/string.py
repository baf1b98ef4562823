"""The riser of a deck as sections: its consecutive lines, the lines along them, and the water surface."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from riserstudy.importers.orcaflex.chain import Roles, depth
from riserstudy.importers.orcaflex.deck import EMPTY, GUESS, Part, q
from riserstudy.importers.orcaflex.ends import Line, in_series
from riserstudy.importers.orcaflex.meeting import heights
from riserstudy.importers.orcaflex.pipe import (
    across,
    along,
    contents_of,
    kind_of,
    lengths_of,
    stressed,
    submerged,
    wall,
)
from riserstudy.importers.orcaflex.sea import Sea
from riserstudy.scene.geometry import at_level
from riserstudy.scene.modules_and_lines import disc

# share of its length by which a line along the riser may be longer or shorter than that
SLACK = 1e-3
DECIMALS = 9  # of elevations: a rounding error must not become a short section


class Piece(NamedTuple):
    """A piece of one line type, from its lower end."""

    name: str
    line: Line
    kind: str
    low: float  # elevation, unstretched (m)
    high: float
    begins: bool  # whether it is the lowest of its line, above another line


def sections(deck: Part, cast: Roles, bottom: float, sea: Sea) -> list[dict[str, Any]]:
    """Return the sections from the lowest to the highest; the lower end has the elevation ``bottom`` (m)."""
    made: list[dict[str, Any]] = []
    attached = _alongside(deck, cast, bottom)
    levels = [level for _, *ends in attached for level in ends]
    for line in (*cast.riser, *cast.alongside):
        _bare(line.part)
    for piece in _cut(list(_pieces(cast, bottom)), levels, sea.surface):
        with deck.noting():
            made.append(_section(deck, cast, piece, sea))
            here = [line for line, low, high in attached if low <= piece.low and piece.high <= high]
            if here:
                _add_lines(deck, made[-1], here)
    called = [str(section["name"]) for section in made]
    for k, section in enumerate(made):
        if called.count(called[k]) > 1:
            section["name"] = f"{called[k]} {called[k:].count(called[k])}"
    return made


def _bare(line: Part) -> None:
    """Record an error where clumps or buoyancy modules are attached to a line: a scene has no such bodies."""
    for key in line.data:
        if "AttachmentType" in key and (rows := line.optional(str(key))) not in EMPTY:
            found = f"{len(rows) if isinstance(rows, list) else 1} attachments"
            allowed = "add their mass to line types, since a scene has bodies only at the ends of the riser"
            line.note(line.refused("AttachmentType", found, allowed))


def _pieces(cast: Roles, bottom: float) -> Iterator[Piece]:
    """Yield the pieces from the bottom; pieces of one line type are numbered from the top."""
    rows = []
    for k, line in enumerate(cast.riser[::-1]):
        found = lengths_of(line.part)
        upwards = found[::-1] if line.part.text("TopEnd") == "End A" else found
        rows += [(line, *row, k > 0 and j == 0) for j, row in enumerate(upwards)]
    kinds = [kind for _, kind, *_ in rows]
    low = bottom
    for k, (line, kind, length, begins) in enumerate(rows):
        name = f"{kind} {kinds[k:].count(kind)}" if kinds.count(kind) > 1 else kind
        high = round(low + length, DECIMALS)
        yield Piece(name, line, kind, low, high, begins)
        low = high


def _cut(pieces: list[Piece], levels: list[float], surface: float) -> list[Piece]:
    """Return the pieces, cut at the water surface and at the ends of lines along them (m)."""
    for level in (surface, *levels):
        pieces = [
            piece._replace(low=at_level(level, piece.low), high=at_level(level, piece.high))
            for piece in pieces
        ]
        for k in range(len(pieces) - 1, -1, -1):
            piece = pieces[k]
            if piece.low < level < piece.high:
                name = f"{piece.name}, {'above water' if level == surface else 'upper part'}"
                upper = piece._replace(name=name, low=level, begins=False)
                pieces[k : k + 1] = [piece._replace(high=level), upper]
    return pieces


def _section(deck: Part, cast: Roles, piece: Piece, sea: Sea) -> dict[str, Any]:
    line = piece.line.part
    kind = kind_of(deck, line, piece.kind)
    density = sea.density if piece.high <= sea.surface else 0.0
    section = {"name": piece.name, "length": q(piece.high - piece.low, "m"), **wall(kind)}
    section["submerged_weight"] = submerged(kind, density, sea.gravity)
    section |= _water(kind)
    if (inside := contents_of(line)) and kind.number("ID"):
        section["contents"] = {"density": q(1000.0 * inside, "kg/m^3")}
    section |= stressed(kind, "contents" in section)
    if piece.begins and (joint := _joint(deck, cast, piece)):
        section["flex_joint_below"] = joint
    return section


def _joint(deck: Part, cast: Roles, piece: Piece) -> dict[str, Any] | None:
    """Return the spring between a line of the riser and the line below it; None if they are clamped."""
    below = cast.riser[cast.riser.index(piece.line) + 1]
    stiffness = in_series(piece.line.lower.stiffness, below.upper.stiffness)
    if below.upper.to == "Free" or piece.line.lower.to == below.name:
        stiffness = piece.line.lower.stiffness
    if piece.line.lower.to == "Free":
        stiffness = below.upper.stiffness
    if stiffness is None:
        allowed = "write a bending stiffness above 0, since a scene has no hinge within the riser"
        deck.note(
            piece.line.part.refused(
                "ConnectionxBendingStiffness", "0 is a hinge between two lines of the riser", allowed
            )
        )
    if stiffness is None or math.isinf(stiffness):
        return None
    return {"stiffness": q(stiffness, "kN*m/deg")}


def _water(kind: Part) -> dict[str, Any]:
    """Return drag and added mass of a line type."""
    outer = kind.number("OD")
    fields: dict[str, Any] = {}
    drag, added = _coefficient(kind, "Cd"), _coefficient(kind, "Ca")
    sliding, extra = along(kind, "Cd"), along(kind, "Ca")
    wide, long = kind.given("NormalDragLiftDiameter"), kind.given("AxialDragLiftDiameter")
    if drag:
        fields["drag"] = {"coefficient": drag, "diameter": q(wide or outer, "m")}
    if sliding:
        along_it = {"coefficient": sliding, "diameter": q(long or outer, "m")}
        fields["tangential_drag"] = along_it
    if added is not None and (mass := _added_mass(kind, added, outer)):
        fields["added_mass"] = mass
    if extra:
        kind.otherwise["Ca"] = f"{extra:g} along the line is left out"
    return fields


def _added_mass(kind: Part, added: float, outer: float) -> dict[str, Any] | None:
    """Return added mass with the coefficient and diameter that give Ca and Cm; None without both.

    In a scene, Ca D^2 of the diameter D is the added mass, and (1 + Ca) D^2 the force of accelerating water.
    """
    given, length = across(kind, "Cm"), along(kind, "Cm")
    if length:
        kind.otherwise["Cm"] = f"{length:g} along the line is left out"
    inertia = 1.0 + added if given is None else given
    displaced = inertia - added
    if not added and not inertia:
        return None
    if displaced <= 0.0:
        kind.otherwise["Cm"] = f"{inertia:g} is replaced by 1 + Ca: in a scene, it exceeds Ca"
        displaced = 1.0
    return {"coefficient": added / displaced, "diameter": q(outer * math.sqrt(displaced), "m")}


def _coefficient(kind: Part, name: str) -> float | None:
    """Return a coefficient across the line; its absence, for which OrcaFlex has a default, is an error."""
    value = across(kind, name)
    if value is None:
        kind.note(kind.refused(f"{name}x or {name}n or {name}", "missing", GUESS))
    return value


def _alongside(deck: Part, cast: Roles, bottom: float) -> list[tuple[Line, float, float]]:
    """Return the lines along the riser, with the riser's elevations at their ends (m)."""
    lengths = [depth(line) for line in cast.riser[::-1]]
    levels = [round(bottom + sum(lengths[:k]), DECIMALS) for k in range(len(lengths) + 1)][::-1]
    found, at = [], heights(cast)
    for line in cast.alongside:
        high = levels[cast.nodes.index(line.upper.to)] if line.upper.to in cast.nodes else levels[0]
        low = levels[cast.nodes.index(line.lower.to)] if line.lower.to in cast.nodes else levels[-1]
        over = line.upper.z - at.get(line.upper.to, 0.0)
        under = line.lower.z - at.get(line.lower.to, 0.0) if low > levels[-1] else 0.0
        reach = (high + over) - (low + under)
        long = depth(line)
        with deck.noting():
            if not high > low or abs(long - reach) > SLACK * reach:
                words = f"{long:g} m along {reach:g} m of the riser"
                allowed = "give the line the length of this part of the riser"
                raise line.part.refused("Length", words, allowed)
            found.append((line, low, high))
        aside = math.hypot(line.lower.x, line.lower.y)
        line.part.otherwise["ConnectionX"] = (
            f"its distance of {aside:.4g} m from the riser's axis is left out: in a scene, bending of the "
            "riser does not stretch it"
        )
        if abs(long - reach) > 1e-9 * reach:
            line.part.otherwise["Length"] = (
                f"the difference of {long - reach:+.3g} m from the unstretched riser is left out"
            )
    return found


def _add_lines(deck: Part, section: dict[str, Any], lines: list[Line]) -> None:
    """Add lines along a section, with their drag and added mass."""
    attached, kinds = [], []
    for line in lines:
        names = {name for name, _ in lengths_of(line.part)}
        if len(names) > 1:
            found = f"this line along the riser has several line types, {', '.join(sorted(names))}"
            raise line.part.refused("LineType", found, "use one line type")
        kind = kind_of(deck, line.part, *names)
        kinds.append(kind)
        fields = _pipe(kind) | {"name": line.name, "tension": "shared"}
        if inside := contents_of(line.part):
            fields["contents"] = q(1000.0 * inside, "kg/m^3")
        attached.append({"name": fields.pop("name"), **fields})
    section["lines"] = attached
    waters = [_water(kind) for kind in kinds]
    for name in ("drag", "tangential_drag"):
        _add_drag(section, [water[name] for water in waters if name in water], name)
    _add_mass(section, [water["added_mass"] for water in waters if "added_mass" in water])


def _add_drag(section: dict[str, Any], more: list[dict[str, Any]], name: str) -> None:
    """Set the diameter of a drag coefficient such that it represents the lines along the section, too."""
    parts = [section[name], *more] if name in section else more
    if not more:
        return
    first = parts[0]["coefficient"]
    whole = sum(part["coefficient"] * _diameter(part) for part in parts)
    reason = "diameters of pipe and lines, times their coefficients"
    section[name] = {"coefficient": first, "diameter": {"derived": q(whole / first, "m"), "from": reason}}


def _add_mass(section: dict[str, Any], more: list[dict[str, Any]]) -> None:
    """Add the lines along a section to its added mass and to the force of accelerating water.

    With the displaced water of all and their mean coefficient, both Ca D^2 and (1 + Ca) D^2 are sums.
    """
    parts = [section["added_mass"], *more] if "added_mass" in section else more
    if not more:
        return
    squares = [_diameter(part) ** 2 for part in parts]
    coefficients = [float(part["coefficient"]) for part in parts]
    mean: Any = sum(c * d for c, d in zip(coefficients, squares, strict=True)) / sum(squares)
    if len(set(coefficients)) == 1:
        mean = coefficients[0]
    else:
        mean = {"derived": mean, "from": "mean of the coefficients of pipe and lines, by displaced water"}
    diameter = q(math.sqrt(sum(squares)), "m")
    reason = "squares of the diameters of pipe and lines"
    section["added_mass"] = {"coefficient": mean, "diameter": {"derived": diameter, "from": reason}}


def _diameter(part: dict[str, Any]) -> float:
    return float(part["diameter"].split()[0])


def _pipe(kind: Part) -> dict[str, Any]:
    """Return a line along the riser, with its diameters, modulus and mass."""
    fields = wall(kind)
    if "young_modulus" not in fields:
        area = disc(kind.number("OD")) - disc(kind.number("ID"))
        if not area > 0.0:
            found = f"{kind.number('ID'):g} m is not less than OD"
            allowed = "correct ID or OD"
            raise kind.refused("ID", found, allowed)
        modulus = kind.number("EA") / area
        fields["young_modulus"] = {"derived": q(modulus, "kN/m^2"), "from": "EA and diameters"}
        second = (kind.number("OD") ** 4 - kind.number("ID") ** 4) * math.pi / 64.0
        kind.otherwise["EI"] = (
            f"the scene has {modulus * second:.4g} kN m^2 for this line, from EA and diameters"
        )
    for key in ("axial_stiffness", "bending_stiffness"):
        fields.pop(key, None)
    return fields
