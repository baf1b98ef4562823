"""The largest speed of a riser's upper end on a moving platform, against its positions over time."""

import numpy as np
import pytest
from random_rigs import HIGHEST, rig, shed_vortices, timed, written
from scipy.interpolate import CubicSpline

from riserstudy.model.layout import unstretched
from riserstudy.model.platform_motion import largest_speed
from riserstudy.model.sea import components_of
from riserstudy.model.vortices import shortest_shedding_period
from riserstudy.scene.load import SceneFile

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
IN_PLANE = ("surge", "heave", "pitch")
SI = {"x": "m", "y": "m", "roll": "rad", "pitch": "rad", "yaw": "rad", "heading": "rad"}
STILL = {"roll": 0.1, "pitch": 0.1, "yaw": 1.0}  # largest tilts of a platform at rest (rad)
SMALL = 0.04  # rad, largest amplitude of tilts: their levers are then close to those at rest
TIMES = np.arange(0.0, 6000.0, 0.1)  # s
GRAVITY = 9.80665


def standing(seed, kind):
    """A rig on inclined tensioners beside the platform's centre of rotation, and the names of its motions."""
    draw = np.random.default_rng((seed, len(kind)))
    spatial = bool(seed % 2)
    tree = shed_vortices(rig(seed, spatial=spatial, conductor=False))
    tree["top"]["offset"] = float(draw.uniform(-20.0, 20.0))
    x, y, z = draw.uniform([-20.0, -20.0, -20.0], [20.0, 20.0, 5.0]).tolist()
    tree["platform"]["centre_of_rotation"] = {"x": x, "y": y * spatial, "elevation": z}
    names = draw.permutation(MOTIONS if spatial else IN_PLANE)
    tilts = [name for name in (MOTIONS if spatial else IN_PLANE) if name in STILL and kind != "response"]
    tree["platform"]["position"] |= {name: STILL[name] * float(draw.uniform(-1.0, 1.0)) for name in tilts}
    tree["analysis"] = timed(60.0, 0.1, 40, 0.1)
    return tree, names[: draw.integers(1, len(names) + 1)].tolist(), draw


def sizes(names, draw):
    """Amplitudes (m or rad) and phases (rad) of motions."""
    each = [float(draw.uniform(0.3, 1.0)) * (SMALL if name in STILL else 2.0) for name in names]
    return each, draw.uniform(0.0, 6.0, len(names)).tolist()


def velocity(tree, names, away):
    """Horizontal velocity of the riser's upper end by differences of its positions, (times, 2), m/s.

    Parameters
    ----------
    away : function of times (s) to the motions of these names, (names, times), m or rad.
    """
    platform = tree["platform"]
    rest = np.array([platform["position"].get(name, 0.0) for name in MOTIONS])
    moved = np.tile(rest[:, None], len(TIMES))
    for name, motion in zip(names, away(TIMES), strict=True):
        moved[MOTIONS.index(name)] += motion
    about = platform["centre_of_rotation"]
    arm = [tree["top"]["offset"] - about["x"], -about["y"], tree["top"]["elevation"] - about["elevation"]]
    point = [np.full(len(TIMES), one) for one in arm]
    for axis, angle in enumerate(moved[3:]):  # roll, then pitch, then yaw, about fixed axes
        i, j = (axis + 1) % 3, (axis + 2) % 3
        c, s = np.cos(angle), np.sin(angle)
        point[i], point[j] = c * point[i] - s * point[j], s * point[i] + c * point[j]
    place = np.array(point[:2]) + moved[:2]
    return ((place[:, 2:] - place[:, :-2]) / (TIMES[2] - TIMES[0])).T


def found(tree):
    scene = SceneFile("rig.yaml", written(tree, unit_of=SI)).resolved()
    return scene, largest_speed(scene, np.array([scene.top.offset, 0.0, unstretched(scene).top]))


