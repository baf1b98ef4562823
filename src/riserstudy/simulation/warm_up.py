"""Compile every kernel: small models that together have all effects, by number of directions."""

from __future__ import annotations

from typing import Any

from riserstudy.effects.catalogue import catalogue
from riserstudy.model.layout import directions
from riserstudy.scene.load import SceneFile
from riserstudy.scene.models import Scene
from riserstudy.simulation.refine import run

Tree = dict[str, Any]

_SECTION: Tree = {
    "name": "all",
    "length": "100 m",
    "outer_diameter": "0.5 m",
    "inner_diameter": "0.4 m",
    "young_modulus": "200 GPa",
    "mass": "500 kg/m",
    "submerged_weight": "1 kN/m",
    "structural_damping": {"ratio": 0.01, "at_period": "10 s"},
}
_ALONG: Tree = {"tangential_drag": {"coefficient": 0.02, "diameter": "0.5 m"}}
_WET: Tree = {
    "lateral_load": "1 N/m",
    "drag": {"coefficient": 1.0, "diameter": "0.5 m"},
    "added_mass": {"coefficient": 1.0, "diameter": "0.5 m"},
    "contents": {"density": "1000 kg/m^3"},
}
_HALVES = [{"name": "below", "length": "50 m"}, {"name": "above", "length": "50 m"}]
_TABLE = [{"elevation": "40 m", "value": value} for value in (0.7, 1.2)]
_BY_DEPTH: Tree = _WET | {"drag": {"coefficient": _TABLE, "diameter": "0.5 m"}}
_BODY: Tree = {"name": "body", "mass": "10 t", "submerged_weight": "10 kN"}
_GAS: Tree = {"area": "0.1 m^2", "pressure": "50 bar absolute", "volume": "3 m^3", "exponent": 1.4}
_CHAMBER: Tree = {key: value for key, value in _GAS.items() if key != "exponent"}
_TWO: Tree = {
    "high": _CHAMBER,
    "low": _CHAMBER | {"pressure": "2 bar absolute"},
    "exponent": 1.4,
    "pistons": {"mass": "1 t", "counted": "each"},
}
_RIG: Tree = {
    "count": 4,
    "mid_stroke": "riser in equilibrium",
    "damping": "1 kN*s/m",
    "stroke": {"shortest": "-8 m", "longest": "8 m", "stop_stiffness": "1e7 N/m"},
}
_PLACES: Tree = {
    "ring_radius": "1 m",
    "deck_radius": "2 m",
    "deck_elevation": "110 m",
    "first_bearing": "0 deg",
}
_LOSS: Tree = {"share": 0.5, "at": "1 s", "over": "1 s"}
_CLAY: Tree = {
    "strength_at_mudline": "3 kPa",
    "strength_gradient": "1 kPa/m",
    "submerged_unit_weight": "6 kN/m^3",
    "strain_at_half_strength": 0.02,
    "depth_factor": 0.5,
    "straight_up_to": 0.1,
}
_SAND: Tree = {
    "friction_angle": "35 deg",
    "submerged_unit_weight": "10 kN/m^3",
    "initial_modulus": "20 MN/m^3",
    "loading": "cyclic",
}
_THRUST: Tree = {"gain": "10 kN/m", "command": "1 m", "lag": "1 s"}
_COUPLED: Tree = {"scheme": "iterated", "interval": "0.5 s"}
_TURNS: Tree = {
    "mass": "1e7 kg",
    "sway": {"added_mass": "1e7 kg"},
    "yaw": {"inertia": "1e10 kg*m^2"},
    "thrusters": _THRUST | {"yaw": {"gain": "1e8 N*m/rad"}},
    "coupling": _COUPLED,
}
_LET_GO: Tree = {
    "at": "0.4 s",
    "over": "0.1 s",
    "recoil_valve": {"oil_density": "900 kg/m^3", "opening": "1 m^2", "discharge": 0.7}
    | {"residual": 0.5, "over": "0.2 s"},
    "drain": {"friction": 0.02},
    "stack": {"stiffness": "10 MN/m"},
}
_HEAVE: Tree = {"amplitude": "1 m", "period": "10 s"}
_ANALYSIS: Tree = {
    "duration": "1 s",
    "output": {"interval": "0.15 s"},
    "mesh": {"elements": 4},
    "step": "0.1 s",
}


