"""Which inputs explain the damage of a conductor, on outcomes whose answer is known."""

import numpy as np
import pytest
import xarray as xr

from chapters.design.derived.wellhead import wellhead_fatigue
from chapters.design.figures.wellhead import wellhead_fatigue as drawn


def samples(slopes, count=192, seed=0):
    """Damage 10 to the sum of inputs by their slopes; an input of three options, others of a range."""
    draw = np.random.default_rng(seed)
    ranges = {name: draw.permutation((np.arange(count) + 0.5) / count) for name in ("a", "b", "c")}
    option = draw.integers(0, 3, count)
    log = sum(slopes.get(name, 0.0) * x for name, x in ranges.items()) + slopes.get("d", 0.0) * option
    rates = 10.0 ** log[:, None, None, None] * np.array([0.1, 1.0])
    data = xr.Dataset(
        {"damage_rate": (("sample", "detail", "wall_angle", "s_node"), rates)}, {"sample": np.arange(count)}
    )
    for name, values in ranges.items():
        data[f"assumed_{name}"] = ("sample", values, {"long_name": name})
    largest = rates.max(axis=(1, 2, 3))[:, None]
    data["value_of_statistic"] = (("sample", "statistic"), largest)
    data["statistic"] = ["damage_rate max"]
    data["assumed_d"] = ("sample", np.array(["one", "two", "three"])[option], {"long_name": "d"})
    return data


def explained(data):
    """With a second mesh on which damage of some samples is larger, by up to a tenth."""
    few = data.isel(sample=slice(0, 4))
    larger = xr.DataArray([1.0, 1.02, 1.1, 1.0], dims="sample")
    finer = few.assign({name: few[name] * larger for name in ("damage_rate", "value_of_statistic")})
    return wellhead_fatigue(data, xr.concat([few, finer], "mesh"))


def test_what_mesh_and_step_are_worth_is_the_largest_change():
    assert float(explained(samples({"a": 1.0}))["damage_error"]) == pytest.approx(0.1 / 1.1)


@pytest.mark.parametrize("seed", range(3))
def test_shares_are_those_of_independent_inputs(seed):
    """Variances of a range and of three options are 1/12 and 2/3, and add."""
    slopes = {"a": 2.0, "b": 1.0, "d": 0.5}
    found = explained(samples(slopes, seed=seed))
    parts = {"a": 4.0 / 12.0, "b": 1.0 / 12.0, "c": 0.0, "d": 0.25 * 2.0 / 3.0}
    for name, part in parts.items():
        share = float(found["share_explained"].sel(varied_input=name))
        assert share == pytest.approx(part / sum(parts.values()), abs=0.06)
    assert found["varied_input"].values[0] == "a"
    assert float(found["damage_largest"].max()) <= 10.0**4


def test_an_input_that_does_nothing_is_no_more_than_chance():
    found = explained(samples({"a": 1.0}))
    for name in ("b", "c", "d"):
        one = found.sel(varied_input=name)
        assert one["share_explained"] <= one["by_chance"] + 0.05


def test_the_figure_names_the_input_that_explains_most():
    figure = drawn(explained(samples({"d": 1.0, "a": 0.3})))
    assert figure.get_suptitle().startswith("The d explains ")


def test_without_a_difference_nothing_is_named():
    figure = drawn(explained(samples({})))
    assert "explains" not in figure.get_suptitle()
