"""How far two runs are apart, and what that says of the error of the finer one."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from riserstudy.dataset.result import Result

Array = NDArray[np.float64]
Arrays = dict[str, Array]

MOST_FALL = 8.0  # of successive differences that an estimate trusts: third order
SURE_FALL = 4.0  # where mesh and step both changed between them: second


def estimate(
    now: dict[str, float], before: dict[str, float] | None, most: float = MOST_FALL
) -> dict[str, float]:
    """Error of the finest of three runs, each twice as fine as the last, from their differences.

    Where differences fall by a factor q, what is left is 1 / (q - 1) of the last; q is taken as no more
    than ``most``, and as 2 where it is smaller or unknown.
    """
    error = {}
    for name, value in now.items():
        fall = (before or {}).get(name, 0.0) / value if value > 0.0 else most
        error[name] = value / (min(max(fall, 2.0), most) - 1.0)
    return error


def difference(coarse: Result, fine: Result) -> dict[str, float]:
    """Relative difference of two runs, by quantity.

    Envelopes and the static state are compared at all nodes, histories at the stations, so that an
    error in phase counts too. The scale is the largest value anywhere.
    """
    found = {}
    for name, fields in (
        ("displacement", ("x", "y", "z")),
        ("tension", ("effective_tension",)),
        ("moment", ("bending_moment",)),
    ):
        scale, off = 0.0, 0.0
        for field in fields:
            for low, up in _pairs(coarse.arrays, fine.arrays, field):
                scale = max(scale, float(np.abs(up).max()))
                off = max(off, float(np.abs(up - low).max()))
        rounding = 1e-9 * float(fine.arrays["s_node"][-1]) if name == "displacement" else 0.0
        if scale > rounding:
            found[name] = off / scale
    return found


def _pairs(coarse: Arrays, fine: Arrays, field: str) -> Iterator[tuple[Array, Array]]:
    """The same values of both runs: envelopes, static state, histories; displacements from straight."""
    s0, s1 = coarse["s_node"], fine["s_node"]
    zero0, zero1 = (a.get("zero_" + field, np.zeros_like(a["s_node"])) for a in (coarse, fine))
    for end in ("_max", "_min", "_static"):
        if field + end in fine:
            yield coarse[field + end] - zero0, np.interp(s0, s1, fine[field + end] - zero1)
    if field in fine and "time" in coarse:
        mine, yours = coarse["s"], fine["s"]
        _, here, there = np.intersect1d(np.round(mine, 6), np.round(yours, 6), return_indices=True)
        if len(here):
            low = coarse[field][:, here] - np.interp(mine[here], s0, zero0)
            yield low, fine[field][:, there] - np.interp(yours[there], s1, zero1)
        else:  # no station on a node of the coarse mesh
            low = make_interp_spline(mine, coarse[field] - zero0, k=min(3, len(mine) - 1), axis=1)
            yield low(yours), fine[field] - np.interp(yours, s1, zero1)
