"""A scene by the Hermite beam: small slopes, and the constant tension of the straight riser.

This is the papers' solution method, and an independent check of the lumped-mass engine, with which it shares
no code. Water is evaluated at the elevations of the static riser, stretched and inclined.
"""

from __future__ import annotations

import math
import time as clock
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.model.build import build
from riserstudy.model.current_jump import spread, up_to_surface
from riserstudy.model.hydrodynamics import wave_of
from riserstudy.model.layout import flexibility_of, stiffness
from riserstudy.model.mesh import Mesh, even
from riserstudy.model.sea import current_velocity, still_surface
from riserstudy.model.warnings_of_scene import warnings_of
from riserstudy.records.arrays import FloatArray
from riserstudy.records.warning import warning
from riserstudy.scene.analysis import Newmark
from riserstudy.scene.ends import Rotation
from riserstudy.scene.forcing import Translation
from riserstudy.scene.resolve import Resolved
from riserstudy.solve.hermite import dynamics, in_still_water, statics
from riserstudy.solve.hermite_beam import Beam, End, HermiteError, Motion, Response, Stepping, Waves

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

STIFFENING = 0.01  # relative change of the top tension from which on its omission causes a warning
# correction that ends an iteration (m); on fine elements, rounding errors are 1e-10
CORRECTION = 1e-8
#: effects of the lumped-mass engine that the beam also has; its waterline is that at rest
SUPPORTED = {
    *("axial elasticity", "bending", "flex joint", "clamp", "support", "weight", "line load", "inertia"),
    *("contents", "added mass", "drag", "current", "wave", "wave force", "waterline"),
    *("platform motion", "platform position", "constant tension", "lateral force"),
}
#: effects that the small-angle assumption excludes by definition
LARGE_ANGLES = {"foreshortening"}
AVERAGE_ACCELERATION = Newmark(beta=0.25, gamma=0.5)


def solve_small_angle(scene: Resolved, mesh: Mesh, step: float | None) -> Result:
    """One run of a scene as a tensioned beam, with a time step (s; None: static).

    It has histories at all nodes, and envelopes over the outputs. Raises SimulationError when the beam cannot
    represent the scene, is unstable, or a step fails.
    """
    started = clock.perf_counter()
    beam = beam_of(scene, mesh)
    undeflected = scene.analysis.start == "undeflected" and step is not None
    try:
        rest = statics(in_still_water(beam) if undeflected else beam)
        moving = _moving(scene, beam, step) if step else None
    except HermiteError as error:
        raise SimulationError(f"analysis.solver hermite: {error}") from None
    tension = np.append(beam.tension[:, 0], beam.tension[-1, 1])
    elevation = (scene.bottom.elevation or 0.0) + mesh.s
    arrays = {"s_node": mesh.s, "l0": mesh.l0, "zero_x": np.zeros(len(mesh.s)), "zero_z": elevation}
    values = {"x": rest.displacement, "z": elevation, "effective_tension": tension}
    for name, value in (values | {"bending_moment": rest.moment}).items():
        arrays[name + "_static"] = value
    lowest = int(tension.argmin())
    facts: RunFacts = {
        "effects": effects_of(scene),
        "elements": len(mesh.l0),
        "directions": 2,
        "warnings": warnings_of(scene),
        "smallest_tension": float(tension[lowest]),
        "smallest_tension_s": float(mesh.s[lowest]),
    }
    if moving is not None and step is not None and scene.analysis.output is not None:
        keep = moving.time >= (scene.analysis.output.start or 0.0) - 1e-9
        arrays |= _over_time(moving, keep, {"z": elevation, "effective_tension": tension})
        arrays["s"] = mesh.s
        facts |= {"step": step, "newton_iterations": moving.iterations}
        left_out = _stiffening(scene, mesh, rest.displacement, moving.displacement[keep]) / tension[-1]
        if left_out > STIFFENING:
            text = (
                "top.z is held: bending would change the top tension by about {change:.2g} %, which the "
                "Hermite beam does not include; use lumped masses"
            )
            facts["warnings"].append(warning("left_out_stiffening", text, {"change": 100 * left_out}))
    facts["solve_seconds"] = clock.perf_counter() - started
    return Result(arrays, facts)


