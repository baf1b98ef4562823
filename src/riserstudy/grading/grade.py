"""Grade datasets against a paper: a record for every published value and claim, a row for every erratum."""

from __future__ import annotations

import math
import string
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from riserstudy.dataset.unit_names import factor_between
from riserstudy.errors import InputError, SimulationError
from riserstudy.grading.cases import Sources, places_of, regrade
from riserstudy.grading.confidence import MANY, share_with_interval
from riserstudy.grading.found import FALSE, NO_DIFFERENCE, TRUE, Found, answers, at_cell, consistent, judged
from riserstudy.grading.grounds import explained, outcome_of, settled
from riserstudy.grading.margin import below
from riserstudy.grading.models import Checked, Erratum, Item, PublishedFile
from riserstudy.grading.readings import axes_of_readings, base_share, readings_of
from riserstudy.grading.rows import ErratumRow
from riserstudy.grading.verdict import SLACK, error, met, tolerance
from riserstudy.records.graded import (
    Case,
    Chosen,
    Graded,
    Grounds,
    Meaning,
    Missing,
    Outcome,
    Premise,
    Together,
    Verdict,
)

__all__ = ["Found", "answers", "errata", "grade", "graded", "judged"]

Datasets = Mapping[str, xr.Dataset]
Checks = Callable[[str], Callable[..., Any]]  # by their names
#: attribute of a dataset without a scene: whether it depends on an input fitted to a published value
FITTED = "rests_on_fitted"
ENDS = (0.05, 0.95)  # quantiles of the samples between which margins are reported


def grade(file: PublishedFile, datasets: Datasets, checks: Checks) -> list[Graded]:
    """Results of every published value and claim of a paper, by its checks; raises as ``graded``."""
    by_id = {item.id: item for item in file.items}
    return [
        graded(file.paper, item, checks, datasets, file.called, [by_id[i] for i in item.together])
        for item in file.items
    ]


def graded(
    paper: str,
    item: Item,
    checks: Checks,
    datasets: Datasets,
    called: Mapping[str, str] | None = None,
    others: Sequence[Item] = (),
) -> Graded:
    """One published value or claim, with the grounds of its verdict and all its cases.

    ``called``: names of inputs, as in ``riserstudy.grading.names.input_name``. ``others``: published values
    that the same case must meet. Raises SimulationError when a check finds no finite number, or no answer, at
    the base. Raises InputError when a check contradicts itself, or has no result at the base.
    """
    printed = (paper, item.id, item.figure, item.kind, item.statement, item.published)
    if item.impossible:
        grounds = Grounds(impossible=item.impossible, note=item.note)
        return Graded(*printed, None, item.unit, None, "not reproducible", grounds)
    if item.not_comparable:
        grounds = Grounds(not_comparable=item.not_comparable, note=item.note)
        return Graded(*printed, None, item.unit, None, "not comparable", grounds)
    task = Task(paper, item, checks, datasets, called, others)
    looked = task.look(item.reads)
    base = task.at_base(looked, item.base)
    every = task.look(item.over) if item.over else looked
    space = every.granted() if every.granted().value.size else base
    simulated, at_base = float(base.value), _answers(item, base)
    if not math.isfinite(simulated) or bool(at_base.isnull().any()):
        lacking = "no margin" if math.isfinite(simulated) else "no finite value"
        raise _without(f"{paper}/{item.id}", item, f"{lacking} for the scene as assumed")
    # of a claim whose premise no sample meets, the base case alone shows nothing
    unjudged = item.kind == "claim" and not every.granted().value.size
    cases = [replace(case, judged=case.judged and not unjudged) for case in _cases(task, base, space)]
    verdict: Verdict | None = "depends" if unjudged else regrade(item.kind, cases)
    if verdict is None:
        raise _without(f"{paper}/{item.id}", item, "no result in any case")
    found = _answers(item, space)
    off = None if item.published is None else error(simulated, item.published)
    grounds = _grounds(task, base, every, found)
    if unjudged:
        grounds = replace(grounds, because="too few samples")
    elif found.ndim:
        known = regrade(item.kind, [case for case in cases if case.met is not None])
        hit = bool((at_base > 0.0).all())
        about = task.about if space is every else task.about.sel(sample=found["sample"])
        shares = replace(
            grounds,
            share=base_share(found, item.base) if axes_of_readings(found) else share_with_interval(found),
            readings=readings_of(item.kind, found, about, called),
        )
        grounds = explained(shares, found, about, known or verdict, hit, called)
        if known != verdict:
            grounds = replace(grounds, because="missing values", settled=None)
    margins = _margins(_margin(item, space), _margin(item, base))
    return Graded(*printed, simulated, item.unit, off, verdict, grounds, *margins, cases)


