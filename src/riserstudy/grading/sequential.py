"""Number of samples after which a verdict was certain, with samples examined in their order.

The first Sobol points of each such number are spread evenly. The others are simulated anyway, because finding
the deciding inputs requires more samples than the verdict.

References
----------
Clopper and Pearson (1934): bounds of a share from the number of hits.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binomtest

from riserstudy.grading.verdict import ALMOST_ALWAYS, ALMOST_NEVER, verdict_of_claim, verdict_of_number
from riserstudy.records.graded import Kind, Verdict

SURE = 0.99  # confidence that a share is on the indicated side of a bound
FIRST = 8  # smallest number of samples that is examined


def looks(samples: int) -> list[int]:
    """Numbers of samples that are examined: 8, 16, 32, 64, 96, 128, 192, 256 ..., and finally all."""
    counts = [FIRST]
    while counts[-1] < samples:
        last = counts[-1]
        power = 1 << (last.bit_length() - 1)
        counts.append(last + power // 2 if last >= 8 * FIRST else 2 * last)
    return [count for count in counts if count < samples] + [samples]


def certain(hits: int, samples: int) -> bool:
    """Whether the number of hits determines if the share is almost all, almost none, or neither."""
    band = binomtest(hits, samples).proportion_ci(2.0 * SURE - 1.0, method="exact")
    always, never = band.low >= ALMOST_ALWAYS, band.high <= ALMOST_NEVER
    return bool(always or never or (band.low > ALMOST_NEVER and band.high < ALMOST_ALWAYS))


def decided_after(hits: NDArray[np.bool_], kind: Kind = "claim", base: bool = True) -> int | None:
    """Number of samples after which the verdict of all samples was certain; None if it never was.

    Parameters
    ----------
    hits : (samples,) in the order of the samples.
    kind : "number" or "claim".
    base : whether the base case is met.
    """
    total, verdict = np.cumsum(hits), _verdict_by_share(kind, base)
    last = verdict(float(np.mean(hits)))
    return next(
        (
            n
            for n in looks(len(hits))
            if certain(int(total[n - 1]), n) and verdict(float(total[n - 1]) / n) == last
        ),
        None,
    )


def _verdict_by_share(kind: Kind, base: bool) -> Callable[[float], Verdict]:
    if kind == "number":
        return lambda share: verdict_of_number(base, share, False)
    return lambda share: verdict_of_claim(share, False, base)
