"""The three answers of the first screen: cost, stability, effects."""

import re

import numpy as np
import pytest
import xarray as xr

from chapters.numerics.report.tiles import tiles


def shown(datasets):
    """Tiles with an answer."""
    return [tile for tile in tiles(datasets) if tile.answer]


def test_without_datasets_there_are_three_questions_and_no_answer():
    assert [tile.figure for tile in tiles({})] == ["cost", "stability", "effects"]
    assert shown({}) == []


def test_the_tile_of_hard_cases_counts_them_and_draws_their_shares():
    cases = {
        "as_expected": [True] * 3 + [False],
        "written_outcome": ["accurate", "refused", "stable but inaccurate", "stable but inaccurate"],
    }
    stability = xr.Dataset({name: ("case", values) for name, values in cases.items()})
    (one,) = shown({"stability": stability})
    assert one.number == "1 of 3 results inaccurate without a warning"
    assert one.answer.startswith(
        "2 of 4 difficult scenes run to their end. Of the difficult scenes, 1 is refused with a stated "
        "reason and 1 is not as expected."
    )
    assert "each is accurate" not in one.answer
    assert one.spark.count("<rect") == 4


def test_the_tile_of_cost_is_the_ratio_of_times_and_draws_a_line_per_scene():
    rows = {
        "request_scene": ["a", "a", "b", "b"],
        "requested": [0.01, 0.0005, 0.01, 0.0005],
        "request_seconds": [0.1, 0.3, 0.2, 0.5],
    }
    accuracy = xr.Dataset({name: ("request", values) for name, values in rows.items()})
    (one,) = shown({"accuracy": accuracy})
    assert one.number == "0.05\u00a0% error instead of 1\u00a0%: 2.5 to 3× the time"
    assert one.answer == (
        "With a tolerance of 1\u00a0% for displacement, moment and tension, 2 test scenes take "
        "100 to 200\u00a0ms. With a tolerance of 0.05\u00a0%, the test scenes take 2.5 to 3 times as long."
    )
    assert one.spark.count("<polyline") == 2
    assert "time limit" not in one.spark


@pytest.mark.parametrize("ratio", [0.85, 1.0, 1.05, 1.2, 4.0])
def test_finer_tolerances_that_take_no_longer_are_said_to_take_no_more_time(ratio):
    rows = {"request_scene": ["a", "a"], "requested": [0.05, 0.01], "request_seconds": [0.1, 0.1 * ratio]}
    accuracy = xr.Dataset({name: ("request", values) for name, values in rows.items()})
    (one,) = shown({"accuracy": accuracy})
    assert one.number.endswith("no more time") == (ratio < 1.1)
    assert "takes 100\u00a0ms" in one.answer
    assert "one line per scene" not in one.spark


def test_the_words_below_the_lines_name_all_tolerances_that_are_drawn_and_scenes_in_words():
    rows = {
        "request_scene": ["S2"] * 3 + ["fem_riser base"],
        "requested": [0.05, 0.01, 0.0005, 0.01],
        "request_seconds": [0.05, 0.1, 0.3, np.nan],
    }
    accuracy = xr.Dataset({name: ("request", values) for name, values in rows.items()})
    (one,) = shown({"accuracy": accuracy})
    assert "tolerances from 5 to 0.05\u00a0%" in one.spark
    assert "without “riser in waves, without ramp”, whose runs exceed the time limit" in one.spark


@pytest.mark.parametrize("missed", [["c"], ["b", "c"]])
def test_scenes_without_any_run_in_time_are_named_where_the_others_are_drawn(missed):
    scenes = [*"aabbcc"]
    seconds = [np.nan if s in missed else 1.0 + k for k, s in enumerate(scenes)]
    rows = {"request_scene": scenes, "requested": [0.01, 0.0005] * 3, "request_seconds": seconds}
    accuracy = xr.Dataset({name: ("request", values) for name, values in rows.items()})
    (one,) = shown({"accuracy": accuracy})
    named = " and ".join(f"“{name}”" for name in missed)
    assert f"without {named}, whose runs exceed the time limit" in one.spark
    assert one.spark.count("<polyline") == 3 - len(missed)


@pytest.mark.parametrize("seed", range(12))
def test_the_tile_of_effects_states_a_share_of_scenes_that_no_effect_it_names_falls_below(seed):
    rng = np.random.default_rng(seed)
    names = [f"effect {k}" for k in range(rng.integers(2, 6))]
    sizes = np.where(rng.random((71, len(names))) < rng.uniform(0.8, 1.0, len(names)), 0.5, 0.001)
    sizes[rng.random(sizes.shape) < 0.1] = np.nan  # scenes without the effect
    every = {
        f"{of}_change": (("scene", "change"), sizes) for of in ("displacement", "moment", "tension", "time")
    }
    every |= {"changed_effect": ("change", names), "is_added": ("change", [False] * len(names))}
    effects = xr.Dataset(every, {"change": [f"without {name}" for name in names]})
    (one,) = shown({"effects": effects})
    least = int(re.search(r"in at least (\d+)", one.answer)[1])
    named = [k for k, name in enumerate(names) if name.lower() in one.number.lower()]
    shares = [100 * np.mean(sizes[np.isfinite(sizes[:, k]), k] > 0.01) for k in named]
    assert len(named) == min(3, len(names))
    assert least <= min(shares) < least + 1
    assert re.match(r"Leaving out (effect \d, )*effect \d or effect \d changes", one.answer)
