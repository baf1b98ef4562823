"""Verdicts of published values and claims.

A published value is met within half a unit of its last printed digit or 1 %, whichever is larger; its file
may give a stricter share than 1 %. If inputs are unspecified, values and claims are judged over samples of
these. A claim that is true in the base case and in almost all samples holds, and a claim that is false in the
base case and true in almost no sample fails. A value that neither the base case nor a sample meets fails. All
other cases depend.

References
----------
Wilks (1941), Determination of sample sizes for setting tolerance limits: the required number of draws.
"""

from __future__ import annotations

import math
from typing import Any

from riserstudy.records.graded import Verdict

RELATIVE = 0.01  # relative tolerance of a published value, even if it has more digits
ALMOST_ALWAYS, ALMOST_NEVER = 0.95, 0.05  # shares of the samples
#: smallest number of samples for a claim to hold. If all of 59 random draws are true, the claim is true for
#: at least 95 % of the unspecified inputs, with a confidence of 95 %: 0.95^59 < 0.05. Fewer draws cannot show
#: this.
ENOUGH = 59
SLACK = 1e-9  # relative margin, so that a value on the bound meets it


def tolerance(published: float, rounding: float, within: float | None = None) -> float:
    """Largest deviation that counts as met: half a unit of the last printed digit, or 1 % (``within``)."""
    return max(0.5 * rounding, (RELATIVE if within is None else within) * abs(published))


def met(simulated: Any, published: float, rounding: float, within: float | None = None) -> Any:
    """Whether a simulated number, or each of an array, meets the published one; ``within`` as above."""
    bound = tolerance(published, rounding, within)
    return abs(simulated - published) <= bound * (1.0 + SLACK)


def error(simulated: float, published: float) -> float:
    """Relative error; absolute if the published value is zero."""
    return (simulated - published) / abs(published) if published else simulated


def verdict_of_number(hit: bool, share: float | None, calibrated: bool) -> Verdict:
    """Verdict of a published value.

    Parameters
    ----------
    hit : whether the base case meets it.
    share : share of the samples that meet it, None without samples.
    calibrated : whether it depends on a calibrated input.
    """
    if share is not None:
        # one interpretation that meets a value shows that the value is possible
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
    share : share of the samples in which it is true.
    calibrated : whether it depends on a calibrated input.
    base : whether it is true in the base case.
    samples : number of samples; None if all combinations of the unspecified inputs are judged.
    """
    if math.isnan(share):
        raise ValueError("a share of no samples")
    if share >= ALMOST_ALWAYS:
        if not base or few(samples):
            return "depends"
        return "calibrated" if calibrated else "holds"
    return "fails" if share <= ALMOST_NEVER and not base else "depends"


def few(samples: int | None) -> bool:
    """Whether samples are too few for a claim to hold."""
    return samples is not None and samples < ENOUGH
