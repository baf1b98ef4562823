"""What changed between two sets of results."""

import json
import random
import time

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.diff import changes
from riserstudy.errors import InputError

HEAD = "paper,id,figure,kind,statement,published,simulated,unit,error,verdict,depends_on,note\n"


def results(folder, simulated="2.0", verdict="holds", moment=(1.0, -4.0), **more):
    """A results folder with one graded row and one dataset."""
    (folder / "paper").mkdir(parents=True)
    row = f"paper,N1,,number,,2,{simulated},m,0,{verdict},,\n"
    (folder / "reproduction.csv").write_text(HEAD + row)
    spent = time.perf_counter() * np.ones(len(moment))
    values = {"moment": ("s", np.array(moment)), "wall_seconds": ("s", spent)}
    xr.Dataset(values | more, attrs={"tier": "preview"}).to_netcdf(folder / "paper/run.nc")
    return folder


def test_the_same_numbers_have_no_changes_though_they_took_another_time(tmp_path):
    found = changes(results(tmp_path / "a"), results(tmp_path / "b"))
    assert (found.graded, found.varied, found.largest) == ([], [], 0.0)
    assert (found.rows, found.variables) == (1, 1)


def test_a_change_is_told_with_its_size_by_the_largest_magnitude(tmp_path):
    new = results(tmp_path / "b", "2.1", "fails", (1.5, -4.0))
    found = changes(results(tmp_path / "a"), new)
    assert found.graded == [
        ("paper/N1", "simulated", "2.0", "2.1"),
        ("paper/N1", "verdict", "holds", "fails"),
    ]
    assert [(one.variable, one.change) for one in found.varied] == [("moment", 0.125)]
    alone = changes(tmp_path / "a/paper/run.nc", new / "paper/run.nc")
    assert alone.largest == 0.125


@pytest.mark.parametrize(
    "other, why",
    [
        ({"moment": (1.0, -4.0, 2.0)}, "shape"),
        ({"moment": (1.0, np.nan)}, "defined elsewhere"),
        ({"tension": ("s", [1.0, 2.0])}, "only in NEW"),
    ],
)
def test_what_cannot_be_compared_counts_as_changed_without_bound(tmp_path, other, why):
    found = changes(results(tmp_path / "a"), results(tmp_path / "b", **other))
    assert (found.varied[0].change, found.apart, found.largest) == (np.inf, 1, 0.0)
    assert why in found.varied[0].why


@pytest.mark.parametrize("seed", range(6))
def test_numbers_in_another_unit_are_no_longer_the_same(tmp_path, seed):
    draw = random.Random(seed)
    units = draw.sample(["m", "ft", "kN", "kip", "degree", ""], 2)
    names = draw.sample(["moment", "s"], draw.randint(1, 2))  # a variable and an axis
    for folder, unit in zip("ab", units, strict=True):
        path = results(tmp_path / folder, s=[1.0, 2.0]) / "paper/run.nc"
        dataset = xr.load_dataset(path)
        for name in names:
            dataset[name].attrs["units"] = unit
        dataset.to_netcdf(path)
    found = changes(tmp_path / "a", tmp_path / "b")
    assert {one.variable for one in found.varied} == {*names}
    assert found.apart == len(names)
    assert f"unit {units[0] or 'none'}, now {units[1] or 'none'}" == found.varied[0].why


SPECIAL = (np.nan, np.inf, -np.inf, 0.0, 1.0, -2.5)


@pytest.mark.parametrize("seed", range(40))
def test_only_what_is_the_same_bit_by_bit_has_not_changed(tmp_path, seed):
    """Infinite, which stands for never, is neither no number nor minus infinite."""
    rng = random.Random(seed)
    before = [rng.choice(SPECIAL) for _ in range(6)]
    after = [rng.choice(SPECIAL) if rng.random() < 0.15 else value for value in before]
    same = all(a == b or (a != a and b != b) for a, b in zip(before, after, strict=True))
    found = changes(*(results(tmp_path / n, moment=m) for n, m in (("a", before), ("b", after))))
    assert (found.varied == []) == same
    assert found.apart == any(one.why for one in found.varied)
    assert same or found.apart or found.largest > 0.0


def grid(folder, amplitudes, swapped=False):
    """A chapter's folder with a response that is twice the amplitude."""
    folder.mkdir(parents=True, exist_ok=True)
    response = 2.0 * np.array(amplitudes)[:: -1 if swapped else 1]
    axes = {"amplitude": amplitudes, "s": [0.0, 1.0]}
    values = {"response": (("amplitude", "s"), np.stack([response, response], axis=1))}
    xr.Dataset(values, axes).to_netcdf(folder / "heave.nc")
    return folder