def scenes() -> dict[str, list[Scene]]:
    """Small scenes that together have every effect, by group of kernels."""
    linear: Tree = {"tension": "500 kN", "stiffness": "10 kN/m"}
    axial: Tree = {
        "title": "axial",
        "water": {"density": "1000 kg/m^3"},
        "riser": [_SECTION | _ALONG],
        "bottom": {"hold": "wellhead", "elevation": "0 m", "body": _BODY},
        "top": {"z": "free", "body": _BODY, "tensioners": _RIG | {"gas": _GAS}},
        "platform": {"heave": _HEAVE, "position": {"heave": "0.1 m"}},
        "analysis": _ANALYSIS,
    }
    points = [{"time": f"{t} s", "value": f"{0.01 * t} m"} for t in range(5)]
    planar = axial | {
        "title": "planar",
        "gravity": "9.81 m/s^2",
        "water": axial["water"] | {"seabed": "0 m", "surface": "90 m"},
        "wave": {"height": "1 m", "period": "8 s", "above_mean_level": "stretched"},
        "riser": [_SECTION | _WET | _ALONG | half for half in _HALVES],
        "bottom": axial["bottom"] | {"rotation": {"stiffness": "10 kN*m/deg"}},
        "top": axial["top"]
        | {"x": "platform", "rotation": "fixed", "tension": "100 kN", "tension_loss": _LOSS}
        | {"tensioners": _RIG | {"linear": linear}},
        "platform": {"surge": _HEAVE, "cruise": {"speed": "1 m/s"}, "heave": {"points": points}},
        "current": {
            "profile": [
                {"elevation": "0 m", "speed": "0 m/s"},
                {"elevation": "100 m", "speed": "1 m/s"},
            ]
        },
    }
    gas_in_plane = planar | {
        "riser": [_SECTION | _BY_DEPTH],
        "top": axial["top"] | {"x": "free", "lateral_force": "1 N"},
        "platform": axial["platform"],
        "bottom": axial["bottom"] | {"rotation": "fixed"},
        "disconnect": _LET_GO,
    }
    pistons = axial | {
        "gravity": "9.81 m/s^2",
        "top": axial["top"] | {"tensioners": _RIG | {"two_chamber_gas": _TWO}},
    }
    rows = [{"reach": f"{x} m", "force": f"{500 + 9 * x} kN"} for x in (-9, 0, 9)]
    tabulated = axial | {"top": axial["top"] | {"tensioners": _RIG | {"table": rows}}}
    linear_axial = axial | {"top": axial["top"] | {"tensioners": _RIG | {"linear": linear}}}
    spatial = planar | {
        "title": "spatial",
        "riser": [_SECTION | _BY_DEPTH | _ALONG | half for half in _HALVES],
        "top": {
            "x": "platform",
            "z": "platform",
            "elevation": "110 m",
            "rotation": {"stiffness": "10 kN*m/deg"},
            "telescopic_joint": {"length": "10 m", "bending_stiffness": "1e8 N*m^2"},
            "tensioners": _RIG | {"linear": linear, "failed": [0], "arrangement": _PLACES},
        },
        "platform": {"roll": {"amplitude": "1 deg", "period": "10 s"}, "heave": _HEAVE}
        | {"centre_of_rotation": {"elevation": "110 m"}, "cruise": {"speed": "1 m/s"}},
    }
    pitching = spatial | {
        "platform": {"pitch": {"amplitude": "1 deg", "period": "10 s"}}
        | {"centre_of_rotation": {"elevation": "110 m"}},
    }
    afloat = planar | {
        "title": "afloat",
        "riser": [
            _SECTION,
            _SECTION | _WET | {"name": "above", "flex_joint_below": {"stiffness": "90 kN*m/deg"}},
        ],
        "bottom": {"hold": "foot", "elevation": "-90 m"},
        "top": {
            "x": "vessel",
            "z": "held",
            "elevation": "120 m",
            "telescopic_joint": {"length": "10 m", "bending_stiffness": "1e8 N*m^2"}
            | {"tension": "500 kN"},
        },
        "platform": None,
        "vessel": {"mass": "1e7 kg", "thrusters": _THRUST, "coupling": _COUPLED},
        "soil": {"mudline": "0 m", "resistance": _CLAY},
        "analysis": _ANALYSIS | {"output": {"interval": "0.15 s", "stress_in": "above"}},
    }
    superposed: Tree = {
        "vessel": {"mass": "1e7 kg", "thrusters": _THRUST},
        "platform": {"surge": _HEAVE},
    }
    linear_soil = afloat | {"soil": {"mudline": "0 m", "resistance": {"stiffness": "1 MPa"}}}
    sandy = afloat | {"soil": {"mudline": "0 m", "resistance": _SAND}}
    across = {"current": planar["current"] | {"heading": "90 deg"}}
    twisted = [section | {"shear_modulus": "80 GPa"} for section in afloat["riser"]]
    turning = afloat | across | {"vessel": _TURNS, "riser": twisted}
    short = _ANALYSIS | {"duration": "1 ms", "step": "0.1 ms", "method": "explicit"}
    wavy = planar | {
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "free", "tension": "500 kN"},
        "riser": [{k: v for k, v in (_SECTION | _WET).items() if k != "structural_damping"}],
        "wave": planar["wave"] | {"above_mean_level": "none"},
        "platform": None,
        "analysis": _ANALYSIS | {"solver": "hermite"},
    }
    pipe = ("young_modulus", "outer_diameter", "inner_diameter", "structural_damping", "contents")
    string = {k: v for k, v in (_SECTION | _WET).items() if k not in pipe}
    slack = {
        "title": "string",
        "gravity": "9.81 m/s^2",
        "water": planar["water"],
        "riser": [string | _ALONG | {"axial_stiffness": "1 GN"}],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "platform", "z": "held", "elevation": "101 m"},
        "platform": {"surge": _HEAVE},
        "current": planar["current"],
        "analysis": _ANALYSIS,
    }
    adrift = slack | {
        "title": "adrift",
        "top": {"x": "vessel", "z": "held", "elevation": "101 m"},
        "platform": None,
        "vessel": {"mass": "1e7 kg", "thrusters": _THRUST, "coupling": _COUPLED},
    }
    groups = {
        "space": [_with_examples(spatial), turning, afloat | across | superposed],
        "plane": [
            _with_examples(planar),
            gas_in_plane,
            pitching,
            afloat,
            afloat | superposed,
            linear_soil,
            sandy,
            planar | {"analysis": short},
        ],
        "line": [
            axial,
            pistons,
            linear_axial,
            tabulated,
            axial | {"analysis": short},
            axial | {"analysis": _ANALYSIS | {"method": "ESDIRK4"}},
        ],
        "string": [slack, adrift, adrift | superposed],
        "hermite": [wavy],
    }
    return {name: [Scene.model_validate(s) for s in group] for name, group in groups.items()}


def _with_examples(tree: Tree) -> Tree:
    """A scene with what effects name as an example of what calls for them, in the directions that it has."""
    file = SceneFile("warm-up", tree, {})
    needed = directions(file.scene())
    for effect in catalogue().values():
        if effect.example:
            more = file.with_values(dict(effect.example), "examples of effects")
            file = more if directions(more.scene()) == needed else file
    return file.tree


def warm_up(group: str | None = None) -> None:
    """Run them, or those of one group."""
    for name, several in scenes().items():
        for scene in several if group in (None, name) else ():
            run(scene)
