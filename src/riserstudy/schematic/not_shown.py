"""Names of the parts of a scene that its schematic does not show: no part is omitted without notice."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import BaseModel

from riserstudy.scene.resolve import Resolved

#: parts of a scene that are drawn, or named in the label of a drawn part, by section
DRAWN = {
    "water": "density surface seabed",
    "current": "profile heading headings",
    "wave": "amplitude height period significant_height peak_period heading",
    "soil": "mudline resistance",
    "bottom": "hold elevation rotation body",
    "top": "x z elevation offset rotation body tension lateral_force telescopic_joint tensioners",
    "platform": "surge sway heave roll pitch yaw position response cruise centre_of_rotation",
    "vessel": "mass added_mass sway yaw wind wave_drift thrusters",
    "riser": "name length joints outer_diameter inner_diameter axial_stiffness bending_stiffness mass "
    "contents submerged_weight drag added_mass viv tangential_drag lateral_load flex_joint_below guide_below",
}
#: materials and numerical settings of sections, which cannot be drawn
NOTHING_TO_DRAW = {
    "current": "beyond ramp",
    "wave": "above_mean_level components peak_enhancement phase ramp seed",
    "soil": "damping",
    "vessel": "coupling heading",
    "riser": "young_modulus shear_modulus wall_density structural_damping buoyancy_lift",
}


def _paths(by_section: dict[str, str]) -> frozenset[str]:
    return frozenset(f"{name}.{part}" for name, parts in by_section.items() for part in parts.split())


DRAWN_PARTS = _paths(DRAWN)
NO_PART = _paths(NOTHING_TO_DRAW) | {"title", "paper", "note", "limits", "analysis", "gravity"}


def parts_left_out(scene: Resolved) -> list[str]:
    """Return the parts of a scene, by their names in the file, that its schematic neither draws nor names."""
    return [path for path in dict.fromkeys(_parts(scene)) if path not in DRAWN_PARTS | NO_PART]


def _parts(scene: Resolved) -> Iterator[str]:
    """Yield the parts of a scene to two levels: ``riser.drag`` if any section has a drag."""
    for name in type(scene).model_fields:
        value = getattr(scene, name)
        if value is None or name in DRAWN_PARTS | NO_PART:
            continue
        if not any(path.startswith(f"{name}.") for path in DRAWN_PARTS):  # no part of it is drawn
            yield name
            continue
        for part in value if isinstance(value, list | tuple) else [value]:
            if not isinstance(part, BaseModel):
                yield name
                continue
            for inner in type(part).model_fields:
                if getattr(part, inner) is not None:
                    yield f"{name}.{inner}"
