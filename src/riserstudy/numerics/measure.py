"""Measure a dataset of the study file: the one door for the workflow."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from riserstudy.dataset.label import history
from riserstudy.digests import engine_digest
from riserstudy.numerics.scenes import MeasuredStudy, Setting
from riserstudy.study.measured import (
    AccuracyStudy,
    EffectsStudy,
    EnergyStudy,
    LimitStudy,
    LongStudy,
    RandomStudy,
    StabilityStudy,
    TiersStudy,
    ValidationStudy,
)

if TYPE_CHECKING:
    import xarray as xr

#: the module that measures each kind of study, by a function of its own name
MODULES: dict[type[MeasuredStudy], str] = {
    StabilityStudy: "stability",
    LimitStudy: "stable_step",
    EffectsStudy: "effects",
    AccuracyStudy: "accuracy",
    RandomStudy: "random_scenes",
    LongStudy: "long_runs",
    TiersStudy: "tiers",
    EnergyStudy: "energy",
    ValidationStudy: "validation",
}


def module_of(study: MeasuredStudy) -> str:
    """The module that measures a study."""
    return f"riserstudy.numerics.{MODULES[type(study)]}"


def measure(title: str, study: MeasuredStudy, setting: Setting) -> xr.Dataset:
    """One measured dataset of a chapter, labelled with the engine it is about."""
    module = import_module(module_of(study))
    name = MODULES[type(study)]
    dataset: xr.Dataset = getattr(module, name)(study, setting)
    if setting.tier == "reference" and hasattr(module, "wanted"):
        from riserstudy.numerics.reference.check import recomputed

        wanted = list(module.wanted(study, setting.config))
        dataset = dataset.merge(recomputed(setting.config, name, wanted))
    dataset.attrs |= {
        "Conventions": "CF-1.11",
        "title": f"{title}: {study.caption}",
        "tier": setting.tier,
        "engine": engine_digest(),
        "history": history(f"measured {title}, tier {setting.tier}"),
    }
    return dataset
