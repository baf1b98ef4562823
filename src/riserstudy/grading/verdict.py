"""How a printed number or claim comes out.

A number is met within half a unit of its last printed digit or 1 %, whichever is larger; its file may name a
stricter share than 1 %. Where a paper
leaves something open, number and claim are judged over samples of it: what almost always holds holds, a
claim that almost never holds fails, a number fails that no sample meets, anything between depends.

References
----------
Wilks (1941), Determination of sample sizes for setting tolerance limits: how many draws are enough.
"""

from __future__ import annotations

import math
from typing import Any

from riserstudy.records.graded import Verdict

RELATIVE = 0.01  # a number is met within this share of it, however finely it is printed
ALMOST_ALWAYS, ALMOST_NEVER = 0.95, 0.05  # shares of the samples
#: samples of which a claim that holds must be true. If all of 59 random draws are true, at least 95 % of what
#: is open is, at a confidence of 95 %: 0.95^59 < 0.05. Fewer cannot show it, however they come out.
ENOUGH = 59
SLACK = 1e-9  # so that a value on the bound is inside it


def tolerance(published: float, rounding: float, within: float | None = None) -> float:
    """Largest deviation that counts as met: half a unit of the last printed digit, or 1 % (``within``)."""
    return max(0.5 * rounding, (RELATIVE if within is None else within) * abs(published))


def met(simulated: Any, published: float, rounding: float, within: float | None = None) -> Any:
    """Whether a simulated number, or each of an array, is the printed one; ``within`` as in ``tolerance``."""
    bound = tolerance(published, rounding, within)
    return abs(simulated - published) <= bound * (1.0 + SLACK)


def error(simulated: float, published: float) -> float:
    """Relative error, absolute where the printed number is zero."""
    return (simulated - published) / abs(published) if published else simulated


def verdict_of_number(hit: bool, share: float | None, calibrated: bool) -> Verdict:
    """Verdict of a number.

    Parameters
    ----------
    hit : met by the base case.
    share : share of the samples that meet it, None without samples.
    calibrated : whether a calibrated input lies on its path.
    """
    if share is not None:
        # one reading that meets a number shows that it can be had
        settled = share >= ALMOST_ALWAYS if hit else share == 0.0
        if not settled:
            return "depends"
    if not hit:
        return "fails"
    return "calibrated" if calibrated else "reproduced"


def verdict_of_claim(
    share: float, calibrated: bool, base: bool = True, samples: int | None = None
) -> Verdict:
    """Verdict of a claim.

    Parameters
    ----------
    share : of what is open for which it is true.
    calibrated : whether a calibrated input lies on its path.
    base : true in the base case.
    samples : that the share is of; None where all combinations of what is open are judged.
    """
    if math.isnan(share):
        raise ValueError("a share of no samples")
    if share >= ALMOST_ALWAYS:
        if not base or few(samples):
            return "depends"
        return "calibrated" if calibrated else "holds"
    return "fails" if share <= ALMOST_NEVER else "depends"


def few(samples: int | None) -> bool:
    """Whether samples are too few for a claim to hold."""
    return samples is not None and samples < ENOUGH
