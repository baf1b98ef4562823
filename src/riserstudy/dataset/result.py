"""What a run returns. Needs no kernels: reading stored points must not load them."""

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
    """Arrays of one run by name, facts about it, and what it knows of all steps until it is finished."""

    arrays: dict[str, NDArray[np.float64]]
    facts: RunFacts = field(default_factory=dict)  # type: ignore[assignment]
    seen: Seen = field(default_factory=Seen)
