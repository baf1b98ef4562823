"""Stress of the wall, shear, and what a static run tells of joints and ends, against closed forms."""

import json
import math

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from riserstudy import simulate
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.wall_stress import Wall, four_stresses, lame

INCH = 0.0254
PIPE = Wall(10.5 * INCH, 9.625 * INCH)


def test_von_mises_stress_of_a_joint_at_depth():
    """Worked by hand from Lamé's equations: 21 x 0.875 in at 1500 m, mud of 1440 kg/m3, 1520 m of it."""
    g = 9.80665
    inside, outside = 1440.0 * g * 1520.0, 1025.0 * g * 1500.0
    found = four_stresses(PIPE, np.array(1.5e6), np.array(1e5), np.array(inside), np.array(outside))
    np.testing.assert_allclose(found / 1e6, [87.1449, 93.6007, 61.2825, 72.4037], atol=5e-5)


def test_lame_solves_the_equations_of_elasticity():
    """A second method: radial displacement u of a thick cylinder by collocation, plane strain, nu = 0.3."""
    inside, outside, young, nu = 3e7, 1e7, 2e11, 0.3
    a, b = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), young * nu / ((1 + nu) * (1 - 2 * nu))

    def radial(r, u, slope):
        return a * slope + b * u / r

    r = np.linspace(PIPE.inner, PIPE.outer, 11)
    solved = solve_bvp(
        lambda r, y: np.stack([y[1], y[0] / r**2 - y[1] / r]),
        lambda low, up: np.array(
            [(radial(r[0], *low) + inside) / young, (radial(r[-1], *up) + outside) / young]
        ),
        r,
        np.stack([1e-5 * r, np.full_like(r, 1e-5)]),
        tol=1e-10,
    )
    for radius in (PIPE.inner, 0.5 * (PIPE.inner + PIPE.outer), PIPE.outer):
        u, slope = solved.sol(radius)
        hoop, across = lame(PIPE, np.array(inside), np.array(outside), radius)
        assert hoop == pytest.approx(a * u / radius + b * slope, rel=1e-6)
        assert across == pytest.approx(radial(radius, u, slope), rel=1e-6)


def beam(**top):
    """1000 m without weight under 2 MN and 150 N/m across, EI 1.4e8, flex joint below and hinge above."""
    return {
        "title": "beam",
        "riser": [
            {
                "name": "riser",
                "length": "1000 m",
                "axial_stiffness": "1e12 N",
                "bending_stiffness": "1.4e8 N*m^2",
                "submerged_weight": "0 N/m",
                "lateral_load": "150 N/m",
            }
        ],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "free", "tension": "2 MN", "rotation": "free"} | top,
        "analysis": {"accuracy": "0.05 %"},
    }


def test_a_static_run_tells_the_angle_of_its_lower_flex_joint():
    """theta = theta_p / (1 + (K/T)(k coth kL - 1/L)): 2.67710 deg, 339.991 kN m, for small slopes."""
    tree = beam(offset="30 m")
    tree["bottom"]["rotation"] = {"stiffness": "127 kN*m/deg"}
    found = simulate(SceneFile("beam.yaml", tree))
    # sine and tangent of 2.7 degrees are a thousandth apart
    assert math.degrees(found["lfj_angle"]) == pytest.approx(2.67710, rel=2e-3)
    assert abs(found["bending_moment"][0]) == pytest.approx(339.991e3, rel=2e-3)
    assert abs(found["bending_moment"][0] / found["lfj_angle"]) == pytest.approx(
        127e3 * 180 / math.pi, rel=1e-3
    )


def test_shear_of_a_tensioned_beam():
    """V = (w/k) tanh(kL/2) at its hinges, k = sqrt(T/EI), for small slopes: squared they are 1.4e-3."""
    tree = beam() | {"analysis": {"mesh": {"elements": 4000}}}
    found = simulate(SceneFile("beam.yaml", tree))
    k = math.sqrt(2e6 / 1.4e8)
    exact = 150.0 / k * math.tanh(0.5 * k * 1000.0)
    assert np.abs(found["shear_force"].values[[0, -1]]) == pytest.approx(exact, rel=2e-3)


WALLED = {
    "title": "walled",
    "gravity": "9.80665 m/s^2",
    "water": {"density": "1025 kg/m^3", "seabed": "0 m", "surface": "1500 m"},
    "riser": [
        {
            "name": "riser",
            "length": "1520 m",
            "outer_diameter": "21 in",
            "inner_diameter": "19.25 in",
            "axial_stiffness": "6e9 N",
            "bending_stiffness": "2e8 N*m^2",
            "submerged_weight": "-2500 N/m",
            "contents": {"density": "1440 kg/m^3"},
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m"},
    "top": {"x": "held", "z": "free", "tension": "2 MN", "rotation": "free"},
    "analysis": {},
}


def test_stress_at_the_foot_is_that_of_the_columns_above_it():
    """Against the hand formula with the lower end's own tension; stiffness is given beside diameters."""
    tree = json.loads(json.dumps(WALLED))
    found = simulate(SceneFile("walled.yaml", tree))
    g, bore = 9.80665, math.pi * PIPE.inner**2
    tension = float(found["lower_end_tension"])
    assert tension == pytest.approx(2e6 - 1520.0 * (1440.0 * g * bore - 2500.0), rel=1e-9)
    stretched = float(found["z"][-1]) - 0.0
    inside, outside = 1440.0 * g * stretched, 1025.0 * g * 1500.0
    told = four_stresses(PIPE, np.array(tension), np.array(0.0), np.array(inside), np.array(outside))
    assert found["von_mises_stress"][0] == pytest.approx(told.max(), rel=1e-9)
    level = SceneFile("walled.yaml", tree).with_values({"riser[0].contents.level": "1600 m"}, "test")
    higher = simulate(level)["von_mises_stress"][0]
    inside += 1440.0 * g * (1600.0 - stretched)
    told = four_stresses(PIPE, np.array(tension), np.array(0.0), np.array(inside), np.array(outside))
    assert higher == pytest.approx(told.max(), rel=1e-9)


def test_stress_that_cannot_be_known_is_absent():
    tree = json.loads(json.dumps(WALLED))
    del tree["riser"][0]["contents"]
    found = simulate(SceneFile("walled.yaml", tree))
    assert "von_mises_stress" not in found
    assert "lower_end_tension" in found
