"""A gauge pressure pulls by what it is above the atmosphere, and its gas expands as what it is in all."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from riserstudy import load_scene, simulate
from riserstudy.model.tensioner_law import gas_force, linear_law, tension_at_mid_stroke

SCENES = Path(__file__).parents[2] / "config/scenes"
CHANG, LIU = SCENES / "chang2020/heave.yaml", SCENES / "liu2020/heave.yaml"
HIGH, LOW = (f"top.tensioners.two_chamber_gas.{side}.pressure" for side in ("high", "low"))
ATMOSPHERE = 101325.0  # Pa
GRAVITY, PISTON = 9.81, 6050.0  # m/s2; kg, counted once


def rig(scene, **pressures):
    return load_scene(scene, **pressures).resolved().top.tensioners


def test_at_mid_stroke_six_cylinders_pull_as_hand_statics_say():
    """The manometer's pressures on their areas, with the atmosphere on the rod."""
    printed = rig(LIU, **{HIGH: "2.08 MPa gauge", LOW: "0.15 MPa gauge"})
    both = printed.two_chamber_gas
    by_hand = 2.08e6 * both.high.area - 0.15e6 * both.low.area
    pulls = gas_force(both, np.zeros(1))[0]
    assert pulls == pytest.approx(by_hand, rel=1e-12)
    tonnes = 6.0 * pulls / GRAVITY / 1e3 - PISTON / 1e3
    assert tonnes == pytest.approx(231.83, abs=0.01)
    assert 6.0 * tension_at_mid_stroke(printed, GRAVITY) / GRAVITY / 1e3 == pytest.approx(tonnes)


def test_one_chamber_pulls_nothing_where_its_gas_is_down_to_the_atmosphere():
    gas = rig(CHANG, **{"top.tensioners.gas.pressure": "190.2 bar gauge"}).gas
    whole = 190.2e5 + ATMOSPHERE
    stretched = gas.volume * (whole / ATMOSPHERE) ** (1.0 / gas.exponent)
    reach = (gas.volume - stretched) / gas.area
    assert brentq(lambda x: gas_force(gas, np.array([x]))[0], 2.0 * reach, 0.0) == pytest.approx(reach)
    assert gas_force(gas, np.zeros(1))[0] == pytest.approx(190.2e5 * gas.area)


def test_the_line_has_the_slope_of_the_law():
    tension, stiffness = linear_law(
        rig(CHANG, **{"top.tensioners.gas.pressure": "190.2 bar gauge"}).replaced(
            linearised=rig(CHANG, **{"top.tensioners.linearised": {"by": "tangent"}}).linearised
        )
    )
    gas = rig(CHANG, **{"top.tensioners.gas.pressure": "190.2 bar gauge"}).gas
    ends = gas_force(gas, np.array([-1e-4, 1e-4]))
    assert stiffness == pytest.approx((ends[1] - ends[0]) / 2e-4, rel=1e-6)
    assert tension == pytest.approx(190.2e5 * gas.area)


def test_a_riser_hangs_on_what_the_law_says():
    """The engine's cylinders, which have records of their own, against the law in numbers."""
    settings = {
        "top.tensioners.gas.pressure": "190.2 bar gauge",
        "analysis.duration": None,
        "analysis.output": None,
        "analysis.step": None,
        "analysis.method": None,
    }
    scene = load_scene(CHANG, **settings)
    found = simulate(scene)
    law = scene.resolved().top.tensioners
    reach = found["tensioner_stroke_static"].values
    expected = gas_force(law.gas, reach) * np.array(law.working)
    np.testing.assert_allclose(found["tensioner_force_static"], expected, rtol=1e-9)
    assert tension_at_mid_stroke(law) == pytest.approx(190.2e5 * law.gas.area)
