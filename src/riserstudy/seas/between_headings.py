"""Error of the response interpolated between two headings, from runs in waves half-way between them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import FloatArray
from riserstudy.scene.load import SceneFile
from riserstudy.seas.cover import Cover, off_by, scale_of
from riserstudy.seas.riser_hours import Response
from riserstudy.seas.sea_states import SeaStates

if TYPE_CHECKING:
    from riserstudy.seas.riser_response import RiserResponse

# number of sea states half-way between two headings: the highest, and others drawn by their rows
COMPARED = 4


class Half(NamedTuple):
    """Waves half-way between a heading and the next heading."""

    angle: float  # deg
    file: SceneFile
    states: FloatArray  # (n, 2) sea states that are compared
    rows: NDArray[np.bool_]  # (rows,) true for rows of the record between the two headings
    following: int  # index of the next heading


class Middle(NamedTuple):
    """Responses half-way between two headings, and the error of the mean of the two."""

    heading: float  # deg
    riser: RiserResponse
    states: FloatArray  # (n, 2) significant height (m), peak period (s)
    responses: FloatArray  # (n, limits)
    deviation: FloatArray  # (n, limits) their standard errors by seeds
    rows: NDArray[np.bool_]  # (rows,) true for rows of the record between the two headings
    scale: FloatArray  # (limits,) reference value of errors; the response is used if it is larger
    error: FloatArray  # (limits,) largest error, relative to this reference


def states_between(of: SeaStates, inside: NDArray[np.bool_]) -> FloatArray:
    """Sea states to compare half-way between two headings, (n, 2).

    ``inside``: (rows,) true for rows of the record between the two headings.
    """
    there = of.among(inside)
    highest = int(there.states[:, 0].argmax())
    others = np.delete(np.arange(len(there.states)), highest)
    count = min(COMPARED - 1, len(others))
    if not count:
        return there.states[[highest]]
    weights = there.rows[others] / there.rows[others].sum()
    drawn = np.random.default_rng(0).choice(others, count, replace=False, p=weights)
    return there.states[[highest, *drawn]]


def compared(half: Half, riser: RiserResponse, neighbours: Sequence[Cover]) -> Middle:
    """Compare the mean of two headings with runs half-way between them.

    Parameters
    ----------
    riser : riser in waves half-way between.
    neighbours : simulated sea states of the two headings.
    """
    simulated = riser(half.states)
    expected = np.mean([one.surface.at(half.states) for one in neighbours], axis=0)
    scale = scale_of(riser.allowed, np.concatenate([one.responses for one in neighbours]))
    error = np.nanmax(off_by(expected, simulated, scale), axis=0, initial=0.0)
    none = np.full(len(riser.limits), math.nan)
    deviation = np.array([riser.deviation.get((h, t), none) for h, t in half.states.tolist()])
    return Middle(half.angle, riser, half.states, simulated, deviation, half.rows, scale, error)


def widened(rows: Response, inside: NDArray[np.bool_], middle: Middle) -> Response:
    """The response in rows, with the error of rows between two headings, (n,), added to the uncertainty."""
    off = rows.off.copy()
    off[inside] += middle.error * np.maximum(middle.scale, np.abs(rows.demand[inside]))
    return rows._replace(off=off)
