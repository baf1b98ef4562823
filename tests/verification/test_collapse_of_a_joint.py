"""A telescopic joint that collapses on its stop: a mass that a moving stop hits, against its closed form.

A ring of mass M is held by a soft riser of stiffness K and by a constant tension; it is at rest while the
platform comes down at speed V. After the gap g its stop, of stiffness S, is on the ring. With
w^2 = (K + S)/M and tau from the touch on, the ring is at -S V/(K + S) (tau - sin(w tau)/w), and the stop is
compressed by V tau less that, until it lets go.
"""

import json

import numpy as np
import pytest
from scipy.optimize import brentq

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile

MASS, STOP, SPEED, GAP, LENGTH, BARREL = 100e3, 2e6, 1.0, 1.0, 300.0, 5.0
AXIAL = 6e6  # so that the riser's stiffness is a hundredth of the stop's
SOFT = AXIAL / LENGTH
TENSION = 10e3
W = np.sqrt((SOFT + STOP) / MASS)


def compressed(tau):
    """By how much the stop is, so long after the touch (m)."""
    return SPEED * tau - STOP * SPEED / (SOFT + STOP) * (tau - np.sin(W * tau) / W)


def scene(**values):
    """The ring, the riser below it, and a platform that comes down."""
    tree = {
        "title": "collapse",
        "riser": [
            {
                "name": "rope",
                "length": f"{LENGTH} m",
                "axial_stiffness": f"{AXIAL} N",
                "bending_stiffness": "1 MN*m^2",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {
            "x": "platform",
            "z": "platform",
            "elevation": f"{LENGTH * (1.0 + TENSION / AXIAL) + BARREL} m",
            "body": {"name": "ring", "mass": f"{MASS} kg"},
            "telescopic_joint": {
                "length": f"{BARREL} m",
                "bending_stiffness": "1 MN*m^2",
                "tension": f"{TENSION} N",
                "stop": {"collapse": f"{GAP} m", "stiffness": f"{STOP} N/m"},
            },
        },
        "platform": {"heave": {"points": [{"time": f"{t} s", "value": f"{-SPEED * t} m"} for t in range(5)]}},
        "analysis": {
            "duration": "2.5 s",
            "output": {"interval": "0.005 s"},
            "mesh": {"elements": 1},
            "step": "0.001 s",
        },
    }
    return SceneFile("collapse", tree).with_values(values, "test")


@pytest.fixture(scope="module")
def run():
    return simulate(scene())


def test_the_stop_is_compressed_as_by_the_closed_form(run):
    apart = brentq(compressed, 0.6 * np.pi / W, 1.4 * np.pi / W)  # the first zero after the touch
    tau = run["time"].values - GAP / SPEED
    within = (tau > 0.0) & (tau < apart)
    assert within.sum() > 100
    pressed = -GAP - run["stroke"].values[within]
    # the touch falls within a step: an error of step times speed times the share of a swing
    np.testing.assert_allclose(pressed, compressed(tau[within]), atol=2e-3 * compressed(tau).max())
    assert np.all(-GAP - run["stroke"].values[tau < 0.0] < 1e-9)


def test_the_ring_leaves_as_fast_as_it_came(run):
    """Seen from the stop, so at nearly twice its speed, and free until the soft riser turns it."""
    tau = run["time"].values - GAP / SPEED
    apart = brentq(compressed, 0.6 * np.pi / W, 1.4 * np.pi / W)
    speed = -STOP * SPEED / (SOFT + STOP) * (1.0 - np.cos(W * apart))
    place = -STOP * SPEED / (SOFT + STOP) * (apart - np.sin(W * apart) / W)
    free, own = tau - apart, np.sqrt(SOFT / MASS)
    after = (free > 0.0) & (free < 0.8)
    ring = run["z"].isel(s=-2).values[after]
    expected = place * np.cos(own * free[after]) + speed / own * np.sin(own * free[after])
    np.testing.assert_allclose(ring - ring[0], expected - expected[0], atol=4e-3)
    assert speed == pytest.approx(-2.0 * SPEED, rel=0.02)


def test_no_energy_is_lost_or_made(run):
    audit = json.loads(run.attrs["audit"])
    assert audit["unexplained_share"] < 1e-4


def test_the_contact_is_told_with_its_force(run):
    (said,) = [w for w in json.loads(run.attrs["warnings"]) if "collapsed" in w]
    assert said.startswith("telescopic joint collapsed: first reaches its stop at t = 1")
    force = 1e3 * float(said.split("largest force of ")[1].split(" kN")[0])
    assert force == pytest.approx(SPEED * np.sqrt(STOP * MASS), rel=0.01)


def test_tensioners_that_pull_at_the_ring_have_the_joint_s_stop_too():
    pulled = {"top.telescopic_joint.tension": None, "top.tension": f"{TENSION} N"}
    own, same = (simulate(scene(**values)) for values in ({}, pulled))
    np.testing.assert_allclose(own["stroke"], same["stroke"], atol=1e-9)


@pytest.mark.parametrize(
    "stop, why",
    [
        ({"collapse": "5 m", "stiffness": "1 MN/m"}, "give less than 5 m"),
        ({"stiffness": "1 MN/m"}, "give stroke .outwards., collapse .inwards. or both"),
    ],
)
def test_stops_that_are_none_are_refused(stop, why):
    with pytest.raises(InputError, match=why):
        scene(**{"top.telescopic_joint.stop": stop}).resolved()
