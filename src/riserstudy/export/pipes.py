"""Sections of a scene as line types and lines of a deck.

In a deck the weight of a line in water follows from its mass and from the water that its ``OD`` displaces. A
scene gives the weight in water independently of diameters. Its line type therefore has the ``OD`` that yields
this weight, and separate diameters for drag, added mass and stress.
"""

from __future__ import annotations

import math
from typing import Any

from riserstudy.export.deck import Deck
from riserstudy.scene.riser import Section
from riserstudy.scene.units import GRAVITY

SAME = 1e-6  # largest relative difference of numbers that count as equal
FINE = 100  # segments along the riser, for a scene without a mesh
STEEPER = 1e-3  # smallest weight that is reported (kN)
#: Poisson's ratio with which pressures change no length in a deck: in a scene, the effective tension is EA
#: times the strain; in a deck, (1 - 2 ratio) times the pressures on the areas of the pipe is added
INCOMPRESSIBLE = 0.5

Run = list[int]  # numbers of consecutive sections that form one line


def runs(deck: Deck) -> list[Run]:
    """Return the sections of each line, from the top; a line ends at a joint or a change of contents."""
    found: list[Run] = []
    riser = deck.scene.riser
    for k in range(len(riser) - 1, -1, -1):
        above = riser[k + 1] if k + 1 < len(riser) else None
        same = above is not None and not above.flex_joint_below and _inside(above) == _inside(riser[k])
        if same:
            found[-1].append(k)
        else:
            found.append([k])
    return found


def _inside(section: Section) -> float | None:
    return section.contents.density if section.contents else None


def line_types(deck: Deck) -> None:
    """Write the line types, one per section."""
    for k, section in enumerate(deck.scene.riser):
        deck.add("LineTypes", _line_type(deck, section, k))
    deck.carried |= {
        f"riser.{name}"
        for name in (
            "length", "joints", "outer_diameter", "inner_diameter", "young_modulus", "mass", "wall_density",
            "axial_stiffness", "bending_stiffness", "submerged_weight", "modules", "contents.density",
            "tangential_drag", "added_mass.coefficient", "added_mass.diameter", "drag.diameter",
            "flex_joint_below",
        )
    }  # fmt: skip
    if deck.scene.buoyancy:
        deck.otherwise["buoyancy"] = "included in the submerged weights and in the top tension"


def _line_type(deck: Deck, section: Section, k: int) -> dict[str, Any]:
    scene, path = deck.scene, f"riser[{k}]"
    if section.name.strip() == "~":
        raise deck.refused(f"{path}.name", section.name, "'~' stands for a default in OrcaFlex. Rename it")
    if section.mass is None:
        found = "missing, but OrcaFlex requires the mass of every section"
        raise deck.refused(f"{path}.mass", found, "add mass to this section")
    water = scene.water.density if scene.water else 0.0
    lost = section.mass - (section.submerged_weight or 0.0) / GRAVITY  # kg/m, in the water
    _above_water(deck, section, k)
    high = _levels(deck, k)[1]
    outer = section.outer_diameter or 0.0
    afloat = scene.water is not None and (scene.water.surface or 0.0) < high
    dry = scene.water is not None and _levels(deck, k)[0] >= (scene.water.surface or 0.0) and afloat
    if not dry:
        area = lost / water
        if area < 0.0:
            found = "the submerged weight is more than the weight in air"
            raise deck.refused(f"{path}.submerged_weight", found, "correct mass or submerged_weight")
        outer = math.sqrt(4.0 * area / math.pi)
    inner = (section.inner_diameter or 0.0) if section.contents else 0.0
    own = section.outer_diameter or 0.0
    entry: dict[str, Any] = {"Name": section.name}
    pipe = section.young_modulus and not section.lines and abs(outer - own) < SAME * own
    if pipe:
        entry |= {
            "Category": "Homogeneous pipe", "OD": own, "ID": section.inner_diameter or 0.0,
            "MaterialDensity": 1e-3 * section.mass / section.wall_area,
            "E": 1e-3 * (section.young_modulus or 0.0), "PoissonRatio": INCOMPRESSIBLE,
        }  # fmt: skip
        outer = own
    else:
        if outer <= inner:
            found = (
                f"the buoyancy is that of a pipe with a diameter of {outer:.4g} m, "
                f"around contents with a diameter of {inner:.4g} m"
            )
            allowed = "correct mass or submerged_weight, since a pipe must be wider than its contents"
            raise deck.refused(f"{path}.submerged_weight", found, allowed)
        axial, bending = section.elasticity
        entry |= {
            "Category": "General", "OD": outer, "ID": inner, "MassPerUnitLength": 1e-3 * section.mass,
            "EI": [1e-3 * bending, None], "EA": 1e-3 * axial, "PoissonRatio": INCOMPRESSIBLE, "GJ": 80.0,
            "StressOD": section.outer_diameter, "StressID": section.inner_diameter,
        }  # fmt: skip
        if own and abs(outer - own) > SAME * own:
            deck.otherwise[f"{path}.outer_diameter"] = (
                f"{own:.6g} m is written as StressOD; OD is {outer:.6g} m, from the submerged weight"
            )
    if section.lines:
        deck.otherwise[f"{path}.lines"] = (
            "included in the mass, weight and stiffness of the line type; stresses of the OrcaFlex model are "
            "those of a pipe that carries the tension of the lines, too"
        )
    return entry | _water(deck, section, k, outer, bool(pipe))


