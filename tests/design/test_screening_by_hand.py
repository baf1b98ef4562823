"""Screening of strings of two diameters in a sheared current below a surface: by sines and fine sums."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from riserstudy.design.vortex_screening import Coefficients, screening
from riserstudy.scene.load import SceneFile

LENGTH, TENSION, MASS = 300.0, 2e6, 400.0
FINE = 20_000  # places along the string
PHASE = 2.0 * math.pi * (np.arange(48) + 0.5) / 48


def case(seed):
    """Scene, coefficients, and diameter, speed and drag coefficient over elevation (m)."""
    draw = np.random.default_rng(seed)
    cut, surface = draw.uniform(60.0, 160.0), draw.uniform(200.0, 290.0)
    diameters, foot, top = draw.uniform(0.3, 0.7, 2), draw.uniform(0.1, 0.3), draw.uniform(0.6, 1.0)
    drags = draw.uniform(0.7, 1.4, 2)
    ratio = float((2 * draw.integers(5, 8) + 1) ** 2)  # the axial mode is half way between two lateral ones
    given = Coefficients(
        float(draw.uniform(0.17, 0.25)),
        lift=float(draw.uniform(0.6, 1.2)),
        drag_gain=float(draw.uniform(1, 3)),
    )
    table = [{"elevation": f"{z} m", "value": float(c)} for z, c in ((0.0, drags[0]), (250.0, drags[1]))]
    sections = [
        {
            "name": f"part {k}",
            "length": f"{length} m",
            "axial_stiffness": f"{ratio * TENSION} N",
            "mass": f"{MASS} kg/m",
            "submerged_weight": "0 N/m",
            "outer_diameter": f"{0.9 * diameters[k]} m",
            "drag": {"coefficient": table, "diameter": f"{diameters[k]} m"},
        }
        for k, length in enumerate((cut, LENGTH - cut))
    ]
    profile = [(0.0, foot), (surface, top)]
    tree = {
        "title": "string of two diameters",
        "water": {"density": "1025 kg/m^3", "surface": f"{surface} m"},
        "riser": sections,
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "free", "tension": f"{TENSION} N"},
        "analysis": {"mesh": {"elements": 120}},
        "current": {"profile": [{"elevation": f"{z} m", "speed": f"{u} m/s"} for z, u in profile]},
    }
    stretch = 1.0 + 1.0 / ratio
    z = (np.arange(FINE) + 0.5) / FINE * LENGTH * stretch
    wet = z < surface
    speed = np.where(wet, foot + (top - foot) * z / surface, 0.0)
    diameter = np.where(z < cut * stretch, *diameters)
    drag = np.where(wet, np.interp(z, (0.0, 250.0), drags), 0.0)
    return tree, given, stretch, z, diameter, speed, drag


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_all_that_a_screening_tells_of_each_mode(seed, spatial):
    tree, given, stretch, z, diameter, speed, drag = case(seed)
    if spatial:
        tree["current"]["heading"] = "37 deg"
    found = screening(SceneFile("scene.yaml", tree), given)
    wet, step = speed > 0.0, z[1] - z[0]
    first = math.sqrt(TENSION / MASS / stretch) / (2.0 * LENGTH)
    expected = []
    for n in range(1, 60):
        reduced = speed / (n * first * diameter)
        if ((reduced >= 4.0) & (reduced <= 8.0)).sum() > 0.01 * FINE:
            expected.append(n)
    close = found.where(found["excited_length"] > 0.01 * LENGTH * stretch, drop=True)
    order = np.round(close["natural_frequency"].values / first).astype(int)
    assert order.tolist() == expected
    assert expected
    np.testing.assert_allclose(close["natural_frequency"], np.array(expected) * first, rtol=0.01)
    for k, n in enumerate(expected):
        frequency = float(close["natural_frequency"][k])
        reduced = speed / (frequency * diameter)
        excited = (reduced >= 4.0) & (reduced <= 8.0)
        shape = abs(np.sin(math.pi * n * z / (LENGTH * stretch)))

        def gained(size, frequency=frequency, excited=excited, shape=shape):
            total = 0.0
            for cosine in np.cos(PHASE):
                v = 2.0 * math.pi * frequency * size * cosine * shape[::10]
                lift = given.lift * excited[::10] * speed[::10] * cosine
                total += diameter[::10] @ (np.hypot(v, speed[::10]) * (lift - drag[::10] * v) * v)
            return total / size

        size = brentq(gained, 1e-6, 5.0)
        relative = size * shape / diameter
        right = {
            "excited_length": excited.sum() * step,
            "excited_from": z[excited][0],
            "excited_to": z[excited][-1],
            "slowest_current": 4.0 * frequency * diameter[wet].min(),
            "fastest_current": 8.0 * frequency * diameter[wet].max(),
            "amplitude": relative.max(),
            "amplitude_limit": (given.lift * reduced / (2.0 * math.pi * np.where(wet, drag, 1.0)))[
                excited
            ].max(),
            "drag_factor": 1.0 + given.drag_gain * relative[excited].mean(),
        }
        for name, value in right.items():
            near = {"abs": 0.5} if name in ("excited_from", "excited_to") else {"rel": 0.02}  # m or 1
            assert float(close[name][k]) == pytest.approx(value, **near), (n, name)
    middles = found["z"].values
    shed = given.strouhal * np.interp(middles, z, speed / diameter)
    inside = (abs(middles - middles[:-1][np.diff(found["current_speed"]).argmin()]) > 5.0) & (middles < 195.0)
    inside &= abs(np.interp(middles - 3.0, z, diameter) - np.interp(middles + 3.0, z, diameter)) < 1e-9
    np.testing.assert_allclose(found["shedding_frequency"].values[inside], shed[inside], rtol=0.01)
    # the segment at the surface has the mean speed of its part in water
    half, surface = 0.5 * np.diff(middles)[-1], z[wet][-1]
    at = np.flatnonzero((middles - half < surface - 0.1) & (middles + half > surface + 0.1))
    for k in at:
        part = wet & (z > middles[k] - half)
        assert float(found["current_speed"][k]) == pytest.approx(speed[part].mean(), rel=1e-3)
