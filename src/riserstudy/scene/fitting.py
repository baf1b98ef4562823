"""Whether the parts of a scene fit together: what needs what, and what excludes what."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.scene.alike import alike
from riserstudy.scene.analysis import MOST_PERIODS
from riserstudy.scene.fatigue import fatigue_fits
from riserstudy.scene.forcing import Shape
from riserstudy.scene.geometry import closes, covered
from riserstudy.scene.limit_inputs import limits_fit

if TYPE_CHECKING:
    from riserstudy.scene.disconnect import RecoilValve
    from riserstudy.scene.forcing import Platform
    from riserstudy.scene.parts import Parts


def fit(scene: Parts) -> None:
    """See that checked parts fit together.

    Raises
    ------
    ValueError
        The line of the scene, and what is allowed there.
    """
    _needs_water(scene)
    _viv(scene)
    _current_acts(scene)
    _sea(scene)
    _needs_gravity(scene)
    _needs_mass_and_time(scene)
    _needs_a_hold(scene)
    _bends_throughout(scene)
    _vessel_and_soil(scene)
    _ends(scene)
    _starts_gently(scene)
    _stations(scene)
    closes(scene)
    covered(scene)
    limits_fit(scene)
    fatigue_fits(scene)
    _disconnect(scene)
    _events(scene)


def _needs_water(scene: Parts) -> None:
    wet = [s for s in scene.riser if s.drag or s.tangential_drag or s.added_mass]
    if wet and scene.water is None:
        raise ValueError(f"riser section {wet[0].name!r} has drag or added mass: needs water")
    if scene.current and scene.water is None:
        raise ValueError("current needs water")


def _current_acts(scene: Parts) -> None:
    in_water = any(s.drag for s in scene.riser) or (scene.vessel and scene.vessel.hull_drag)
    if scene.current and not in_water:
        raise ValueError("current needs a riser section with drag, or a vessel with hull_drag")


def _needs_gravity(scene: Parts) -> None:
    if any(s.contents for s in scene.riser) and scene.gravity is None:
        raise ValueError("contents need gravity")
    rig = scene.top.tensioners
    if rig and rig.piston_mass and scene.gravity is None:
        raise ValueError("pistons need gravity")
    if any(body.displaced_volume is not None or body.density for body in scene.bodies) and (
        scene.gravity is None or scene.water is None
    ):
        raise ValueError("a body's displaced_volume or density needs gravity and water")


def _needs_mass_and_time(scene: Parts) -> None:
    if scene.analysis.duration and not (
        all(s.mass for s in scene.riser) or scene.top.body or scene.bottom.body
    ):
        raise ValueError("dynamics need mass: give every section its mass, or an end a body")
    if scene.top.tension_loss and scene.analysis.duration is None:
        raise ValueError("top.tension_loss needs analysis.duration: statics are before it")


def _needs_a_hold(scene: Parts) -> None:
    if scene.bottom.hold == "free" and scene.top.z == "free" and not scene.top.tensioners:
        raise ValueError("both ends are free: hold one, or hang the top on tensioners")
    if scene.lateral and scene.top.x is None:
        raise ValueError(f"top.x is needed, because of {scene.lateral}")
    if scene.top.z != "free" and scene.bottom.hold == "free" and scene.top.elevation is None:
        raise ValueError("a riser that hangs needs top.elevation")
    if scene.platform is None and "platform" in (scene.top.x, scene.top.z):
        raise ValueError("top is on the platform: needs platform")
    joint = scene.top.telescopic_joint
    if joint and joint.mid_stroke and scene.bottom.hold == "free":
        raise ValueError(
            "top.telescopic_joint.mid_stroke needs a lower end that is held; give the joint's length alone"
        )


def _bending(scene: Parts) -> list[bool]:
    """Whether each section has bending stiffness."""
    return [bool(s.young_modulus or s.bending_stiffness) for s in scene.riser]


def _bends_throughout(scene: Parts) -> None:
    bending = _bending(scene)
    if any(bending) and not all(bending):
        raise ValueError("riser: give bending stiffness to all sections or to none")
    damping = [s.structural_damping for s in scene.riser]
    if not alike(d.time if d else None for d in damping):
        raise ValueError("riser: structural_damping must be the same in all sections")
    if scene.top.telescopic_joint and not all(bending):
        raise ValueError("a telescopic_joint needs bending stiffness in the riser")


def _stations(scene: Parts) -> None:
    joint = scene.top.telescopic_joint
    length = sum(section.total_length for section in scene.riser) + (joint.length if joint else 0.0)
    stations = (scene.analysis.output and scene.analysis.output.stations) or []
    for s in stations:
        if not 0.0 <= s <= length * (1.0 + 1e-9):
            raise ValueError(
                f"analysis.output.stations: {s:g} m is not on the riser; "
                f"allowed is from 0 to {length:g} m"
            )


def _sea(scene: Parts) -> None:
    response = scene.platform and scene.platform.response
    if response and response.wave is None and scene.wave is None:
        raise ValueError("platform.response needs a wave, of its own or of the scene")
    levels = scene.water and None not in (scene.water.surface, scene.water.seabed)
    if scene.wave:
        if not levels:
            raise ValueError("wave needs water.surface and water.seabed")
        if scene.gravity is None:
            raise ValueError("wave needs gravity")
        if not any(s.drag or s.added_mass for s in scene.riser):
            raise ValueError("wave needs a riser section with drag or added mass")
        if any(s.added_mass and s.added_mass.direction for s in scene.riser):
            raise ValueError("a wave needs added_mass across the pipe: leave out its direction")
    if scene.current and scene.current.by_depth and (scene.water and scene.water.surface) is None:
        raise ValueError("current.profile: depths need water.surface")
    for part in scene.current.parts if scene.current else []:
        own = isinstance(part, Shape) and None not in (part.seabed, part.surface)
        if not own and not levels:
            raise ValueError("current.profile needs water.surface and water.seabed")


def _viv(scene: Parts) -> None:
    shedding = [s for s in scene.riser if s.viv]
    for section in shedding:
        if section.drag is None or section.drag.direction:
            raise ValueError(
                f"riser section {section.name!r}: viv needs drag across the pipe, which limits its amplitude"
            )
    if shedding and not scene.current and not scene.wave:
        raise ValueError("riser.viv needs water that flows past: a current or a wave")
    if shedding and scene.analysis.duration is None:
        raise ValueError("riser.viv needs analysis.duration: statics know no vortices")
    if shedding and scene.analysis.method == "explicit":
        raise ValueError("riser.viv: explicit stepping has no phases; take an implicit method")
    if any(s.viv.ramp is None for s in shedding if s.viv) and not scene.current:
        raise ValueError("riser.viv.ramp is needed where there is no current to take it from")
    for name in ("ramp", "seed"):
        if not alike(getattr(s.viv, name) for s in shedding):
            raise ValueError(f"riser.viv.{name} must be the same in all sections")


def _vessel_and_soil(scene: Parts) -> None:
    if (scene.vessel is None) != (scene.top.x != "vessel"):
        raise ValueError("vessel and 'top.x: vessel' go together")
    if scene.vessel and scene.platform:
        _first_order(scene, scene.platform)
    turning = scene.vessel and scene.vessel.yaw and scene.spatial
    if turning and scene.analysis.method == "explicit":
        raise ValueError(
            "vessel.yaw: explicit stepping does not know the forces of a turning hull; "
            "take an implicit method"
        )
    placed = scene.top.tensioners and scene.top.tensioners.arrangement
    for name in ("yaw", "coupling"):
        if placed and getattr(scene.vessel, name, None):
            raise ValueError(
                f"vessel.{name}: not simulated with top.tensioners.arrangement, whose cylinders pull at the "
                f"vessel; leave out vessel.{name} or the arrangement"
            )
    if scene.vessel and scene.vessel.coupling:
        scene.vessel.coupling.fits(scene.analysis)
        _exchange(scene)
    if scene.vessel and scene.vessel.hull_drag and scene.water is None:
        raise ValueError("vessel.hull_drag needs water")
    if (scene.bottom.hold == "foot") != (scene.soil is not None):
        raise ValueError("soil and 'bottom.hold: foot' go together")
    joints = [s for s in scene.riser if s.flex_joint_below]
    if joints and (not all(_bending(scene)) or len(joints) > 1 or scene.riser[0].flex_joint_below):
        raise ValueError(
            "flex_joint_below: one, between sections that bend; the lower end has bottom.rotation"
        )
    if scene.riser[0].guide_below and scene.bottom.hold != "free":
        raise ValueError("riser[0].guide_below: the bottom is held there; guide a section above")
    gauged = scene.analysis.output and scene.analysis.output.stress_in
    if gauged and gauged not in [s.name for s in scene.riser if s.young_modulus]:
        raise ValueError(
            f"analysis.output.stress_in: no section {gauged!r} with young_modulus and diameters"
        )


def _first_order(scene: Parts, platform: Platform) -> None:
    """Beside a vessel, which keeps its heading, a platform has first-order motion alone."""
    remedies: dict[str, tuple[object, str]] = {
        "platform.cruise": (platform.cruise, "the vessel finds its own way; leave the cruise out"),
        "vessel.yaw": (
            scene.vessel and scene.vessel.yaw,
            "first-order motions are those of the heading at rest; leave out vessel.yaw or the platform",
        ),
        "vessel.coupling": (
            scene.vessel and scene.vessel.coupling,
            "first-order motions are not exchanged in turns; leave out vessel.coupling or the platform",
        ),
        "analysis.method: explicit": (
            scene.analysis.method == "explicit",
            "explicit steps have no first-order motions; take an implicit method",
        ),
    }
    for way, remedy in (("surge", "give top.offset"), ("sway", "leave it out")):
        there = platform.position and getattr(platform.position, way)
        remedies[f"platform.position.{way}"] = (there, f"the vessel rests at top.offset; {remedy}")
    for line, (there, remedy) in remedies.items():
        if there:
            raise ValueError(f"{line}: does not go with a vessel and a platform: {remedy}")


def _ends(scene: Parts) -> None:
    """A step that is chosen is a share of the shortest period: more of these than any run could end with."""
    duration, shortest = scene.analysis.duration, scene.shortest_period
    if duration is None or shortest is None or scene.analysis.step is not None:
        return
    if duration / MOST_PERIODS > shortest:
        raise ValueError(
            f"analysis.duration {duration:g} s holds more than {MOST_PERIODS} periods of {shortest:g} s, the "
            "shortest of platform and waves; take a shorter duration or a longer period"
        )


def _starts_gently(scene: Parts) -> None:
    """Accuracy is not asked for where an end starts with a speed.

    It sends waves of all lengths along the riser: what is not damped is nothing to refine to.
    """
    a = scene.analysis
    chosen = a.duration is not None and a.mesh is None and any(s.mass for s in scene.riser)
    damped = all(s.structural_damping for s in scene.riser)
    later = a.output and a.output.start
    release = scene.disconnect
    if release and release.over is None and chosen and not damped:
        raise ValueError(
            "disconnect lets go at once: tensions of an undamped riser then have no peak that a finer "
            "mesh and step would settle; give disconnect.over, structural_damping, or analysis.mesh and "
            "step"
        )
    if scene.platform is None or not chosen or (damped and later):
        return
    for line, motion in scene.platform.sudden:
        if (scene.top.z if motion == "heave" else scene.top.x) in ("platform", "vessel"):
            raise ValueError(
                f"platform.{line} starts from rest with a speed: moments and tensions then have no "
                "peaks that a finer mesh and step would settle; give it a ramp, or "
                "structural_damping and a later analysis.output.start, or analysis.mesh and step"
            )


def _exchange(scene: Parts) -> None:
    """What is exchanged is the force of the string's end: nothing else may act there across."""
    top = scene.top
    if top.telescopic_joint:
        return
    for name in ("body", "lateral_force", "tensioners"):
        if getattr(top, name) is not None:
            raise ValueError(
                f"vessel.coupling: top.{name} acts on the platform beside the riser; put a "
                "telescopic_joint between, or leave coupling out"
            )


