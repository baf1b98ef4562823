"""The result of a run. This module loads no kernels, so reading stored points stays fast."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.seen import Seen

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts


@dataclass
class Result:
    """Arrays of one run by name, its facts, and its values at all steps until the run is finished."""

    arrays: dict[str, NDArray[np.float64]]
    facts: RunFacts = field(default_factory=dict)  # type: ignore[assignment]
    seen: Seen = field(default_factory=Seen)
