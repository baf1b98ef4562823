"""Measure a dataset of the study file: the one door for the workflow."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.digests import engine_digest
from riserstudy.numerics.accuracy import accuracy
from riserstudy.numerics.effects import effects
from riserstudy.numerics.energy import energy
from riserstudy.numerics.long_runs import long_runs
from riserstudy.numerics.random_scenes import random_scenes
from riserstudy.numerics.stability import stability
from riserstudy.numerics.stable_step import stable_steps
from riserstudy.numerics.tiers import tiers
from riserstudy.solve.kernel_cache import mends_kernel_cache
from riserstudy.study.measured import (
    AccuracyStudy,
    EffectsStudy,
    EnergyStudy,
    LimitStudy,
    LongStudy,
    RandomStudy,
    StabilityStudy,
    TiersStudy,
)

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.jobs.workplan import Workplan


@mends_kernel_cache
def measure(plan: Workplan, paper: str, name: str, threads: int) -> xr.Dataset:
    """One measured dataset of a chapter, labelled with the engine it is about."""
    study = getattr(plan.files[paper].measured, name)
    if isinstance(study, StabilityStudy):
        dataset = stability(study, plan.config, plan.tier, threads)
    elif isinstance(study, EffectsStudy):
        dataset = effects(study, plan.studies, plan.tier, Path(plan.compiled))
    elif isinstance(study, AccuracyStudy):
        dataset = accuracy(study, plan.config, plan.tier)
    elif isinstance(study, RandomStudy):
        dataset = random_scenes(study, plan.config, plan.tier, threads)
    elif isinstance(study, EnergyStudy):
        dataset = energy(study, plan.config, plan.tier)
    elif isinstance(study, TiersStudy):
        dataset = tiers(study, plan.config, plan.tier)
    elif isinstance(study, LongStudy):
        dataset = long_runs(study, plan.config, plan.tier, threads)
    elif isinstance(study, LimitStudy):
        dataset = stable_steps(study, plan.config, plan.tier)
    else:
        raise TypeError(f"{paper}/{name} cannot be measured")
    dataset.attrs |= {
        "Conventions": "CF-1.11",
        "title": f"{paper} {name}: {study.caption}",
        "tier": plan.tier,
        "engine": engine_digest(),
    }
    return dataset
