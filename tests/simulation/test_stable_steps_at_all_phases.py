"""The stable step of the explicit method, where end stops are reached at one phase of the heave."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.stable_step import explicit_limit

#: rigs in the plane and in space whose tensioners reach their stops by a heave of 3 m
RIGS = [*((seed, False) for seed in (0, 1, 4, 5)), *((seed, True) for seed in (0, 4))]


def harmonic(amplitude, period):
    """A motion of an amplitude (m) and a period (s), with a ramp."""
    return {"amplitude": f"{amplitude} m", "period": f"{period} s", "ramp": "8 s"}


def sampled(amplitude, period, ramp=0.0):
    """The same motion as a time series of 80 s, in which it has its full size from the ramp (s) on."""
    times = np.arange(0.0, 80.0, period / 20.0)
    sizes = amplitude * np.minimum(times / ramp, 1.0) if ramp else amplitude
    values = sizes * np.sin(2.0 * np.pi * times / period)
    rows = zip(times, values, strict=True)
    return {"points": [{"time": f"{t} s", "value": f"{value} m"} for t, value in rows]}


def response(amplitude, period):
    """The heave in a regular wave of 2 m height that the platform follows with a multiple of its height."""
    of_wave = {"heave": f"{amplitude} m/m", "heave_phase": "30 deg"}
    operators = [{"period": f"{share * period} s"} | of_wave for share in (0.5, 2.0)]
    wave = {"height": "2 m", "period": f"{period} s"}
    return {"response": {"operators": operators, "phases": "lead", "wave": wave, "ramp": "8 s"}}


def limit(seed, spatial, **motions):
    """The limit (s) with stiff stops and some motions of the platform, by the fields of the platform."""
    tree = written(moving(seed, spatial=spatial))
    kept = {name: tree["platform"][name] for name in ("position", "centre_of_rotation")}
    tree["platform"] = kept | motions
    tree["analysis"]["duration"] = "60 s"
    stops = {"shortest": "-2 m", "longest": "2.9 m", "stop_stiffness": "2000 MN/m"}
    tree["top"]["tensioners"]["stroke"] = stops
    scene = SceneFile("rig.yaml", tree).resolved()
    return explicit_limit(scene, settle(scene, even(scene, 40))[0])


@pytest.mark.parametrize("ratio", [2, 16, 32])
@pytest.mark.parametrize("seed, spatial", RIGS)
def test_a_slow_motion_of_a_centimetre_does_not_hide_the_stops(seed, spatial, ratio):
    """At a sixteenth of its period, the heave always has the same phase."""
    alone = limit(seed, spatial, heave=harmonic(3.0, 8.0))
    assert alone < 0.5 * limit(seed, spatial, heave=harmonic(0.1, 8.0))  # the stops are reached
    both = limit(seed, spatial, heave=harmonic(3.0, 8.0), surge=harmonic(0.01, 8.0 * ratio))
    assert both == pytest.approx(alone, rel=0.02)


@pytest.mark.parametrize("seed, spatial", RIGS)
def test_the_limit_does_not_depend_on_how_a_heave_is_given(seed, spatial):
    alone = limit(seed, spatial, heave=harmonic(3.0, 8.0))
    assert limit(seed, spatial, heave=sampled(3.0, 8.0, ramp=16.0)) == pytest.approx(alone, rel=0.02)
    assert limit(seed, spatial, **response(3.0, 8.0)) == pytest.approx(alone, rel=0.02)
