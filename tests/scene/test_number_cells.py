"""Cells of tables: every reader takes the same spellings of a number, and refuses all others."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.external.text import read_table
from riserstudy.errors import InputError
from riserstudy.fatigue.occurrence import of_table
from riserstudy.importers.wamit import from_wamit
from riserstudy.inputs.number_cell import number_in
from riserstudy.scene.tables import fill_in_tables

SPELLINGS = {"1.5": 1.5, "+1.5": 1.5, "1.": 1.0, ".5": 0.5, "15E-1": 1.5, "2e0": 2.0, "  3 ": 3.0}
OTHERS = ("1_5", "1_0.5", "1e1_0", "\u0661\u0665", "inf", "-Infinity", "0x10", "1e", "e5", "1 5", "--1")


def scatter(folder, cell):
    path = folder / "scatter.csv"
    path.write_text(f"hs (m),share (%)\n{cell},10\n", "utf-8")
    axis = xr.DataArray([0.0, 20.0], dims="hs", attrs={"units": "m"})
    return of_table(path, xr.Dataset(coords={"hs": axis}), ["hs"]).values["hs"][0]


def current(folder, cell):
    (folder / "current.csv").write_text(f"elevation (m), speed (m/s)\n0, {cell}\n-100, 0.1\n", "utf-8")
    tree = fill_in_tables({"current": {"profile": {"file": "current.csv"}}}, folder)
    return tree["current"]["profile"][0].speed


def wamit(folder, cell):
    path = folder / "rao.4"
    rows = [f"{period} {heading} 3 1.0 0.0 1.0 0.0" for period in (8, 12) for heading in (0, 90)]
    path.write_text("\n".join([*rows, f"16 0 3 {cell.strip()} 0.0 {cell.strip()} 0.0"]), "utf-8")
    return from_wamit(path, 1.0).table


def history(folder, cell):
    path = folder / "other.csv"
    path.write_text(f"time (s),force (kN)\n0,1\n1,{cell}\n", "utf-8")
    return read_table(path).columns[1][-1]


READERS = (scatter, current, history)


@pytest.mark.parametrize("read", READERS)
@pytest.mark.parametrize("cell", SPELLINGS)
def test_every_reader_takes_each_spelling_of_a_number(read, cell, tmp_path):
    np.testing.assert_allclose(read(tmp_path, cell), SPELLINGS[cell], rtol=1e-12)


@pytest.mark.parametrize("read", [*READERS, wamit])
@pytest.mark.parametrize("cell", OTHERS)
def test_no_reader_takes_what_is_no_number(read, cell, tmp_path):
    with pytest.raises(InputError):
        read(tmp_path, cell)


@pytest.mark.parametrize("seed", range(20))
def test_a_number_that_is_written_in_any_way_is_read_back(seed):
    rng = np.random.default_rng(seed)
    value = float(rng.normal() * 10.0 ** rng.integers(-12, 12))
    for text in (repr(value), f"{value:.17g}", f"{value:+.16e}", f"{value:.16E}", f" {value!r}\t"):
        assert number_in(text) == value
