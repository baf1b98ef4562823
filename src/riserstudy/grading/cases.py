"""Cases of a published value or claim: result of each, points that it uses, and the joint verdict."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.dataset.supporting_points import Axes, supporting_studies
from riserstudy.grading.verdict import verdict_of_claim, verdict_of_number
from riserstudy.records.graded import Case, Kind, Place, Verdict


class Sources:
    """Simulated studies from which datasets of a paper are derived."""

    def __init__(self, paper: str, datasets: Mapping[str, xr.Dataset]):
        studies: dict[str, Axes] = {}
        for name, dataset in datasets.items():
            studies |= supporting_studies(name, dataset)
        self._values = {
            f"{paper}/{study}": {axis: frozenset(values) for axis, values in axes.items()}
            for study, axes in studies.items()
        }

    def rests_on(self, place: Place) -> dict[str, list[str]]:
        """Studies, each with the axes by which a place selects points, which have the value of the place."""
        return {
            study: [a for a, value in place.items() if a in axes and value in axes[a]]
            for study, axes in self._values.items()
        }


def places_of(values: xr.DataArray) -> Iterator[tuple[tuple[int, ...], Place]]:
    """Index and place (values by axis) of each cell."""
    dims = [str(dim) for dim in values.dims]
    along = {dim: values[dim].values.tolist() for dim in dims}
    for index in np.ndindex(values.shape):
        yield index, {dim: along[dim][k] for dim, k in zip(dims, index, strict=True)}


class Dropped:
    """Points to exclude, by study. A case uses a point if both agree on all axes that select points."""

    def __init__(self, points: Mapping[str, Iterable[Place]]):
        self._points = {study: [*places] for study, places in points.items()}
        self._picked: dict[tuple[str, ...], set[tuple[Any, ...]]] = {}

    def touches(self, case: Case) -> bool:
        """Whether a case uses one of the points."""
        return any(
            tuple(case.place[axis] for axis in axes) in self._at(study, axes)
            for study, axes in case.rests_on.items()
            if study in self._points
        )

    def _at(self, study: str, axes: Sequence[str]) -> set[tuple[Any, ...]]:
        """Values of the points of a study on some axes; cached."""
        key = (study, *axes)
        if key not in self._picked:
            self._picked[key] = {tuple(p[axis] for axis in axes) for p in self._points[study]}
        return self._picked[key]


def regrade(
    kind: Kind, cases: Sequence[Case], drop: Mapping[str, Iterable[Place]] | Dropped | None = None
) -> Verdict | None:
    """Verdict of a published value or claim without the cases that use some points.

    Cases without a result are not judged; if their answers could change the verdict, the verdict is
    "depends".

    Parameters
    ----------
    kind : "number" or "claim".
    cases : all its cases.
    drop : places of the points to exclude, by study (paper/name). None: no exclusion.

    Returns
    -------
    None if no case remains to be judged, or if the base case is excluded but decisive.
    """
    dropped = drop if isinstance(drop, Dropped) else Dropped(drop or {})
    left = [case for case in cases if not dropped.touches(case)]
    judged = [case for case in left if case.judged]
    if not judged:
        return None
    base = [case.met for case in left if case.base]
    known = not all(base) or len(base) == sum(case.base for case in cases)
    missing = [case for case in left if case.met is None]
    verdicts = {
        _with_missing(kind, judged, missing, hit) for hit in ([all(base)] if known else [True, False])
    }
    return verdicts.pop() if len(verdicts) == 1 else None


def _with_missing(kind: Kind, judged: Sequence[Case], missing: Sequence[Case], base: bool) -> Verdict:
    """The verdict of the judged cases, if the missing cases could not change it."""
    ways = [[replace(case, met=met) for case in missing] for met in (True, False)]
    could = {_verdict(kind, [*judged, *way], base) for way in ways}
    verdict = _verdict(kind, judged, base)
    return verdict if could == {verdict} else "depends"


def _verdict(kind: Kind, judged: Sequence[Case], base: bool) -> Verdict:
    """The verdict if it is the same for all interpretations, else "depends"; shares never mix them."""
    calibrated = any(case.calibrated for case in judged)
    verdicts = set()
    for cases in by_reading(judged):
        share = sum(bool(case.met) for case in cases) / len(cases)
        if kind == "number":
            verdicts.add(verdict_of_number(base, share, calibrated))
        else:
            verdicts.add(verdict_of_claim(share, calibrated, base, samples_of(cases)))
    return verdicts.pop() if len(verdicts) == 1 else "depends"


def by_reading(cases: Iterable[Case]) -> Iterable[list[Case]]:
    """Cases grouped by interpretation, which is their place on all axes except samples."""
    groups: dict[tuple[Any, ...], list[Case]] = {}
    for case in cases:
        place = tuple(value for axis, value in sorted(case.place.items()) if axis != "sample")
        groups.setdefault(place, []).append(case)
    return groups.values()


def samples_of(cases: Iterable[Case]) -> int | None:
    """Number of samples of some cases; None if all combinations of a grid are judged."""
    samples = {case.place["sample"] for case in cases if "sample" in case.place}
    return len(samples) or None