class Task(NamedTuple):
    """A published value or claim of a paper, and the datasets that its check reads."""

    paper: str
    item: Item
    checks: Checks
    datasets: Datasets
    called: Mapping[str, str] | None
    others: Sequence[Item]

    @property
    def about(self) -> xr.Dataset:
        """The dataset with the assumptions of its samples."""
        return self.datasets[next(iter((self.item.over or self.item.reads).values()))]

    def look(self, reads: Mapping[str, str]) -> Found:
        """The result of its check in some datasets.

        Raises InputError when the check returns neither a result nor, for a published value, a number.
        """
        found = self._found(self.item, reads)
        for other in self.others:
            theirs = self._found(other, reads)
            found = _together(self.item, found, other, theirs)
        return consistent(found, self.paper, self.item.check or "")

    def _found(self, item: Item, reads: Mapping[str, str]) -> Found:
        """The result of an item's check; the check of a published value may return a number alone.

        Raises InputError when the check returns anything else, or a quantity in another unit.
        """
        answer = _answer(item, reads, self.checks, self.datasets)
        where = f"config/published/{self.paper}.yaml"
        if item.kind == "number" and isinstance(answer, int | float | xr.DataArray):
            answer = Found(xr.DataArray(answer))
        if isinstance(answer, Found):
            unit = str(answer.value.attrs.get("units", item.unit))
            if item.unit and factor_between(unit, item.unit) != 1.0:
                allowed = f"write {unit!r}, or convert the result in the check"
                raise InputError(
                    where,
                    f"{item.id}.unit",
                    f"the unit is {item.unit!r}, but the check {item.check} returns {unit!r}",
                    allowed,
                )
            return answer
        found = f"the check {item.check} returns {answer!r}"[:60]
        allowed = "return judged(value, margin) for a claim, and the number itself for a number"
        raise InputError(where, f"{item.id}.check", found, allowed)

    def at_base(self, found: Found, cell: Mapping[str, Any]) -> Found:
        """The cell of the base case."""
        if not cell:
            return found
        return at_cell(found, cell, f"config/published/{self.paper}.yaml", f"{self.item.id}.base")


def _together(item: Item, found: Found, other: Item, theirs: Found) -> Found:
    """A published value that counts as met only where another is met, too."""
    mine = _room(item, found.value) if found.margin is None else found.margin
    room = xr.apply_ufunc(np.minimum, mine, _room(other, theirs.value))
    on_the_bound = (room <= 0.0) & (room > -SLACK)  # counts as met, as for a single value
    return judged(found.value, room.where(~on_the_bound, SLACK), found.given)


def _grounds(task: Task, base: Found, every: Found, found: xr.DataArray) -> Grounds:
    """Grounds: premise, missing cases, samples until the verdict was certain, base and further cases."""
    item, granted = task.item, every.granted()
    premise = None
    if granted is not every:
        premise = Premise(granted.value.size, every.value.size)
    known = found.values[found.notnull().values]
    many = found.dims == ("sample",) and known.size >= MANY
    left_out = found.size - known.size
    alone = share_with_interval(_met(item, granted.value)) if item.together else None
    hit = bool((_answers(item, base) > 0.0).all())
    return Grounds(
        within=item.within,
        words=[Meaning(*word) for word in item.words],
        premise=premise,
        missing=Missing(left_out, found.size) if left_out else None,
        together=Together(item.together, alone) if alone else None,
        chosen=Chosen(item.chosen.what, item.chosen.varied) if item.chosen else None,
        settled=settled(known > 0.0, item.kind, hit) if many else None,
        outcomes=[*_outcomes(task, base)],
        note=item.note,
    )


def _outcomes(task: Task, base: Found) -> Iterator[Outcome]:
    """The base case of a claim, which has no column, and further cases."""
    item = task.item

    def of(name: str, found: Found, about: xr.Dataset) -> Outcome:
        answer = _answers(item, found)
        many = readings_of(item.kind, answer, about, task.called)
        return outcome_of(name, found.value, answer, about, task.called, many)

    if item.published is None:
        yield of("Base case", base, task.about)
    for name, reads in item.further_cases.items():
        found = task.look(reads)
        there = {dim: value for dim, value in item.base.items() if dim in found.value.dims}
        yield of(name, task.at_base(found, there), task.datasets[next(iter(reads.values()))])


