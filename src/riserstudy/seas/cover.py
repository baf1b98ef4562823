"""Selection of the sea states to simulate, until the surface through them predicts the others.

It begins with the corners of the record, so every row of the record is between simulated sea states. More sea
states are added where cubic and linear interpolation over triangles differ most. Then further sea states are
drawn, which the surface does not use, and compared with it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError, SimulationError
from riserstudy.records.arrays import FloatArray
from riserstudy.records.words import counted
from riserstudy.seas.sea_states import SeaStates
from riserstudy.seas.surface import Surface

FIRST = 12  # number of initial sea states in addition to the corners
BATCH = 6  # number of sea states that are added at a time
# number of sea states for comparison; half drawn from all rows, half from rows near a limit
HELD_OUT = 16
NEAR = 0.3  # distance from a limit that counts as near, as a share of the allowable
Run = Callable[[FloatArray], FloatArray]
Notify = Callable[[str], None]


class Cover(NamedTuple):
    """Simulated sea states, and the error of the surface through them."""

    states: FloatArray  # (n, 2) significant height (m), peak period (s)
    responses: FloatArray  # (n, k) NaN where a run failed
    # (n,) true for sea states that are compared only, not used by the surface
    held_out: NDArray[np.bool_]
    # (k,) largest error at these, relative to the allowable, or the response if larger
    error: FloatArray

    @property
    def surface(self) -> Surface:
        """The surface."""
        return Surface(self.states[~self.held_out], self.responses[~self.held_out])


def cover(
    of: SeaStates,
    run: Run,
    allowed: FloatArray,
    error: float,
    most: int,
    seed: int = 0,
    notify: Notify = lambda _: None,
) -> Cover:
    """Simulate sea states of a record until responses at others are predicted within an error.

    Raises InputError when the record's sea states are on a line, so that there is no area between them, or
    ``most`` is too small from the start. Raises SimulationError when ``most`` sea states do not suffice.

    Parameters
    ----------
    run : function that returns responses (m, k) of sea states (m, 2); NaN where a run fails.
    allowed : (k,) allowable of each response, in its unit; for an allowable of 0, the median response is
        used.
    error : largest error at the sea states for comparison, relative to the allowable, or the response if
        larger.
    most : largest number of sea states.
    seed : seed of the draw of sea states for comparison.
    notify : function that receives a description of the next step.
    """
    check_most([of], most)
    draw = np.random.default_rng(seed)
    known, reached = first(of), ""
    notify(f"{len(known)} sea states that enclose the record")
    responses = run(of.states[known])
    while True:
        surface = Surface(of.states[known], responses)
        scale = scale_of(allowed, responses)
        more = _next(of, surface, scale, error, set(known))
        if not len(more):
            held = _drawn(of, surface, allowed, scale, known, draw)
            _refuse_more(len(known), len(held), most, reached)
            notify(f"{counted(len(held), 'sea state')} to check the interpolation between {len(known)}")
            simulated = run(of.states[held]) if held else responses[:0]
            predicted = surface.at(of.states[held])
            off = off_by(predicted, simulated, scale)
            failed = (np.isnan(simulated) & ~np.isnan(predicted)).any()
            worst = float(np.nanmax(off, initial=0.0))
            if not failed and worst <= error:
                return _whole(of, known, responses, held, simulated, off)
            more, found, reached = held, simulated, _above(worst, error)
        else:
            worst = float(np.nanmax(surface.bend(of.states[more]) / scale))
            reached = _above(worst, error)
            _refuse_more(len(known), len(more), most, reached)
            notify(
                f"{counted(len(more), 'further sea state')}: linear and cubic interpolation differ by "
                f"{worst:.1%}, {len(known)} done"
            )
            found = run(of.states[more])
        known, responses = [*known, *more], np.concatenate([responses, found])


def _above(worst: float, error: float) -> str:
    return f" give an error of {worst:.1%}, above the tolerance of {error:.1%}, and"


def _refuse_more(known: int, more: int, most: int, reached: str) -> None:
    """Refuse to simulate more sea states than allowed."""
    if known + more > most:
        raise SimulationError(
            f"{known} sea states{reached} are simulated and {more} more are required, but at most {most} are "
            "allowed; give a larger --error, or a larger --most"
        )


def least(of: SeaStates) -> int:
    """Number of sea states that are simulated if no more are needed, with those for comparison.

    Raises InputError when the record's sea states are on a line.
    """
    chosen = first(of)
    free = of.rows > 0
    free[chosen] = False
    return len(chosen) + min(HELD_OUT, int(free.sum()))


def check_most(headings: Sequence[SeaStates], most: int) -> None:
    """Check that ``most`` sea states can suffice in each heading.

    Raises InputError if they cannot, or the sea states of a heading are on a line.
    """
    needed = max(map(least, headings), default=0)
    if needed > most:
        found = f"the record requires the simulation of at least {needed} sea states"
        raise InputError("--most", str(most), found, f"give {needed} or more")


def first(of: SeaStates) -> list[int]:
    """The first sea states to simulate: corners of the record, and those farthest from all previous ones.

    Raises InputError when the record's sea states are on a line.
    """
    chosen = corners(of.states)
    places = _places(of.states)
    apart = np.min([np.hypot(*(places - places[k]).T) for k in chosen], axis=0)
    apart[of.rows == 0] = 0.0
    for _ in range(FIRST):
        if apart.max() <= 0.0:
            break
        chosen.append(int(apart.argmax()))
        apart = np.minimum(apart, np.hypot(*(places - places[chosen[-1]]).T))
    return chosen


def corners(states: FloatArray) -> list[int]:
    """Indices of the sea states, (n, 2), whose convex hull contains all others.

    Raises InputError when they are on a line.
    """
    from scipy.spatial import ConvexHull, QhullError

    try:
        if len(states) < 3:
            raise QhullError
        return [int(k) for k in ConvexHull(_places(states)).vertices]
    except QhullError:
        found = "the sea states are on one line in the diagram of height and period"
        allowed = "give a record whose rows differ in height and in period"
        raise InputError("RECORD", "sea states", found, allowed) from None


def _places(states: FloatArray) -> FloatArray:
    """Sea states scaled to ranges from 0 to 1."""
    low, wide = states.min(axis=0), np.maximum(np.ptp(states, axis=0), 1e-12)
    return np.asarray((states - low) / wide)


def scale_of(allowed: FloatArray, responses: FloatArray) -> FloatArray:
    """Reference value for errors of each response, (k,)."""
    usual = np.nanmedian(np.abs(responses), axis=0)
    scale = np.where(allowed == 0.0, usual, np.abs(allowed))
    return np.where(scale > 0.0, scale, 1.0)


def off_by(predicted: FloatArray, simulated: FloatArray, scale: FloatArray) -> FloatArray:
    """Errors (m, k) of predictions, relative to the allowable, or to the response if it is larger."""
    return np.asarray(np.abs(predicted - simulated) / np.maximum(scale, np.abs(simulated)))


def _next(of: SeaStates, surface: Surface, scale: FloatArray, error: float, known: set[int]) -> list[int]:
    """Sea states where cubic and linear interpolation differ by more than the error, one per triangle."""
    there = surface.at(of.states)
    doubt = surface.bend(of.states) / np.maximum(scale, np.abs(there))
    doubt = np.nan_to_num(doubt, nan=0.0).max(axis=1)
    doubt[of.rows == 0] = 0.0
    triangle = surface.triangle(of.states)
    chosen: dict[int, int] = {}
    for k in np.argsort(-doubt):
        if doubt[k] <= error or len(chosen) == BATCH:
            break
        if int(k) not in known:
            chosen.setdefault(int(triangle[k]), int(k))
    return list(chosen.values())


def _drawn(
    of: SeaStates,
    surface: Surface,
    allowed: FloatArray,
    scale: FloatArray,
    known: list[int],
    draw: np.random.Generator,
) -> list[int]:
    """Sea states that the surface does not use: half drawn by their rows, half near an allowable."""
    free = of.rows > 0
    free[known] = False
    near = (np.abs(surface.at(of.states) - allowed) <= NEAR * scale).any(axis=1)
    found: list[int] = []
    for among, count in ((free & near, HELD_OUT // 2), (free, HELD_OUT)):
        among[found] = False
        places = np.flatnonzero(among)
        weights = of.rows[places] / max(of.rows[places].sum(), 1)
        count = min(count - len(found), len(places))
        if count > 0:
            found += [int(k) for k in draw.choice(places, count, replace=False, p=weights)]
    return found


def _whole(
    of: SeaStates,
    known: list[int],
    responses: FloatArray,
    held: list[int],
    simulated: FloatArray,
    off: FloatArray,
) -> Cover:
    largest = np.nanmax(off, axis=0, initial=0.0)
    flags = np.concatenate([np.zeros(len(known), bool), np.ones(len(held), bool)])
    return Cover(of.states[[*known, *held]], np.concatenate([responses, simulated]), flags, largest)
