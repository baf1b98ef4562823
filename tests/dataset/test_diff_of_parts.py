"""What ``diff`` states about parts of results: statistics, axes with gaps, flags, published values."""

import shutil

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.diff import changes


def written(folder, name, **variables):
    path = folder / f"{name}.nc"
    xr.Dataset(variables).to_netcdf(path)
    return path


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("last", [True, False])
def test_each_statistic_has_its_own_size(tmp_path, seed, last):
    """A tension in N is a billion times an angle in rad; both may change."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(2, 6))
    sizes = 10.0 ** draw.uniform(-6.0, 9.0, count)
    values = sizes * draw.uniform(0.5, 1.0, (4, count))
    k, by = int(draw.integers(count)), float(draw.uniform(1e-6, 1e-1))
    other = values.copy()
    place = abs(values[:, k]).argmax()
    other[place, k] *= 1.0 - by
    dims = ("sample", "statistic")
    if not last:
        dims, values, other = dims[::-1], values.T, other.T
    files = [written(tmp_path, name, v=(dims, of)) for name, of in (("a", values), ("b", other))]
    found = changes(*files)
    assert [one.variable for one in found.varied] == ["v"]
    assert found.largest == pytest.approx(by, rel=1e-6)


@pytest.mark.parametrize("gap", [np.nan, 3.0])
def test_equal_axes_with_a_missing_value_are_equal(tmp_path, gap):
    axis, last = ("x", [1.0, 2.0, gap]), {"a": 6.0, "b": 6.0, "c": 7.0}
    one, same, other = (written(tmp_path, n, x=axis, v=("x", [4.0, 5.0, v])) for n, v in last.items())
    assert changes(one, same).varied == []
    (found,) = changes(one, other).varied
    assert (found.variable, found.change) == ("v", pytest.approx(1.0 / 7.0))


def test_flags_are_values_and_words_are_text(tmp_path):
    a = written(tmp_path, "a", flag=("x", [True, False]), word=("x", ["p", "q"]))
    b = written(tmp_path, "b", flag=("x", [True, True]), word=("x", ["p", "r"]))
    found = {one.variable: one.why for one in changes(a, b).varied}
    assert found == {"flag": "other values", "word": "other text"}


@pytest.mark.parametrize("column", ["published", "unit", "simulated", "error", "verdict", "depends_on"])
def test_each_value_of_a_graded_row_counts(tmp_path, column):
    names = ["paper", "id", "kind", "published", "simulated", "unit", "error", "verdict", "depends_on"]
    row = dict(zip(names, ["p", "N1", "number", "2", "2.1", "m", "0.05", "fails", ""], strict=True))
    for name, changed in (("a", row), ("b", row | {column: "7"})):
        (tmp_path / f"{name}.csv").write_text(",".join(names) + "\n" + ",".join(changed.values()) + "\n")
    found = changes(tmp_path / "a.csv", tmp_path / "b.csv")
    assert [(one.item, one.column, one.new) for one in found.graded] == [("p/N1", column, "7")]


def test_the_last_line_counts_variables(tmp_path, commands):
    """Without a variable that can be compared, there is no largest change."""
    a = written(tmp_path, "a", v=("x", [1.0, 2.0]), w=("x", [1.0, 2.0]))
    b = written(tmp_path, "b", v=("x", [1.0, np.nan]), w=("x", [1.0, 2.0]))
    c = written(tmp_path, "c", v=("x", [1.0, np.nan]), w=("x", [1.0, 2.2]))
    code, out, _ = commands("diff", a, b)
    assert code == 1
    assert out.splitlines()[-1] == "1 of 2 variables changed; 1 changed variable cannot be compared"
    code, out, _ = commands("diff", a, c)
    assert out.splitlines()[-1] == (
        "2 of 2 variables changed, by 0.091 at most; 1 changed variable cannot be compared"
    )
    shutil.copy(a, tmp_path / "d.nc")
    assert commands("diff", a, tmp_path / "d.nc")[0] == 0


@pytest.mark.parametrize("shape", [(), (1,), (0,), (2, 0), (3, 1)])
def test_variables_of_any_shape_are_compared(tmp_path, shape):
    dims = tuple("pq"[: len(shape)])
    a, b = (
        written(tmp_path, name, v=(dims, np.full(shape, value))) for name, value in (("a", 2.0), ("b", 2.5))
    )
    changed = [one.change for one in changes(a, b).varied]
    assert changed == ([pytest.approx(0.2)] if np.prod(shape) else [])
    assert changes(a, a).varied == []
