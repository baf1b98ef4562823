"""The upper end of a scene in a deck: vessel, tension ring, tensioners, telescopic joint."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from riserstudy.export.deck import Deck
from riserstudy.export.pipes import BENDING, ENDS, INCOMPRESSIBLE, stiffness
from riserstudy.model.tensioner_law import gas_force, linear_law, table_law
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.ends import Body, TelescopicJoint
from riserstudy.scene.forcing import TILTS
from riserstudy.scene.tensioners import Tensioners
from riserstudy.scene.units import GRAVITY

VESSEL, RING, SLIDE, BARREL = "Platform", "Tension ring", "Slide", "Inner barrel"
UNEVEN = 1e-3  # relative difference of weight and mass that another gravity makes
LIGHT = 1e-3  # mass of a ring without a body (t): a buoy needs some mass
ABOVE = 20.0  # length from the ring to the deck ends of upright cylinders (m)
POINTS = 101  # of a curved law
REACH = 10.0  # range of a law without stops, either way (m)
LINK = "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionzRelativeTo"


class Rest(NamedTuple):
    """Elevations of the ring (m): with the riser unstretched, and with the cylinders at mid-stroke."""

    unstretched: float
    equilibrium: float


def held(deck: Deck) -> str:
    """Return the name of the object with which the upper end moves: the vessel of the deck, or none."""
    return VESSEL if "platform" in (deck.scene.top.x, deck.scene.top.z) else "Fixed"


def _moves_as_one(deck: Deck) -> None:
    """Refuse an upper end that an object of a deck, which moves as a whole, would hold otherwise."""
    of, platform = deck.scene.top, deck.scene.platform
    if of.x == "free":
        allowed = "write 'held' or 'platform' for top.x"
        found = f"free, but z is {_in_words(of.z)}: OrcaFlex would hold the end in x and y, too"
        raise deck.refused("top.x", found, allowed)
    if platform is None or (of.x == "platform") == (of.z == "platform"):
        return
    way, others = ("x", ("surge", "sway")) if of.z == "platform" else ("z", ("heave",))
    place, response = platform.position, platform.response
    moved = [f"platform.position.{name}" for name in others if getattr(place, name, None)]
    if response and {*others, *TILTS} & {*response.moving}:
        moved.append("platform.response")
    if platform.cruise and way == "x":
        moved.append("platform.cruise")
    if moved:
        found = f"{_in_words(getattr(of, way))}, but the OrcaFlex vessel would move the end by {moved[0]}"
        allowed = f"write 'top.{way}: platform', or remove {moved[0]}"
        raise deck.refused(f"top.{way}", found, allowed)


def _in_words(hold: str | None) -> str:
    return {"platform": "on the platform", None: "absent"}.get(hold, str(hold))


def top(deck: Deck, rest: Rest) -> tuple[list[Any], float]:
    """Write the objects that hold and pull the riser's upper end.

    Raises InputError when a deck cannot describe it.

    Returns
    -------
    list, float
        Connection of the riser's highest line (name and place in m), and its bending stiffness (kN m/deg).
    """
    of, scene = deck.scene.top, deck.scene
    offset = of.offset or 0.0
    deck.carried |= {"top.x", "top.z", "top.offset", "top.elevation", "top.rotation"}
    if of.held_at_tension is not None:
        allowed = (
            "give top.elevation instead, since OrcaFlex cannot hold an end where the tension has a given "
            "value"
        )
        found = f"{of.held_at_tension:g} N cannot be exported to OrcaFlex"
        raise deck.refused("top.held_at_tension", found, allowed)
    if of.z != "free":
        _moves_as_one(deck)
    if of.telescopic_joint:
        _refuse_upright_pulls(deck)
        _joint(deck, of.telescopic_joint, offset, rest)
        pulls(deck, RING, rest, along=of.elevation or 0.0)
        return [RING, 0, 0, 0], math.inf
    if of.z != "free":
        return [held(deck), offset, 0, of.elevation], stiffness(of.rotation)
    if of.x == "free":
        return _free(deck, rest), 0.0 if of.body else stiffness(of.rotation)
    deck.add("Constraints", {
        "Name": SLIDE, "InFrameConnection": held(deck),
        "InFrameInitialPosition": [offset, 0, rest.unstretched], **_sliding(),
    })  # fmt: skip
    if of.body:
        _body(deck, of.body, SLIDE, rest.unstretched)
    pulls(deck, SLIDE, rest, along=None)
    if scene.top.x is None:
        deck.otherwise["top.x"] = "missing in the scene; OrcaFlex holds the upper end above the lower end"
    return [SLIDE, 0, 0, 0], stiffness(of.rotation)


def _sliding() -> dict[str, Any]:
    free = [[False], [False], [True, 0], [False], [False], [False]]
    return {
        "ConstraintType": "Calculated DOFs", "DOFFree, DOFInitialValue": free,
        "TranslationalStiffness": 0, "TranslationalDamping": 0,
    }  # fmt: skip


def _free(deck: Deck, rest: Rest) -> list[Any]:
    """Write an upper end that is free on inclined tensioners; with a body it turns freely."""
    of = deck.scene.top
    if of.tensioners is None or of.tensioners.arrangement is None:
        allowed = (
            "add top.tensioners.arrangement, since OrcaFlex has no part that pulls vertically on a free end"
        )
        raise deck.refused("top.x", "a free end cannot be exported to OrcaFlex", allowed)
    if of.rotation not in (None, "free"):
        deck.otherwise["top.rotation"] = "free in the OrcaFlex model, because the ring turns freely"
    _body(deck, of.body, "Free", rest.unstretched)
    pulls(deck, RING, rest, along=None)
    return [RING, 0, 0, 0]


def _refuse_upright_pulls(deck: Deck) -> None:
    """Refuse a vertical pull on the ring below a joint, which moves aside below the platform.

    Links and winches of a deck pull towards a point of the vessel. Along the joint, their pull does not bend
    it, but a vertical pull does.
    """
    of = deck.scene.top
    if of.tensioners and not of.tensioners.arrangement:
        allowed = "add arrangement, since OrcaFlex has no part that pulls vertically below a telescopic joint"
        found = "upright cylinders cannot be exported to OrcaFlex"
        raise deck.refused("top.tensioners.arrangement", found, allowed)
    if of.tension:
        allowed = "give telescopic_joint.tension, which pulls along the joint, instead"
        found = "a vertical pull below a telescopic joint cannot be exported to OrcaFlex"
        raise deck.refused("top.tension", found, allowed)


def _joint(deck: Deck, joint: TelescopicJoint, offset: float, rest: Rest) -> None:
    """Write a barrel that hangs on the vessel, and a constraint that slides in the ring."""
    of = deck.scene.top
    deck.carried |= {"top.telescopic_joint.length", "top.telescopic_joint.bending_stiffness"}
    _body(deck, of.body, "Free", rest.unstretched)
    deck.add("Constraints", {"Name": SLIDE, "InFrameConnection": RING, **_sliding()})
    barrel, taken = BARREL, {section.name.lower() for section in deck.scene.riser}
    while barrel.lower() in taken:
        barrel += " of the joint"
    deck.add("LineTypes", {
        "Name": barrel, "Category": "General", "OD": 0.5, "ID": 0.4, "MassPerUnitLength": 0.1,
        "EI": [1e-3 * joint.bending_stiffness, None], "EA": 1e6, "PoissonRatio": INCOMPRESSIBLE, "GJ": 80.0,
        "Ca": [0, None, 0], "Cd": [0, None, 0],
    })  # fmt: skip
    deck.otherwise["top.telescopic_joint (inner barrel)"] = (
        "its inner barrel has a mass of 0.1 t/m in the deck, carried by the vessel, and no drag"
    )
    deck.add("Lines", {
        "Name": "Telescopic joint", "IncludeTorsion": False, "TopEnd": "End A",
        ENDS: [
            [held(deck), offset, 0, of.elevation, 0, 180, 0, None], [SLIDE, 0, 0, 0, 0, 180, 0, None],
        ],
        BENDING: [[stiffness(of.rotation), None], [math.inf, None]],
        "LineType, Length, TargetSegmentLength": [[barrel, joint.length, joint.length / 4.0]],
        "IncludedInStatics": True, "StaticsStep1": "Catenary", "StaticsStep2": "Full statics",
    })  # fmt: skip
    apart = (of.elevation or 0.0) - rest.unstretched
    if abs(joint.length - apart) > 1e-6:
        deck.otherwise["top.telescopic_joint.length"] = (
            f"programs that read the deck may measure it from the unstretched riser to the top, {apart:.6g} m"
        )


def _body(deck: Deck, body: Body | None, on: str, elevation: float) -> None:
    """Write a lumped buoy as the ring, with mass, volume and drag of the body at the ring.

    Parameters
    ----------
    on : object that the buoy is connected to, at its origin; or ``Free``.
    elevation : elevation of the upper end of the unstretched riser (m).
    """
    mass, volume, name = LIGHT, 0.0, RING
    areas, added = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    if body:
        mass = max(1e-3 * body.mass, LIGHT)
        volume = _volume(deck, body, 1e3 * mass, elevation)
        if body.drag_area:
            across, along = body.drag_area.horizontal or 0.0, body.drag_area.vertical or 0.0
            areas = [across, across, along]
        if body.added_mass:
            across, along = body.added_mass.horizontal or 0.0, body.added_mass.vertical or 0.0
            added = [1e-3 * across, 1e-3 * across, 1e-3 * along]
        deck.carried |= {"top.body"}
    else:
        deck.otherwise["top.body"] = f"absent: the ring of the deck has {1e3 * LIGHT:g} kg"
    height = elevation if on == "Free" else 0.0
    deck.add("6DBuoys", {
        "Name": name, "BuoyType": "Lumped buoy", "Connection": on,
        "InitialPosition": [0, 0, height], "InitialAttitude": [0, 0, 0], "Mass": mass,
        "MomentsOfInertia": [0, 0, 0], "CentreOfMass": [0, 0, 0], "Volume": volume,
        "DragArea": areas, "DragForceCoefficient": [1.0 if area else 0.0 for area in areas],
        "HydrodynamicMass": added, "AddedMassCoefficient": [1.0 if one else 0.0 for one in added],
    })  # fmt: skip


def _volume(deck: Deck, body: Body, mass: float, height: float) -> float:
    """Return the volume (m3) of a lumped buoy with a body's weight, at an elevation (m); mass in kg."""
    water = deck.scene.water
    density = water.density if water else 0.0
    weight = body.weight(deck.scene.gravity or GRAVITY, density)
    dry = height >= ((water.surface if water else None) or 0.0)
    lost = mass - weight / GRAVITY  # kg, by buoyancy
    if lost < -UNEVEN * mass and not dry:
        found = "the submerged weight is more than the weight in air"
        raise deck.refused("top.body.submerged_weight", found, "correct mass or submerged_weight")
    differs = []
    if (dry or lost < 0.0) and abs(lost) * GRAVITY > 1.0:
        where = "above the water" if dry else "without volume"
        differs.append(f"{where} the deck weighs its mass: {1e-3 * GRAVITY * lost:+.4g} kN")
    if dry and (body.drag_area or body.added_mass):
        differs.append("above the water it has neither drag nor added mass in OrcaFlex")
    if differs:
        deck.otherwise["top.body"] = "; ".join(differs)
    return lost / density if density and lost > 0.0 and not dry else 0.0


