"""Fit the calibrated values of a study to published values, by a search within their ranges.

``python -m riserstudy.jobs.calibrate mao_hangoff/nearest N1 N2 N3`` prints the values that minimise the
largest relative error of the numbers. The free values are those that the study sets as ``calibrated`` with a
range. The search tries points all over the ranges, and continues from the best of them; with a single free
value, it continues from each minimum, and all values that fit equally well are printed. The study is then
repeated with finer meshes and shorter time steps, which show how accurate the fit is. The search writes no
file: the user copies its result into the study file. No rule of the workflow runs it, because a search needs
hundreds of runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from riserstudy.chapters import checks_of
from riserstudy.chapters.derive import derive
from riserstudy.errors import InputError, SimulationError
from riserstudy.grading.grade import Task
from riserstudy.grading.models import Item
from riserstudy.grading.printed import with_printed
from riserstudy.grading.published import read_published
from riserstudy.grading.verdict import tolerance
from riserstudy.jobs.search import MOST, Fit, Shares, search
from riserstudy.records.numerals import percent
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.tolerance import DISPLACEMENT
from riserstudy.study.collect import dataset_of
from riserstudy.study.read import read_studies
from riserstudy.study.study import Study

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.study.models import Derived

CONFIG = Path("config")
AT_END = 1e-3  # distance from the end of a range that counts as none, as a share of the range
ASIDE = 0.01  # change of a value that shows whether it has an effect, as a share of a range
DIGITS = 6  # of a value, relative to its range
NO_RUN = 1e3  # relative error that is assumed where a run cannot be completed
FINER = 2  # ratio of segments and of time steps of the run that shows the error of a fit


class Free(NamedTuple):
    """A calibrated value of a study: path in the scene, starting value, range and unit."""

    path: str
    start: float
    low: float
    high: float
    unit: str

    def value(self, share: float) -> str | float:
        """Return the value at a share (1) of the range, in the notation of study files."""
        size = max(abs(self.low), abs(self.high)) / (self.high - self.low)
        figures = DIGITS + max(0, math.ceil(math.log10(size)))
        digits = f"{self.low + share * (self.high - self.low):.{figures}g}"
        return f"{digits} {self.unit}" if self.unit else float(digits)


def free_values(study: Study) -> list[Free]:
    """Return the calibrated values of a study that have a range.

    Raises InputError when the study has none, or when a value is outside its range or in another unit.
    """
    free = []
    for path, value in study.model.set.items():
        if isinstance(value, dict) and "calibrated" in value and "range" in value:
            where = f"set.{path}"
            start, low, high = (_parts(study, where, one) for one in (value["calibrated"], *value["range"]))
            if not start[1] == low[1] == high[1]:
                allowed = "give the value and its range in one unit"
                found = "the units differ in "
                found += ", ".join(map(str, (value["calibrated"], *value["range"])))
                raise InputError(study.where, where, found, allowed)
            if not (low[0] < high[0] and low[0] <= start[0] <= high[0]):
                found = f"{value['calibrated']} is not in the range "
                found += f"{value['range'][0]} to {value['range'][1]}"
                raise InputError(study.where, where, found, "give a value within a range [low, high]")
            free.append(Free(path, start[0], low[0], high[0], start[1]))
    if not free:
        found = "no value is calibrated within a range"
        allowed = "write, for example, {calibrated: 4.5 m, to: paper/N1, range: [0 m, 25 m]}"
        raise InputError(study.where, "set", found, allowed)
    return free


def _parts(study: Study, where: str, value: Any) -> tuple[float, str]:
    """Return number and unit of a value."""
    number, _, unit = str(value).strip().partition(" ")
    try:
        return float(number), unit.strip()
    except ValueError:
        allowed = "write a number with its unit, such as '4.5 m'"
        raise InputError(study.where, where, f"{value!r} does not start with a number", allowed) from None


def with_values(study: Study, free: Sequence[Free], shares: Shares) -> Study:
    """Return the study with its free values at the given shares (1) of their ranges."""
    sets = dict(study.model.set)
    for one, share in zip(free, shares, strict=True):
        sets[one.path] = sets[one.path] | {"calibrated": one.value(share)}
    return replace(study, model=study.model.replaced(set=sets))


def values_of(
    study: Study, items: Sequence[Item], derived: dict[str, Derived], finer: bool = False
) -> dict[str, float]:
    """Simulate a study; return the simulated values of numbers whose checks read one study, here this one.

    ``finer``: whether segments and time steps are half as long, or the tolerance is a quarter. Raises
    InputError when a check reads several datasets, or returns a value in another unit.
    """
    files = [study.grid.file(point.index) for point in study.plan]
    files = [_finer(file) for file in files] if finer else files
    runs = dataset_of(study, [run(file.resolved(), estimated=False) for file in files])
    values = {}
    for item in items:
        datasets = {of: _read(study, item, of, derived, runs) for of in item.reads.values()}
        task = Task(study.paper, item, checks_of(study.paper), datasets, None, ())
        found = task.look(item.reads)
        cell = {dim: at for dim, at in item.base.items() if dim in found.value.dims}
        value = task.at_base(found, cell).value
        if value.size != 1:
            along = " and ".join(map(str, value.dims))
            why = f"the check returns {value.size} values along {along}"
            raise InputError(study.where, item.id, why, "select one of them by 'base'")
        values[item.id] = float(value)
    return values


def _finer(file: SceneFile) -> SceneFile:
    """Return a scene with segments and time steps half as long, or a quarter of its tolerance."""
    analysis = file.resolved().analysis
    changes: dict[str, Any] = {}
    if analysis.mesh:
        changes["analysis.mesh.elements"] = FINER * analysis.mesh.elements
    if analysis.step:
        changes["analysis.step"] = f"{analysis.step / FINER!r} s"
    if not analysis.mesh:
        accuracy = analysis.accuracy / 4.0 if analysis.accuracy else DISPLACEMENT
        changes["analysis.accuracy"] = f"{100.0 * accuracy!r} %"
    return file.with_values(changes, "calibrate")


def _read(study: Study, item: Item, name: str, derived: dict[str, Derived], runs: xr.Dataset) -> xr.Dataset:
    """Return a dataset that a check reads: one derived from the study alone, or the study's own runs.

    The runs also take the place of another study that the check reads. Raises InputError for another derived
    dataset.
    """
    if name not in derived:
        return runs
    if derived[name].reads == [study.name]:
        settings = with_printed(derived[name].settings, CONFIG, study.paper)
        return derive(study.paper, name, {study.name: runs}, settings)
    allowed = f"give a study, or a dataset that is derived from {study.name} alone"
    found = f"{name} is derived from other datasets"
    raise InputError(f"config/published/{study.paper}.yaml", f"{item.id}.reads", found, allowed)


def worst_miss(found: dict[str, float], items: Sequence[Item]) -> float:
    """Return the largest relative error (1) of the numbers."""
    return max(abs(found[item.id] / (item.published or 0.0) - 1.0) for item in items)


def _check_items(study: Study, items: Sequence[Item], derived: dict[str, Derived]) -> None:
    """Check that numbers can be fitted, and print which studies this study stands for.

    Raises InputError when a number has no published value or zero, or its check reads several datasets.
    """
    if not items or any(item.published is None for item in items):
        found = "no published numbers are given to which values are fitted"
        raise InputError(study.where, "", found, "give the IDs of published numbers")
    if zero := [item.id for item in items if item.published == 0.0]:
        found = f"{', '.join(zero)} is 0, for which no relative error exists"
        allowed = "fit to numbers other than 0"
        raise InputError(study.where, "published", found, allowed)
    for item in items:
        read = {*item.reads.values()}
        if len(read) > 1:
            found = f"its check reads several datasets, {', '.join(sorted(read))}"
            raise InputError(study.where, item.id, found, "fit to numbers whose check reads one dataset")
        if read - {study.name, *derived}:
            print(f"{item.id}: its check reads the runs of {study.name} in place of {', '.join(read)}")


def calibrate(study: Study, items: Sequence[Item], derived: dict[str, Derived], most: int) -> Fit:
    """Fit the free values of a study to published values, and print values, numbers and doubts.

    Raises InputError when the study has no free value, or a number cannot be fitted. Raises SimulationError
    when no run can be completed.
    """
    free = free_values(study)
    _check_items(study, items, derived)
    known: dict[tuple[str | float, ...], dict[str, float]] = {}

    def values(shares: Shares) -> dict[str, float]:
        key = tuple(one.value(share) for one, share in zip(free, shares, strict=True))
        if key not in known:
            known[key] = values_of(with_values(study, free, shares), items, derived)
        return known[key]

    def miss(shares: Shares) -> float:
        try:
            worst = worst_miss(values(shares), items)
        except SimulationError:
            return NO_RUN
        return worst if np.isfinite(worst) else NO_RUN

    fit = search(miss, [(one.start - one.low) / (one.high - one.low) for one in free], most)
    if fit.miss >= NO_RUN:
        values(fit.shares)  # which raises the cause
        raise SimulationError(
            f"{study.where}: a check returns no finite number at any value of the ranges; change the ranges"
        )
    for one, share in zip(free, fit.shares, strict=True):
        print(f"{one.path}: {one.value(share)}")
    reached = values(fit.shares)
    for item in items:
        print(f"{item.id}: {reached[item.id]:.4g} {item.unit}, printed {item.published:g}")
    print(f"largest relative error {100.0 * fit.miss:.2f} % after {fit.looks} trials")
    slopes = _slopes(values, fit.shares, free, items)
    lines = [
        *_doubts(free, fit, slopes),
        *_numerical_error(study, free, fit, items, derived, slopes, reached),
    ]
    print("\n".join(lines))
    return fit


def _slopes(
    values: Callable[[Shares], dict[str, float]], shares: Shares, free: Sequence[Free], items: Sequence[Item]
) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Change of numbers, as a share of the published ones, per share of a range: (numbers, free values).

    NaN where a run cannot be completed.
    """
    base, made = values(shares), np.full((len(items), len(free)), np.nan)
    for k, share in enumerate(shares):
        aside = share + (ASIDE if share < 0.5 else -ASIDE)
        try:
            there = values([*shares[:k], aside, *shares[k + 1 :]])
        except SimulationError:
            continue
        for n, item in enumerate(items):
            made[n, k] = (there[item.id] - base[item.id]) / (item.published or 1.0) / (aside - share)
    return made


