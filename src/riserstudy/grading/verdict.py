"""How a printed number or claim comes out.

A number is met within half a unit of its last printed digit or 1 %, whichever is larger. Where a paper
leaves something open, number and claim are judged over samples of it: what almost always holds holds, a
claim that almost never holds fails, a number fails that no sample meets, anything between depends.
"""

from __future__ import annotations

import math
from typing import Literal

Verdict = Literal["reproduced", "calibrated", "holds", "fails", "depends", "not reproducible"]

RELATIVE = 0.01  # a number is met within this share of it, however finely it is printed
ALMOST_ALWAYS, ALMOST_NEVER = 0.95, 0.05  # shares of the samples
SLACK = 1e-9  # so that a value on the bound is inside it


def tolerance(published: float, rounding: float) -> float:
    """Largest deviation that counts as met: half a unit of the last printed digit, or 1 %."""
    return max(0.5 * rounding, RELATIVE * abs(published))


def met(simulated: float, published: float, rounding: float) -> bool:
    """Whether a simulated number is the printed one."""
    bound = tolerance(published, rounding)
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


def verdict_of_claim(share: float, calibrated: bool) -> Verdict:
    """Verdict of a claim, by the share of the samples for which it is true."""
    if math.isnan(share):
        raise ValueError("a share of no samples")
    if share >= ALMOST_ALWAYS:
        return "calibrated" if calibrated else "holds"
    return "fails" if share <= ALMOST_NEVER else "depends"
