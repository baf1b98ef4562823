"""An invented paper: its checks, datasets and samples, and the row that grading makes of an item."""

import json
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from riserstudy.grading.grade import Found, graded
from riserstudy.grading.models import Item
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import row_of
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[2] / "config"


def published(paper="chang2020"):
    studies = read_studies(CONFIG, paper)
    return read_published(CONFIG, paper, {*studies.studies, *studies.derived})


def samples(**assumed):
    count = len(next(iter(assumed.values())))
    return xr.Dataset(
        {
            f"assumed_{name}": ("sample", values, {"long_name": name.replace("_", ".")})
            for name, values in assumed.items()
        },
        {"sample": np.arange(count)},
    )


class Checks:
    """Checks of an invented paper."""

    @staticmethod
    def number(runs):
        return Found(runs["quantity"])

    @staticmethod
    def alone(runs):
        return runs["quantity"]

    @staticmethod
    def plain(runs):
        return float(runs["quantity"])

    @staticmethod
    def claim(runs, at_least):
        return Found(runs["quantity"], runs["quantity"] >= at_least)

    @staticmethod
    def premised(runs, least, premise):
        return Found(runs["quantity"], runs["quantity"] >= least, runs["quantity"] >= premise)


def dataset(quantity, **origins):
    values = np.asarray(quantity, float)
    dims = ("sample",)[: values.ndim]
    return xr.Dataset({"quantity": (dims, values)}, attrs={"origins": json.dumps(origins)})


def row(datasets, called=None, **about):
    fields = {"id": "X1", "figure": "1", "statement": "invented", "reads": {"runs": "base"}}
    item = Item(**(fields | about))
    return row_of(graded("paper", item, partial(getattr, Checks), datasets, called))


def number_row(datasets, **about):
    about = {"kind": "number", "published": 2.0, "rounding": 0.1, "check": "number"} | about
    return row(datasets, **about)
