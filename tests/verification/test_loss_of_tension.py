"""Half of the top tension lost at once: the wave that it sends down a bar, energy, what is refused."""

import json
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError

SCENES = Path(__file__).parents[2] / "config/scenes"
LENGTH, STIFFNESS, MASS, TENSION = 1800.0, 8e9, 320.0, 2e6
SPEED = (STIFFNESS / MASS) ** 0.5  # 5000 m/s
BAR = """
title: bar held below and pulled above
riser:
  - {name: bar, length: 1800 m, axial_stiffness: 8e9 N, mass: 320 kg/m}
bottom: {hold: wellhead, elevation: 0 m}
top: {z: free, tension: 2 MN, tension_loss: {share: 0.5, at: 0.05 s, over: 0.2 s}}
analysis:
  duration: 0.7 s
  output: {interval: 0.01 s}
  mesh: {elements: 360}
  step: 0.0005 s
"""


def lost(t):
    """Share lost at a time, and its integral over time."""
    gone = np.clip((t - 0.05) / 0.2, 0.0, 1.0)
    whole = 0.1 * (gone - np.sin(np.pi * gone) / np.pi) + np.maximum(t - 0.25, 0.0)
    return 0.25 * (1.0 - np.cos(np.pi * gone)), 0.5 * whole


def test_a_wave_runs_down_the_bar_and_comes_back_doubled(tmp_path):
    """Until it is back, the top sinks at dF / sqrt(EA m); below, the tension falls by 2 dF after L / c."""
    file = tmp_path / "bar.yaml"
    file.write_text(BAR)
    run = simulate(file)
    t = run["time"].values
    sunk = TENSION * lost(t)[1] / (STIFFNESS * MASS) ** 0.5
    top = run["z"].isel(s=-1).values
    np.testing.assert_allclose(top[0] - top, sunk, atol=1e-3 * sunk.max())
    below = TENSION * (1.0 - 2.0 * lost(t - LENGTH / SPEED)[0])
    np.testing.assert_allclose(run["effective_tension"].isel(s=0), below, atol=5e-3 * TENSION)
    assert below.min() < 1.0  # slack as the wave arrives whole


def test_energy_balances_while_a_moving_riser_loses_half_its_tension():
    values = {
        "top.tension_loss": {"share": 0.5, "at": "20 s", "over": "0.5 s"},
        "analysis.duration": "30 s",
        "analysis.step": "0.05 s",
        "analysis.mesh": {"elements": 40},
    }
    run = simulate(load_scene(SCENES / "hard/surge.yaml", **values))
    assert json.loads(run.attrs["audit"])["unexplained_share"] < 1e-3
    tension = run["effective_tension"].isel(s=-1)
    assert float(tension.sel(time=20.0)) == pytest.approx(2275e3, rel=1e-3)
    assert float(tension.sel(time=slice(20.5, None)).mean()) == pytest.approx(1137.5e3, rel=0.02)


@pytest.mark.parametrize(
    "values, said",
    [
        ({"analysis": {}}, "has no effect on a static run"),
        ({"top.tension_loss.share": 1.2}, "top.tension_loss.share"),
        ({"top.tension_loss.over": "0 s"}, "top.tension_loss.over"),
    ],
)
def test_a_loss_that_cannot_be_meant_is_refused(tmp_path, values, said):
    file = tmp_path / "bar.yaml"
    file.write_text(BAR)
    with pytest.raises(InputError, match=said):
        load_scene(file, **values).resolved()