def _doubts(free: Sequence[Free], fit: Fit, slopes: np.ndarray[Any, np.dtype[np.float64]]) -> Iterator[str]:
    """Sentences about values without effect, at the end of their range, and other values that fit."""
    for k, (one, share) in enumerate(zip(free, fit.shares, strict=True)):
        if (slopes[:, k] == 0.0).all():
            yield f"warning: {one.path} has no effect on the numbers, so its value is arbitrary"
        elif min(share, 1.0 - share) < AT_END:
            yield f"warning: {one.path} is at the end of its range; a value outside may fit better"
    for shares in fit.others:
        words = ", ".join(f"{one.path}: {one.value(x)}" for one, x in zip(free, shares, strict=True))
        yield f"warning: another value fits equally well: {words}"


def _numerical_error(
    study: Study,
    free: Sequence[Free],
    fit: Fit,
    items: Sequence[Item],
    derived: dict[str, Derived],
    slopes: np.ndarray[Any, np.dtype[np.float64]],
    reached: dict[str, float],
) -> Iterator[str]:
    """Sentences about numbers and fitted values on finer meshes, which show the numerical error."""
    try:
        finer = values_of(with_values(study, free, fit.shares), items, derived, finer=True)
    except SimulationError as error:
        yield f"warning: the numerical error is not known, because the finer run failed: {error}"
        return
    changes = np.array([(finer[item.id] - reached[item.id]) / (item.published or 1.0) for item in items])
    coarse = False
    for item, change in zip(items, changes, strict=True):
        published = item.published or 0.0
        large = abs(change * published) > tolerance(published, item.rounding or 0.0, item.within)
        coarse |= large
        yield (
            f"{item.id} in finer runs, with the same values: {finer[item.id]:.4g} {item.unit}, "
            f"a difference of {percent(abs(change))}"
        )
    if len(items) >= len(free) and np.isfinite(slopes).all():
        shift = np.linalg.lstsq(slopes, -changes, rcond=None)[0]
        for one, share in zip(free, shift, strict=True):
            size = abs(share) * (one.high - one.low)
            yield f"{one.path}: finer runs change the fitted value by about {size:.2g} {one.unit}".rstrip()
    if coarse:
        yield (
            "warning: mesh and time step are too coarse for this fit, and its error may be several times "
            "these differences. Use a finer mesh and a shorter time step, or give the study a tolerance "
            "(analysis.accuracy)"
        )


def fit_study(config: Path, study: str, ids: list[str], tier: str, most: int | None) -> Fit:
    """Fit a study, named ``paper/study``, to published values of its paper.

    Raises InputError when the study or a published value does not exist.
    """
    paper, _, name = study.partition("/")
    file = read_studies(config, paper)
    if name not in file.studies:
        allowed = f"use one of {', '.join(file.studies)}"
        where = config / "studies" / f"{paper}.yaml"
        raise InputError(where, "studies", f"the file has no study {name!r}", allowed)
    published = read_published(config, paper, set(file.datasets))
    if missing := [one for one in ids if one not in {item.id for item in published.items}]:
        allowed = f"use one of {', '.join(item.id for item in published.items if item.kind == 'number')}"
        where = config / "published" / f"{paper}.yaml"
        raise InputError(where, "", f"the file has no number {', '.join(missing)}", allowed)
    items = [item for item in published.items if item.id in ids]
    made = Study(paper, name, file.studies[name], config, tier, None, file.readings)  # type: ignore[arg-type]
    return calibrate(made, items, dict(file.derived), most or MOST)
