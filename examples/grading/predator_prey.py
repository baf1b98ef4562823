"""Predators and prey: what the claims of ``predator_prey.yaml`` are checked against."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import xarray as xr
from scipy.integrate import solve_ivp

from riserstudy.grading import alike, claim, grade_claims, more, read_claims

SATIETY = 0.15  # prey eaten at half satiety is so many times the balance, inverted
YEARS = 40.0
FISHED = 0.1  # 1/year, of both


def _law(inputs: Mapping[str, object], fished: float = 0.0):
    """Rates of change, and the balance of prey and predators; prey counts in its balance without satiety."""
    growth, decay = inputs["growth"] - fished, inputs["decay"] + fished
    eaten = SATIETY if inputs["feeding"] == "with satiety" else 0.0
    feed = inputs["decay"]  # what a predator gains of a unit of prey

    def rates(_time: float, state: np.ndarray) -> list[float]:
        prey, predators = state
        meal = prey / (1.0 + eaten * prey)
        return [growth * prey - meal * predators, feed * meal * predators - decay * predators]

    prey = decay / (feed - eaten * decay)
    return rates, (prey, growth * (1.0 + eaten * prey))


def first_cycle(inputs: Mapping[str, object]) -> tuple[float, float, float]:
    """Length of the first cycle (years), by how much predators lag (years), mean of prey over its balance."""
    return _first_cycle(*(inputs[name] for name in ("growth", "decay", "start", "feeding")))


@cache
def _first_cycle(growth: float, decay: float, start: float, feeding: str) -> tuple[float, float, float]:
    inputs = {"growth": growth, "decay": decay, "feeding": feeding}
    rates, (prey, predators) = _law(inputs)

    def most_prey(time: float, state: np.ndarray) -> float:
        return rates(time, state)[0]

    def most_predators(time: float, state: np.ndarray) -> float:
        return rates(time, state)[1]

    most_prey.direction = most_predators.direction = -1.0
    run = solve_ivp(
        rates, (0.0, YEARS), [start * prey, predators], events=(most_prey, most_predators),
        rtol=1e-9, atol=1e-12, dense_output=True,
    )  # fmt: skip
    of_prey, of_predators = run.t_events
    first, second = of_prey[of_prey > 0.1][:2]
    lag = of_predators[of_predators > first][0] - first
    times = np.linspace(first, second, 2001)
    mean = np.trapezoid(run.sol(times)[0], times) / (second - first)
    return float(second - first), float(lag), float(mean / prey)


def predators_follow(inputs):
    """Predators peak within the half cycle after the prey; value: by how much later (years)."""
    length, lag, _ = first_cycle(inputs)
    return claim(lag, min(lag / length, 0.5 - lag / length))


def mean_is_balance(inputs, same):
    """Mean of prey over a cycle is its balance; value: their ratio."""
    ratio = first_cycle(inputs)[2]
    return claim(ratio, alike(xr.DataArray(ratio), 1.0, same))


def fishing_helps_prey(inputs, **words):
    """Fishing of both raises the balance of prey; value: the ratio."""
    balances = [_law(inputs, fished)[1][0] for fished in (FISHED, 0.0)]
    return claim(balances[0] / balances[1], more(xr.DataArray(balances[0]), balances[1], words["more"]))


def cycle(inputs):
    """Length of a cycle (years)."""
    return first_cycle(inputs)[0]


CHECKS = {f.__name__: f for f in (predators_follow, mean_is_balance, fishing_helps_prey, cycle)}
FILE = Path(__file__).with_suffix(".yaml")

if __name__ == "__main__":
    for graded in grade_claims(read_claims(FILE), CHECKS):
        print(graded.id, graded.verdict, graded.grounds.to_json())