def _disconnect(scene: Parts) -> None:
    release = scene.disconnect
    if release is None:
        return
    if scene.bottom.hold != "wellhead":
        raise ValueError("disconnect needs 'bottom.hold: wellhead', which lets go")
    if scene.bottom.body and scene.bottom.body.reach:
        raise ValueError("disconnect needs a body at a point: leave out bottom.body's reach")
    if release.valve and (scene.top.tension is None or scene.top.tension_loss):
        raise ValueError("disconnect.valve needs top.tension, without a tension_loss of its own")
    if release.recoil_valve:
        _throttled(scene, release.recoil_valve)
    if release.drain:
        _drains(scene)


def _throttled(scene: Parts, valve: RecoilValve) -> None:
    """A recoil valve has gas behind it, and bottles that are part of it."""
    rig = scene.top.tensioners
    gas = rig.pulling if rig else None
    if rig is None or gas is None or rig.linearised:
        raise ValueError(
            "disconnect.recoil_valve needs tensioners with gas or two_chamber_gas, not linearised"
        )
    if valve.failed and max(valve.failed) >= rig.count:
        raise ValueError(
            f"disconnect.recoil_valve.failed: {valve.failed} of {rig.count} cylinders; they count from 0"
        )
    if valve.isolation and not valve.isolation.volume < gas.volume:
        raise ValueError(
            f"disconnect.recoil_valve.isolation.volume {valve.isolation.volume:g} m^3 leaves none of the "
            f"{gas.volume:g} m^3 of a cylinder's gas"
        )


