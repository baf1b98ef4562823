"""What a tier costs and how far its numbers are off: the scenes behind published numbers at each accuracy.

Peaks are compared with those of the finest tier that ran, whose own error is the one it estimates.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import psutil
from numpy.typing import NDArray

from riserstudy.numerics.ablation import peaks
from riserstudy.numerics.attempt import Attempt, attempt, deciding, in_time
from riserstudy.numerics.scenes import Setting, case_file, in_tier
from riserstudy.scene.load import SceneFile
from riserstudy.study.measured import TiersStudy

if TYPE_CHECKING:
    import xarray as xr


PEAKS = ("displacement", "moment", "tension")
COSTS = ("wall_seconds", "elements", "step")
DEFAULT = "default"


def tiers(study: TiersStudy, setting: Setting) -> xr.Dataset:
    """Every scene at the accuracy of every tier, one after another: they are timed."""
    import xarray as xr

    scenes = in_tier(study.scenes, setting.tier)
    names = list(study.accuracies)
    shape = (len(scenes), len(names))
    cost = {name: np.full(shape, np.nan) for name in (*COSTS, "estimated")}
    peak = np.full((*shape, len(PEAKS)), np.nan)
    message = np.full(shape, "", object)
    for i, (name, case) in enumerate(scenes.items()):
        file = case_file(setting.config, name, case)
        once(file, study.accuracies[names[0]], 0.0)  # loads its kernels
        for k, of in enumerate(names):
            tried = once(file, study.accuracies[of], study.patience[setting.tier])
            message[i, k] = tried.message
            if tried.result is None:
                continue
            for key in COSTS:
                cost[key][i, k] = tried.result.facts.get(key, math.nan)
            cost["estimated"][i, k] = deciding(tried.result.facts.get("error_estimate", {}))
            peak[i, k] = peaks(tried.result)
    off = beside_finest(peak)
    data: dict[str, Any] = {name: (("scene", "tier"), values) for name, values in cost.items()}
    data["message"] = (("scene", "tier"), message.astype(str))
    of_peak = {"long_name": "largest size of the quantity, in its SI unit"}
    data["peak"] = (("scene", "tier", "quantity"), peak, of_peak)
    data["error"] = (("scene", "tier", "quantity"), off)
    dataset = xr.Dataset(data, {"scene": list(scenes), "tier": names, "quantity": list(PEAKS)})
    for name, (unit, words) in ABOUT.items():
        dataset[name].attrs = {"units": unit, "long_name": words}
    dataset.attrs["load_average"] = psutil.getloadavg()[0]
    return dataset


def beside_finest(peak: NDArray[np.float64]) -> NDArray[np.float64]:
    """Relative difference of peaks (scene, tier, quantity) from those of the finest tier that was run."""
    off = np.full_like(peak, np.nan)
    for of, change in zip(peak, off, strict=True):
        ran = np.flatnonzero(np.isfinite(of).any(axis=1))
        if len(ran):
            change[ran[:-1]] = np.abs(of[ran[:-1]] / of[ran[-1]] - 1.0)
    return off


def asked(file: SceneFile, accuracy: str) -> Any:
    """The scene with the accuracy of a tier."""
    values = None if accuracy == DEFAULT else accuracy
    return file.with_values({"analysis.accuracy": values}, "tiers").scene()


def once(file: SceneFile, accuracy: str, patience: float) -> Attempt:
    """One run, or what it is refused for."""
    return attempt(lambda: in_time(asked(file, accuracy), patience))


ABOUT = {
    "wall_seconds": ("s", "wall time with all refinements"),
    "elements": ("1", "segments"),
    "step": ("s", "time step"),
    "estimated": ("1", "error that the run estimates"),
    "error": ("1", "difference of the largest value from that of the finest tier that was run"),
}
