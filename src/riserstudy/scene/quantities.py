"""Quantities that runs return: the scenes that have each quantity, its limits and its estimated errors.

A new quantity requires an entry here, its label in ``dataset/variables.yaml``, and the code that computes it.
Limits, plots, figures, the report and the list of names that axes may not have use this table. The labels are
in another file, so that a study need not simulate its points again when a label changes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from riserstudy.scene.analysis import Analysis
    from riserstudy.scene.disconnect import Disconnect
    from riserstudy.scene.ends import Bottom, Top
    from riserstudy.scene.forcing import Platform
    from riserstudy.scene.riser import Section
    from riserstudy.scene.vessel import Vessel
    from riserstudy.scene.water import Water


class _SceneParts(Protocol):
    """The parts of a scene that decide which quantities its runs return."""

    @property
    def riser(self) -> Sequence[Section]: ...
    @property
    def bottom(self) -> Bottom: ...
    @property
    def top(self) -> Top: ...
    @property
    def gravity(self) -> float | None: ...
    @property
    def water(self) -> Water | None: ...
    @property
    def platform(self) -> Platform | None: ...
    @property
    def vessel(self) -> Vessel | None: ...
    @property
    def disconnect(self) -> Disconnect | None: ...
    @property
    def fatigue(self) -> object | None: ...
    @property
    def analysis(self) -> Analysis: ...
    @property
    def lateral(self) -> str: ...
    @property
    def spatial(self) -> str: ...
    @property
    def drains(self) -> bool: ...


@dataclass(frozen=True)
class Quantity:
    """A quantity of runs."""

    # fields of the scene that the quantity requires. Absent: every scene has the quantity
    needs: str = ""
    is_in: Callable[[_SceneParts], bool] = lambda _: True  # whether a scene has these fields
    # SI unit that the text of a limit is converted to. Absent: the quantity has no limits
    limit_unit: str = ""
    # whether runs return its largest and smallest values at every node along the riser
    along: bool = False
    # quantity along the riser of which it is the value at the riser's lower end
    at_foot_of: str = ""
    # whether runs return it over the riser or time; if not, runs return one number
    is_array: bool = True
    history: bool = True  # whether runs return it over time
    at_rest: bool = True  # whether runs also return its value at rest
    of_beam: bool = False  # whether ``analysis.solver: hermite`` also returns it
    sign_is_convention: bool = False  # if so, a limit applies to the magnitude
    # names of the estimated errors that cover it
    errors: tuple[str, ...] = ("displacement",)

    def lacks(self, scene: _SceneParts) -> str:
        """What a scene lacks for the quantity; empty if its runs return it."""
        if scene.analysis.solver and not self.of_beam:
            return "lumped masses (without analysis.solver)"
        return "" if self.is_in(scene) else self.needs

    @property
    def endings(self) -> tuple[str, ...]:
        """Endings of the quantity's name in the arrays of runs; without an ending, it is the quantity."""
        sizes = ("_absmax",) if self.along and self.sign_is_convention else ()
        return (
            "",
            *(("_static",) if self.at_rest else ()),
            *(("_max", "_min") if self.along else ()),
            *sizes,
        )


def wall_lacks(scene: _SceneParts, section: Section) -> list[str]:
    """Fields of the scene that are missing for the stress of a section's wall; empty if none is missing.

    The pressure of the contents is known only below an unbroken column: a section without contents breaks it.
    """
    names = [one.name for one in scene.riser]
    filled = [k for k, one in enumerate(scene.riser) if one.contents]
    between = range(names.index(section.name) + 1, max(filled, default=-1))
    gaps = [names[k] for k in between if k not in filled]
    return range_lacks(scene, section) + [f"contents of section {name!r}" for name in gaps]


def range_lacks(scene: _SceneParts, section: Section) -> list[str]:
    """Fields missing for the range of a wall's stress over time; constant pressure does not change it."""
    lacks = [
        f"{name} of section {section.name!r}"
        for name in ("outer_diameter", "inner_diameter")
        if not getattr(section, name)
    ]
    if scene.water is not None:
        lacks += [] if section.contents else [f"contents of section {section.name!r}"]
        lacks += ["water.surface"] if scene.water.surface is None else []
        lacks += ["gravity"] if scene.gravity is None else []
    return lacks + (["constant contents, which drain here"] if scene.drains and section.contents else [])


def _bends(scene: _SceneParts) -> bool:
    """Whether a riser has bending moments; with a section without bending stiffness, it is a string."""
    return bool(scene.lateral) and all(section.elasticity[1] > 0.0 for section in scene.riser)


def _has_upper_angle(scene: _SceneParts) -> bool:
    held = scene.top.x == "held" or (scene.platform and scene.top.x == "platform")
    return bool(scene.lateral and (held or (scene.vessel and _bends(scene))))


def _has_lower_angle(scene: _SceneParts) -> bool:
    if scene.analysis.solver and scene.analysis.duration is None:  # the beam returns it over time alone
        return False
    joint = _bends(scene) and any(section.flex_joint_below for section in scene.riser)
    return bool(scene.lateral and (scene.bottom.hold == "wellhead" or joint))


def _has_stroke(scene: _SceneParts) -> bool:
    top = scene.top
    below = scene.platform and top.z == "free"
    return bool(scene.analysis.duration and (top.tensioners or top.telescopic_joint or below))


def _of_vessel(*parts: str, spatial: bool = False) -> Callable[[_SceneParts], bool]:
    """Test of a scene for a vessel with some parts; with ``spatial``, also for motion out of the plane."""

    def is_in(scene: _SceneParts) -> bool:
        there = all(getattr(scene.vessel, part) for part in parts) if scene.vessel else False
        return bool(there and (scene.spatial or not spatial))

    return is_in


