"""The remaining error of a run, from its differences to runs that are coarser by one and by two halvings."""

from __future__ import annotations

from collections.abc import Mapping

from riserstudy.scene.limits import OF_ONE_PLACE

# largest ratio of successive differences that an estimate uses: second order. A larger ratio is that of an
# error of higher order, which can hide one of second order that is smaller but remains
MOST_FALL = 4.0
LEAST_FALL = 1.5
STEEPEST_FALL = 20.0  # ratio above which it is not plausible; for fourth order it is 16
SURE = {"shear": 2.0, "lift": 2.0}
# quantities of one or two places, whose change can be small by chance, where the error changes its sign. If
# it decreases by more than the order of the method, the estimate uses the change that this order gives
SIGN_CHANGES = tuple(OF_ONE_PLACE)
MOST_BY_CHANCE = 2.0  # largest ratio of these changes that is used
SURE_AFTER_DISCONNECT = {"stroke": 2.0, "tensioner_force": 2.0}


def estimate(
    now: dict[str, float],
    before: dict[str, float] | None,
    most: float = MOST_FALL,
    sure: Mapping[str, float] | None = None,
) -> dict[str, float]:
    """Relative error of the finest of three runs, each twice as fine as the previous, from their differences.

    If differences decrease by a factor q, the remaining error is the last difference divided by q - 1. The
    estimate uses at most ``most`` for q. It uses `LEAST_FALL` if q is smaller or unknown, or larger than the
    order of any method gives, because then the coarsest run has not converged. Where differences of a
    quantity of one place decrease by more than ``most``, the last difference may be small by chance. The
    estimate also uses at most the sure order of a quantity: first order for shear, the slope of the moment,
    near jumps of the load. After a disconnect, which sends steep waves along the riser, it is first order for
    lift, strokes and tensioner forces. ``sure``: largest ratios in place of these, by quantity.
    """
    error = {}
    surest = SURE | (SURE_AFTER_DISCONNECT if "lift" in now else {}) | dict(sure or {})
    for name, value in now.items():
        fall = (before or {}).get(name, 0.0) / value if value > 0.0 else most
        if fall > STEEPEST_FALL:
            fall = LEAST_FALL
        trusted = min(most, surest.get(name, most))
        by_chance = max(fall / most, 1.0) if name in SIGN_CHANGES else 1.0
        error[name] = min(by_chance, MOST_BY_CHANCE) * value / (min(max(fall, LEAST_FALL), trusted) - 1.0)
    return error