def _cases(task: Task, base: Found, space: Found) -> Iterator[Case]:
    """The base case, and each judged case; one case if these are the same."""
    item, datasets = task.item, task.datasets
    # a claim is judged over unspecified inputs, among which may be one that is fitted in the base case
    judging = {*item.over.values()} if item.kind == "claim" and item.over else item.datasets
    calibrated = any(_rests_on_fitted(datasets[name]) for name in judging)
    calibrated |= item.chosen is not None and not item.chosen.varied

    def of(found: Found, reads: Mapping[str, str], at: Mapping[str, Any]) -> Iterator[Case]:
        sources = Sources(task.paper, {name: datasets[name] for name in reads.values()})
        answer, margin = _answers(item, found), _margin(item, found)
        for index, own in places_of(answer):
            place, one = {**at, **own}, float(answer.values[index])
            known = not math.isnan(one)
            here = math.nan if margin is None else float(margin.values[index])
            yield Case(
                *(task.paper, item.id, place, False, known),
                one > 0.0 if known else None,
                one == NO_DIFFERENCE,
                None if math.isnan(here) or not known else here,
                calibrated,
                sources.rests_on(place),
            )

    if space is base:
        yield from (replace(case, base=True) for case in of(base, item.reads, item.base))
        return
    cases = [*of(space, item.over or item.reads, {})]
    if not item.over:
        cases = [replace(case, base=_is_at(case, item.base)) for case in cases]
    if not any(case.base for case in cases):  # the base case is not among the judged cases
        alone = of(base, item.reads, item.base)
        yield from (replace(case, base=True, judged=False) for case in alone)
    yield from cases


def _rests_on_fitted(dataset: xr.Dataset) -> bool:
    """Whether a dataset depends on an input that was fitted to a published value."""
    if FITTED in dataset.attrs:
        return bool(dataset.attrs[FITTED])
    from riserstudy.dataset.origins import origins_of  # imports scenes

    return "calibrated" in origins_of(dataset).values()


def _is_at(case: Case, cell: Mapping[str, Any]) -> bool:
    return all(case.place.get(axis) == value for axis, value in cell.items())


def _margins(
    margin: xr.DataArray | None, at_base: xr.DataArray | None
) -> tuple[float | None, float | None, float | None]:
    """The margin of the base case, and the range of nine in ten judged cases."""
    if margin is None or at_base is None:
        return None, None, None
    low, high = (float(margin.quantile(share)) for share in ENDS) if margin.ndim else (None, None)
    # a base case with several comparisons has several margins
    return None if at_base.ndim else float(at_base), low, high


def _margin(item: Item, found: Found) -> xr.DataArray | None:
    """Distance of a value from the end of its tolerance, or of a claim from its change; -1 to 1."""
    if item.published is None or item.together:
        return None if found.margin is None else found.margin.clip(-1.0, 1.0)
    return _room(item, found.value)


def _room(item: Item, value: xr.DataArray) -> xr.DataArray:
    """Distance of a value from the end of its tolerance; -1 to 1."""
    published, rounding = item.published or 0.0, item.rounding or 0.0
    return below(abs(value - published), tolerance(published, rounding, item.within)).clip(-1.0, 1.0)


def _without(where: str, item: Item, found: str) -> SimulationError:
    """Return the error for a check without a result."""
    return SimulationError(f"{where}: the check {item.check} returns {found}; correct the check or its data")


def _answers(item: Item, found: Found) -> xr.DataArray:
    """Whether a published value is met, or a claim is true; as ``answers``."""
    if item.published is None or item.together:
        if found.true is None:
            allowed = "return `judged(value, margin)` for a claim; give published and rounding for a number"
            found_text = f"the check {item.check} does not return whether the claim is true"
            raise InputError("config/published", item.id, found_text, allowed)
        return answers(found)
    return _met(item, found.value)


def _met(item: Item, value: xr.DataArray) -> xr.DataArray:
    """Whether a published value alone is met, as ``answers``."""
    hits = met(value, item.published or 0.0, item.rounding or 0.0, item.within)
    answer: xr.DataArray = xr.where(hits, TRUE, FALSE).where(value.notnull())
    return answer


def errata(file: PublishedFile, datasets: Datasets, checks: Checks) -> list[ErratumRow]:
    """A row for every erratum of a paper, with simulated values inserted into its text."""
    return [
        ErratumRow(file.paper, e.id, e.where, e.printed, e.reading, _filled(e, checks, datasets))
        for e in file.errata
    ]


def _answer(entry: Checked, reads: Mapping[str, str], checks: Checks, datasets: Datasets) -> Any:
    """What a check returns; with a unit only if this is a variable of a dataset, or the check names the unit.

    Elsewhere xarray would keep the unit of an operand: the ratio of two forces would be a force.
    """
    with xr.set_options(keep_attrs=False):
        return checks(entry.check or "")(
            **{name: datasets[of] for name, of in reads.items()}, **entry.options
        )


class _Spaced(string.Formatter):
    """Fills a text; shares, such as {share:.0%}, have a space before the sign."""

    def format_field(self, value: Any, format_spec: str) -> str:
        text = str(super().format_field(value, format_spec))
        return text.replace("%", " %") if format_spec.endswith("%") else text


def _filled(erratum: Erratum, checks: Checks, datasets: Datasets) -> str:
    if not erratum.check:
        return erratum.simulation
    return _Spaced().vformat(erratum.simulation, (), _answer(erratum, erratum.reads, checks, datasets))