def _with_platform(is_in: Callable[[_SceneParts], bool]) -> Callable[[_SceneParts], bool]:
    return lambda scene: bool(scene.platform and is_in(scene))


def _yaw_of_thrusters(scene: _SceneParts) -> bool:
    thrusters = scene.vessel.thrusters if scene.vessel else None
    return bool(thrusters and thrusters.yaw and _of_vessel("yaw", spatial=True)(scene))


def _disconnects(scene: _SceneParts) -> bool:
    return scene.disconnect is not None


def _moving(needs: str, is_in: Callable[[_SceneParts], bool], error: str = "displacement") -> Quantity:
    """A quantity over time only, without limits."""
    return Quantity(needs, is_in, at_rest=False, errors=(error,))


_OUT = "load or motion out of the plane"
_ACROSS = "bending stiffness of every section, and a load across"

QUANTITIES: dict[str, Quantity] = {
    "effective_tension": Quantity(limit_unit="N", along=True, of_beam=True, errors=("tension",)),
    "bending_moment": Quantity(
        _ACROSS, _bends, "N*m", along=True, of_beam=True, sign_is_convention=True, errors=("moment",)
    ),
    "shear_force": Quantity(
        _ACROSS, _bends, "N", along=True, history=False, sign_is_convention=True, errors=("shear",)
    ),
    "von_mises_stress": Quantity(
        "section with diameters and contents, or no gravity or water.surface",
        lambda s: not all(wall_lacks(s, section) for section in s.riser),
        "N/m^2",
        along=True,
        history=False,
        errors=("moment", "tension"),
    ),
    "x": Quantity(
        "load or motion across",
        lambda s: bool(s.lateral),
        "m",
        along=True,
        of_beam=True,
        sign_is_convention=True,
    ),
    "y": Quantity(_OUT, lambda s: bool(s.spatial), "m", along=True, sign_is_convention=True),
    "z": Quantity(along=True, of_beam=True),
    "ufj_angle": Quantity(
        "load or motion across, and top.x that is held, on the platform or a vessel",
        _has_upper_angle,
        "rad",
        sign_is_convention=True,
        errors=("ufj_angle",),
    ),
    "lfj_angle": Quantity(
        "load or motion across, and a held lower end or a riser.flex_joint_below",
        _has_lower_angle,
        "rad",
        of_beam=True,
        sign_is_convention=True,
        errors=("lfj_angle",),
    ),
    "stroke": Quantity(
        "motion, and top.tensioners, top.telescopic_joint, or a platform below which top.z is free",
        _has_stroke,
        "m",
        at_rest=False,
        errors=("stroke",),
    ),
    "joint_stroke": Quantity(
        "top.telescopic_joint", lambda s: s.top.telescopic_joint is not None, "m", errors=("stroke",)
    ),
    "tensioner_stroke": Quantity(
        "top.tensioners", lambda s: s.top.tensioners is not None, "m", errors=("stroke",)
    ),
    "tensioner_force": Quantity(
        "top.tensioners", lambda s: s.top.tensioners is not None, "N", errors=("tensioner_force",)
    ),
    "lower_end_tension": Quantity(limit_unit="N", at_foot_of="effective_tension", errors=("tension",)),
    "largest_stress": Quantity(
        "analysis.output.stress_in",
        lambda s: bool(s.analysis.output and s.analysis.output.stress_in),
        "N/m^2",
        errors=("moment", "tension"),
    ),
    "overpull": Quantity(
        "disconnect", _disconnects, "N", is_array=False, history=False, at_rest=False, errors=("overpull",)
    ),
    "lmrp_clearance": Quantity(
        "disconnect", _disconnects, "m", is_array=False, history=False, at_rest=False, errors=("lift",)
    ),
    "damage_rate": Quantity(
        "fatigue", lambda s: s.fatigue is not None, history=False, at_rest=False, errors=("damage",)
    ),
    "lift": _moving("disconnect", _disconnects, "lift"),
    "lift_rate": _moving("disconnect", _disconnects, "lift"),
    "lift_aside": _moving("disconnect", _disconnects, "lift"),
    "platform_surge": _moving("vessel", _of_vessel()),
    "platform_speed_x": _moving("vessel", _of_vessel()),
    "riser_reaction_x": _moving("vessel", _of_vessel(), "tension"),
    "environment_force_x": _moving("vessel", _of_vessel()),
    "platform_speed_y": _moving(f"vessel with {_OUT}", _of_vessel(spatial=True)),
    "riser_reaction_y": _moving(f"vessel with {_OUT}", _of_vessel(spatial=True), "tension"),
    "environment_force_y": _moving(f"vessel with {_OUT}", _of_vessel(spatial=True)),
    "platform_sway": _moving("vessel.sway", _of_vessel("sway")),
    "platform_yaw": _moving("vessel.yaw", _of_vessel("yaw")),
    "low_frequency_surge": _moving("vessel with a platform", _with_platform(_of_vessel())),
    "low_frequency_speed_x": _moving("vessel with a platform", _with_platform(_of_vessel())),
    "low_frequency_sway": _moving("vessel.sway with a platform", _with_platform(_of_vessel("sway"))),
    "low_frequency_speed_y": _moving(
        f"vessel.sway with a platform, and {_OUT}", _with_platform(_of_vessel("sway", spatial=True))
    ),
    "thrust_x": _moving("vessel.thrusters", _of_vessel("thrusters")),
    "thrust_y": _moving(
        f"vessel.thrusters and vessel.sway with {_OUT}", _of_vessel("thrusters", "sway", spatial=True)
    ),
    "thrust_moment": _moving(f"vessel.thrusters.yaw with {_OUT}", _yaw_of_thrusters),
}
