"""Time steps resolve the vortices that current and waves shed together."""

import copy
import re

import numpy as np
import pytest
from short_riser import SCENE

from riserstudy.model.sea import components_of, speed_at_crest, wave_number
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.starting_mesh import period

LONG = 600.0  # s, period of a wave whose water moves alike at all depths


def in_words(wave):
    return {"amplitude": f"{wave[0]} m", "period": f"{wave[1]} s", "above_mean_level": "none"}


def of(speed, wave=None, **analysis):
    """The short riser in a uniform current (m/s), and in a wave of an amplitude (m) and a period (s)."""
    tree = copy.deepcopy(SCENE)
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": f"{speed} m/s"}}
    if wave is not None:
        tree["wave"] = in_words(wave)
    tree["analysis"] |= analysis
    return SceneFile("riser.yaml", tree, {}).resolved()


@pytest.mark.parametrize("seed", range(6))
def test_the_water_below_a_crest_carries_what_the_crest_moves_on(seed):
    """Conservation of mass: the flux below the crest is the speed of the wave times its amplitude."""
    draw = np.random.default_rng(seed)
    amplitude, length = draw.uniform(0.5, 5.0), draw.uniform(4.0, 20.0)
    scene = of(0.3, (amplitude, length))
    depth = scene.water.surface - scene.water.seabed
    elevations = np.linspace(scene.water.seabed, scene.water.surface, 20_001)
    speed = speed_at_crest(scene.wave, scene.water, scene.gravity, elevations)
    phase_speed = 2.0 * np.pi / length / wave_number(2.0 * np.pi / length, depth, scene.gravity)
    assert np.trapezoid(speed, elevations) == pytest.approx(amplitude * phase_speed, rel=1e-5)
    assert (np.diff(speed) > 0.0).all()


@pytest.mark.parametrize("seed", range(4))
def test_the_speed_of_a_sea_is_twice_the_standard_deviation(seed):
    tree = copy.deepcopy(SCENE)
    draw = np.random.default_rng((seed, 1))
    tree["wave"] = {"significant_height": f"{draw.uniform(1.0, 8.0)} m", "peak_period": "9 s", "seed": seed}
    tree["wave"] |= {"peak_enhancement": 2.0, "components": 60}
    tree["wave"] |= {"above_mean_level": "none"}
    scene = SceneFile("riser.yaml", tree, {}).resolved()
    deep = scene.water.replaced(seabed=-2000.0)  # each component decays by exp(kz)
    amplitude, w, phase = components_of(scene.wave)
    time, down = np.linspace(0.0, 40_000.0, 80_001)[:, None], draw.uniform(0.0, 40.0)
    u = (amplitude * w * np.exp(-(w**2) / scene.gravity * down) * np.cos(w * time + phase)).sum(axis=1)
    found = speed_at_crest(scene.wave, deep, scene.gravity, np.array([deep.surface - down]))
    assert found[0] == pytest.approx(2.0 * u.std(), rel=0.01)


@pytest.mark.parametrize("seed", range(3))
def test_a_long_wave_calls_for_the_steps_of_a_current_as_fast(seed):
    """Water that a wave moves alike at all depths sheds the vortices of a current: two ways to write it."""
    draw = np.random.default_rng((seed, 2))
    slow, fast = draw.uniform(0.1, 0.3), draw.uniform(0.5, 1.5)
    still = of(fast)
    depth = still.water.surface - still.water.seabed
    both = of(slow, ((fast - slow) / np.sqrt(still.gravity / depth), LONG))
    assert period(both) == pytest.approx(period(still), rel=0.01)
    assert period(of(slow)) > 1.5 * period(still)


@pytest.mark.parametrize("seed", range(3))
def test_a_wave_in_still_water_calls_for_the_steps_of_its_crest(seed):
    """A wave sheds as fast without a current as in the slowest of currents."""
    wave = np.random.default_rng((seed, 3)).uniform([1.0, 8.0], [4.0, 16.0])
    slow = of(1e-6, wave)
    alone = copy.deepcopy(SCENE) | {"wave": in_words(wave)}
    assert period(SceneFile("riser.yaml", alone, {}).resolved()) == pytest.approx(period(slow), rel=1e-5)
    assert period(of(0.0, wave)) == pytest.approx(period(slow), rel=1e-5)


def test_a_step_too_long_for_vortices_in_waves_is_warned_of():
    """With this step, cross-flow motion is a third too small, and the estimate of its error is 3 %."""
    short = {"duration": "100 s", "output": {"interval": "0.2 s"}}
    facts = run(of(0.4, (4.0, 12.0), step="0.1 s", **short), estimated=False).facts
    (warned,) = [text for text in sentences(facts["warnings"]) if "the time step is too long" in text]
    proposed = float(re.search(r"use a time step of ([\d.]+) s", warned)[1])
    better = of(0.4, (4.0, 12.0), step=f"{proposed} s", **short)
    for shorter in (run(better, estimated=False), run(of(0.4, step="0.1 s", **short))):
        assert not any("too long" in text for text in sentences(shorter.facts["warnings"]))
