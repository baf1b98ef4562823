"""Explicit stepping: predicted and measured stable step.

The measured step is the longest one at which a small disturbance of every mode does not grow. It is found
to 0.6 % by halving a bracket around the prediction, with the engine's refusal of long steps switched off.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from chapters.numerics.models import LimitStudy, case_file, in_tier
from riserstudy.errors import SimulationError
from riserstudy.model.mesh import Mesh, even
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.run import EXPLICIT_BOUND
from riserstudy.simulation.stable_step import explicit_limit
from riserstudy.solve.evaluate import move_to
from riserstudy.solve.explicit import leapfrog
from riserstudy.solve.record import new_record
from riserstudy.solve.sums import DONE, new_sums
from riserstudy.study.measured import Setting

if TYPE_CHECKING:
    import xarray as xr


GROWN = 10.0  # ratio to the largest speed of a stable run; only unbounded growth exceeds it
BRACKET = (0.9, 1.1)  # ratios to the predicted step; the prediction is tried first
HALVINGS = 5  # of the bracket


def stable_step(study: LimitStudy, setting: Setting) -> xr.Dataset:
    """Compute and measure the stable step of every variant on every mesh."""
    import xarray as xr

    variants = in_tier(study.variants, setting.tier)
    most = max(len(variant.elements) for variant in variants.values())
    shape = (len(variants), most)
    values = {name: np.full(shape, np.nan) for name in ("elements", "predicted", "measured")}
    for i, (name, variant) in enumerate(variants.items()):
        for k, elements in enumerate(variant.elements):
            settings = {
                "analysis.method": "explicit",
                "analysis.accuracy": None,
                "analysis.mesh": {"elements": elements},
                "analysis.step": "0.1 ms",
                "analysis.duration": study.duration,
                "analysis.output": {"interval": study.duration},
            }
            scene = case_file(setting.config, name, variant).with_values(settings, name).resolved()
            mesh = even(scene, elements)
            predicted = limit(scene, mesh)
            values["elements"][i, k] = len(mesh.l0)
            values["predicted"][i, k] = predicted
            values["measured"][i, k] = predicted * measured(scene, mesh, predicted)
    dataset = xr.Dataset({name: (("variant", "mesh"), array) for name, array in values.items()})
    dataset = dataset.assign_coords(variant=list(variants))
    for name in ("predicted", "measured"):
        dataset[name].attrs = {"units": "s", "long_name": f"{name} stable step"}
    return dataset


def limit(scene: Resolved, mesh: Mesh) -> float:
    """The stable step that the engine predicts."""
    return explicit_limit(scene, settle(scene, mesh)[0])


def measured(scene: Resolved, mesh: Mesh, predicted: float) -> float:
    """Longest stable step found, divided by the predicted one; if outside the bracket, its nearer end."""
    low, high = BRACKET
    calm = speed(scene, mesh, 0.5 * predicted)
    if grows(scene, mesh, low * predicted, calm):
        return low
    if not grows(scene, mesh, high * predicted, calm):
        return high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if grows(scene, mesh, middle * predicted, calm):
            high = middle
        else:
            low = middle
    return low


def grows(scene: Resolved, mesh: Mesh, step: float, calm: float) -> bool:
    """Return whether the largest speed grows far beyond the largest speed ``calm`` (m/s) of a stable run."""
    return not speed(scene, mesh, step) <= GROWN * calm


def speed(scene: Resolved, mesh: Mesh, step: float) -> float:
    """Largest speed at the end of an explicit run (m/s), infinite if the run stops early."""
    model, _ = settle(scene, mesh)
    rng = np.random.default_rng(1)
    state = model.s
    # a small disturbance of every mode, from which the fastest mode can grow
    state.r[:] += 1e-9 * mesh.riser_length * rng.standard_normal(state.r.shape)
    move_to(model.programs, model.state, 0.0)
    steps = math.ceil((scene.analysis.duration or 0.0) / step)
    record = new_record([steps * step], [0], state)
    try:
        outcome: Any = leapfrog(
            model.programs,
            model.state,
            model.spare,
            step,
            steps,
            EXPLICIT_BOUND,
            model.fixed,
            record,
            new_sums(),
        )
    except SimulationError:
        return math.inf
    return float(np.abs(state.v).max()) if outcome == DONE else math.inf
