"""The stable step of the explicit method, where end stops are reached at one phase of the heave."""

import pytest
from random_rigs import moving, written

from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.stable_step import explicit_limit

#: rigs in the plane and in space whose tensioners reach their stops by a heave of 3 m
RIGS = [*((seed, False) for seed in (0, 1, 4, 5)), *((seed, True) for seed in (0, 4))]


def limit(seed, spatial, **motions):
    """The limit (s) with stiff stops and some motions of the platform, each with a ramp."""
    tree = written(moving(seed, spatial=spatial))
    kept = {name: tree["platform"][name] for name in ("position", "centre_of_rotation")}
    tree["platform"] = kept | {
        name: {"amplitude": f"{amplitude} m", "period": f"{period} s", "ramp": "8 s"}
        for name, (amplitude, period) in motions.items()
    }
    stops = {"shortest": "-2 m", "longest": "2.9 m", "stop_stiffness": "2000 MN/m"}
    tree["top"]["tensioners"]["stroke"] = stops
    scene = SceneFile("rig.yaml", tree).resolved()
    return explicit_limit(scene, settle(scene, even(scene, 40))[0])


@pytest.mark.parametrize("ratio", [2, 16, 32])
@pytest.mark.parametrize("seed, spatial", RIGS)
def test_a_slow_motion_of_a_centimetre_does_not_hide_the_stops(seed, spatial, ratio):
    """At a sixteenth of its period, the heave always has the same phase."""
    alone = limit(seed, spatial, heave=(3.0, 8.0))
    assert alone < 0.5 * limit(seed, spatial, heave=(0.1, 8.0))  # the stops are reached
    assert limit(seed, spatial, heave=(3.0, 8.0), surge=(0.01, 8.0 * ratio)) == pytest.approx(alone, rel=0.02)
