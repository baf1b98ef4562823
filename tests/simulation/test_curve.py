"""Between nodes a run is what its elements mean: closed forms at places that no node has."""

import json

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.simulation.curve import curve

LENGTH, STIFF, TENSION, LOAD = 100.0, 2e8, 5e5, 800.0  # m, N m2, N, N/m
SCENE = f"""\
title: a beam under tension and even load
riser:
  - {{name: beam, length: {LENGTH} m, axial_stiffness: 1e12 N, bending_stiffness: {STIFF} N*m^2}}
bottom: {{hold: wellhead, elevation: 0 m}}
top: {{x: held, z: free, tension: {TENSION} N}}
analysis: {{mesh: {{elements: 8}}}}
"""
IN_TIME = {
    "riser[0].mass": "100 kg/m",
    "analysis.mesh.elements": 16,
    "analysis.duration": "1 s",
    "analysis.step": "0.1 s",
    "analysis.output": {"interval": "0.5 s", "stations": ["31.7 m", "50 m", "68.3 m"]},
}
UNEVEN = np.cumsum([0.0, 2.0, 3.0, 3.5, 6.0, 5.0, 8.0, 7.0])


def moment(s):
    """EI w'' of a pinned beam under tension: w'''' EI - T w'' = q, small slope."""
    k = np.sqrt(TENSION / STIFF)
    return -LOAD / k**2 * (1.0 - np.cosh(k * (s - LENGTH / 2)) / np.cosh(k * LENGTH / 2))


def deflection(s):
    """From T w = M + q s (L - s) / 2, the balance of a part of the beam."""
    return (moment(s) + 0.5 * LOAD * s * (LENGTH - s)) / TENSION


def run(tmp_path, **settings):
    file = tmp_path / "beam.yaml"
    file.write_text(SCENE)
    return simulate(load_scene(file, **({"riser[0].lateral_load": f"{LOAD} N/m"} | settings)))


def test_histories_stand_at_their_stations_not_at_nodes_nearby(tmp_path):
    found = run(tmp_path, **IN_TIME).isel(time=-1)
    s = found["s"].values
    assert s.tolist() == [31.7, 50.0, 68.3]
    assert found["bending_moment"].values == pytest.approx(moment(s), rel=2e-3)
    assert found["x"].values == pytest.approx(deflection(s), rel=1e-3)
    assert found["x"].values[0] == pytest.approx(found["x"].values[2], rel=1e-9)


def test_a_curve_in_space_is_that_in_its_plane(tmp_path):
    def swept(heading):
        current = {"profile": {"shape": "uniform", "surface_speed": "1 m/s"}, "heading": heading}
        drag = {"coefficient": 1.0, "diameter": "1 m"}
        water = {"density": "1025 kg/m^3", "seabed": "0 m", "surface": f"{LENGTH} m"}
        settings = {"riser[0].drag": drag, "current": current, "water": water}
        settings["riser[0].submerged_weight"] = "0 N/m"  # of as much buoyancy as weight
        return run(tmp_path, **(IN_TIME | {"riser[0].lateral_load": None} | settings))

    plane, space = swept("0 deg"), swept("30 deg")
    assert "y" in space
    away = np.hypot(space["x"], space["y"])
    assert away.values == pytest.approx(plane["x"].values, rel=1e-6)
    assert space["bending_moment"].values == pytest.approx(abs(plane["bending_moment"].values), rel=1e-6)
    for one in (plane, space):
        assert one.attrs["largest_bending_moment_s"] == pytest.approx(LENGTH / 2, rel=1e-6)


@pytest.mark.parametrize("elements", [7, 9])
def test_the_largest_moment_is_found_between_nodes(tmp_path, elements):
    """An odd number of segments has no node where the moment is largest."""
    found = run(tmp_path, **{"analysis.mesh.elements": elements})
    largest = abs(moment(LENGTH / 2))
    nodal = float(abs(found["bending_moment"]).max())
    error = abs(found.attrs["largest_bending_moment"] / largest - 1.0)
    assert error < 0.1 * abs(nodal / largest - 1.0)
    assert error < 2e-3
    assert found.attrs["largest_bending_moment_s"] == pytest.approx(LENGTH / 2, abs=0.5)


def test_the_estimate_covers_the_largest_moment(tmp_path):
    for elements in (5, 7, 11):
        found = run(tmp_path, **{"analysis.mesh.elements": elements})
        error = abs(found.attrs["largest_bending_moment"] / abs(moment(LENGTH / 2)) - 1.0)
        assert error < 1.5 * json.loads(found.attrs["error_estimate"])["moment"]


def test_a_parabola_is_itself_whatever_the_nodes():
    of = curve(UNEVEN, np.zeros(len(UNEVEN)))
    places = np.linspace(0.0, UNEVEN[-1], 41)
    assert of.cubic(UNEVEN**2 - 3.0 * UNEVEN, places) == pytest.approx(places**2 - 3.0 * places)


def test_a_slope_may_jump_at_a_corner_and_nowhere_else():
    corner = np.zeros(len(UNEVEN))
    corner[4] = 1.0
    places = np.linspace(0.0, UNEVEN[-1], 97)
    bent = np.where(UNEVEN[4] > UNEVEN, UNEVEN**2, 50.0 - UNEVEN + UNEVEN[4] ** 2)
    bent[4] = UNEVEN[4] ** 2
    right = np.where(places < UNEVEN[4], places**2, 0.0)
    found = curve(UNEVEN, corner).cubic(bent, places)
    below = places < UNEVEN[4]
    assert found[below] == pytest.approx(right[below])
    smooth = curve(UNEVEN, np.zeros(len(UNEVEN))).cubic(bent, places)
    assert abs(smooth[below] - right[below]).max() > 1.0


def test_the_error_between_nodes_falls_with_the_third_power_at_least():
    errors = []
    for count in (10, 20, 40):
        s = np.linspace(0.0, 1.0, count + 1) ** 1.3
        places = np.linspace(0.0, 1.0, 1001)
        found = curve(s, np.zeros(count + 1)).cubic(np.sin(4.0 * s), places)
        errors.append(abs(found - np.sin(4.0 * places)).max())
    falls = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (falls > 2.7).all()


@pytest.mark.parametrize("nodes", [2, 3, 4, 8])
def test_kernels_take_the_same_curve_at_the_middles(nodes):
    s = UNEVEN[:nodes]
    of = curve(s, np.zeros(nodes))
    values = np.sin(s)
    middle = of.middle_weights
    ones = [
        sum(middle[e, k] * values[min(max(e - 1 + k, 0), nodes - 1)] for k in range(4))
        for e in range(nodes - 1)
    ]
    assert ones == pytest.approx(of.cubic(values, 0.5 * (s[1:] + s[:-1])))


def test_a_plumb_riser_is_not_refined_on_rounding(tmp_path):
    still = {"profile": {"shape": "uniform", "surface_speed": "0 m/s"}}
    settings = {
        "riser[0].lateral_load": None,
        "riser[0].submerged_weight": "1 kN/m",
        "riser[0].drag": {"coefficient": 1.0, "diameter": "1 m"},
        "water": {"density": "1025 kg/m^3", "seabed": "0 m", "surface": f"{LENGTH} m"},
        "current": still,
        "analysis.mesh": None,
    }
    found = run(tmp_path, **settings)
    assert found.attrs["elements"] <= 64
    assert "accuracy not reached" not in found.attrs["warnings"]
    assert float(abs(found["bending_moment"]).max()) < 1e-9 * STIFF
