"""One run of a scene with a given mesh and time step: statics, time stepping, outputs, audit.

The results are arrays in plain dictionaries; `dataset.label` labels them.
"""

from __future__ import annotations

import math
import time as clock
from typing import TYPE_CHECKING, Any

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError, StepFailed, TakesTooLong
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.model.space_out import joint_of
from riserstudy.model.warnings_of_scene import warnings_of
from riserstudy.records.arrays import Arrays
from riserstudy.records.seen import Seen
from riserstudy.scene.analysis import Output
from riserstudy.scene.at_rest import moves_at, unmoved
from riserstudy.scene.limits import ANGLES
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation import audit, outputs, vortex_vibration
from riserstudy.simulation.coupling import Sides, march_in_turns, sides_of
from riserstudy.simulation.disconnect import enter_lift, rows_of_limits
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.events import Marched, march_through
from riserstudy.simulation.extremes import extremes, peaks_that_count, within_peaks
from riserstudy.simulation.failure import why
from riserstudy.simulation.first_reached import first_reached
from riserstudy.simulation.phase_of_drift import lost_phase
from riserstudy.simulation.rest import Rest
from riserstudy.simulation.section_forces import derived, envelopes_of, section_of, shear_of
from riserstudy.simulation.start import begin
from riserstudy.simulation.step_peaks import room_for_steps, steps_of
from riserstudy.simulation.time_limit import Watch, share
from riserstudy.simulation.time_stepping import method_of, steps_in
from riserstudy.simulation.until import until_disconnect
from riserstudy.solve.evaluate import energies
from riserstudy.solve.explicit import leapfrog
from riserstudy.solve.program import Packed
from riserstudy.solve.sums import DONE, STOPPED, Sums, new_sums

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

MOST_WHOLE = 20_000_000  # largest number of values of one quantity at all nodes: 160 MB
EXPLICIT_BOUND = 1e12  # sum of squared velocities (m2/s2) that no riser reaches


def single(
    scene: Resolved, mesh: Mesh, step: float | None, everywhere: bool = False, watch: Watch | None = None
) -> Result:
    """One run with a given mesh and time step (s; None: static), without error estimate.

    Raises SimulationError when no equilibrium is found, or a value is not finite. Raises StepFailed when a
    step fails: time, node, effect and remedy. Raises TakesTooLong when the watch breaks the march off.

    Parameters
    ----------
    everywhere : whether histories are at all nodes, with the data for interpolation between nodes, instead of
        at the requested places.
    watch : reports progress and interrupts the run; absent: no reports and no time limit.
    """
    result = finish(scene, mesh, march(scene, mesh, step, everywhere, watch))
    stations = scene.analysis.output and scene.analysis.output.stations
    if stations and not everywhere:
        outputs.keep_stations(result, stations)
    return result


def march(
    scene: Resolved,
    mesh: Mesh,
    step: float | None,
    everywhere: bool = True,
    watch: Watch | None = None,
    rest: Rest | None = None,
    extremes: bool = True,
) -> Result:
    """A run with a time step (s) as in `single`, without the outputs that `finish` derives afterwards.

    It has the outputs for a comparison with other runs. Raises SimulationError as `single` does.

    Parameters
    ----------
    rest : the scene at rest on the mesh; absent: it is computed.
    extremes : whether extremes of all outputs over all steps are computed; a run that is only compared needs
        those of displacement, tension, moment, and outputs of one place.
    """
    if scene.analysis.solver == "hermite":
        from riserstudy.simulation.hermite_run import solve_small_angle  # slow to load

        return solve_small_angle(scene, mesh, step)
    started = clock.perf_counter()
    vortex_vibration.since(scene)  # raises its errors before the statics
    if scene.fatigue:
        from riserstudy.simulation import fatigue_damage  # loads the library for cycle counting

        fatigue_damage.since(scene)
    rest = rest or Rest(scene, mesh)
    model, arrays, seen = rest.model, dict(rest.arrays), Seen()
    facts = _facts_at_rest(scene, mesh, rest)
    if scene.analysis.duration is not None and step is not None and scene.analysis.output:
        whole = everywhere or fits(scene.analysis.output, scene.analysis.duration, mesh)
        if scene.fatigue and not whole:
            raise fatigue_damage.too_large()
        histories, seen = in_motion(
            scene, model, mesh, step, whole, arrays, facts, watch or Watch(), extremes
        )
        arrays |= histories
        vortex_vibration.enter(scene, step, arrays, facts)
    audit.finite(arrays)
    audit.tension(scene, arrays, facts)
    if scene.fatigue:
        fatigue_damage.enter(scene, mesh, arrays, facts)
    if len(model.s.dof) - len(model.s.dim) == 3:
        arrays["mesh_moment_static"] = rest.moment
    facts["solve_seconds"] = clock.perf_counter() - started
    return Result(arrays, facts, seen)


