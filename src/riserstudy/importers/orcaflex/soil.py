"""Soil of an OrcaFlex text model: the p-y model of the line in the soil.

In OrcaFlex strain is in per cent, and soil has an effective density in place of a weight (P-y models: Data).
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from riserstudy.importers.orcaflex.deck import Part, q
from riserstudy.importers.orcaflex.pipe import lengths_of

MODELS, CURVES = "P-yModels", "PyCurves"
SOFT_CLAY = "API RP 2A soft clay"
# of the displacement at half the resistance: Matlock's curve begins infinitely stiff
STRAIGHT = 0.1
CLOSE = 1e-3  # m, of an end and the seabed


def soil_of(deck: Part, line: Part, seabed: float, gravity: float) -> dict[str, Any] | None:
    """Return the soil around a line below the seabed (m); None if the line has none.

    Raises InputError when a scene cannot describe it: sand, tables, several ranges of depth, a missing model.
    """
    name = _model(line)
    if name is None:
        return None
    models = {model.text("Name"): model for model in deck.parts(MODELS)}
    if name not in models:
        found = f"the model has no p-y model {str(name)!r}"
        allowed = f"use one of {', '.join(models)}" if models else "add a p-y model"
        raise line.refused("PyModel", found, allowed)
    curves = models[name].parts(CURVES)
    if len(curves) != 1 or curves[0].number("DepthBelowSeabedFrom"):
        allowed = (
            "give one range from 0 m, since the strength of clay in a scene is a straight line over depth; "
            "or remove PyModel from the line and write 'soil:' into the scene"
        )
        raise models[name].refused(CURVES, f"the p-y model has {len(curves)} ranges of depth", allowed)
    return {"mudline": q(seabed, "m"), "resistance": _soft_clay(curves[0], gravity)}


def same_soil(lines: list[Part], foot: float, seabed: float) -> None:
    """Check that all lines of a riser, from the lowest up, have one model of the soil where they are in it.

    ``foot``: elevation of the lower end (m). Raises InputError when a line has another one, or none.
    """
    lowest, level = _model(lines[0]), foot
    for line, above in pairwise(lines):
        level += sum(length for _, length in lengths_of(line))
        if level < seabed - CLOSE and _model(above) != lowest:
            found = f"the model is {_model(above) or 'none'}, but {lowest or 'none'} in the line below"
            allowed = "use one model for all lines below the seabed, since a scene has one soil"
            raise above.refused("PyModel", found, allowed)


def _model(line: Part) -> str | None:
    name = line.optional("PyModel")
    return None if name in (None, "(none)") else str(name)


def _soft_clay(curve: Part, gravity: float) -> dict[str, Any]:
    kind = curve.text("ModelType")
    if kind.lower() != SOFT_CLAY.lower():
        allowed = (
            f"use {SOFT_CLAY}, since the import converts no curves of sand and no tables; "
            "or remove PyModel from the line and write 'soil:' into the scene"
        )
        raise curve.refused("ModelType", f"the import cannot convert {kind}", allowed)
    density, strain = curve.number("EffectiveUnitSoilDensity"), curve.number("Epsilonc")
    curve.otherwise["ModelType"] = (
        "the curve is Matlock's cube root under static load, with a straight line "
        f"below {STRAIGHT:g} times the displacement at half the resistance"
    )
    return {
        "strength_at_mudline": q(curve.number("UndrainedShearStrength"), "kN/m^2"),
        "strength_gradient": "0 N/m^3",
        "submerged_unit_weight": {
            "derived": q(density * gravity, "kN/m^3"), "from": "EffectiveUnitSoilDensity and gravity",
        },
        "strain_at_half_strength": {"derived": 0.01 * strain, "from": "Epsilonc, which is in per cent"},
        "depth_factor": curve.number("J"),
        "straight_up_to": {"chosen": STRAIGHT, "because": "the curve begins infinitely stiff"},
    }  # fmt: skip
