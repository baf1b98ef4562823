"""Tables of the limits of studies: largest utilisation of each limit, and how many points exceed it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from riserstudy.dataset.limits import EXCEEDED, UNKNOWN, limit_in_words, numbered
from riserstudy.dataset.unit_systems import read_in
from riserstudy.dataset.variables import attributes
from riserstudy.figures.grid import called
from riserstudy.report.formats import counted

if TYPE_CHECKING:
    import xarray as xr


class LimitRow(NamedTuple):
    """One limit at the point of its largest utilisation."""

    limit: str
    allowable: str
    origin: str
    demand: str
    use: str  # utilisation, or margin
    where: str
    verdict: str
    exceeded: bool  # at one or more points
    unknown: bool  # not evaluated at one or more points


class LimitTable(NamedTuple):
    """Limits of one study; ``about`` is its caption."""

    about: str
    points: int
    rows: list[LimitRow]

    @property
    def sentences(self) -> str:
        """Number of limits that are exceeded, or not evaluated, at some point, in words."""
        exceeded, unknown = (sum(row.exceeded for row in self.rows), sum(row.unknown for row in self.rows))
        many, somewhere = counted(len(self.rows), "limit"), "at one or more points of the study"
        left = f"; {unknown} {'is' if unknown == 1 else 'are'} {UNKNOWN} {somewhere}" if unknown else ""
        if not exceeded:
            return f"None of {many} is exceeded{left}"
        return f"{exceeded} of {many} {'is' if exceeded == 1 else 'are'} exceeded {somewhere}{left}"


def limit_tables(datasets: Mapping[str, xr.Dataset], captions: Mapping[str, str]) -> list[LimitTable]:
    """Return one table for each study that has limits; ``captions``: of the studies, by name."""
    return [
        LimitTable(captions[name], dataset["point_key"].size, _rows(dataset))
        for name, dataset in datasets.items()
        if "use_of_limit" in dataset
    ]


def _rows(dataset: xr.Dataset) -> list[LimitRow]:
    axes = [str(dim) for dim in dataset["point_key"].dims]
    limits = json.loads(dataset.attrs["limits"])
    each = enumerate(zip(limits, numbered([_in_words(**one) for one in limits]), strict=True))
    return [_row(dataset.isel(limit=k).transpose(*axes, ...), axes, one, words) for k, (one, words) in each]


def _row(of: xr.Dataset, axes: list[str], values: Mapping[str, str | float | None], words: str) -> LimitRow:
    use, verdicts = of["use_of_limit"].values, of["verdict_of_limit"].values
    factor, unit = read_in(str(values["unit"]))
    differ = values["allowable"] is None
    allowables = of["allowable_of_limit"].values if differ else np.full(use.shape, values["allowable"])
    origin = str(values["origin"])
    if np.isnan(use).all():
        ends = sorted({float(allowables.min()), float(allowables.max())})
        allowed = " to ".join(_figure(factor * end) for end in ends)
        return LimitRow(words, f"{allowed} {unit}", origin, "–", "–", "–", UNKNOWN, False, True)
    demand = of["demand_of_limit"].values
    nearest = (np.where(np.isnan(use), np.inf, -use), demand if values["side"] == "smallest" else -demand)
    place = np.unravel_index(int(np.lexsort([n.ravel() for n in nearest[::-1]])[0]), use.shape)
    at = ", ".join(called(of[axis][k]) for axis, k in zip(axes, place, strict=True))
    value = f"{_figure(factor * float(demand[place]))} {unit}"
    share, allowable = float(use[place]), float(allowables[place])
    if values["side"] == "smallest" and allowable == 0.0:
        used = f"margin {value}"  # a lower limit of zero has no utilisation
    else:
        used = f"{_figure(100.0 * share)} %" if np.isfinite(share) else "exceeded"
    allowed = f"{_figure(factor * allowable)} {unit}"
    counts = {word: int((verdicts == word).sum()) for word in (EXCEEDED, UNKNOWN)}
    over, unknown = (counts[word] > 0 for word in (EXCEEDED, UNKNOWN))
    return LimitRow(words, allowed, origin, value, used, at, _verdict(counts), over, unknown)


def _figure(value: float) -> str:
    """Return a number with three digits, without an exponent."""
    return np.format_float_positional(float(f"{value:.3g}"), trim="-")


def _verdict(counts: Mapping[str, int]) -> str:
    """Return in words at how many points the limit is exceeded or not evaluated; else that all are within."""
    words = [f"{word} at {count}" for word, count in counts.items() if count]
    return ", ".join(words) or "met at all points"


def _in_words(*, mode: str, side: str, output: str, at: str, **_: object) -> str:
    """Return a limit in words, with the long name of its quantity."""
    return limit_in_words(mode, side, attributes(output).get("long_name", output), at)