def _over_time(
    moving: Response, keep: NDArray[np.bool_], constant: dict[str, FloatArray]
) -> dict[str, FloatArray]:
    """Histories (time, s) of the requested outputs, with their envelopes; some quantities are constant."""
    still = np.ones((int(keep.sum()), 1))
    histories = {name: still * values for name, values in constant.items()}
    histories |= {"x": moving.displacement[keep], "bending_moment": moving.moment[keep]}
    largest = {name + "_max": history.max(axis=0) for name, history in histories.items()}
    smallest = {name + "_min": history.min(axis=0) for name, history in histories.items()}
    angle = moving.rotation[keep, 0]
    return {"time": moving.time[keep], "lfj_angle": angle, **histories, **largest, **smallest}


def _stiffening(scene: Resolved, mesh: Mesh, rest: FloatArray, moving: FloatArray) -> float:
    """Largest change of tension (N) of a held top due to lateral motion, which a constant tension omits."""
    if scene.top.z == "free":
        return 0.0
    flexibility = sum(
        mesh.l0[mesh.section == k].sum() / stiffness(section).axial for k, section in enumerate(scene.riser)
    )
    longer = 0.5 * ((np.diff(moving) ** 2 - np.diff(rest) ** 2) / mesh.l0).sum(axis=-1)
    return float(np.abs(longer).max() / flexibility)


def beam_of(scene: Resolved, mesh: Mesh) -> Beam:
    """The beam of a scene on a mesh.

    Raises SimulationError when a beam with small slopes cannot represent the scene.
    """
    _refuse(scene)
    gravity = scene.gravity or 0.0
    density = scene.water.density if scene.water else 0.0
    n = len(mesh.l0)

    def per_segment(values: list[float]) -> FloatArray:
        return np.array(values)[mesh.section]

    sections = scene.riser
    weight = per_segment([(s.submerged_weight or 0.0) + s.contents_mass * gravity for s in sections])
    above = np.append(np.cumsum((weight * mesh.l0)[::-1])[::-1], 0.0)
    tension = (scene.top.tension or scene.top.held_at_tension or 0.0) - above
    displaced = [s.added_mass.displaced(density) if s.added_mass else 0.0 for s in sections]
    added = [m * (s.added_mass.coefficient if s.added_mass else 0.0)
             for m, s in zip(displaced, sections, strict=True)]  # fmt: skip
    drag = [0.5 * density * s.drag.constant * s.drag.diameter if s.drag else 0.0
            for s in sections]  # fmt: skip
    bending = per_segment([stiffness(s).bending for s in sections])
    load = per_segment([s.lateral_load or 0.0 for s in sections])
    dry = Beam(
        s=mesh.s,
        bending_stiffness=np.stack([bending, bending], axis=1),
        tension=np.stack([tension[:-1], tension[1:]], axis=1),
        mass=per_segment([(s.mass or 0.0) + s.contents_mass for s in sections]),
        added_mass=per_segment(added),
        drag=per_segment(drag),
        load=np.stack([load, load], axis=1).reshape(n, 2),
        bottom=End(rotation_stiffness=_spring(scene.bottom.rotation)),
        top=_top(scene),
    )
    wet = _wet_share(scene, mesh)
    dry = dry._replace(added_mass=wet * dry.added_mass, drag=wet * dry.drag)
    strain = dry.tension.mean(axis=1) / per_segment([stiffness(s).axial for s in sections])
    inertia = wet * per_segment([a + b for a, b in zip(displaced, added, strict=True)])
    return _wet(scene, dry, strain, inertia)


