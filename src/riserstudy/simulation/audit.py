"""Checks of a run: balance of energy, finite values, tension."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from riserstudy.errors import SimulationError, StepFailed
from riserstudy.records.arrays import FloatArray
from riserstudy.records.warning import warning
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.vessel import Coupling
from riserstudy.simulation.equilibrium import rounding
from riserstudy.solve.sums import HALVED, ITERATIONS, STEPS, Sums

if TYPE_CHECKING:
    from riserstudy.model.model import Model
    from riserstudy.records.facts import RunFacts

PLANE = 1e-6  # distance from a plane that counts as none, as a share of the distance within it
UNEXPLAINED = 1e-3  # largest energy residual without a warning, as a share of the energy exchanged


def terms_of_energy(model: Model, arrays: dict[str, FloatArray]) -> float:
    """Size of the terms of the stored energy (J): largest tension times largest coordinate of a node.

    Depending on the datum of elevations, their sum can be much smaller, but not its rounding error.
    ``arrays``: over the nodes, (n + 1,).
    """
    coordinates = model.s.r[:, : len(model.s.l0) + 1]
    return float(np.abs(arrays["effective_tension_static"]).max() * np.abs(coordinates).max())


def energy(facts: RunFacts, sums: Sums, before: float, after: float, step: float, terms: float) -> None:
    """Add the balance of energy (J) to the facts, with a warning if its residual is large: theory (11).

    ``before`` and ``after`` are the stored energies (J) at start and end; ``step`` is the time step (s).
    ``terms`` is the size of the terms of these energies (J), which their rounding errors depend on.
    """
    held, supplied, dissipated, numerical, exchanged = (float(x) for x in sums.work)
    residual = held + supplied - dissipated - numerical - (after - before)
    still = 1e-12 * max(abs(before), abs(after), terms, 1.0)  # rounding errors of a riser at rest (J)
    scale = max(exchanged, abs(after - before), still / UNEXPLAINED)
    facts["step"] = step
    facts["audit"] = {
        "work_of_supports": held,
        "work_of_water_and_devices": supplied,
        "dissipated": dissipated,
        "numerically_dissipated": numerical,
        "stored": after - before,
        "exchanged": exchanged,
        "unexplained": residual,
        "unexplained_share": abs(residual) / scale,
    }
    facts["steps"] = int(sums.count[STEPS])
    facts["newton_iterations"] = int(sums.count[ITERATIONS])
    facts["halved_steps"] = int(sums.count[HALVED])
    if abs(residual) > UNEXPLAINED * scale:
        text = (
            "energy: the balance does not account for {share:percent} of the energy exchanged; use a finer "
            "mesh and a shorter time step"
        )
        facts["warnings"].append(warning("energy_residual", text, {"share": abs(residual) / scale}))


def exchange(facts: RunFacts, coupling: Coupling) -> None:
    """Report the energy that the exchange adds, which is the work of the support with the vessel's motion.

    With a floating vessel, no other support moves.
    """
    audit = facts["audit"]
    made = audit.pop("work_of_supports")
    facts["audit"] = {"work_of_supports": 0.0, "made_by_exchange": made, **audit}
    if coupling.scheme == "staggered":
        share = abs(made) / max(audit["exchanged"], 1e-300)
        text = (
            "vessel.coupling: the staggered exchange of forces every {interval:g} s added {made:plain} kJ of "
            "spurious energy, {share:percent} of the energy exchanged; the estimated error does not include "
            "the error of this interval"
        )
        values = {"interval": coupling.interval, "made": made / 1e3, "share": share}
        facts["warnings"].append(warning("energy_of_the_coupling", text, values))


def finite(arrays: dict[str, FloatArray]) -> None:
    """Check that all values are finite; arrays have any shape and unit.

    Raises StepFailed if a value over time is not finite: an output between long steps may have a gas volume
    of zero. Raises SimulationError if a static value is not finite.
    """
    for name, values in arrays.items():
        if not np.isfinite(values).all():
            how = "in static equilibrium" if name.endswith("_static") else "although every step converged"
            error = SimulationError if name.endswith("_static") else StepFailed
            raise error(
                f"{int((~np.isfinite(values)).sum())} values of {name} are infinite or undefined {how}; "
                "use a smaller time step, and check stroke and gas volume"
            )


def tension(scene: Resolved, arrays: dict[str, FloatArray], facts: RunFacts) -> None:
    """Add the riser's smallest tension (N) to the facts, with a warning if it is negative.

    ``arrays``: over the nodes, (n + 1,).
    """
    along = arrays.get("effective_tension_min", arrays["effective_tension_static"])
    # excluded: stack and conductor, which stand on the seabed, and a telescopic joint, which slides
    ends = scene.borders
    s, slip = arrays["s_node"], 1e-9 * ends[-1]
    outside = (s < ends[scene.lowest_riser_section] - slip) | (s > ends[-1] + slip)
    k = int(np.where(outside, np.inf, along).argmin())
    facts["smallest_tension"] = float(along[k])
    facts["smallest_tension_s"] = float(arrays["s_node"][k])
    if along[k] < -rounding(scene) and (excluded := _excluded(arrays, facts["directions"])):
        text = (
            "effective tension decreases to {tension:newtons} at s = {s:.4g} m: a riser may go slack or "
            "buckle there, which this run does not simulate, because it excludes {excluded}"
        )
        values = {"tension": along[k], "s": arrays["s_node"][k], "excluded": excluded}
        facts["warnings"].append(warning("negative_tension", text, values))


def _excluded(arrays: dict[str, FloatArray], directions: int) -> str:
    """The motion that a run excludes; "" if a riser may buckle in every direction.

    In space, a riser that nothing moves out of one vertical plane stays in it, as in a model of this plane.
    """
    if directions == 1:
        return "lateral motion"
    if directions == 2 or _in_one_plane(arrays):
        return "motion out of its plane"
    return ""


def _in_one_plane(arrays: dict[str, FloatArray]) -> bool:
    """Whether the riser is in one vertical plane, at rest and at all outputs and stations."""
    places = [
        np.stack([arrays[f"x{end}"].ravel(), arrays[f"y{end}"].ravel()], axis=1)
        for end in ("_static", "")
        if f"x{end}" in arrays
    ]
    away = np.concatenate(places) - places[0][0]
    longest, aside = np.linalg.svd(away, compute_uv=False)
    return bool(aside <= PLANE * longest)
