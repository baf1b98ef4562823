"""A pendulum in air: what the claims of ``pendulum.yaml`` are checked against."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import xarray as xr
from scipy.integrate import solve_ivp

from riserstudy.grading import above, alike, below, claim, grade_claims, read_claims

#: drag of the bob over its mass (1/m), by what it is made of
DRAG = {"none": 0.0, "a lead bob": 2e-4, "a wooden bob": 4e-3}
SMALL = 1.0  # deg


def period_and_return(inputs: Mapping[str, object]) -> tuple[float, float]:
    """Period (s), and the height of the first return over that at the start."""
    names = ("length", "gravity", "amplitude", "air")
    return _period_and_return(*(inputs[name] for name in names))


@cache
def _period_and_return(length: float, gravity: float, degrees: float, air: str) -> tuple[float, float]:
    drag, start = DRAG[air] * length, np.radians(degrees)

    def motion(_time: float, state: np.ndarray) -> list[float]:
        angle, speed = state
        return [speed, -gravity / length * np.sin(angle) - drag * abs(speed) * speed]

    def at_rest(_time: float, state: np.ndarray) -> float:
        return state[1]

    at_rest.direction = -1.0  # it stops on the side where it started
    end = 8.0 * np.pi * np.sqrt(length / gravity)
    run = solve_ivp(motion, (1e-9, end), [start, -1e-12], events=at_rest, rtol=1e-9, atol=1e-12)
    back = run.y_events[0][0][0]
    return float(run.t_events[0][0]), float((1.0 - np.cos(back)) / (1.0 - np.cos(start)))


def small_period(inputs):
    """Period at a small amplitude (s)."""
    return period_and_return({**inputs, "amplitude": SMALL})[0]


def isochronous(inputs, same):
    """The period is that of small amplitudes; value: their ratio."""
    ratio = period_and_return(inputs)[0] / small_period(inputs)
    return claim(ratio, alike(xr.DataArray(ratio), 1.0, same))


def comes_back_lower(inputs):
    """The first return is no higher than the start but for the integration's error; value: its height."""
    height = period_and_return(inputs)[1]
    return claim(height, below(height, 1.0 + 1e-6))


def slower_in_proportion(inputs):
    """Four times the length, four times the period; value: ratio of the periods."""
    longer = {**inputs, "length": 4.0 * inputs["length"]}
    ratio = period_and_return(longer)[0] / period_and_return(inputs)[0]
    return claim(ratio, above(ratio, 3.9))


CHECKS = {f.__name__: f for f in (small_period, isochronous, comes_back_lower, slower_in_proportion)}
FILE = Path(__file__).with_suffix(".yaml")

if __name__ == "__main__":
    for graded in grade_claims(read_claims(FILE), CHECKS):
        print(graded.id, graded.verdict, graded.grounds.to_json())