def _facts_at_rest(scene: Resolved, mesh: Mesh, rest: Rest) -> RunFacts:
    """Facts of a run that are known before its first time step."""
    facts: RunFacts = {
        "effects": {e.name: e.because for e in rest.model.effects},
        "elements": len(mesh.l0),
        "directions": len(rest.model.s.dim),
        "statics_iterations": rest.iterations,
        "warnings": warnings_of(scene),
    }
    if scene.vessel:
        facts["coupling"] = {"scheme": "as one"}
    if scene.analysis.duration and math.isfinite(scene.lower_joint_until):
        facts["lower_joint_until"] = scene.lower_joint_until
    return facts


def finish(scene: Resolved, mesh: Mesh, result: Result) -> Result:
    """Add forces, stresses, extremes and warnings about strokes to a run of `march`."""
    started = clock.perf_counter()
    arrays, facts, seen = result.arrays, result.facts, result.seen
    if scene.fatigue:
        from riserstudy.simulation.fatigue_damage import refuse_coarse

        refuse_coarse(scene, facts)
    if rig := scene.top.tensioners:
        facts["warnings"] += outputs.of_tensioners(rig, arrays, seen.steps)
        if "tensioner_stroke" in arrays:
            facts["largest_stroke"] = float(abs(arrays["tensioner_stroke"]).max())
    if joint := joint_of(scene):
        facts["warnings"] += outputs.of_joint(joint, arrays, seen.steps)
    facts["warnings"] += lost_phase(scene, arrays)
    facts |= outputs.peaks(arrays)
    arrays |= outputs.sizes(arrays)
    if scene.analysis.solver != "hermite":
        forces, histories_of = derived(scene, mesh, arrays, arrays.pop("mesh_moment_static", None))
        arrays |= forces
        of_limits = rows_of_limits(scene, facts)
        facts["extremes"] = extremes(scene, mesh, arrays, histories_of, seen) + of_limits
        if scene.disconnect and "time" in arrays:
            facts["extremes_connected"] = _extremes_connected(scene, mesh, arrays, histories_of, seen)
            facts["extremes_connected"] += of_limits
        if scene.limits and "time" in arrays:
            found = first_reached(scene, mesh, arrays, histories_of, seen.steps)
            facts["limits_reached"] = [one.time for one in found]
            facts["limits_reached_error"] = [one.error for one in found]
    facts["solve_seconds"] += clock.perf_counter() - started
    kept = {"time", *seen.rotations}
    steps = {name: values for name, values in seen.steps.items() if name in kept}
    result.seen = Seen(steps=steps, rotations=seen.rotations)
    return result


def _extremes_connected(
    scene: Resolved, mesh: Mesh, arrays: Arrays, histories: Arrays, of: Seen
) -> list[dict[str, Any]]:
    """Rows of extremes until the disconnect of a scene."""
    arrays, histories, seen = until_disconnect(scene, arrays, histories, of)
    seen.peaks = peaks_that_count(scene, seen) if "time" in seen.steps else {}
    return extremes(scene, mesh, arrays, histories, seen)


def fits(output: Output, duration: float, mesh: Mesh) -> bool:
    """Whether histories at all nodes over a duration (s), from which stresses follow, fit into memory."""
    return len(mesh.s) * (duration / output.interval + 1.0) <= MOST_WHOLE