def _above_water(deck: Deck, section: Section, k: int) -> None:
    """Report a section above the water whose weight differs in a deck, where it displaces no water."""
    water = deck.scene.water
    low, high = _levels(deck, k)
    surface = water.surface if water else None
    if surface is None or high <= surface:
        return
    if low < surface:
        deck.otherwise[f"riser[{k}].length"] = (
            f"OrcaFlex divides the section at the surface, {surface - low:.6g} m above its lower end"
        )
    dry = high - max(low, surface)
    more = ((section.mass or 0.0) * GRAVITY - (section.submerged_weight or 0.0)) * dry
    if abs(more) > 1e3 * STEEPER and deck.scene.gravity:
        deck.otherwise[f"riser[{k}].submerged_weight"] = (
            f"above the water, OrcaFlex computes the weight from the mass: {1e-3 * more:+.4g} kN in total"
        )


def _levels(deck: Deck, k: int) -> tuple[float, float]:
    """Return the elevations of a section's ends, unstretched (m)."""
    lengths = [section.total_length for section in deck.scene.riser]
    low = (deck.scene.bottom.elevation or 0.0) + sum(lengths[:k])
    return low, low + lengths[k]


def _water(deck: Deck, section: Section, k: int, outer: float, pipe: bool) -> dict[str, Any]:
    """Return drag and added mass, each with its own diameter.

    OrcaFlex refers added mass (Ca) and the force of accelerating water (Cm) to ``outer``; a scene refers both
    to the diameter of the added mass, and has neither along the riser.
    """
    drag, added, sliding = section.drag, section.added_mass, section.tangential_drag
    across = along = mass = inertia = 0.0
    entry: dict[str, Any] = {}
    if drag:
        across = drag.constant if not drag.table else _mean(deck, drag.table, k)
        entry["NormalDragLiftDiameter"] = drag.diameter
        deck.carried |= set() if drag.table else {"riser.drag.coefficient"}
    if sliding:
        along = sliding.coefficient
        entry["AxialDragLiftDiameter"] = sliding.diameter
    if added:
        displaced = (added.diameter / outer) ** 2
        mass, inertia = added.coefficient * displaced, (1.0 + added.coefficient) * displaced
    if pipe and all(key not in entry or entry[key] == outer for key in entry):
        return {"Cdn": across, "Cdz": along, "Can": mass, "Caz": 0, "Cmn": inertia, "Cmz": 0}
    if pipe:  # a homogeneous pipe has one diameter for all
        scale = entry.get("NormalDragLiftDiameter", outer) / outer
        slide = entry.get("AxialDragLiftDiameter", outer) / outer
        coefficients = {"Cdn": across * scale, "Cdz": along * slide}
        return {**coefficients, "Can": mass, "Caz": 0, "Cmn": inertia, "Cmz": 0}
    water = {"Ca": [mass, None, 0], "Cm": [inertia, None, 0]}
    return {**water, "Cd": [across, None, along], **entry}


