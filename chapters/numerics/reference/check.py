"""A random tenth of the stored reference solutions, with a seed, recomputed and compared."""

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

    from riserstudy.study.measured import Setting

SEED = 37
SHARE = 10  # one of this number is recomputed


def tenth(wanted: Sequence[Wanted], seed: int = SEED) -> list[Wanted]:
    """Return a random tenth of the cases, at least one; a seed always gives an identical choice."""
    count = math.ceil(len(wanted) / SHARE)
    return random.Random(seed).sample(list(wanted), count)


def with_recomputed(
    dataset: xr.Dataset, setting: Setting, study: str, wanted: Iterable[Wanted]
) -> xr.Dataset:
    """Add the deviations of recomputed references to a dataset of the reference tier, and to no other.

    ``study``: name of the study whose references they are.

    Raises
    ------
    NotUsed
        When a stored reference cannot be used.
    """
    if setting.tier != "reference":
        return dataset
    return dataset.merge(recomputed(setting.config, study, [*wanted]))


def recomputed(config: Path, study: str, wanted: Sequence[Wanted]) -> xr.Dataset:
    """Recompute a tenth of the references of a study; return their deviations, by case.

    Raises
    ------
    NotUsed
        When a stored reference cannot be used.
    """
    import xarray as xr

    chosen = tenth(wanted)
    off = [deviation(read(config, study, one.case, one.file.resolved()), one.compute()) for one in chosen]
    words = "difference from the kept solution over the estimated errors of both"
    deviations = ("recomputed", off, {"units": "1", "long_name": words})
    return xr.Dataset({"recomputed_deviation": deviations}, {"recomputed": [one.case for one in chosen]})


def deviation(kept: Kept, anew: Kept) -> float:
    """Difference of two solutions of a case, divided by the allowed difference.

    The allowed difference is the sum of the changes by their last refinements, and rounding. The result is 0
    if neither solution exists, and infinite if only one exists.
    """
    if kept.result is None or anew.result is None:
        return 0.0 if kept.result is anew.result else math.inf
    found = errors(anew.result, kept.result)
    allowed = {
        name: kept.error.get(name, 0.0) + anew.error.get(name, 0.0) + 2.0 * RESOLUTION for name in found
    }
    return max((value / allowed[name] for name, value in found.items()), default=0.0)
