"""The dataset of effects: change of results and run time by each in every kind of scene, compile times."""

from __future__ import annotations

import json
import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from chapters.numerics.models import EffectsStudy
from riserstudy.advice.ablation import Ablation, ablate
from riserstudy.advice.effect_cost import Cost, Freedom, costs, freedom
from riserstudy.dataset.describe import label_variables
from riserstudy.effects.catalogue import changes
from riserstudy.errors import InputError, RiserStudyError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle
from riserstudy.solve.kernel_cache import kernel_cache
from riserstudy.study.measured import Setting
from riserstudy.study.processes import each

if TYPE_CHECKING:
    import xarray as xr


WHERE = "config/studies/numerics.yaml"
QUANTITIES = ("displacement", "moment", "tension")


class Tried(NamedTuple):
    """Results for one scene."""

    ablation: Ablation
    costs: list[Cost]
    freedom: Freedom | None


def effects(study: EffectsStudy, setting: Setting) -> xr.Dataset:
    """Run every applicable change of every kind of scene of the chapters, and of the study's own scenes.

    As many scenes run in parallel as there are threads. The compared runs, which are the changes of one
    scene, run in sequence in one process, since other scenes or jobs run at the same time.

    Raises
    ------
    InputError
        When a change that a tier omits does not exist.
    """
    import xarray as xr

    _check(study)
    scenes = dict(study.scene_files(setting))
    of_tier = (study.repeats[setting.tier], study.budget[setting.tier])
    one = partial(_tried, *of_tier, study.left_out.get(setting.tier, []))
    outcomes = dict(zip(scenes, each(one, list(scenes.values()), setting.threads), strict=True))
    tried = {name: outcome for name, outcome in outcomes.items() if isinstance(outcome, Tried)}
    refused = {name: outcome for name, outcome in outcomes.items() if isinstance(outcome, str)}
    ablations = {name: outcome.ablation for name, outcome in tried.items()}
    spent = {name: outcome.costs for name, outcome in tried.items()}
    free = {name: outcome.freedom for name, outcome in tried.items() if outcome.freedom}
    dataset = xr.Dataset(_changed(ablations) | _cost(ablations, spent) | kernels(setting.compiled))
    dataset = dataset.assign_coords(scene=list(ablations), change=_labels())
    for key in ("base_seconds", "elements", "unknowns"):
        values = {
            "base_seconds": lambda n: ablations[n].seconds,
            "elements": lambda n: len(ablations[n].mesh.l0),
            "unknowns": lambda n: free[n].unknowns if n in free else 0,
        }[key]
        dataset[key] = ("scene", [values(name) for name in ablations])
    dataset["freedom"] = ("scene", [free[n].because if n in free else "" for n in ablations])
    label_variables(dataset, ABOUT)
    dataset.attrs = {"refused": json.dumps(refused)} | compiling(setting.compiled)
    return dataset


def _check(study: EffectsStudy) -> None:
    labels = _labels()
    for tier, names in study.left_out.items():
        for name in names:
            if name not in labels:
                where = f"measured.effects.left_out.{tier}"
                raise InputError(WHERE, where, name, f"allowed are {', '.join(labels)}")


def _tried(repeats: int, budget: float, left_out: list[str], file: SceneFile) -> Tried | str:
    """Run one scene with its changes, or return the reason why it cannot be run."""
    try:
        ablation = ablate(file, repeats, budget, left_out=left_out)
        scene = ablation.file.resolved()
        if scene.analysis.solver:
            return Tried(ablation, [], None)
        model = settle(scene, ablation.mesh)[0]
        return Tried(ablation, costs(scene, ablation.mesh, ablation.step), freedom(scene, model))
    except RiserStudyError as error:
        return str(error)


def _labels() -> list[str]:
    return [change.label for change in changes()]


def _changed(found: dict[str, Ablation]) -> dict[str, Any]:
    """Relative changes of peaks and run time by each change, and why some cannot be run."""
    labels = _labels()
    shape = (len(found), len(labels))
    change = {name: np.full(shape, np.nan) for name in (*QUANTITIES, "time")}
    faults = np.full(shape, "", object)
    for i, one in enumerate(found.values()):
        for changed in one.changed:
            at = (i, labels.index(changed.change.label))
            faults[at] = changed.fault
            if changed.peaks is None or one.peaks is None or changed.message:
                continue
            values = one.peaks.change_to(changed.peaks)
            for name, value in zip(QUANTITIES, values, strict=True):
                change[name][at] = value
            change["time"][at] = changed.seconds / one.seconds - 1.0
    dims = ("scene", "change")
    return {f"{name}_change": (dims, values) for name, values in change.items()} | {
        "fault": (dims, faults.astype(str)),
        "changed_effect": ("change", [change.name for change in changes()]),
        "is_added": ("change", [change.kind == "added" for change in changes()]),
    }


def _cost(found: dict[str, Ablation], spent: dict[str, list[Cost]]) -> dict[str, Any]:
    """Share of run time and number of calls by effect."""
    names = sorted({cost.name for of in spent.values() for cost in of})
    share = np.full((len(found), len(names)), np.nan)
    calls = np.zeros(share.shape, np.int64)
    for i, name in enumerate(found):
        for cost in spent.get(name, []):
            at = (i, names.index(cost.name))
            share[at], calls[at] = cost.share, cost.calls
    dims = ("scene", "effect")
    return {"time_share": (dims, share), "calls": (dims, calls), "effect": ("effect", names)}


def kernels(marker: Path) -> dict[str, Any]:
    """Number of compiled signatures of every kernel and their compile times, if the workflow noted them."""
    rows = _noted(marker).get("kernels", [])
    names = sorted({name for name, _ in rows})
    seconds = {name: [s for n, s in rows if n == name] for name in names}
    return {
        "kernel": ("kernel", names),
        "compile_seconds": ("kernel", [sum(seconds[name]) for name in names]),
        "signatures": ("kernel", [len(seconds[name]) for name in names]),
    }


def _noted(marker: Path) -> dict[str, Any]:
    noted: dict[str, Any] = json.loads(marker.read_text("utf-8") or "{}") if marker.exists() else {}
    return noted


def compiling(marker: Path) -> dict[str, Any]:
    """Time of compiling with an empty cache, if the workflow noted it, and number of compiled functions."""
    noted = _noted(marker)
    cold, spent = noted.get("cold_seconds"), noted.get("cold_core_seconds")
    return {
        "cold_compile_seconds": float(cold) if cold else math.nan,
        "cold_compile_core_seconds": float(spent) if spent else math.nan,
        "compiled_functions": len(list(kernel_cache().rglob("*.nbi"))),
    }


ABOUT = {
    "displacement_change": ("1", "relative change of the peak displacement"),
    "moment_change": ("1", "relative change of the peak bending moment"),
    "tension_change": ("1", "relative change of the peak top tension"),
    "time_change": ("1", "relative change of the run time"),
    "is_added": ("1", "whether the change adds the effect, in place of removing it"),
    "time_share": ("1", "share of the run time spent in an effect's own calls"),
    "compile_seconds": ("s", "time of compiling all signatures of a kernel, without what it calls"),
    "signatures": ("1", "signatures of a kernel that the study compiles"),
    "calls": ("1", "calls of an effect that a run makes"),
    "base_seconds": ("s", "run time of the unchanged scene, while other scenes also run"),
    "elements": ("1", "segments of the riser"),
    "unknowns": ("1", "degrees of freedom solved"),
}