def _wet_share(scene: Resolved, mesh: Mesh) -> FloatArray:
    """Share of each segment below the surface, for an upright riser, (n,); 1 without a surface."""
    if scene.water is None or scene.water.surface is None:
        return np.ones(len(mesh.l0))
    below = scene.water.surface - (scene.bottom.elevation or 0.0) - mesh.s[:-1]
    return np.clip(below / mesh.l0, 0.0, 1.0)


def _wet(scene: Resolved, dry: Beam, strain: FloatArray, inertia: FloatArray) -> Beam:
    """The beam in water, evaluated at the elevations of the riser at rest."""
    elevation = (scene.bottom.elevation or 0.0) + np.append(0.0, np.cumsum((1.0 + strain) * np.diff(dry.s)))
    beam = dry
    if scene.current:
        z, velocity = current_velocity(scene.current, scene.water)
        if (surface := still_surface(scene)) is not None:
            z, velocity = up_to_surface(z, velocity, surface)
        z, (along, _) = spread(z, velocity, elevation)
        beam = dry._replace(current=lambda s: np.interp(np.interp(s, dry.s, elevation), z, along))
    if scene.wave is None or scene.water is None:
        return beam
    still = scene.analysis.start == "undeflected"
    x = statics(in_still_water(beam) if still else beam).displacement
    slope = np.gradient(x, dry.s)
    drop = np.append(0.0, np.cumsum(0.25 * (slope[1:] ** 2 + slope[:-1] ** 2) * np.diff(dry.s)))
    sea = wave_of(scene.wave, scene.water, scene.gravity or 0.0, np.ones(1))
    travel = _sign(scene.wave.heading)
    return beam._replace(
        waves=Waves(
            lambda s: _speeds(sea, np.interp(s, dry.s, elevation - drop)),
            inertia, sea.frequency, travel * sea.number, sea.phase, sea.ramp,
        )
    )  # fmt: skip


def _sign(heading: float | None) -> float:
    """1 for a heading along x, -1 for a heading against x."""
    return math.copysign(1.0, math.cos(heading or 0.0))


def effects_of(scene: Resolved) -> dict[str, str]:
    """Effects of the beam, with the reason for each.

    Raises SimulationError when the scene includes an effect that the beam does not have.
    """
    model = build(scene, even(scene, max(2, len(scene.riser))), ring_elevation=0.0, d=2)
    called = {effect.name: effect.because for effect in model.effects}
    for name, because in called.items():
        if name not in SUPPORTED | LARGE_ANGLES:
            raise SimulationError(
                f"analysis.solver hermite cannot simulate {name} ({because}); remove this effect from the "
                "scene, or remove analysis.solver"
            )
    return {name: because for name, because in called.items() if name in SUPPORTED}


def _refuse(scene: Resolved) -> None:
    """Refuse scenes that the beam cannot represent."""
    top, platform = scene.top, scene.platform
    if not top.telescopic_joint:  # which has no place on the mesh of a beam
        effects_of(scene)
    position = platform.position if platform else None
    reasons = {
        "riser without bending stiffness": not all(stiffness(s).bending for s in scene.riser),
        "riser.structural_damping": any(s.structural_damping for s in scene.riser),
        "vessel": scene.vessel,
        "soil": scene.soil,
        "drag coefficient over elevation": any(s.drag and s.drag.table for s in scene.riser),
        "tangential_drag": any(s.tangential_drag for s in scene.riser),
        "flex_joint_below": any(s.flex_joint_below for s in scene.riser),
        "bottom.hold: free": scene.bottom.hold == "free",
        "a body at an end": scene.bottom.body or top.body,
        "top.tensioners": top.tensioners,
        "top.telescopic_joint": top.telescopic_joint,
        "top.tension_loss": top.tension_loss,
        "a top without tension": not (top.tension or top.held_at_tension),
        "top.z on a platform that heaves": top.z == "platform" and platform and platform.heave,
        "platform.position.heave of the top": top.z == "platform" and position and position.heave,
        "platform.position.pitch": position and position.pitch,
        "analysis.start: unstretched": scene.analysis.start == "unstretched",
        "motion out of the plane": scene.spatial,
        "platform.pitch": platform and (platform.pitch or platform.response),
        "platform.cruise": platform and platform.cruise,
        "a time series as platform.surge": platform
        and platform.surge
        and not isinstance(platform.surge, Translation),
        "current.ramp": scene.current and scene.current.ramp,
        "a wave that acts above the mean level": scene.wave and scene.wave.above_mean_level != "none",
        "analysis.method that is not Newmark's": scene.analysis.method
        and not isinstance(scene.analysis.method, Newmark),
    }
    for name, there in reasons.items():
        if there:
            raise SimulationError(
                f"analysis.solver hermite cannot simulate {name}; remove this part from the scene, or remove "
                "analysis.solver"
            )


