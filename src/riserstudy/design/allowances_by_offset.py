"""Allowances of a sea at the ends of an envelope, and between them.

Allowances depend on the offset: tensioners are stiffer further out, and the riser moves less where its
tension is larger. They are therefore computed at three offsets, and interpolated.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from riserstudy.design.operability import Offsets
from riserstudy.design.sea_allowances import Allowance
from riserstudy.errors import SimulationError
from riserstudy.scene.limits import Limit

NEAR = 0.02  # share of the search within which two offsets have the same allowances


class ByOffset(NamedTuple):
    """Allowances of one limit at some offsets (m), in increasing order."""

    offsets: Sequence[float]
    each: Sequence[Allowance]

    @property
    def missing(self) -> str:
        """Why an allowance is not known; empty if all are known."""
        return next((one.missing for one in self.each if one.missing), "")

    def at(self, offset: float) -> float | dict[str, float]:
        """The allowance at an offset (m), by place, in the unit of the output; constant beyond the ends.

        Between the offsets it is a monotone cubic function.
        """
        parts = [one.by_place for one in self.each]
        common = [name for name in parts[0] or () if all(name in (part or ()) for part in parts)]
        if not common:
            return self._between([one.value for one in self.each], offset)
        return {name: self._between([(part or {})[name] for part in parts], offset) for name in common}

    def _between(self, values: Sequence[float], offset: float) -> float:
        if len(values) == 1:
            return values[0]
        from scipy.interpolate import PchipInterpolator  # slow to load

        inside = min(max(offset, self.offsets[0]), self.offsets[-1])
        return max(float(PchipInterpolator(self.offsets, values)(inside)), 0.0)


def ends_of(limits: Sequence[Limit], found: Sequence[Offsets], reach: float) -> list[float]:
    """The lowest and the highest end of the envelopes of all modes (m), at most ``reach`` from the well.

    Limits that are met at no offset, or are not evaluated, do not count. Empty if no limit counts.
    """
    ends = []
    for mode in dict.fromkeys(limit.mode for limit in limits):
        of = [
            one
            for limit, one in zip(limits, found, strict=True)
            if limit.mode == mode and not math.isnan(one.low)
        ]
        if of:
            ends += [max(one.low for one in of), min(one.high for one in of)]
    ends = [min(max(end, -reach), reach) for end in ends]
    return [min(ends), max(ends)] if ends else []


def with_ends(
    limits: Sequence[Limit],
    own: tuple[float, Sequence[Allowance]],
    ends: Sequence[float],
    reach: float,
    allowances_at: Callable[[float], Sequence[Allowance]],
) -> list[ByOffset]:
    """Allowances of each limit at the scene's own offset and at the ends of its envelopes (m).

    Where a run at an end cannot be completed, the allowances there are not known.

    Parameters
    ----------
    own : the scene's own offset (m), and the allowances there.
    allowances_at : allowances of all limits at an offset (m).
    """
    known: dict[float, Sequence[Allowance]] = {own[0]: own[1]}
    for end in ends:
        if min(abs(end - other) for other in known) <= NEAR * reach:
            continue
        try:
            known[end] = allowances_at(end)
        except SimulationError as failure:
            why = f"a run in the sea at an offset of {end:.4g} m ({failure})"
            known[end] = [Allowance(math.nan, why)] * len(limits)
    offsets = sorted(known)
    return [ByOffset(offsets, [known[offset][k] for offset in offsets]) for k in range(len(limits))]
