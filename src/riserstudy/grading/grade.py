"""Grade datasets against what a paper printed: one row a number or claim, one an erratum."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, fields, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from scipy.stats import binomtest

from riserstudy.dataset.origins import origins_of
from riserstudy.errors import SimulationError
from riserstudy.grading.margin import below
from riserstudy.grading.models import Checked, Erratum, Item, PublishedFile
from riserstudy.grading.names import input_name, option_name
from riserstudy.grading.sensitivity import deciding, listed, shares_by_option
from riserstudy.grading.sequential import settled
from riserstudy.grading.verdict import (
    Verdict,
    error,
    met,
    tolerance,
    verdict_of_claim,
    verdict_of_number,
)

Datasets = Mapping[str, xr.Dataset]
Checks = Callable[[str], Callable[..., Any]]  # by their names
MANY = 100  # samples from which a band is told
ENDS = (0.05, 0.95)  # shares of the samples between which margins are told


class Found(NamedTuple):
    """What a check finds: a quantity, and for a claim whether it is true; over the same cells.

    ``given``: where what the claim takes for granted is so, over samples; others are not judged. Absent: all.
    ``margin``: how far the claim is from where it would turn, as `riserstudy.grading.margin` has it.
    """

    value: xr.DataArray
    true: xr.DataArray | None = None
    given: xr.DataArray | None = None
    margin: xr.DataArray | None = None

    def at(self, cell: Mapping[str, Any]) -> Found:
        """One cell of it."""
        return Found(*(None if part is None else part.sel(cell) for part in self))  # type: ignore[arg-type]

    def granted(self) -> Found:
        """The samples that may be judged."""
        if self.given is None or "sample" not in self.given.dims:
            return self
        return self.at({"sample": self.given["sample"][self.given.values]})


def judged(value: xr.DataArray, margin: xr.DataArray, given: xr.DataArray | None = None) -> Found:
    """A claim that is true where its margin is above zero."""
    return Found(value, margin > 0.0, given, margin)


@dataclass(frozen=True)
class Row:
    """One line of reproduction.csv; the fields are its columns."""

    paper: str
    id: str
    figure: str
    kind: str
    statement: str
    published: float | None
    simulated: float | None
    unit: str
    error: float | None
    verdict: Verdict
    depends_on: str
    margin: float | None
    margin_low: float | None
    margin_high: float | None
    note: str


@dataclass(frozen=True)
class Margin:
    """One line of margins.csv: how far one case of a number or claim is from where it would turn.

    ``place`` names the case: sample and cell of the axes that are judged, nothing where there is one case.
    """

    paper: str
    id: str
    place: str
    margin: float


class Weighed(NamedTuple):
    """The row of a number or claim, and the margin of each case that it is judged by."""

    row: Row
    margins: list[Margin]


@dataclass(frozen=True)
class ErratumRow:
    """One line of errata.csv; the fields are its columns."""

    paper: str
    id: str
    where: str
    printed: str
    reading: str
    simulation: str


def grade(file: PublishedFile, datasets: Datasets, checks: Checks) -> list[Row]:
    """A row for every number and claim of a paper, by its checks; as ``weigh``."""
    return [item.row for item in weigh(file, datasets, checks)]


def weigh(file: PublishedFile, datasets: Datasets, checks: Checks) -> list[Weighed]:
    """Every number and claim of a paper, by its checks.

    Raises
    ------
    SimulationError
        When a check finds no finite value.
    """
    return [weighed(file.paper, item, checks, datasets, file.called) for item in file.items]


def graded(
    paper: str,
    item: Item,
    checks: Checks,
    datasets: Datasets,
    called: Mapping[str, str] | None = None,
) -> Row:
    """The row of one number or claim; as ``weighed``."""
    return weighed(paper, item, checks, datasets, called).row


def weighed(
    paper: str,
    item: Item,
    checks: Checks,
    datasets: Datasets,
    called: Mapping[str, str] | None = None,
) -> Weighed:
    """The row of one number or claim, with the margins of all its cases.

    ``called``: what inputs are called, as in ``riserstudy.grading.names.input_name``.

    Raises
    ------
    SimulationError
        When a check finds no finite number.
    """
    if item.impossible:
        row = _row(paper, item, None, None, "not reproducible", "", [item.impossible, item.note])
        return Weighed(row, [])
    look = partial(_look, item, checks=checks, datasets=datasets)
    looked = look(item.reads)
    base = looked.at(item.base) if item.base else looked
    space = look(item.over) if item.over else looked
    judged, left_out = space.granted(), ""
    if judged is not space:
        left_out = _judged_in_words(judged.value.size, space.value.size)
        space = judged if judged.value.size else base
    simulated = float(base.value)
    if not math.isfinite(simulated):
        raise SimulationError(f"{paper}/{item.id}: {item.check} finds {simulated}")
    # a claim is judged over what is open, where a value fitted for the base case may be free
    judging = item.datasets if item.kind == "number" or not item.over else item.over.values()
    calibrated = any(_calibrated(datasets[name]) for name in judging)
    hits = _hits(item, space)
    share = float(hits.mean())
    if item.published is None:
        off, verdict = None, verdict_of_claim(share, calibrated)
    else:
        off = error(simulated, item.published)
        sampled = share if hits.ndim else None
        verdict = verdict_of_number(bool(_hits(item, base)), sampled, calibrated)
    about = datasets[next(iter((item.over or item.reads).values()))]
    if left_out and hits.ndim:
        about = about.sel(sample=hits["sample"])
    depends_on, said = _explained(item, hits, about, verdict, called) if hits.ndim else ("", "")
    cases = [_case(item, "Base case", base, about, called) if item.published is None else ""]
    for name, reads in item.beside.items():
        about = datasets[next(iter(reads.values()))]
        cases.append(_case(item, name, _at_base(item, look(reads)), about, called))
    sure = settled(hits.values) if hits.dims == ("sample",) and hits.size >= MANY else ""
    notes = [said, left_out, sure, *cases, item.note]
    row = _row(paper, item, simulated, off, verdict, depends_on, notes)
    margin, at_base = _margin(item, space), _margin(item, base)
    if margin is None or at_base is None:
        return Weighed(row, [])
    if margin.ndim:
        low, high = (float(margin.quantile(share)) for share in ENDS)
        row = replace(row, margin_low=low, margin_high=high)
    # a base case that is compared in several ways has several
    row = replace(row, margin=None if at_base.ndim else float(at_base))
    return Weighed(row, list(_margins(paper, item, margin)))


def _margin(item: Item, found: Found) -> xr.DataArray | None:
    """How far a number is from the end of its tolerance, a claim from where it would turn; -1 to 1."""
    if item.published is None or item.rounding is None:
        return None if found.margin is None else found.margin.clip(-1.0, 1.0)
    off = abs(found.value - item.published)
    return below(off, tolerance(item.published, item.rounding)).clip(-1.0, 1.0)


def _margins(paper: str, item: Item, margin: xr.DataArray) -> Iterator[Margin]:
    """The margin of each case, by name."""
    for index, value in np.ndenumerate(margin.values):
        at = zip(margin.dims, index, strict=True)
        names = [f"{dim}={margin[dim].values[k]}" for dim, k in at]
        yield Margin(paper, item.id, "; ".join(names), float(value))


def _hits(item: Item, found: Found) -> xr.DataArray:
    """Where a number is met, or a claim true."""
    if item.published is None or item.rounding is None:
        if found.true is None:
            raise TypeError(f"{item.id}: {item.check} judges no claim")
        return found.true
    hits: xr.DataArray = xr.apply_ufunc(
        partial(met, published=item.published, rounding=item.rounding), found.value, vectorize=True
    )
    return hits


def _at_base(item: Item, found: Found) -> Found:
    """The cells of a further case that lie at the base where it has the same dimensions."""
    return found.at({dim: value for dim, value in item.base.items() if dim in found.value.dims})


def _case(
    item: Item, name: str, found: Found, about: xr.Dataset, called: Mapping[str, str] | None
) -> str:
    """One further case as a sentence, of one cell or many."""
    hits = _hits(item, found)
    words = ("met", "missed") if item.kind == "number" else ("true", "false")
    unit = f" {item.unit}" if item.unit not in ("", "1") else ""
    if not hits.ndim:
        hit = words[0] if bool(hits) else words[1]
        return f"{name}: {float(found.value):.3g}{unit}, {hit}."
    low, high = float(found.value.min()), float(found.value.max())
    names = [input_name(name, called) for name in deciding(hits, about).names]
    by = f", decided by {listed(names)}" if names else ""
    return f"{name}: {low:.3g} to {high:.3g}{unit}, {_hits_in_words(hits, words[0])}{by}."


def _hits_in_words(hits: xr.DataArray, word: str) -> str:
    """How many samples are hits."""
    percent = f"{100 * float(hits.mean()):.0f} %{_band(hits)}"
    return f"{word} in {int(hits.sum())} of {hits.size} samples ({percent})"


def _judged_in_words(judged: int, samples: int) -> str:
    """How many samples a claim with a premise is judged by."""
    if not judged:
        return f"What it takes for granted is so in none of {samples} samples; judged by the base case."
    return f"Judged where what it takes for granted is so: {judged} of {samples} samples."


def errata(file: PublishedFile, datasets: Datasets, checks: Checks) -> list[ErratumRow]:
    """A row for every erratum of a paper, its text filled with what was simulated."""
    return [
        ErratumRow(file.paper, e.id, e.where, e.printed, e.reading, _filled(e, checks, datasets))
        for e in file.errata
    ]


def table(rows: Iterable[Any], kind: type) -> str:
    """Rows as CSV text with a header; numbers to six digits."""
    text = io.StringIO()
    writer = csv.DictWriter(text, [field.name for field in fields(kind)], lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({name: _cell(value) for name, value in asdict(row).items()})
    return text.getvalue()


def _look(entry: Checked, reads: Mapping[str, str], checks: Checks, datasets: Datasets) -> Any:
    return checks(entry.check or "")(
        **{name: datasets[of] for name, of in reads.items()}, **entry.options
    )


def _filled(erratum: Erratum, checks: Checks, datasets: Datasets) -> str:
    if not erratum.check:
        return erratum.simulation
    return erratum.simulation.format(**_look(erratum, erratum.reads, checks, datasets))


def _explained(
    item: Item,
    hits: xr.DataArray,
    about: xr.Dataset,
    verdict: Verdict,
    called: Mapping[str, str] | None,
) -> tuple[str, str]:
    """What decides, and the share of the samples, as text."""
    word = "met" if item.kind == "number" else "true"
    share = _hits_in_words(hits, word)
    if verdict != "depends":
        return "", f"{share[0].upper()}{share[1:]}."
    names, why = deciding(hits, about, called)
    said = [why, *_by_option(hits, about, names, word, called)]
    in_words = [input_name(name, called) for name in names]
    name = listed(in_words) if names else "no single input or pair"
    return f"{name}; {share}", " ".join(text for text in said if text)


def _by_option(
    hits: xr.DataArray,
    about: xr.Dataset,
    names: list[str],
    word: str,
    called: Mapping[str, str] | None,
) -> Iterator[str]:
    """How often it comes out under each option of deciding inputs, a sentence an input."""
    for name, shares in shares_by_option(hits, about, names).items():
        each = "; ".join(f"{option_name(o)} ({100 * share:.0f} %)" for o, share in shares.items())
        yield f"{word.capitalize()} by {input_name(name, called)}: {each}."


def _band(hits: xr.DataArray) -> str:
    """95 % confidence band of a share of many samples, by Wilson; too wide for evenly spread ones.

    All cells of a sample count as one draw.
    """
    count = hits.sizes.get("sample", 0)
    if count < MANY:
        return ""
    true = round(float(hits.mean()) * count)
    band = binomtest(true, count).proportion_ci(method="wilson")
    return f", {100 * band.low:.0f} to {100 * band.high:.0f} %"


def _calibrated(dataset: xr.Dataset) -> bool:
    return "calibrated" in origins_of(dataset).values()


def _row(
    paper: str,
    item: Item,
    simulated: float | None,
    off: float | None,
    verdict: Verdict,
    depends_on: str,
    notes: list[str],
) -> Row:
    note = " ".join(text for text in notes if text)
    return Row(
        paper,
        item.id,
        item.figure,
        item.kind,
        item.statement,
        item.published,
        simulated,
        item.unit,
        off,
        verdict,
        depends_on,
        None,
        None,
        None,
        note,
    )


def _cell(value: Any) -> Any:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else value
