"""A seeded tenth of the kept reference solutions, computed anew and compared."""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from chapters.numerics.attempt import errors
from chapters.numerics.reference.kept import RESOLUTION, Kept
from chapters.numerics.reference.store import Wanted, read

if TYPE_CHECKING:
    import xarray as xr

    from chapters.numerics.models import EngineStudy
    from riserstudy.study.measured import Setting

SEED = 37
SHARE = 10  # one of so many


def tenth(wanted: Sequence[Wanted], seed: int = SEED) -> list[Wanted]:
    """A tenth of the cases, at least one, the same for a seed."""
    count = math.ceil(len(wanted) / SHARE)
    return random.Random(seed).sample(list(wanted), count)


def with_recomputed(
    dataset: xr.Dataset, setting: Setting, study: EngineStudy, wanted: Iterable[Wanted]
) -> xr.Dataset:
    """A dataset of the reference tier with deviations of recomputed references; others as they are.

    Raises
    ------
    NotUsed
        When a reference that is kept cannot be used.
    """
    if setting.tier != "reference":
        return dataset
    return dataset.merge(recomputed(setting.config, study.references, [*wanted]))


def recomputed(config: Path, study: str, wanted: Sequence[Wanted]) -> xr.Dataset:
    """A tenth of the references of a study, computed anew: by case, how far they deviate.

    Raises
    ------
    NotUsed
        When one that is kept cannot be used.
    """
    import xarray as xr

    chosen = tenth(wanted)
    off = [
        deviation(read(config, study, one.case, one.file.resolved()), one.compute())
        for one in chosen
    ]
    words = "difference from the kept solution over the estimated errors of both"
    deviations = ("recomputed", off, {"units": "1", "long_name": words})
    return xr.Dataset(
        {"recomputed_deviation": deviations}, {"recomputed": [one.case for one in chosen]}
    )


def deviation(kept: Kept, anew: Kept) -> float:
    """Difference of two solutions of a case over what they may differ by.

    That is what their last refinements changed, and rounding. 0 where neither exists, infinite where one
    alone does.
    """
    if kept.result is None or anew.result is None:
        return 0.0 if kept.result is anew.result else math.inf
    found = errors(anew.result, kept.result)
    allowed = {
        name: kept.error.get(name, 0.0) + anew.error.get(name, 0.0) + 2.0 * RESOLUTION
        for name in found
    }
    return max((value / allowed[name] for name, value in found.items()), default=0.0)