def _drains(scene: Parts) -> None:
    """Contents that run out are one column from the lower end upwards, under a sea of known level."""
    filled = [s for s in scene.riser if s.contents]
    if not filled or any(s.contents for s in scene.riser[len(filled) :]):
        raise ValueError("disconnect.drain needs contents in sections from the lowest one upwards")
    inside = [s.contents for s in filled if s.contents]
    same = alike(c.density for c in inside) and alike(c.level for c in inside)
    if not (same and alike(s.inner_diameter for s in filled)):
        raise ValueError(
            "disconnect.drain needs the same contents and bore in all sections with contents"
        )
    if scene.water is None or scene.water.surface is None:
        raise ValueError(
            "disconnect.drain needs water.surface: the sea stands against the contents"
        )


def _events(scene: Parts) -> None:
    """What happens at a time of the run does so before its end, in a march that can stop for it."""
    a, rig = scene.analysis, scene.top.tensioners
    if rig and rig.failing and a.duration is None:
        raise ValueError("top.tensioners.failing needs analysis.duration: statics are before it")
    if not scene.events:
        return
    label = "disconnect" if scene.disconnect else "top.tension_loss or tensioners.failing at once"
    if a.duration is None or not scene.events[-1] < a.duration:
        raise ValueError(
            f"{label} at {scene.events[-1]:g} s: must be before the end of analysis.duration"
        )
    if a.method == "explicit" or a.solver:
        raise ValueError(f"{label} needs an implicit method of lumped masses")
    if scene.vessel and scene.vessel.coupling:
        raise ValueError(f"{label} does not go with vessel.coupling; leave coupling out")