def _mean(deck: Deck, table: tuple[tuple[float, float], ...], k: int) -> float:
    """Return the mean of a drag coefficient over a section, as a line type of a deck has only one."""
    import numpy as np

    low, high = _levels(deck, k)
    z = np.linspace(low, high, 401)
    mean = float(np.interp(z, *np.array(table).T).mean())
    deck.otherwise[f"riser[{k}].drag.coefficient"] = (
        f"mean over the section, {mean:.4g}: a line type has one drag coefficient"
    )
    return mean


def lines(
    deck: Deck, top: list[Any], upper: float, foot: list[Any], lower: float, clay: str | None = None
) -> None:
    """Write the riser's lines, joined end to end.

    Parameters
    ----------
    top, foot : connections of the highest and the lowest end: name, x, y, z (m).
    upper, lower : bending stiffness of these ends (kN m/deg).
    clay : name of the model of the soil around the lines that reach below the seabed, if there is soil.
    """
    found = runs(deck)
    names = ["Riser"] if len(found) == 1 else [f"Riser {k + 1}" for k in range(len(found))]
    mesh = deck.scene.analysis.mesh
    total = sum(section.total_length for section in deck.scene.riser)
    most = total / (mesh.elements if mesh else FINE)
    seabed = (deck.scene.water and deck.scene.water.seabed) or 0.0
    for n, run in enumerate(found):
        riser = deck.scene.riser
        last, high = n == len(found) - 1, _levels(deck, run[0])[1]
        joint = riser[run[-1]].flex_joint_below
        stiff = math.inf if joint is None else 1e-3 * joint.stiffness * math.pi / 180.0
        ends = [
            [*top, 0, 180, 0, None] if n == 0 else ["Free", 0, 0, high, 0, 180, 0, None],
            [*foot, 0, 180, 0, None] if last else [names[n + 1], 0, 0, 0, 0, 180, 0, None, "End A"],
        ]
        inside = _inside(riser[run[0]])
        entry: dict[str, Any] = {
            "Name": names[n], "IncludeTorsion": False, "TopEnd": "End A",
            "LengthAndEndOrientations": "Explicit", "Representation": "Finite element",
            ENDS: ends,
            BENDING: [[upper, None] if n == 0 else [], [lower if last else stiff, None]],
            "LineType, Length, TargetSegmentLength": [
                [riser[k].name, riser[k].total_length, min(riser[k].total_length, most)]
                for k in run
            ],
            "ContentsMethod": "Uniform", "ContentsDensity": 1e-3 * (inside or 0.0),
            "IncludedInStatics": True, "StaticsStep1": "Catenary", "StaticsStep2": "Full statics",
        }  # fmt: skip
        if clay and _levels(deck, run[-1])[0] < seabed:
            entry["PyModel"] = clay
        deck.add("Lines", entry)


ENDS = (
    "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionAzimuth, ConnectionDeclination, "
    "ConnectionGamma, ConnectionReleaseStage, ConnectionzRelativeTo"
)
BENDING = "ConnectionxBendingStiffness, ConnectionyBendingStiffness"


def stiffness(rotation: Any) -> float:
    """Return the bending stiffness of an end (kN m/deg)."""
    if rotation in (None, "free"):
        return 0.0
    return math.inf if rotation == "fixed" else 1e-3 * rotation.stiffness * math.pi / 180.0