def in_motion(
    scene: Resolved,
    model: Model,
    mesh: Mesh,
    step: float,
    whole: bool,
    arrays: Arrays,
    facts: RunFacts,
    watch: Watch,
    judged: bool,
) -> tuple[Arrays, Seen]:
    """Histories and envelopes of a model that starts from rest, and peaks over all time steps.

    The audit is added to the facts. ``whole``: histories at all nodes, else at the nodes for the stations.
    ``judged``: with extremes of all outputs. ``step`` is in s; with ``vessel.coupling``, a whole fraction of
    the interval is used. Raises StepFailed when a step fails: time, node, effect and remedy. Raises
    TakesTooLong when the watch breaks the march off.
    """
    a = scene.analysis
    if a.duration is None or a.output is None:
        raise TypeError("a scene without time")  # asked before
    of = outputs.wanted(arrays, None if whole else a.output.stations)
    coupling, sides = scene.vessel and scene.vessel.coupling, None
    sums = new_sums()
    if coupling:
        steps = steps_in(coupling.interval, step)
        sides = sides_of(scene, model, steps)
        model, step = sides.riser, coupling.interval / steps
    else:
        step = a.duration / steps_in(a.duration, step)
    rest = outputs.positions(_in_calm_water(scene, model, mesh))
    begin(scene, model, mesh)
    section = section_of(scene, mesh, arrays) if judged else shear_of(arrays)
    room = room_for_steps(model, a.duration, step) if a.method != "explicit" else 0
    record = outputs.empty_record(arrays, model, a.output, a.duration, of, section, room)
    before, terms = sum(energies(model.programs, model.state)), audit.terms_of_energy(model, arrays)
    with watch.over(record.value, sums):
        end = _by_method(scene, model, sides, mesh, step, record, sums, facts)
    model = end.model
    if end.outcome == STOPPED:
        raise TakesTooLong(f"stopped with {100 * share(record.value):.2g} % of the outputs written")
    if end.outcome != DONE:
        raise StepFailed(why(model, mesh, sums))
    after = sum(energies(model.programs, model.state)) + end.taken
    audit.energy(facts, sums, before, after, step, terms)
    if coupling:
        audit.exchange(facts, coupling)
    histories = outputs.histories(arrays, model, record.value, of)
    histories |= outputs.over_time(scene, model, mesh, record.value, rest)
    seen = _seen(scene, model, mesh, record, rest, judged)
    histories |= envelopes_of(record.value)
    if judged and end.connected:
        seen.connected = outputs.envelopes(model, end.connected) | envelopes_of(end.connected)
    if judged:
        histories |= within_peaks(scene, histories, seen, ANGLES if len(model.s.dim) == 3 else ())
    enter_lift(scene, seen.steps or histories, facts)
    return histories, seen if judged else Seen(peaks=seen.peaks)


def _by_method(
    scene: Resolved,
    model: Model,
    sides: Sides | None,
    mesh: Mesh,
    step: float,
    record: Packed,
    sums: Sums,
    facts: RunFacts,
) -> Marched:
    """March through all time steps (s) by the scene's method.

    ``sides``: riser and platform of a scene with ``vessel.coupling``.
    """
    a = scene.analysis
    if a.duration is None:
        raise TypeError("a scene without time")  # asked before
    if sides and scene.vessel and scene.vessel.coupling:
        coupling = scene.vessel.coupling
        turn, _ = method_of(scene, mesh, step, len(sides.force.time) - 1)
        outcome, facts["coupling"] = march_in_turns(sides, coupling, turn, a.duration, record, sums)
        return Marched(model, outcome)
    if a.method == "explicit":
        from riserstudy.simulation.stable_step import explicit_limit  # slow to load

        facts["stable_step"] = explicit_limit(scene, model)
        return Marched(model, explicitly(model, step, facts["stable_step"], a.duration, record, sums))
    return march_through(scene, model, mesh, step, record, sums, facts)


def _seen(
    scene: Resolved, model: Model, mesh: Mesh, record: Packed, rest: outputs.AtRest, judged: bool
) -> Seen:
    """Values at all time steps, and their peaks; empty if not all steps were recorded."""
    seen = Seen()
    every_step = steps_of(record.value)
    if len(model.s.dim) == 3 and (judged or every_step):
        seen.rotations = outputs.rotations(scene, model, mesh, every_step or record.value)
    if not every_step:
        return seen
    series = outputs.over_time(scene, model, mesh, every_step, rest)
    seen.steps = {"time": every_step.time, **series}
    seen.peaks = peaks_that_count(scene, seen)
    return seen


def _in_calm_water(scene: Resolved, model: Model, mesh: Mesh) -> Model:
    """What strokes are counted from: the model at rest, its platform not displaced by its motions."""
    if not moves_at(model.s.platform[0], scene):
        return model
    return settle(unmoved(scene), mesh, len(model.s.dim))[0]


def explicitly(model: Model, step: float, limit: float, duration: float, record: Packed, sums: Sums) -> int:
    """March by the explicit method.

    Raises SimulationError when the time step (s) exceeds the stability limit.
    """
    if step > limit:
        raise SimulationError(
            f"analysis.step {step:.4g} s is above the stable step {limit:.4g} s of 'method: explicit' with "
            f"{len(model.s.l0)} segments; give a shorter step, fewer segments, or an implicit method"
        )
    count = steps_in(duration, step)
    return int(
        leapfrog(
            model.programs, model.state, model.spare, step, count, EXPLICIT_BOUND, model.fixed, record, sums
        )
    )