def _speeds(sea: Any, z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Amplitudes of horizontal and vertical velocity at elevations, (c, ...); zero above the mean level."""
    depth = sea.surface - z
    k = sea.number.reshape(-1, *(1 for _ in z.shape))
    speed = (sea.amplitude * sea.frequency).reshape(k.shape)
    under = np.maximum(depth, 0.0)
    near, far = np.exp(-k * under), np.exp(-k * (2.0 * sea.depth - under))
    wet = np.where(depth >= 0.0, speed / -np.expm1(-2.0 * k * sea.depth), 0.0)
    return wet * (near + far), wet * (near - far)


def _spring(rotation: Rotation | None) -> float:
    soft = flexibility_of(rotation)
    if soft is None:
        return 0.0
    return 1.0 / soft if soft > 0.0 else math.inf


def _top(scene: Resolved) -> End:
    top, platform = scene.top, scene.platform
    spring = _spring(top.rotation)
    if top.x == "free":
        return End(held=False, rotation_stiffness=spring, force=top.lateral_force or 0.0)
    surge = platform.surge if top.x == "platform" and platform else None
    return End(rotation_stiffness=spring, motion=_motion(_away(scene), surge))


def _away(scene: Resolved) -> float:
    """Horizontal position of the top at rest (m)."""
    top, platform = scene.top, scene.platform
    away = top.offset or 0.0
    if top.x == "platform" and platform and platform.position:
        away += platform.position.surge or 0.0
    return away


def _motion(away: float, surge: Any) -> Motion:
    def motion(times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        x, v, a = away + 0.0 * times, 0.0 * times, 0.0 * times
        if surge is not None:
            w = 2.0 * math.pi / surge.period
            p = math.pi / surge.ramp if surge.ramp else 0.0
            early = times < (surge.ramp or 0.0)
            grown = np.where(early, 0.5 * (1.0 - np.cos(p * times)), 1.0)
            rate = np.where(early, 0.5 * p * np.sin(p * times), 0.0)
            bend = np.where(early, 0.5 * p * p * np.cos(p * times), 0.0)
            sine, cosine = (f(w * times + (surge.phase or 0.0)) for f in (np.sin, np.cos))
            x = x + surge.amplitude * sine * grown
            v = surge.amplitude * (w * cosine * grown + sine * rate)
            a = surge.amplitude * (-w * w * sine * grown + 2.0 * w * cosine * rate + sine * bend)
        return x, v, a

    return motion


def _moving(scene: Resolved, beam: Beam, step: float) -> Response:
    """Newmark's method; Newton's iteration converges to the solution of the paper's iteration of the drag."""
    a = scene.analysis
    if a.duration is None or a.output is None:
        raise TypeError("a step without a duration")  # refused by the scene
    method = a.method if isinstance(a.method, Newmark) else AVERAGE_ACCELERATION
    count = math.floor(a.duration / a.output.interval * (1.0 + 1e-12) + 1e-9)
    return dynamics(
        beam,
        np.asarray(a.output.interval * np.arange(count + 1), np.float64),
        step,
        Stepping(method.beta, method.gamma, drag="newton", tolerance=CORRECTION),
        start="still water" if a.start == "undeflected" else "equilibrium",
    )
