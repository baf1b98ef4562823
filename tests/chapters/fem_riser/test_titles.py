"""Titles of the figures of trends state what the runs show."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import yaml

from chapters.fem_riser.figures import motion, trends
from riserstudy.figures.figure_text import headline

PUBLISHED = Path(__file__).parents[3] / "config/published/fem_riser.yaml"
NAMES = ("deflection", "stress", "angle", "vibration")


@pytest.mark.parametrize("seed", range(20))
def test_a_result_is_said_to_change_one_way_where_every_step_does(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    values = {name: draw.uniform(1.0, 2.0, 3) for name in NAMES}
    found = xr.Dataset({n: ("ratio", v) for n, v in values.items()}, {"ratio": [1.1, 1.3, 1.5]})
    order = draw.permutation(3)  # cases in any order
    monkeypatch.setattr(trends, "measures", lambda runs: found.isel(ratio=order))
    said = trends._changes(xr.Dataset(coords={"solver": [trends.BEAM]}), "ratio")
    less, _, more = said.partition("increases")
    for name, (first, middle, last) in values.items():
        assert (name in more) == (first < middle < last)
        assert (name in less) == (first > middle > last)


@pytest.mark.parametrize("ratio, word", [(3.14, "triples"), (0.49, "halves"), (2.05, "doubles")])
def test_a_ratio_near_a_simple_one_is_a_verb(ratio, word):
    assert trends._multiplies(ratio) == word


@pytest.mark.parametrize("ratio", [0.4, 0.7, 1.0, 1.5, 2.5, 3.5, 10.0])
def test_any_other_ratio_keeps_its_number(ratio):
    assert trends._multiplies(ratio) == f"multiplies by {ratio:.2g}"
    assert trends._multiplies(ratio, "ing") == f"multiplying by {ratio:.2g}"


@pytest.mark.parametrize("seed", range(6))
def test_waves_are_said_to_stay_near_the_surface_only_where_they_do(seed):
    """A motion that decays exponentially reaches a twentieth of its surface value at a known depth."""
    depth, time = np.linspace(0.0, 2000.0, 1001), np.linspace(0.0, 8.0, 33)
    reach = np.random.default_rng(seed).uniform(*((0.02, 0.09) if seed % 2 else (0.11, 0.9)))
    moved = np.cos(2.0 * np.pi / 8.0 * time)[:, None] * 20.0 ** (-depth / (reach * depth[-1]))
    over = {"time": time, "below_surface": depth}
    names = ("wave_velocity", "wave_acceleration")
    water = xr.Dataset(dict.fromkeys(names, (("time", "below_surface"), moved)), over)
    water["water_speed"] = ("below_surface", 1.0 - depth / depth[-1])
    title = headline(motion.fig03(water))
    assert ("near the surface only" in title) == (reach < 0.1)
    if reach > 0.1:
        assert float(title.split()[-2]) == pytest.approx(reach * depth[-1], abs=2.0 + 0.5)  # grid, rounding


def test_the_title_and_the_claim_use_the_same_shares():
    claims = yaml.safe_load(PUBLISHED.read_text("utf-8"))["items"]
    (claim,) = [one for one in claims if one["id"] == "B1"]
    assert claim["with"] == {"share": motion.FADED, "within": motion.NEAR_SURFACE}
