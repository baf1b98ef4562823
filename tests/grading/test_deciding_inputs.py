"""Which inputs decide an outcome, and what share of it they explain."""

import numpy as np
import pytest
import xarray as xr
from invented import samples

from riserstudy.grading.sensitivity import correlation_ratio, deciding, shares_by_option, total_effects


def sampled(count=128):
    random = np.random.default_rng(1)
    return random, samples(
        analysis_start=random.choice(["unstretched", "equilibrium"], count),
        heave_phase=[f"{x} deg" for x in random.uniform(0.0, 360.0, count)],
        heave_period=[f"{x} s" for x in random.uniform(10.0, 25.0, count)],
    )


def number(dataset, name):
    return np.array([float(str(value).split()[0]) for value in dataset[name].values])


def test_an_option_that_decides_is_named():
    _, about = sampled()
    outcome = about["assumed_analysis_start"] == "equilibrium"
    found = deciding(outcome, about)
    assert (found.names, found.explained) == (["analysis.start"], 1.0)


def test_a_range_that_decides_is_named_though_its_effect_has_no_direction():
    _, about = sampled()
    phase = number(about, "assumed_heave_phase")
    outcome = xr.DataArray((phase > 90.0) & (phase < 270.0), dims="sample")
    assert deciding(outcome, about).names == ["heave.phase"]


def test_two_inputs_that_decide_only_together_are_both_named():
    _, about = sampled(256)
    late = number(about, "assumed_heave_phase") > 180.0
    outcome = (about["assumed_analysis_start"] == "equilibrium") ^ late
    assert set(deciding(outcome, about).names) == {"analysis.start", "heave.phase"}


def test_an_option_is_not_hidden_by_how_evenly_two_ranges_fill_their_plane():
    """Two samples of a Sobol sequence in a cell of two ranges share the option."""
    levels = np.arange(8)
    a, b = (grid.repeat(2) for grid in np.meshgrid(levels, levels))
    half = (a + b) % 2 == 0  # what the cell knows of the option
    about = samples(
        start=np.where(half, "unstretched", "equilibrium"),
        phase=[f"{x} deg" for x in a + 0.01 * np.arange(128)],
        period=[f"{x} s" for x in b + 0.01 * np.arange(128)[::-1]],
    )
    random = np.random.default_rng(2)
    outcome = xr.DataArray(~half | (random.random(128) > 0.6), dims="sample")
    assert deciding(outcome, about).names[0] == "start"


def test_a_dimension_beside_the_samples_can_decide():
    _, about = sampled(32)
    outcome = xr.DataArray(
        np.tile([True, False], (32, 1)),
        dims=("sample", "compared"),
        coords={"compared": ["as it stands", "from equilibrium"]},
    )
    assert deciding(outcome, about).names == ["compared"]


def test_shares_are_told_by_option_and_not_by_number():
    _, about = sampled(64)
    start, phase = about["assumed_analysis_start"], number(about, "assumed_heave_phase")
    outcome = xr.where((start == "equilibrium") | (phase > 180.0), True, False)
    found = shares_by_option(outcome, about, ["analysis.start", "heave.phase"])
    rest = (phase > 180.0)[start.values == "unstretched"].mean()
    assert found == {"analysis.start": {"equilibrium": 1.0, "unstretched": rest}}


@pytest.mark.parametrize("seed", range(4))
def test_options_with_one_number_are_told_by_their_words(seed):
    draw = np.random.default_rng(seed)
    options = ["190.2 bar absolute", "190.2 bar gauge"]
    chosen = draw.permutation(np.repeat(options, 16))
    true = draw.random(32) < np.where(chosen == options[0], 0.9, 0.3)
    about = xr.Dataset({"assumed_pressure": ("sample", chosen, {"long_name": "gas.pressure"})})
    found = shares_by_option(xr.DataArray(true, dims="sample"), about, ["gas.pressure"])
    assert found == {"gas.pressure": {option: true[chosen == option].mean() for option in options}}


def test_shares_of_a_grid_are_told_by_the_labels_of_its_dimensions():
    outcome = xr.DataArray(
        [[True, False], [True, True]],
        dims=("model", "level"),
        coords={"model": ["gas law", "linear"], "level": [1.0, 2.0]},
    )
    found = shares_by_option(outcome, xr.Dataset(), ["model", "level"])
    assert found == {"model": {"gas law": 0.5, "linear": 1.0}}


def test_nothing_decides_what_never_changes():
    _, about = sampled(16)
    assert deciding(xr.ones_like(about["sample"], bool), about).names == []


@pytest.mark.parametrize("count", [16, 128])
def test_pure_chance_is_not_explained(count):
    random, about = sampled(count)
    outcome = xr.DataArray(random.random(count) > 0.5, dims="sample")
    found = deciding(outcome, about)
    assert (found.names, found.explained) == ([], 0.0)


def test_correlation_ratios_run_from_nothing_to_all():
    outcome = np.array([0.0, 0.0, 1.0, 1.0] * 4)
    assert correlation_ratio(outcome, np.array([0, 0, 1, 1] * 4)) == 1.0
    assert correlation_ratio(outcome, np.array([0, 1, 0, 1] * 4)) == 0.0


def test_total_effects_of_a_grid_count_interactions():
    both = np.array([[True, False], [False, True]])
    outcome = xr.DataArray(both[..., None].repeat(3, 2), dims=("one", "other", "idle"))
    assert total_effects(outcome) == {"one": 1.0, "other": 1.0, "idle": 0.0}
    assert set(deciding(outcome, xr.Dataset()).names) == {"one", "other"}