def test_folders_of_one_chapter_are_compared_by_their_datasets(tmp_path):
    old = grid(tmp_path / "a/paper", [1.0, 2.0, 3.0])
    assert changes(old, grid(tmp_path / "b/paper", [1.0, 2.0, 3.0])).variables == 3
    swapped = changes(old, grid(tmp_path / "c/paper", [1.0, 2.0, 3.0], swapped=True))
    assert [(v.dataset, v.variable) for v in swapped.varied] == [("heave", "response")]


def test_of_unequal_grids_the_points_are_compared_that_both_have(tmp_path):
    old = grid(tmp_path / "a", [1.0, 2.0, 3.0])
    (axis,) = changes(old, grid(tmp_path / "b", [4.0, 3.0, 0.5, 1.0])).varied
    assert (axis.variable, axis.why) == ("amplitude", "3 values, now 4; 2 in both")
    found = changes(old, grid(tmp_path / "c", [1.0, 3.0, 4.0], swapped=True)).varied
    assert {one.variable: one.change for one in found}["response"] == 0.75  # 2, 6 before; 8, 6 now
    other, *rest = changes(old, grid(tmp_path / "d", [7.0, 8.0])).varied
    assert (other.variable, other.why) == ("amplitude", "3 values, now 2; 0 in both")
    assert all(one.why.startswith("shape") for one in rest)


@pytest.mark.parametrize("seed", range(12))
def test_points_are_compared_with_themselves_in_whatever_order_their_axes_are(tmp_path, seed):
    draw = np.random.default_rng(seed)
    sizes = {"offset": int(draw.integers(2, 6)), "current": int(draw.integers(2, 5))}
    axes = {
        "offset": draw.permutation(np.arange(-9.0, 9.0))[: sizes["offset"]],
        "current": draw.permutation(["none", "half", "whole", "loop"])[: sizes["current"]],
    }
    moment = (("offset", "current", "s"), draw.normal(size=(*sizes.values(), 4)))
    old = xr.Dataset({"moment": moment}, axes)
    new = old.isel({axis: draw.permutation(size) for axis, size in sizes.items()})
    changed = bool(seed % 2)
    if changed:
        new["moment"].loc[{"offset": axes["offset"][0], "current": axes["current"][1]}] += 0.5
    old.to_netcdf(tmp_path / "old.nc")
    new.to_netcdf(tmp_path / "new.nc")
    found = changes(tmp_path / "old.nc", tmp_path / "new.nc")
    size = max(float(abs(one["moment"]).max()) for one in (old, new))
    told = {one.variable: (one.change, one.why) for one in found.varied}
    other = {axis for axis in axes if not np.array_equal(old[axis], new[axis])}
    assert {axis for axis, of in told.items() if of == (0.0, "other order")} == other
    assert told.get("moment", (0.0, ""))[0] == pytest.approx(0.5 / size if changed else 0.0)


def test_where_there_is_nothing_to_compare_diff_says_so(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "bad.nc").write_bytes(b"nothing")
    for path in (tmp_path / "a", tmp_path / "absent", tmp_path / "bad.nc"):
        with pytest.raises(InputError):
            changes(path, path)


def checked(folder, rows):
    """A run with limits in its attribute."""
    path = results(folder) / "paper/run.nc"
    xr.load_dataset(path).assign_attrs(limits=rows if isinstance(rows, str) else json.dumps(rows)).to_netcdf(
        path
    )
    return path


@pytest.mark.parametrize("seed", range(12))
def test_equal_numbers_with_other_verdicts_or_allowables_have_changed(tmp_path, seed):
    draw = random.Random(seed)
    rows = [
        {
            "mode": draw.choice(["drilling", "connected"]),
            "side": "largest",
            "output": name,
            "at": "",
            "allowable": draw.choice([None, float("nan"), 4.5]),
            "verdict": "within",
            "demand": draw.random(),
        }
        for name in ("lfj_angle", "bending_moment")
    ]
    other = [dict(row) for row in rows]
    name, value = draw.choice([("verdict", "exceeded"), ("allowable", 7.0), ("mode", "survival")])
    draw.choice(other)[name] = value
    before = checked(tmp_path / "a", rows)
    assert changes(before, checked(tmp_path / "b", rows)).varied == []
    (found,) = changes(before, checked(tmp_path / "c", other)).varied
    assert (found.variable, bool(found.why)) == ("limits", True)


@pytest.mark.parametrize("held", ["", "{", "none above 3 m", '["a"]', "1"])
def test_an_attribute_of_others_that_holds_no_limits_is_compared_as_text(tmp_path, held):
    before = checked(tmp_path / "a", held)
    assert changes(before, checked(tmp_path / "b", held)).varied == []
    assert changes(before, checked(tmp_path / "c", held + " ft")).apart == 1
