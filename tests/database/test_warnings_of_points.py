"""Warnings of points are in the database as sentences and as records, and the report joins them by kind."""

import json
import sqlite3
from contextlib import closing

import netCDF4
import numpy as np
import pytest
import workspace
import xarray as xr
from warned_rigs import warned_run

from riserstudy import query
from riserstudy.dataset.diff import changes
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.records.warning import sentences
from riserstudy.report.audit import warned

SURGE = workspace.RESULTS / "plain/surge.nc"
POINTS = 6


@pytest.fixture(scope="module")
def told():
    """Warnings of six runs."""
    runs = (warned_run(seed, spatial) for seed in range(20) for spatial in (False, True))
    given = [run.facts["warnings"] for run in runs if run and run.facts["warnings"]]
    return given[:POINTS]


def with_warnings(told, *, earlier):
    """The study of surge, whose points have these warnings; ``earlier``: as earlier versions wrote it."""
    with netCDF4.Dataset(SURGE, "a") as file:
        shape = file["warnings"].shape
        for name, texts in (
            ("warnings", ["\n".join(sentences(one)) for one in told]),
            ("warning_records", [json.dumps(one) for one in told]),
        ):
            file[name][...] = np.array(texts, dtype=object).reshape(shape)
    if earlier:
        with xr.open_dataset(SURGE, decode_times=False) as opened:
            dataset = opened.load().drop_vars("warning_records")
        write_dataset(dataset, SURGE)
    workspace.built()


def rows_of_the_report():
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        return warned(db)


def test_points_have_the_sentences_and_the_records(mine, told):
    with_warnings(told, earlier=False)
    found = query("select warnings, warning_records from points where study = 'plain/surge' order by point")
    for (lines, records), own in zip(found.values.tolist(), told, strict=True):
        assert json.loads(records) == own
        assert lines.splitlines() == sentences(json.loads(records))
    kinds = {one["kind"] for own in told for one in own}
    assert len(rows_of_the_report()) == len(kinds) > 3


def test_a_dataset_of_an_earlier_version_has_a_row_for_each_sentence(mine, told, commands):
    with_warnings(told, earlier=True)
    lines = [line for own in told for line in sentences(own)]
    assert {row.text: row.number for row in rows_of_the_report()} == {
        text: lines.count(text) for text in lines
    }
    code, out, said = commands("results", "--json")
    assert (code, said) == (0, "")
    listed = {row["study"]: row for row in json.loads(out)}
    assert listed["plain/surge"]["warned"] == POINTS


def test_a_dataset_of_an_earlier_version_differs_in_no_variable(mine, told, tmp_path):
    with_warnings(told, earlier=False)
    new = tmp_path / "new.nc"
    new.write_bytes(SURGE.read_bytes())
    with_warnings(told, earlier=True)
    assert changes(SURGE, new).varied == []
