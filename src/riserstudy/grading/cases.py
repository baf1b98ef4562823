"""Cases of a number or claim: what each found, the points that it rests on, and the verdict of them all."""

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
    """Simulated studies behind some datasets of a paper."""

    def __init__(self, paper: str, datasets: Mapping[str, xr.Dataset]):
        studies: dict[str, Axes] = {}
        for name, dataset in datasets.items():
            studies |= supporting_studies(name, dataset)
        self._values = {
            f"{paper}/{study}": {axis: frozenset(values) for axis, values in axes.items()}
            for study, axes in studies.items()
        }

    def rests_on(self, place: Place) -> dict[str, list[str]]:
        """Studies, and the axes by which a place picks points: those that have its value."""
        return {
            study: [a for a, value in place.items() if a in axes and value in axes[a]]
            for study, axes in self._values.items()
        }


def places_of(values: xr.DataArray) -> Iterator[tuple[tuple[int, ...], Place]]:
    """Index and place of each cell."""
    dims = [str(dim) for dim in values.dims]
    along = {dim: values[dim].values.tolist() for dim in dims}
    for index in np.ndindex(values.shape):
        yield index, {dim: along[dim][k] for dim, k in zip(dims, index, strict=True)}


class Dropped:
    """Points to leave out, by study; a case rests on one where it is at its place on all axes that pick."""

    def __init__(self, points: Mapping[str, Iterable[Place]]):
        self._points = {study: [*places] for study, places in points.items()}
        self._picked: dict[tuple[str, ...], set[tuple[Any, ...]]] = {}

    def touches(self, case: Case) -> bool:
        """Whether a case rests on one of the points."""
        return any(
            tuple(case.place[axis] for axis in axes) in self._at(study, axes)
            for study, axes in case.rests_on.items()
            if study in self._points
        )

    def _at(self, study: str, axes: Sequence[str]) -> set[tuple[Any, ...]]:
        """Places of the points of a study on some axes, looked up once."""
        key = (study, *axes)
        if key not in self._picked:
            self._picked[key] = {tuple(p[axis] for axis in axes) for p in self._points[study]}
        return self._picked[key]


def regrade(
    kind: Kind, cases: Sequence[Case], drop: Mapping[str, Iterable[Place]] | Dropped | None = None
) -> Verdict | None:
    """Verdict of a number or claim without the cases that rest on some points.

    Cases in which nothing is found are not judged; where their answers could turn the verdict, it depends.

    Parameters
    ----------
    kind : "number" or "claim".
    cases : all of it.
    drop : places of the points to leave out, by study (paper/name). None: nothing is left out.

    Returns
    -------
    None where no case is left to be judged, or where the base case is left out and decides.
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
        _with_missing(kind, judged, missing, hit)
        for hit in ([all(base)] if known else [True, False])
    }
    return verdicts.pop() if len(verdicts) == 1 else None


def _with_missing(
    kind: Kind, judged: Sequence[Case], missing: Sequence[Case], base: bool
) -> Verdict:
    """The verdict of those judged, where those that are missing could not turn it."""
    ways = [[replace(case, met=met) for case in missing] for met in (True, False)]
    could = {_verdict(kind, [*judged, *way], base) for way in ways}
    verdict = _verdict(kind, judged, base)
    return verdict if could == {verdict} else "depends"


def _verdict(kind: Kind, judged: Sequence[Case], base: bool) -> Verdict:
    """One verdict with every interpretation; else it depends. No share is one of interpretations."""
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
    """Cases by their interpretation: their place on all axes but that of samples."""
    groups: dict[tuple[Any, ...], list[Case]] = {}
    for case in cases:
        place = tuple(value for axis, value in sorted(case.place.items()) if axis != "sample")
        groups.setdefault(place, []).append(case)
    return groups.values()


def samples_of(cases: Iterable[Case]) -> int | None:
    """How many samples some cases are of; None where what is open is a grid, of which all is judged."""
    samples = {case.place["sample"] for case in cases if "sample" in case.place}
    return len(samples) or None
