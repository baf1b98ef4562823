"""Time series through QATS: written by its own writers, and by hand as RIFLEX does. `make test-formats`."""

import importlib.util
import sys

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.comparison import compared, difference
from riserstudy.errors import InputError

TIME, S = np.arange(0.0, 60.0, 0.5), np.array([0.0, 100.0])
QATS = pytest.mark.skipif(importlib.util.find_spec("qats") is None, reason="run by `make test-formats`")
CALLED = {"Line1 Te": "effective_tension at 100 m (kN)"}


def tension(time):
    """In kN, at 100 m."""
    return 1e3 + 50.0 * np.sin(0.6 * time)


def run():
    values = 1e3 * tension(TIME)[:, None] * np.ones(2)
    data = {"effective_tension": (("time", "s"), values, {"units": "N"})}
    return xr.Dataset(data, {"time": TIME, "s": S})


@pytest.mark.parametrize("ending", ["ts", "h5", "asc", "tdms"])
def test_without_the_library_the_message_says_how_to_have_it(tmp_path, monkeypatch, ending):
    monkeypatch.setitem(sys.modules, "qats", None)
    with pytest.raises(InputError, match=r'pip install "riserstudy\[formats\]"'):
        compared(run(), tmp_path / f"other.{ending}", called=CALLED)


def test_a_pickle_is_not_opened(tmp_path):
    """To open one runs what is in it."""
    path = tmp_path / "other.pkl"
    path.write_bytes(b"cos\nsystem\n(S'touch opened'\ntR.")
    with pytest.raises(InputError):
        compared(run(), path, called=CALLED)


@QATS
@pytest.mark.parametrize("ending", ["ts", "h5", "dat"])
def test_series_that_qats_writes_are_compared(tmp_path, ending):
    from qats import TimeSeries, TsDB

    name = "Te" if ending == "dat" else "Line1 Te"
    base = TsDB()
    base.add(TimeSeries(name, TIME, tension(TIME)))
    base.add(TimeSeries("other", TIME, 0.0 * TIME))
    path = tmp_path / f"results.{ending}"
    base.export(str(path))
    found = compared(run(), path, called={name: CALLED["Line1 Te"]})
    # files of four bytes a number
    assert difference(found.pairs[0]).rms < 1.0
    assert "times are taken in s" in found.notes[0]


@QATS
def test_unknown_series_and_damaged_files_are_refused(tmp_path):
    from qats import TimeSeries, TsDB

    base = TsDB()
    base.add(TimeSeries("Te", TIME, tension(TIME)))
    path = tmp_path / "results.ts"
    base.export(str(path))
    with pytest.raises(InputError, match="use one of Te"):
        compared(run(), path, called=CALLED)
    with pytest.raises(InputError, match="state it with --column"):
        compared(run(), path)
    path.write_bytes(b"\x01")
    with pytest.raises(InputError, match="qats cannot read this file"):
        compared(run(), path, called={"Te": CALLED["Line1 Te"]})
    with pytest.raises(InputError, match="No such file"):
        compared(run(), tmp_path / "none.ts", called=CALLED)


KEY = f"""
   This key file tells the columns of case_elmfor.asc
   For each bar element the following applies :
   DOF 1 = Axial force
   {54 * "-"}
   Line1           1         4           1                 2
"""


@QATS
def test_series_of_riflex_are_compared(tmp_path):
    """Numbers as RIFLEX writes them, a line a step; their names are in the file of keys beside it."""
    (tmp_path / "key_case_elmfor.txt").write_text(KEY)
    table = np.column_stack([TIME, tension(TIME)])
    np.savetxt(tmp_path / "case_elmfor.asc", table, fmt="%.7e")
    called = {"Line1_Seg001_El004_Te": "effective_tension at 100 m (kN)"}
    found = compared(run(), tmp_path / "case_elmfor.asc", called=called)
    assert difference(found.pairs[0]).rms < 1.0
