"""Grade false claims by the grader for published values and claims."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.errors import InputError
from riserstudy.grading.false_claims import Falsified, false_claims_path
from riserstudy.grading.grade import Checks, graded
from riserstudy.grading.models import Item, PublishedFile
from riserstudy.grading.summary import ACCEPTED
from riserstudy.records.graded import Graded, Verdict


@dataclass(frozen=True)
class FalseRow:
    """One line of false_claims.csv.

    Attributes
    ----------
    made_from, verdict_of_that : ID and verdict of the published value or claim from which it is derived.
    how : kind of the falsification. subtle : whether its content is nearly the published one.
    verdict : verdict of the grader. accepted : whether the verdict accepts it as true, a false positive.
    met, samples : number of samples that meet it, and of all samples; None without samples.
    """

    paper: str
    id: str
    made_from: str
    how: str
    subtle: bool
    statement: str
    published: float | None
    simulated: float | None
    verdict: Verdict
    accepted: bool
    met: int | None
    samples: int | None
    verdict_of_that: Verdict


def false_rows(
    config: Path,
    file: PublishedFile,
    false: Sequence[Falsified],
    datasets: Mapping[str, xr.Dataset],
    checks: Checks,
    printed: Sequence[Graded],
) -> Iterator[FalseRow]:
    """A row for every false claim about a paper.

    ``printed``: results of the paper's published values and claims. Raises InputError when variables or
    values to exchange do not exist; also as ``graded``.
    """
    items, verdicts = {item.id: item for item in file.items}, {g.id: g.verdict for g in printed}
    for one in false:
        where = f"{false_claims_path(config, file.paper)}: {one.id}"
        item = _exchange_arguments(one.item(items[one.of]), one)
        names = {*item.reads.values(), *item.over.values()}
        own = falsified({name: datasets[name] for name in names}, one, item, where)
        others = [items[i] for i in item.together]
        found = graded(file.paper, item, checks, own, file.called, others)
        yield _row(one, found, verdicts[one.of])


def _row(one: Falsified, found: Graded, verdict_of_that: Verdict) -> FalseRow:
    judged = [case for case in found.cases if case.judged]
    many = len(judged) > 1
    return FalseRow(
        *(found.paper, one.id, one.of, one.how, one.subtle, one.statement),
        *(found.published, found.simulated, found.verdict, found.verdict in ACCEPTED),
        sum(bool(case.met) for case in judged) if many else None,
        len(judged) if many else None,
        verdict_of_that,
    )


def _exchange_arguments(item: Item, one: Falsified) -> Item:
    """The item with exchanged dataset arguments of its check, if a pair names two of them."""
    for a, b in one.exchanged:
        if a in item.reads and b in item.reads:
            fields = {
                name: {**reads, a: reads[b], b: reads[a]} if reads else reads
                for name, reads in (("reads", item.reads), ("over", item.over))
            }
            item = item.replaced(**fields)
    return item


def falsified(
    datasets: Mapping[str, xr.Dataset], one: Falsified, item: Item, where: str
) -> dict[str, xr.Dataset]:
    """Datasets of one check with the variables, axis values and signs of a false claim.

    Raises InputError when no dataset has the variables or axes to change.
    """
    changed = dict(datasets)
    variables = [pair for pair in one.exchanged if not set(pair) <= set(item.reads)]
    for a, b in variables:
        for name in _those_with(changed, (a, b), where):
            changed[name] = changed[name].rename({a: b, b: a})
    for axis, pair in one.relabelled.items():
        for name in _those_with(changed, (axis,), where):
            changed[name] = _relabelled(changed[name], axis, pair, where)
    for axis in one.reversed:
        for name in _those_with(changed, (axis,), where):
            values = changed[name][axis].values[::-1]
            changed[name] = _with_values(changed[name], axis, values)
    for variable in one.negated:
        for name in _those_with(changed, (variable,), where):
            changed[name] = changed[name].assign({variable: -changed[name][variable]})
    return changed


def _those_with(datasets: Mapping[str, xr.Dataset], variables: Sequence[str], where: str) -> list[str]:
    """Names of the datasets that have all of some variables or axes."""
    there = [name for name, dataset in datasets.items() if all(v in dataset for v in variables)]
    if not there:
        known = sorted({str(v) for dataset in datasets.values() for v in dataset.variables})
        raise _missing(where, " and ".join(variables), known)
    return there


def _relabelled(
    dataset: xr.Dataset, axis: str, pair: tuple[str | float, str | float], where: str
) -> xr.Dataset:
    values = dataset[axis].values.tolist()
    for value in pair:
        if value not in values:
            raise _missing(where, f"{axis}: {value}", map(str, values))
    other = {pair[0]: pair[1], pair[1]: pair[0]}
    return _with_values(dataset, axis, np.array([other.get(v, v) for v in values]))


def _with_values(dataset: xr.Dataset, axis: str, values: Any) -> xr.Dataset:
    """A dataset with other values on an axis, sorted if they are numbers."""
    relabelled = dataset.assign_coords({axis: (axis, values, dataset[axis].attrs)})
    return relabelled.sortby(axis) if np.issubdtype(values.dtype, np.number) else relabelled


def _missing(where: str, kind: str, there: Iterable[str]) -> InputError:
    found = "no dataset of the claim has this name"
    return InputError(where, kind, found, f"use one of {', '.join(there)}")
