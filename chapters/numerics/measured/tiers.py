"""Run times and errors of the tiers, for the scenes behind published numbers, at the tolerance of each tier.

A tier runs its own tolerance and the tolerances of coarser tiers. Peaks are compared with stored references.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import psutil
from numpy.typing import NDArray

from chapters.numerics.attempt import Attempt, attempt, in_time
from chapters.numerics.fixed_step import whole
from chapters.numerics.models import TiersStudy, case_file, in_tier
from chapters.numerics.reference.check import with_recomputed
from chapters.numerics.reference.converge import SMOOTH, converged, none
from chapters.numerics.reference.kept import Kept
from chapters.numerics.reference.store import NotUsed, Wanted, read
from riserstudy.advice.ablation import peaks
from riserstudy.dataset.describe import label_variables
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import HISTORIES, deciding
from riserstudy.simulation.refine import run
from riserstudy.study.measured import Setting

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.axes import Tier


PEAKS = ("displacement", "moment", "tension")
COSTS = ("wall_seconds", "elements", "step")
DEFAULT = "default"
STUDY = "tiers"  # folder of references
ENOUGH = 2e-4  # relative change that ends refinement, below the error of the finest tier


def tiers(study: TiersStudy, setting: Setting) -> xr.Dataset:
    """Run every scene at the tolerance of every tier, in sequence, because the runs are timed."""
    import xarray as xr

    scenes = in_tier(study.scenes, setting.tier)
    names = up_to(setting.tier, study)
    shape = (len(scenes), len(names))
    off = np.full((*shape, len(PEAKS)), np.nan)
    cost = {name: np.full(shape, np.nan) for name in (*COSTS, "estimated")}
    peak = np.full((*shape, len(PEAKS)), np.nan)
    message = np.full(shape, "", object)
    for i, (name, case) in enumerate(scenes.items()):
        file = case_file(setting.config, name, case)
        once(file, study.accuracies[names[0]], 0.0)  # loads kernels
        best, why = known(setting, name, file)
        for k, of in enumerate(names):
            tried = once(file, study.accuracies[of], study.patience[setting.tier])
            message[i, k] = tried.message or why
            if tried.result is None:
                continue
            for key in COSTS:
                cost[key][i, k] = tried.result.facts.get(key, math.nan)
            cost["estimated"][i, k] = deciding(tried.result.facts.get("error_estimate", {}))
            peak[i, k] = peaks(tried.result)
            off[i, k] = np.abs(peak[i, k] / best - 1.0)
    data: dict[str, Any] = {name: (("scene", "tier"), values) for name, values in cost.items()}
    data["message"] = (("scene", "tier"), message.astype(str))
    of_peak = {"long_name": "largest size of the quantity, in its SI unit"}
    data["peak"] = (("scene", "tier", "quantity"), peak, of_peak)
    data["error"] = (("scene", "tier", "quantity"), off)
    dataset = xr.Dataset(data, {"scene": list(scenes), "tier": names, "quantity": list(PEAKS)})
    label_variables(dataset, ABOUT)
    dataset.attrs["load_average"] = psutil.getloadavg()[0]
    return with_recomputed(dataset, setting, study.references, wanted(study, setting.config))


def up_to(tier: Tier, study: TiersStudy) -> list[Tier]:
    """Return a tier and all coarser tiers."""
    every = list(study.accuracies)
    return every[: every.index(tier) + 1]


def known(setting: Setting, name: str, file: SceneFile) -> tuple[NDArray[np.float64], str]:
    """Return the peaks of a scene's reference; if there is none, NaN and the reason."""
    try:
        kept = read(setting.config, STUDY, name, file.resolved())
    except NotUsed as error:
        return np.full(len(PEAKS), np.nan), str(error)
    if kept.result is None:
        return np.full(len(PEAKS), np.nan), kept.missing
    return np.array(peaks(kept.result)), ""


def wanted(study: TiersStudy, config: Path) -> Iterator[Wanted]:
    """Yield the reference of every scene."""
    for name, case in study.scenes.items():
        file = case_file(config, name, case)
        yield Wanted(name, file, partial(solved, name, file))


def solved(name: str, file: SceneFile) -> Kept:
    """Compute the reference of a scene, from the mesh and step that the default accuracy chooses."""
    first = attempt(lambda: run(whole(requested(file, DEFAULT))))
    if first.result is None:
        return none(name, file, first.message)
    kept = converged(name, file, first.result, replace(SMOOTH, enough=ENOUGH))
    if kept.result is None:
        return kept
    extremes = {name: a for name, a in kept.result.arrays.items() if name not in HISTORIES}
    extremes.pop("mesh_moment", None)
    return replace(kept, result=replace(kept.result, arrays=extremes))


def requested(file: SceneFile, accuracy: str) -> Any:
    """Return the scene with the tolerance of a tier."""
    values = None if accuracy == DEFAULT else accuracy
    return file.with_values({"analysis.accuracy": values}, "tiers").resolved()


def once(file: SceneFile, accuracy: str, patience: float) -> Attempt:
    """Make one run, or return the reason for its refusal."""
    return attempt(lambda: in_time(requested(file, accuracy), patience))


ABOUT = {
    "wall_seconds": ("s", "elapsed time with all refinements"),
    "elements": ("1", "segments"),
    "step": ("s", "time step"),
    "estimated": ("1", "estimated error of the run"),
    "error": ("1", "difference of the largest value from that of the reference"),
}
