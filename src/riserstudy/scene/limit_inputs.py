"""What the limits of a scene need of it: places that there are, and inputs that tell their outputs."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from riserstudy.scene.limits import Limit

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts
    from riserstudy.scene.riser import Section


def limits_fit(scene: Parts) -> None:
    """See that limits are at sections that there are.

    Raises
    ------
    ValueError
        Field, what was found and what is allowed.
    """
    names = [section.name for section in scene.riser]
    for k, limit in enumerate(scene.limits or []):
        try:
            limit.sections(names)
        except ValueError as fault:
            raise ValueError(f"limits[{k}].at: {fault}") from None
        if limit.output == "stroke" and scene.top.telescopic_joint:
            raise ValueError(
                f"limits[{k}].output: 'stroke' counts from the static state. Write 'joint_stroke', which "
                "counts from the joint's length"
            )


def wall_lacks(scene: Parts, section: Section) -> list[str]:
    """What the stress of a section's wall lacks, by the fields of the scene; empty where it is known."""
    lacks = [
        f"{name} of section {section.name!r}"
        for name in ("outer_diameter", "inner_diameter")
        if not getattr(section, name)
    ]
    if scene.water is not None:
        lacks += [] if section.contents else [f"contents of section {section.name!r}"]
        lacks += ["water.surface"] if scene.water.surface is None else []
        lacks += ["gravity"] if scene.gravity is None else []
    return lacks


def lacks(scene: Parts, limit: Limit) -> list[str]:
    """What a scene lacks for the output of a limit, by its fields; empty where it should be there."""
    name = limit.output
    if name == "von_mises_stress":
        names = limit.sections([section.name for section in scene.riser])
        return [
            lack
            for section in (scene.riser if limit.at else scene.riser_sections)
            if section.name in names
            for lack in wall_lacks(scene, section)
        ]
    needs: dict[str, tuple[str, Callable[[Parts], bool]]] = {
        "stroke": (
            "motion, and top.tensioners or a platform below which top.z is free",
            lambda s: bool(
                s.analysis.duration and (s.top.tensioners or (s.platform and s.top.z == "free"))
            ),
        ),
        "joint_stroke": ("top.telescopic_joint", lambda s: s.top.telescopic_joint is not None),
        "tensioner_stroke": ("top.tensioners", lambda s: s.top.tensioners is not None),
        "tensioner_force": ("top.tensioners", lambda s: s.top.tensioners is not None),
        "largest_stress": (
            "analysis.output.stress_in",
            lambda s: bool(s.analysis.output and s.analysis.output.stress_in),
        ),
        "overpull": ("disconnect", lambda s: s.disconnect is not None),
        "lmrp_clearance": ("disconnect", lambda s: s.disconnect is not None),
        "ufj_angle": ("top.x that is held, on the platform or a vessel", lambda s: bool(s.lateral)),
        "lfj_angle": ("a held lower end, or a riser.flex_joint_below", lambda s: bool(s.lateral)),
        "bending_moment": ("bending stiffness and a load across", lambda s: bool(s.lateral)),
        "shear_force": ("bending stiffness and a load across", lambda s: bool(s.lateral)),
    }
    field, given = needs.get(name, ("", lambda _: True))
    return [] if given(scene) else [field]
