"""Lift, clearance and re-contact of a lower end whose height over time is written down."""

from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.records.warning import sentences
from riserstudy.simulation.disconnect import ABOVE, enter_lift, rows_of_limits

SCENE = Path(__file__).parents[2] / "config/scenes/design/recoil.yaml"


@pytest.fixture(scope="module")
def scenes():
    """Of a disconnect at 12 s, with and without a stack below."""
    file = load_scene(SCENE)
    return {stack: file.with_values(changes, "test").resolved() for stack, changes in (
        (True, {"disconnect.drain": None}), (False, {"disconnect.drain": None, "disconnect.stack": None})
    )}  # fmt: skip


def entered(scene, lift, aside):
    """Facts of a lift (m) and its distance from the well (m), as functions of the time after the release."""
    time = np.linspace(0.0, 60.0, 2401)
    after = np.maximum(time - scene.disconnect.at, 0.0)
    arrays = {"time": time, "lift": lift(after), "lift_aside": aside(after)}
    arrays["lift"][time <= scene.disconnect.at] = 99.0  # before the release, which does not count
    arrays["lift_rate"] = np.where(time > scene.disconnect.at, np.gradient(lift(after), time), 99.0)
    facts = {"warnings": []}
    enter_lift(scene, arrays, facts)
    return facts


@pytest.mark.parametrize("seed", range(20))
def test_a_lower_end_that_swings_above_the_stack_has_the_end_of_its_first_fall_as_clearance(scenes, seed):
    """A swing that decays: the end of the first fall, half a period after the first crest, is lowest."""
    draw = np.random.default_rng(seed)
    scene, high, period, decay = scenes[bool(seed % 2)], *draw.uniform((3.0, 6.0, 0.01), (9.0, 14.0, 0.05))
    w = 2.0 * np.pi / period
    crest = np.arctan2(-decay, w) / w + 0.5 * period  # where the slope of the swing is zero
    size = lambda t: high * (1.0 - np.exp(-decay * t) * np.cos(w * t))  # noqa: E731
    facts = entered(scene, size, lambda t: 0.01 * t)
    lowest = crest + 0.5 * period
    assert facts["lift_max"] == pytest.approx(size(crest), rel=1e-3)
    assert facts["clearance_time"] - scene.disconnect.at == pytest.approx(lowest, abs=0.05)
    assert facts["clearance_min"] == pytest.approx(size(lowest), abs=2e-3)
    assert facts["clearance_aside"] == pytest.approx(0.01 * lowest, abs=1e-3)
    t = np.linspace(0.0, period, 4001)
    rates = high * np.exp(-decay * t) * (decay * np.cos(w * t) + w * np.sin(w * t))
    assert facts["lift_rate_max"] == pytest.approx(rates.max(), rel=1e-3)
    assert "recontact_time" not in facts
    assert facts["warnings"] == []
    clearance = next(row for row in rows_of_limits(scene, facts) if row["output"] == "lmrp_clearance")
    assert clearance["smallest"] == clearance["largest"] == facts["clearance_min"]
    assert clearance["smallest_time"] == facts["clearance_time"]


@pytest.mark.parametrize("stack", [True, False])
@pytest.mark.parametrize("away", [0.5 * ABOVE, 2.0 * ABOVE])
@pytest.mark.parametrize("deep", [1e-3, 0.4])
def test_an_end_below_the_stack_has_a_time_of_contact(scenes, stack, away, deep):
    """Half a sine up for ten seconds, then half a sine down for five."""

    def lift(t):
        up, down = 5.0 * np.sin(0.1 * np.pi * t), -deep * np.sin(0.2 * np.pi * (t - 10.0))
        return np.where(t < 10.0, up, np.where(t < 15.0, down, 0.0))

    facts = entered(scenes[stack], lift, lambda t: away * t / 12.5)
    assert facts["recontact_time"] == pytest.approx(scenes[stack].disconnect.at + 10.0, abs=0.06)
    assert facts["recontact_aside"] == pytest.approx(away * 15.0 / 12.5, rel=0.02)
    assert facts["clearance_min"] == pytest.approx(-deep, rel=1e-3)
    said = " ".join(sentences(facts["warnings"]))
    assert ("has no stack to stop it" in said) == (not stack)
    assert (f"sinks up to {deep:.3g} m below it" in said) == (not stack)
    assert ("aside from the well" in said) == (stack and away > ABOVE)


@pytest.mark.parametrize("lift", [lambda t: 0.2 * t, lambda t: 0.0 * t, lambda t: 9.0 * np.sin(0.04 * t)])
def test_an_end_that_rises_falls_or_rests_until_the_end_has_no_clearance(scenes, lift):
    facts = entered(scenes[True], lift, lambda t: 0.0 * t)
    assert "clearance_min" not in facts
    assert [row["output"] for row in rows_of_limits(scenes[True], facts)] == []


def test_an_end_that_comes_to_rest_has_the_clearance_of_its_rest(scenes):
    facts = entered(scenes[True], lambda t: 2.0 + np.exp(-t) * np.minimum(t, 1.0), lambda t: 0.0 * t)
    assert facts["clearance_min"] == pytest.approx(2.0, abs=1e-6)
