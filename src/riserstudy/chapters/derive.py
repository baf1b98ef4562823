"""Derive a dataset of a chapter from others."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from riserstudy.chapters import function_of
from riserstudy.dataset.complete import without_inherited
from riserstudy.dataset.extremes import OVER
from riserstudy.dataset.label import history
from riserstudy.dataset.origins import joined, origins_of
from riserstudy.dataset.supporting_points import parent
from riserstudy.dataset.title import titled
from riserstudy.scene.origin import unwrap

if TYPE_CHECKING:
    import xarray as xr


def derive(
    paper: str, name: str, datasets: dict[str, xr.Dataset], settings: dict[str, Any] | None = None
) -> xr.Dataset:
    """Make derived dataset ``name`` of a paper, by the function of that name in its chapter's ``derived``.

    ``settings`` are further arguments from the study file; the attribute ``settings`` of the dataset contains
    them with ranges and reasons.

    Its attribute ``parents`` contains tier, engine, digest and axes of each source. ``origins`` joins the
    origins of the sources: it must stay known which results depend on a calibrated value.
    """
    plain, given, _ = unwrap(settings or {})
    dataset: xr.Dataset = function_of(paper, "derived", name)(**datasets, **plain)
    # statistics of runs, not of the derived dataset
    dataset = without_inherited(dataset.drop_dims(OVER, errors="ignore"), datasets.values())
    own = {f"with.{path}": origin.status for path, origin in given.items()}
    if settings:
        dataset.attrs["settings"] = json.dumps(settings)
    origins = joined([own, *map(origins_of, datasets.values())])
    dataset.attrs.setdefault("title", titled(name.replace("_", " "), paper))
    dataset.attrs["origins"] = json.dumps(origins)
    dataset.attrs["parents"] = json.dumps({name: parent(d) for name, d in datasets.items()})
    dataset.attrs["history"] = history(f"derived {name} of {paper} from {', '.join(datasets)}")
    return dataset
