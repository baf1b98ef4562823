"""Values at all time steps of a run, from which extremes, limits and warnings are computed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Peak(NamedTuple):
    """Largest and smallest value over a run, of all cylinders together, with their times (s)."""

    largest: float
    largest_time: float
    smallest: float
    smallest_time: float


@dataclass
class Seen:
    """Values at all time steps of a run; empty if only its outputs are known."""

    # time (s) and outputs with one value per time, (steps,) or (steps, cylinders), by name
    steps: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    peaks: dict[str, Peak] = field(default_factory=dict)  # peaks of these values, by name
    # rotations of flex joints in space, at these steps, else at the outputs, (time, 3) rad, by name
    rotations: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    # envelopes at the nodes until a disconnect, (n + 1,), by name
    connected: dict[str, NDArray[np.float64]] = field(default_factory=dict)
