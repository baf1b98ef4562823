"""The engine compared with known solutions: runs of every case, with error and tolerance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from chapters.numerics.models import ValidationStudy, case_file, in_tier
from chapters.numerics.validation_cases import CASES
from chapters.numerics.validation_motion import histories
from riserstudy.dataset.describe import label_variables
from riserstudy.study.measured import Setting

if TYPE_CHECKING:
    import xarray as xr

TEXTS = {
    "name": "computed quantity",
    "quantity": "of which a number is compared",
    "unit": "unit of reference and value",
    "kind": "kind of reference: closed form, second method or conservation law",
    "by": "formula or method of the reference",
    "because": "reason for the tolerance",
}
NUMBERS = {
    "reference": "value by the closed form, second method or conservation law, in the unit of its row",
    "value": "value by the engine, in the unit of its row",
    "error": "difference over the size of the reference",
    "tolerance": "error that is allowed",
}


def validation(study: ValidationStudy, setting: Setting) -> xr.Dataset:
    """Run all cases; one row per number: reference, value, error and tolerance."""
    import xarray as xr

    scenes = in_tier(study.scenes, setting.tier)
    files = {name: case_file(setting.config, name, case) for name, case in scenes.items()}
    rows = [row for case in CASES for row in case(files)]
    stored = {name: setting.config / path for name, path in study.stored.items()}
    rows += histories(files, stored)
    data = {name: np.array([getattr(row, name) for row in rows]) for name in (*TEXTS, *NUMBERS)}
    dataset = xr.Dataset({name: ("row", values) for name, values in data.items()})
    label_variables(dataset, {name: ("1", words) for name, words in NUMBERS.items()})
    for name, words in TEXTS.items():
        dataset[name].attrs = {"long_name": words}
    dataset["holds"] = dataset["error"] <= dataset["tolerance"]
    dataset["holds"].attrs = {"long_name": "whether the error is below the tolerance"}
    return dataset.assign_coords(row=np.arange(1, len(rows) + 1))