def pulls(deck: Deck, ring: str, rest: Rest, along: float | None) -> None:
    """Write tensioners and constant tensions.

    Parameters
    ----------
    ring : name of the object that they pull.
    rest : elevations of the ring.
    along : elevation of the top of a joint along which constant tensions pull (m); None: they pull
        vertically.
    """
    of = deck.scene.top
    joint = of.telescopic_joint
    high = rest.unstretched + ABOVE if along is None else along
    base = held(deck)
    for path, tension in (
        ("top.tension", of.tension), ("top.telescopic_joint.tension", joint and joint.tension),
    ):  # fmt: skip
        if tension:
            deck.carried.add(path)
            deck.add("Winches", {
                "Name": "Constant tension", "WinchType": "Simple",
                "Connection, ConnectionX, ConnectionY, ConnectionZ": [
                    [base, of.offset or 0.0, 0, high], [ring, 0, 0, 0],
                ],
                "Stiffness": 1e5, "Damping": 0, "WinchControlType": "By stage",
                "StageMode, StageValue": [["Specified tension", 1e-3 * tension]] * 3,
            })  # fmt: skip
    if of.tensioners:
        _cylinders(deck, of.tensioners, ring, rest, high)


def _cylinders(deck: Deck, rig: Tensioners, ring: str, rest: Rest, high: float) -> None:
    """Write one link per cylinder."""
    deck.carried |= {
        f"top.tensioners.{name}"
        for name in (
            "count", "mid_stroke", "gas", "two_chamber_gas", "linearised", "linear", "table", "interpolation",
            "carried", "damping", "arrangement", "failed",
        )
    }  # fmt: skip
    place = rig.arrangement
    zero = rest.equilibrium if rig.mid_stroke == "riser in equilibrium" else rest.unstretched
    if place:
        inner, outer, height = place.ring_radius, place.deck_radius, place.deck_elevation
        bearings = place.bearings(rig.count)
    else:
        inner = outer = 0.0
        height, bearings = high, [0.0] * rig.count
    length = math.hypot(outer - inner, height - zero)
    aside = deck.scene.top.offset or 0.0
    law, nothing = _law(deck, rig, length), _rows(np.array([-REACH, REACH]) + length, np.zeros(2))
    if rig.mid_stroke == "riser in equilibrium":
        deck.otherwise["top.tensioners.mid_stroke"] = (
            "links have their lengths in static equilibrium; programs that read the deck measure extension "
            f"from the unstretched riser, which differs by {rest.unstretched - zero:+.4g} m"
        )
    for c, bearing in enumerate(bearings):
        x, y = math.cos(bearing), math.sin(bearing)
        works = rig.working[c]
        deck.add("Links", {
            "Name": f"Tensioner {c + 1}{'' if works else ', failed'}", "LinkType": "Spring/damper",
            LINK: [
                [held(deck), outer * x + aside, outer * y, height, None],
                [ring, inner * x, inner * y, 0, None],
            ],
            **(law if works else nothing), "LinearDamper": True,
            "DampingConstant": 1e-3 * rig.damper if works else 0.0,
        })  # fmt: skip


