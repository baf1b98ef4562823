"""Hours that limits on the sea make unworkable, as the table of a riser's limits has them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Flags = NDArray[np.bool_]


class Lost(NamedTuple):
    """Shares of rows that a limit on the sea makes unworkable."""

    limit: str
    exceeded: float  # share in which it is not met
    alone: float  # share in which all other limits are met

    def __str__(self) -> str:
        return f"{self.limit}: not met in {self.exceeded:.2%} of the rows, alone in {self.alone:.2%}"


def lost_by(limits: Mapping[str, Flags], others: Flags) -> list[Lost]:
    """Shares of rows that each limit on the sea makes unworkable.

    Parameters
    ----------
    limits : for each limit, whether the rows meet it, (rows,).
    others : (rows,) whether all other limits are met, such as those of a riser.
    """
    failed = {name: ~met for name, met in limits.items()}
    number = np.sum([*failed.values(), ~others], axis=0)
    return [Lost(name, float(of.mean()), float((of & (number == 1)).mean())) for name, of in failed.items()]
