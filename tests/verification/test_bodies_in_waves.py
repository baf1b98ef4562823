"""Waves on a body: as on a short section with the same properties, and as an oscillator in a small wave."""

import copy

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from riserstudy import simulate
from riserstudy.scene.load import SceneFile

G, RHO, DEPTH = 9.80665, 1025.0, 300.0
LENGTH = 1.0  # of the section that replaces a body (m)


def hang_off(seed, spatial):
    """A riser that hangs from a vessel above an LMRP, which is near enough to the surface for waves."""
    draw = np.random.default_rng((seed, spatial))
    volume, mass = float(draw.uniform(8.0, 20.0)), float(draw.uniform(60e3, 140e3))
    added, area = float(draw.uniform(30e3, 120e3)), float(draw.uniform(5.0, 25.0))
    length = float(draw.uniform(60.0, 110.0))
    wave = {"height": f"{draw.uniform(2.0, 5.0)} m", "period": f"{draw.uniform(7.0, 12.0)} s"}
    if seed % 2:
        wave = {
            "significant_height": f"{draw.uniform(2.0, 4.0)} m",
            "peak_period": f"{draw.uniform(8.0, 12.0)} s",
            **{"peak_enhancement": 2.0, "components": 30, "seed": seed},
        }
    wave |= {"above_mean_level": "stretched", "ramp": "10 s"}
    if spatial:
        wave["heading"] = f"{draw.uniform(20.0, 160.0)} deg"
    tree = {
        "title": f"hang-off {seed}",
        "gravity": f"{G} m/s^2",
        "water": {"density": f"{RHO} kg/m^3", "surface": f"{DEPTH} m", "seabed": "0 m"},
        "riser": [
            {
                "name": "riser",
                "length": f"{length} m",
                "outer_diameter": "0.5334 m",
                "inner_diameter": "0.48895 m",
                "young_modulus": "207 GPa",
                "mass": "560 kg/m",
                "submerged_weight": "2500 N/m",
                "drag": {"coefficient": 1.0, "diameter": "0.75 m"},
                "added_mass": {"coefficient": 1.0, "diameter": "0.75 m"},
            }
        ],
        "bottom": {
            "hold": "free",
            "body": {
                "name": "LMRP",
                "mass": f"{mass} kg",
                "displaced_volume": f"{volume} m^3",
                "added_mass": {"horizontal": f"{added} kg"},
                "drag_area": {"horizontal": f"{area} m^2"},
            },
        },
        "top": {"x": "held", "z": "held", "elevation": f"{DEPTH + 10.0} m", "rotation": "fixed"},
        "wave": wave,
        "analysis": {
            **{"duration": "40 s", "output": {"interval": "0.5 s"}, "mesh": {"elements": 40}, "step": "0.1 s"}
        },
    }
    return tree, volume, mass, added, area


def with_section(tree, volume, mass, added, area):
    """The same riser, whose body is a short section around the place of the body."""
    tree = copy.deepcopy(tree)
    del tree["bottom"]["body"]
    riser = tree["riser"][0]
    outer = np.sqrt(4.0 * volume / (np.pi * LENGTH))
    section = {
        **{key: riser[key] for key in ("outer_diameter", "inner_diameter", "young_modulus")},
        "name": "LMRP",
        "length": f"{LENGTH} m",
        "mass": f"{mass / LENGTH} kg/m",
        "submerged_weight": f"{(mass - RHO * volume) * G / LENGTH} N/m",
        "added_mass": {"coefficient": added / (RHO * volume), "diameter": f"{outer} m"},
        "drag": {"coefficient": area / (LENGTH * outer), "diameter": f"{outer} m"},
    }
    riser["length"] = f"{float(riser['length'].split()[0]) - 0.5 * LENGTH} m"
    tree["riser"].insert(0, section)
    return tree


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_body_moves_in_waves_as_a_short_section_does(seed, spatial):
    tree, *body = hang_off(seed, spatial)
    one, two = (simulate(SceneFile("hang.yaml", t)) for t in (tree, with_section(tree, *body)))
    for name in ["x", *(["y"] if spatial else [])]:
        at_body = one[name].isel(s=0).values
        in_section = two[name].interp(s=0.5 * LENGTH).values
        np.testing.assert_allclose(at_body, in_section, rtol=0.0, atol=0.03 * abs(in_section).max())


@pytest.mark.parametrize("seed", range(4))
def test_a_body_on_a_string_in_a_small_wave_is_an_oscillator(seed):
    """(m + m_a) x'' + (W / l) x = (rho V + m_a) du/dt, for a string without mass and drag."""
    draw = np.random.default_rng(seed)
    length, deep = 100.0, float(draw.uniform(20.0, 60.0))
    mass, volume, added = (float(draw.uniform(*ends)) for ends in ((20e3, 60e3), (4.0, 15.0), (0.0, 50e3)))
    period, height = float(draw.uniform(8.0, 14.0)), 0.02
    weight = (mass - RHO * volume) * G
    tree = {
        "title": "body on a string in a wave",
        "gravity": f"{G} m/s^2",
        "water": {"density": f"{RHO} kg/m^3", "surface": f"{DEPTH} m", "seabed": "0 m"},
        "riser": [
            {
                "name": "string",
                "length": f"{length} m",
                "axial_stiffness": "1e12 N",
                "submerged_weight": "0 N/m",
            }
        ],
        "bottom": {
            "hold": "free",
            "body": {
                "name": "body",
                "mass": f"{mass} kg",
                "displaced_volume": f"{volume} m^3",
                "added_mass": {"horizontal": f"{added} kg"},
            },
        },
        "top": {"x": "held", "z": "held", "elevation": f"{DEPTH - deep + length} m"},
        "wave": {
            "height": f"{height} m",
            "period": f"{period} s",
            "ramp": "20 s",
            "above_mean_level": "none",
        },
        "analysis": {
            **{"duration": "60 s", "output": {"interval": "0.5 s"}, "mesh": {"elements": 4}, "step": "0.05 s"}
        },
    }
    run = simulate(SceneFile("string.yaml", tree))
    omega = 2.0 * np.pi / period
    k = omega**2 / G
    for _ in range(60):
        k = omega**2 / (G * np.tanh(k * DEPTH))
    size = 0.5 * height * omega * np.cosh(k * (DEPTH - deep)) / np.sinh(k * DEPTH)

    def speed(t):
        return size * np.cos(-omega * t) * (0.5 - 0.5 * np.cos(np.pi * min(t / 20.0, 1.0)))

    def rate(t, state):
        acceleration = (speed(t + 1e-4) - speed(t - 1e-4)) / 2e-4 if t > 1e-4 else 0.0
        force = (RHO * volume + added) * acceleration - weight / length * state[0]
        return [state[1], force / (mass + added)]

    time = run["time"].values
    expected = solve_ivp(rate, (0.0, 60.0), [0.0, 0.0], t_eval=time, rtol=1e-8, atol=1e-12, max_step=0.1).y[0]
    found = run["x"].isel(s=0).values
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=0.01 * abs(expected).max())
