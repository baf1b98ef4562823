"""Measure a dataset of a chapter by the chapter's own code."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.chapters import function_of
from riserstudy.dataset.label import history
from riserstudy.dataset.title import titled
from riserstudy.files.digests import engine_digest

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.measured import MeasuredModel, Setting


def measure(paper: str, name: str, model: MeasuredModel, setting: Setting) -> xr.Dataset:
    """Make dataset ``name`` of a paper, by the function of that name in its chapter's ``measured``.

    Its attributes contain the digest of the engine with which it was measured.
    """
    dataset: xr.Dataset = function_of(paper, "measured", name)(model, setting)
    dataset.attrs |= {
        "Conventions": "CF-1.11",
        "title": titled(model.caption, paper, name),
        "tier": setting.tier,
        "engine": engine_digest(),
        "history": history(f"measured {paper} {name}, tier {setting.tier}"),
    }
    return dataset
