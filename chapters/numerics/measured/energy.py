"""Energy balance over time, by method: stored energy, physical and numerical dissipation, energy residual.

A run gives its energy balance only at its end; runs of increasing duration give the balance over time.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from chapters.numerics.attempt import attempt_on
from chapters.numerics.fixed_step import FREE, stepped
from chapters.numerics.models import EnergyCase, EnergyStudy, Method, case_file, in_tier
from riserstudy.dataset.describe import label_variables
from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.study.measured import Setting

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.records.facts import EnergyAudit


PARTS = {
    "stored": "stored",
    "dissipated": "dissipated",
    "numerical": "numerically_dissipated",
    "unexplained": "unexplained",
}


def energy(study: EnergyStudy, setting: Setting) -> xr.Dataset:
    """Energy balance of every case by every method, at several times within its duration."""
    import xarray as xr

    cases, methods = in_tier(study.cases, setting.tier), in_tier(study.methods, setting.tier)
    instants = study.instants[setting.tier]
    shape = (len(cases), len(methods), instants)
    value = {name: np.full(shape, np.nan) for name in (*PARTS, "exchanged")}
    message = np.full(shape[:2], "", object)
    time = np.full((len(cases), instants), np.nan)
    for i, (name, case) in enumerate(cases.items()):
        file = case_file(setting.config, name, case).with_values(FREE, name)
        time[i] = case.duration * np.arange(1, instants + 1) / instants
        for j, method in enumerate(methods.values()):
            for k, duration in enumerate(time[i]):
                audit, text = ledger_of(file, case, method, float(duration))
                message[i, j] = text or message[i, j]
                for part, key in (PARTS | {"exchanged": "exchanged"}).items():
                    value[part][i, j, k] = audit.get(key, math.nan)
    data: dict[str, Any] = {n: (("case", "method", "instant"), v) for n, v in value.items()}
    data["time"] = (("case", "instant"), time)
    data["message"] = (("case", "method"), message.astype(str))
    dataset = xr.Dataset(data, {"case": list(cases), "method": list(methods)})
    label_variables(dataset, ABOUT)
    return dataset


def ledger_of(file: SceneFile, case: EnergyCase, method: Method, duration: float) -> tuple[EnergyAudit, str]:
    """Energy balance of a run with a duration (s); if the run is refused, an empty one and the message."""
    cut = {"analysis.duration": f"{duration!r} s", "analysis.output": {"interval": f"{duration!r} s"}}
    alone = file.with_values(cut, "energy")
    mesh = even(alone.resolved(), case.elements)
    own = stepped(alone, method.set, mesh, case.step)
    tried = attempt_on(own, mesh, case.step, math.inf)
    return (tried.result.facts["audit"] if tried.result else {}), tried.message


ABOUT = {
    "time": ("s", "time since the start"),
    "stored": ("J", "change of potential and kinetic energy since the start"),
    "dissipated": ("J", "dissipated by water, dampers and structure"),
    "numerical": ("J", "dissipated by the method"),
    "unexplained": ("J", "work less all that"),
    "exchanged": ("J", "work of either sign, added up"),
}