@pytest.mark.parametrize("kind", ["one period", "two periods", "series"])
@pytest.mark.parametrize("seed", range(20))
def test_motions_over_time_reach_the_largest_speed(seed, kind):
    """Vortices at the riser's highest place in the water are shed by this speed and the current together."""
    tree, names, draw = standing(seed, kind)
    period = float(draw.uniform(6.0, 15.0))
    size, phase = sizes(names, draw)
    other = 0.618 if kind == "two periods" else 1.0
    periods = [period * (other if k % 2 else 1.0) for k in range(len(names))]

    def away(times):
        rows = zip(size, periods, phase, strict=True)
        return [one * np.sin(2.0 * np.pi * times / length + at) for one, length, at in rows]

    if kind == "series":
        knots = np.linspace(0.0, 5.0 * period, 60) + draw.uniform(0.0, 0.2, 60)
        series = [CubicSpline(knots, values) for values in away(knots)]
        for name, of in zip(names, series, strict=True):
            unit = "rad" if name in STILL else "m"
            points = [{"time": f"{t!r} s", "value": f"{float(of(t))!r} {unit}"} for t in knots.tolist()]
            tree["platform"][name] = {"points": points}
        scene, speed = found(tree)
        real = velocity(tree, names, lambda times: [of(np.clip(times, *knots[[0, -1]])) for of in series])
    else:
        for name, *row in zip(names, size, periods, phase, strict=True):
            tree["platform"][name] = dict(zip(("amplitude", "period", "phase"), row, strict=True))
        scene, speed = found(tree)
        real = velocity(tree, names, away)
    largest = np.hypot(*real.T).max()
    assert speed == pytest.approx(largest, rel=0.03, abs=0.01)
    diameter = tree["riser"][0]["viv"]["diameter"]
    ring = tree["bottom"]["elevation"] + sum(section["length"] for section in tree["riser"])
    share = 1.0 - min(ring, 0.0) / tree["water"]["seabed"]  # of the surface's height above the seabed
    met = tree["current"]["profile"]["surface_speed"] * share + speed
    assert shortest_shedding_period(scene) == pytest.approx(diameter / (HIGHEST * met), rel=1e-9)


@pytest.mark.parametrize("kind", ["swell", "sea", "swell met by a cruise"])
@pytest.mark.parametrize("seed", range(20))
def test_a_response_to_waves_has_the_largest_speed_of_its_motions(seed, kind):
    """In a sea, it is twice the standard deviation in the direction in which this is largest."""
    tree, names, draw = standing(seed, "response")
    platform, (size, phase) = tree["platform"], sizes(names, draw)
    row = {f"{name}_phase": f"{at!r} rad" for name, at in zip(names, phase, strict=True)}
    for name, one in zip(names, size, strict=True):
        row[name] = f"{one!r} {'rad/m' if name in STILL else 'm/m'}"
    operators = [row | {"period": f"{period} s"} for period in (0.5, 200.0)]
    platform["response"] = {"operators": operators, "phases": "lead", "ramp": 20.0}
    if kind == "sea":
        wave = {"significant_height": "2 m", "peak_period": "11 s", "peak_enhancement": 2.0}
        platform["response"]["wave"] = wave | {"components": 40, "seed": seed}
    else:
        wave = {"amplitude": 1.0, "period": float(draw.uniform(6.0, 15.0)), "heading": np.pi * (seed % 4 < 2)}
        tree["wave"] = wave | {"above_mean_level": "none"}
    cruise = float(draw.uniform(0.5, 3.0)) if "cruise" in kind else 0.0
    if cruise:
        platform["cruise"] = {"speed": cruise, "heading": 0.0}
    scene, speed = found(tree)
    amplitude, frequency, start = components_of(scene.platform.response.wave or scene.wave)
    toward = np.cos(wave.get("heading", 0.0)) * cruise  # the speed at which the platform follows the wave
    met = frequency - frequency**2 / GRAVITY * toward  # in deep water

    def away(times):
        lag = np.multiply.outer(times, met) - start
        return [one * (np.cos(lag + at) @ amplitude) for one, at in zip(size, phase, strict=True)]

    real = velocity(tree, names, away)
    if kind == "sea":
        largest = 2.0 * np.sqrt(np.linalg.eigvalsh(np.cov(real.T))[-1])
    else:
        largest = np.hypot(*real.T).max()
    assert speed == pytest.approx(largest, rel=0.03, abs=0.01)
