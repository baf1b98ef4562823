"""The components of a sea end below the tail of its spectrum, as far below as the theory says."""

import re
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, trapezoid

from riserstudy.model.sea import components
from riserstudy.scene.sea import Storm

THEORY = Path(__file__).parents[2] / "docs" / "theory.md"
COUNTS = (20, 100, 400)
SAID = (
    r"the last component of a simulated sea has (\S+) times the peak frequency with 20 components, "
    r"(\S+) times with 100 components, and (\S+) times with 400 components\. .* "
    r"The zero-upcrossing period of the simulated sea is (\S+) % too long with 20 components, "
    r"(\S+) % with 100 components, and (\S+) % with 400 components"
)


def spectrum(ratio, gamma):
    """JONSWAP over the ratio of frequency to peak frequency, without its scale."""
    width = np.where(ratio <= 1.0, 0.07, 0.09)
    peak = gamma ** np.exp(-((ratio - 1.0) ** 2) / (2.0 * width**2))
    return ratio**-5.0 * np.exp(-1.25 * ratio**-4.0) * peak


def ends(gamma, count, peak_period):
    """Highest frequency over the peak's, and mean zero-upcrossing period over that of the spectrum."""
    period = f"{peak_period!r} s"
    sea = Storm(
        significant_height="3 m", peak_period=period, peak_enhancement=gamma, components=count, seed=1
    )
    ratio = components(sea)[0] * peak_period / (2.0 * np.pi)
    w = np.geomspace(0.2, 300.0, 200001)
    energy = spectrum(w, gamma)
    square = trapezoid(energy * w**2, w) / trapezoid(energy, w)
    return ratio[-1], np.sqrt(square / np.mean(ratio**2)), w, energy


@pytest.mark.parametrize("seed", range(12))
def test_half_a_share_of_the_energy_is_above_the_highest_component(seed):
    draw = np.random.default_rng(seed)
    count = int(draw.integers(10, 600))
    highest, longer, w, energy = ends(float(draw.uniform(1.0, 8.0)), count, float(draw.uniform(5.0, 18.0)))
    below = np.interp(highest, w, cumulative_trapezoid(energy, w, initial=0.0)) / trapezoid(energy, w)
    assert 1.0 - below == pytest.approx(0.5 / count, rel=0.25)  # components end at ten times the peak
    assert 1.0 < longer < 1.06


def test_the_theory_states_the_ends_of_some_seas():
    stated = re.search(SAID, THEORY.read_text().replace("\n", " ")).groups()
    found = [ends(3.3, count, 10.0)[:2] for count in COUNTS]
    assert list(stated[:3]) == [f"{one:.1f}" for one, _ in found]
    longer = [100.0 * (one - 1.0) for _, one in found]
    assert [float(text) for text in stated[3:]] == pytest.approx(longer, abs=0.06)
