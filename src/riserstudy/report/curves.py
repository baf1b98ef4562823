"""Specification curves of the numbers and claims that depend on unspecified inputs."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from riserstudy.grading.models import PublishedFile
from riserstudy.grading.names import input_name
from riserstudy.grading.published import printed_of, published_path
from riserstudy.report.claims import Claim
from riserstudy.report.curve import Cases, Curve, curve, ordered

FEWEST = 3  # fewest cases of a curve


def curves(
    db: sqlite3.Connection, config: Path, claims: list[Claim], datasets: Mapping[Any, xr.Dataset]
) -> dict[str, Curve]:
    """Return the curve of every number and claim that depends on unspecified inputs, by its anchor.

    There is no curve if the cases have no margins, or are fewer than three.
    """
    papers = {claim.paper for claim in claims if published_path(config, claim.paper).exists()}
    files: dict[str, PublishedFile] = {paper: printed_of(config, paper) for paper in papers}
    assumed: dict[tuple[str, str], Samples] = {}
    found: dict[str, Curve] = {}
    for claim in claims:
        file = files.get(claim.paper)
        item = next((i for i in file.items if i.id == claim.id), None) if file else None
        if claim.verdict != "depends" or file is None or item is None or not item.reads:
            continue
        key = claim.paper, next(iter((item.over or item.reads).values()))
        if key not in assumed:
            assumed[key] = _samples(datasets.get(key))
        cases = _cases(db, claim, assumed[key], file.called)
        if cases is not None:
            first = [influence.name for influence in claim.grounds.decided_by]
            found[claim.anchor] = curve(ordered(cases, first))
    return found


class Samples(NamedTuple):
    """Assumed inputs of each sample of a dataset, by path, and position of each sample by its number."""

    assumed: dict[str, NDArray[Any]]
    places: dict[int, int]


def _samples(dataset: xr.Dataset | None) -> Samples:
    if dataset is None or "sample" not in dataset.dims:
        return Samples({}, {})
    numbers = dataset["sample"].values.tolist()
    assumed = {
        str(values.attrs.get("long_name", label)): values.values
        for label, values in dataset.data_vars.items()
        if str(label).startswith("assumed_")
    }
    return Samples(assumed, {number: k for k, number in enumerate(numbers)})


def _cases(db: sqlite3.Connection, claim: Claim, samples: Samples, called: Mapping[str, str]) -> Cases | None:
    rows = db.execute(
        "select place, met, same, margin, judged, base from margins where paper = ? and id = ?",
        (claim.paper, claim.id),
    ).fetchall()
    base = next((row[3] for row in rows if row[5]), None)
    judged = [row for row in rows if row[4] and row[3] is not None]
    if len(judged) < FEWEST:
        return None
    places = [json.loads(row[0]) for row in judged]
    inputs: dict[str, NDArray[Any]] = {
        input_name(axis, called): np.array([place[axis] for place in places])
        for axis in places[0]
        if axis != "sample"
    }
    if samples.assumed and "sample" in places[0]:
        at = [samples.places[place["sample"]] for place in places]
        inputs |= {input_name(path, called): of[at] for path, of in samples.assumed.items()}
    return Cases(
        np.array([row[3] for row in judged], float),
        np.array([bool(row[1]) for row in judged]),
        np.array([bool(row[2]) for row in judged]),
        inputs,
        base,
    )
