"""What a tier costs and how far its numbers are off: the scenes behind published numbers at each accuracy.

Peaks are compared with those of the finest tier, whose own error is the one it estimates.
"""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.numerics.ablation import peaks
from riserstudy.numerics.attempt import Attempt, attempt, deciding
from riserstudy.numerics.models import TiersStudy
from riserstudy.numerics.scenes import case_file, in_tier
from riserstudy.run import run
from riserstudy.scene.load import SceneFile

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study import Tier

PEAKS = ("displacement", "moment", "tension")
COSTS = ("wall_seconds", "elements", "step")
DEFAULT = "default"


def tiers(study: TiersStudy, config: Path, tier: Tier) -> xr.Dataset:
    """Every scene at the accuracy of every tier, one after another: they are timed."""
    import xarray as xr

    scenes = in_tier(study.scenes, tier)
    names = list(study.accuracies)
    shape = (len(scenes), len(names))
    cost = {name: np.full(shape, np.nan) for name in (*COSTS, "estimated")}
    peak = np.full((*shape, len(PEAKS)), np.nan)
    message = np.full(shape, "", object)
    for i, (name, case) in enumerate(scenes.items()):
        file = case_file(config, name, case)
        attempt(lambda file=file: run(asked(file, study.accuracies[names[0]])))  # type: ignore[misc]
        for k, of in enumerate(names):
            tried = once(file, study.accuracies[of])
            message[i, k] = tried.message
            if tried.result is None:
                continue
            for key in COSTS:
                cost[key][i, k] = tried.result.facts.get(key, math.nan)
            cost["estimated"][i, k] = deciding(tried.result.facts.get("error_estimate", {}))
            peak[i, k] = peaks(tried.result)
    off = np.abs(peak / peak[:, -1:] - 1.0)
    off[:, -1] = np.nan
    data: dict[str, Any] = {name: (("scene", "tier"), values) for name, values in cost.items()}
    data["message"] = (("scene", "tier"), message.astype(str))
    data["peak"] = (("scene", "tier", "quantity"), peak)
    data["error"] = (("scene", "tier", "quantity"), off)
    dataset = xr.Dataset(data, {"scene": list(scenes), "tier": names, "quantity": list(PEAKS)})
    for name, (unit, words) in ABOUT.items():
        dataset[name].attrs = {"units": unit, "long_name": words}
    dataset.attrs["load_average"] = os.getloadavg()[0]
    return dataset


def asked(file: SceneFile, accuracy: str) -> Any:
    """The scene with the accuracy of a tier."""
    values = None if accuracy == DEFAULT else accuracy
    return file.with_values({"analysis.accuracy": values}, "tiers").scene()


def once(file: SceneFile, accuracy: str) -> Attempt:
    """One run, or what it is refused for."""
    return attempt(lambda: run(asked(file, accuracy)))


ABOUT = {
    "wall_seconds": ("s", "wall time with all refinements"),
    "elements": ("1", "segments"),
    "step": ("s", "time step"),
    "estimated": ("1", "error that the run estimates"),
    "error": ("1", "difference of the largest value from that of the finest tier"),
}