def _law(deck: Deck, rig: Tensioners, length: float) -> dict[str, Any]:
    """Return the law of a link with the given length at mid-stroke (m)."""
    gravity = deck.scene.gravity or 0.0
    if rig.linear or rig.linearised:
        tension, slope = linear_law(rig, gravity)
        if rig.linearised:
            line = f"the straight line of {1e-3 * tension:.6g} kN and {1e-3 * slope:.6g} kN/m at mid-stroke"
            deck.otherwise |= {f"top.tensioners.{name}": line for name in (_named(rig), "linearised")}
        if slope:
            unstretched = length - tension / slope
            return {
                "LinearSpring": True, "UnstretchedLength": unstretched, "Stiffness": 1e-3 * slope,
            }  # fmt: skip
        reach = np.array([-REACH, REACH])
        return _rows(reach + length, np.array([tension, tension]))
    if rig.table:
        nodes = np.array([row.reach for row in rig.table])
        if rig.interpolation == "linear":
            return _rows(nodes + length, np.array([row.force for row in rig.table]))
        reach = _with(nodes, np.linspace(nodes[0], nodes[-1], POINTS))
        force = table_law(rig.table)(reach)
    else:
        gas = rig.any_gas
        if gas is None:
            raise TypeError("tensioners without a law")  # refused by the scene
        low = rig.stroke.shortest if rig.stroke else -min(REACH, 0.9 * length)
        longest = rig.stroke.longest if rig.stroke else REACH
        empty = rig.pulling.volume / rig.pulling.area if rig.pulling else math.inf
        reach = np.linspace(low, min(longest, 0.9 * empty), POINTS)
        reach = _with(np.zeros(1), reach)
        force = gas_force(gas, reach) - rig.piston_mass * gravity
        reach, force = reach[force >= 0.0], force[force >= 0.0]
        if rig.piston_mass:
            mass = f"{rig.piston_mass * sum(rig.working):.6g} kg"
            deck.otherwise["top.tensioners.two_chamber_gas.pistons"] = (
                f"their weight is in the law; their mass of {mass}, which moves with the ring, is not written"
            )
    deck.otherwise[f"top.tensioners.{_named(rig)}"] = (
        f"the law is a table of {len(reach)} points from {reach[0]:.4g} m to {reach[-1]:.4g} m"
    )
    return _rows(reach + length, force)


def _with(exact: FloatArray, others: FloatArray) -> FloatArray:
    """Return two sets of reaches (m) as one in rising order; reaches equal up to rounding occur once."""
    close = 1e-6 * (others[-1] - others[0])
    apart = abs(others[:, None] - exact).min(axis=1) > close
    return np.sort(np.concatenate([exact, others[apart]]))


def _named(rig: Tensioners) -> str:
    """Return the field of a curved law."""
    return next(name for name in ("gas", "two_chamber_gas", "table") if getattr(rig, name))


def _rows(length: FloatArray, force: FloatArray) -> dict[str, Any]:
    rows = [[float(a), 1e-3 * float(b)] for a, b in zip(length, force, strict=True)]
    return {"LinearSpring": False, "SpringLength, SpringTension": rows}
