"""Fit the calibrated values of a study to published values, by a continuous search within their ranges.

``python -m riserstudy.jobs.calibrate mao_hangoff/nearest N1 N2 N3`` prints the values that minimise the
largest relative error of the numbers. The free values are those that the study sets as ``calibrated`` with a
range. The search writes no file: the user copies its result into the study file. No rule of the workflow runs
it, because a search needs hundreds of runs.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.optimize import minimize

from riserstudy.chapters import checks_of
from riserstudy.chapters.derive import derive
from riserstudy.errors import InputError, SimulationError
from riserstudy.grading.models import Item
from riserstudy.grading.printed import with_printed
from riserstudy.grading.published import read_published
from riserstudy.simulation.refine import run
from riserstudy.study.collect import dataset_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.models import Derived

CONFIG = Path("config")
MOST = 400  # evaluations per start
STARTS = 3  # the largest error has edges, onto which a simplex shrinks: it is restarted there
FIRST_STEP = 0.1  # as a share of a range
NO_RUN = 1e3  # relative error that is assumed where a run cannot be completed


class Free(NamedTuple):
    """A calibrated value of a study: path in the scene, starting value, range and unit."""

    path: str
    start: float
    low: float
    high: float
    unit: str

    def value(self, share: float) -> str | float:
        """Return the value at a share (1) of the range, in the notation of study files."""
        digits = f"{self.low + share * (self.high - self.low):.4g}"
        return f"{digits} {self.unit}" if self.unit else float(digits)


class Fit(NamedTuple):
    """Result of a search: shares of the ranges, the largest relative error, and number of evaluations."""

    shares: list[float]
    miss: float
    looks: int


def free_values(study: Study) -> list[Free]:
    """Return the calibrated values of a study that have a range.

    Raises InputError when the study has none.
    """
    free = []
    for path, value in study.model.set.items():
        if isinstance(value, dict) and "calibrated" in value and "range" in value:
            low, high = (float(str(end).split()[0]) for end in value["range"])
            number, _, unit = str(value["calibrated"]).partition(" ")
            free.append(Free(path, float(number), low, high, unit))
    if not free:
        raise InputError(study.where, "set", "no calibrated values with a range", "add range")
    return free


def with_values(study: Study, free: Sequence[Free], shares: Sequence[float]) -> Study:
    """Return the study with its free values at the given shares (1) of their ranges."""
    sets = dict(study.model.set)
    for one, share in zip(free, shares, strict=True):
        sets[one.path] = sets[one.path] | {"calibrated": one.value(share)}
    return replace(study, model=study.model.model_copy(update={"set": sets}))


def values_of(study: Study, items: Sequence[Item], derived: dict[str, Derived]) -> dict[str, float]:
    """Simulate a study; return the simulated values of numbers whose checks read this study alone."""
    results = [run(study.grid.file(point.index).resolved(), estimated=False) for point in study.plan]
    runs = dataset_of(study, results)
    values = {}
    for item in items:
        reads = {name: _read(study, of, derived, runs) for name, of in item.reads.items()}
        value = checks_of(study.paper)(item.check or "")(**reads, **item.options).value
        at = {dim: cell for dim, cell in item.base.items() if dim in value.dims}
        values[item.id] = float(value.sel(at))
    return values


def _read(study: Study, name: str, derived: dict[str, Derived], runs: xr.Dataset) -> xr.Dataset:
    """Return a dataset that a check reads: one derived from the study alone, else the study's own runs."""
    if name in derived and derived[name].reads == [study.name]:
        settings = with_printed(derived[name].settings, CONFIG, study.paper)
        return derive(study.paper, name, {study.name: runs}, settings)
    return runs


def worst_miss(found: dict[str, float], items: Sequence[Item]) -> float:
    """Return the largest relative error (1) of the numbers."""
    return max(abs(found[item.id] / (item.published or 0.0) - 1.0) for item in items)


def search(miss: Callable[[Sequence[float]], float], start: Sequence[float], most: int = MOST) -> Fit:
    """Find the point of the unit cube at which a function (here the largest error) is least.

    References
    ----------
    Nelder and Mead (1965); the simplex is restarted at the point onto which it has shrunk.
    """
    best, looks = Fit([*start], miss(start), 1), 1
    for _ in range(STARTS):
        corner = np.array(best.shares)
        away = np.where(corner < 0.5, FIRST_STEP, -FIRST_STEP)
        simplex = np.vstack([corner, corner + np.diag(away)])
        minimum = minimize(
            miss,
            corner,
            method="Nelder-Mead",
            bounds=[(0.0, 1.0)] * len(corner),
            options={"maxfev": most, "initial_simplex": simplex, "xatol": 1e-3, "fatol": 1e-5},
        )
        looks += int(minimum.nfev)
        if minimum.fun >= best.miss:
            break
        best = Fit([float(x) for x in minimum.x], float(minimum.fun), looks)
    return best._replace(looks=looks)


def calibrate(study: Study, items: Sequence[Item], derived: dict[str, Derived], most: int) -> Fit:
    """Fit the free values of a study to published values.

    Raises InputError when the study has no free value, or a number has no published value.
    """
    free = free_values(study)
    if not items or any(item.published is None for item in items):
        raise InputError(study.where, "", "no published numbers to fit to", "name some by ID")

    def miss(shares: Sequence[float]) -> float:
        try:
            return worst_miss(values_of(with_values(study, free, shares), items, derived), items)
        except SimulationError:
            return NO_RUN

    fit = search(miss, [(one.start - one.low) / (one.high - one.low) for one in free], most)
    for one, share in zip(free, fit.shares, strict=True):
        print(f"{one.path}: {one.value(share)}")
    reached = values_of(with_values(study, free, fit.shares), items, derived)
    for item in items:
        print(f"{item.id}: {reached[item.id]:.4g} {item.unit}, printed {item.published:g}")
    print(f"largest relative error {100.0 * fit.miss:.2f} % after {fit.looks} trials")
    return fit


def fit_study(config: Path, study: str, ids: list[str], tier: str, most: int | None) -> Fit:
    """Fit a study, named ``paper/study``, to published values of its paper.

    Raises InputError when the study does not exist.
    """
    paper, _, name = study.partition("/")
    file = read_studies(config, paper)
    if name not in file.studies:
        raise InputError(config / "studies" / f"{paper}.yaml", "studies", f"no study {name!r}", "")
    published = read_published(config, paper, set(file.datasets))
    items = [item for item in published.items if item.id in ids]
    made = Study(paper, name, file.studies[name], config, tier, None, file.readings)  # type: ignore[arg-type]
    return calibrate(made, items, dict(file.derived), most or MOST)


if __name__ == "__main__":
    from riserstudy.jobs.tasks import run as run_job

    sys.exit(run_job(["calibrate", *sys.argv[1:]]))
