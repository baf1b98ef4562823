"""Long simulations with the mesh, time step and method of their paper.

Such a run takes much longer than a candidate of `long_runs`. Other jobs may run at the same time, because
its CPU time is compared with times that are a hundred times smaller or larger.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from chapters.numerics.answers import OWN
from chapters.numerics.fixed_step import freed, whole
from chapters.numerics.measured.long_runs import STUDY, candidate, dataset_of, row
from chapters.numerics.models import PaperStudy, in_tier
from chapters.numerics.reference.store import solution
from riserstudy.model.mesh import even
from riserstudy.study.measured import Setting

if TYPE_CHECKING:
    import xarray as xr

WHERE = "config/studies/numerics.yaml: measured.papers_settings"


def papers_settings(study: PaperStudy, setting: Setting) -> xr.Dataset:
    """Run each case with the setting of its paper: one row each, as in the dataset of long runs.

    Raises
    ------
    SimulationError
        When the reference of a case cannot be used.
    """
    rows = []
    for name, case in in_tier(study.cases, setting.tier).items():
        file = freed(setting.config / case.scene, case.set, f"{WHERE}: {name}")
        best = solution(setting.config, STUDY, name, file.resolved())
        mesh = even(whole(file.resolved()), case.own.elements)
        tried = candidate(file, case.own.set, mesh, case.own.step, 1)
        rows.append(row(name, (OWN, ""), case.own.step, tried, best))
    return dataset_of(rows)
