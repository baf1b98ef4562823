"""A body with a lever arm and rotary inertia at the lower end: pendulums, one and two, in closed form."""

import json
import math

import numpy as np
import pytest
from scipy.linalg import eigh

from riserstudy import simulate
from riserstudy.scene.load import read_scene
from riserstudy.simulation.modes import modes_of

MASS, WEIGHT, ARM, INERTIA, LENGTH = 140e3, 1.2e6, 3.0, 2e6, 30.0
ROD = 300.0  # kg/m, without weight
SCENE = f"""\
title: body on a rod
gravity: 9.81 m/s^2
water: {{density: 1025 kg/m^3}}
riser:
  - name: rod
    length: {LENGTH} m
    axial_stiffness: 1e12 N
    mass: {ROD} kg/m
    submerged_weight: 0 N/m
bottom:
  hold: free
  body:
    name: LMRP
    mass: {MASS} kg
    submerged_weight: {WEIGHT} N
    centre_below: {ARM} m
    rotary_inertia: {INERTIA} kg*m^2
top: {{x: held, z: held, elevation: 0 m, rotation: free}}
analysis: {{mesh: {{elements: 32}}}}
"""
# bends by 3e-6; a hundred times as stiff, rounding would take over
STIFF = {"riser[0].bending_stiffness": "1e11 N*m^2"}


@pytest.fixture
def scene(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text(SCENE)
    return lambda **sets: read_scene(file).with_values(sets, "test")


def compound(length, arm, mass=MASS, inertia=INERTIA):
    """Frequency (Hz) of a rigid rod with the body at its end."""
    far = length + arm
    total = inertia + mass * far**2 + ROD * length**3 / 3.0
    return math.sqrt(WEIGHT * far / total) / (2.0 * math.pi)


@pytest.mark.parametrize("arm, inertia", [(3.0, 2e6), (0.5, 2e6), (4.0, None)])
def test_a_body_on_a_rod_that_does_not_bend_is_a_compound_pendulum(scene, arm, inertia):
    """To the 1e-5 or so by which rod and body bend."""
    body = {"bottom.body.centre_below": f"{arm} m"}
    body["bottom.body.rotary_inertia"] = f"{inertia} kg*m^2" if inertia else None
    found = modes_of(scene(**(STIFF | body)).resolved(), 1)
    known = compound(LENGTH, arm, inertia=inertia or 0.0)
    assert float(found["frequency"][0]) == pytest.approx(known, rel=1e-4)


def test_it_swings_alike_in_every_direction(scene):
    across = {"platform": {"sway": {"amplitude": "0 m", "period": "10 s"}}, "top.x": "platform"}
    found = modes_of(scene(**(STIFF | across | {"top.z": "platform"})).resolved(), 2)
    np.testing.assert_allclose(found["frequency"], compound(LENGTH, ARM), rtol=1e-4)


def test_on_a_string_it_is_a_double_pendulum(scene):
    """String and body swing apart: two frequencies."""
    string = MASS * LENGTH**2 + ROD * 5.0 / 12.0 * LENGTH**3  # of one segment, by its shares
    mass = [[string, MASS * LENGTH * ARM], [MASS * LENGTH * ARM, INERTIA + MASS * ARM**2]]
    square = eigh(np.diag([WEIGHT * LENGTH, WEIGHT * ARM]), mass, eigvals_only=True)
    one = {"analysis.mesh.elements": 1, "top.rotation": None}
    found = modes_of(scene(**one, **{"riser[0].lateral_load": "1e-9 N/m"}).resolved(), 2)
    np.testing.assert_allclose(found["frequency"], np.sqrt(square) / (2 * np.pi), rtol=1e-4)


def test_added_mass_moves_with_the_centre(scene):
    body = {"bottom.body.added_mass": {"horizontal": "70 t"}}
    found = modes_of(scene(**(STIFF | body)).resolved(), 1)
    known = compound(LENGTH, ARM, mass=MASS + 70e3)
    assert float(found["frequency"][0]) == pytest.approx(known, rel=1e-4)


def test_the_end_carries_the_moment_of_the_body(scene):
    """At rest in a current: weight and drag act at the centre, not at the riser's end."""
    flow = {
        "riser[0].young_modulus": None,
        "riser[0].bending_stiffness": "2.7e8 N*m^2",
        "riser[0].submerged_weight": "2.7 kN/m",
        "riser[0].drag": {"coefficient": 1.0, "diameter": "0.5 m"},
        "bottom.body.drag_area": {"horizontal": "40 m^2"},
        "current": {
            "profile": [{"elevation": "-40 m", "speed": "2 m/s"}, {"elevation": "0 m", "speed": "2 m/s"}]
        },
        "analysis.mesh.elements": 64,
    }
    rest = simulate(scene(**flow))
    drag = 0.5 * 1025.0 * 40.0 * 2.0**2
    dx, dz = (float(rest[name][1] - rest[name][0]) for name in "xz")
    lever = ARM / math.hypot(dx, dz)
    expected = abs(WEIGHT * lever * dx + drag * lever * dz)
    s = float(rest["s"][1])
    assert s == pytest.approx(ARM + INERTIA / (MASS * ARM))
    assert float(abs(rest["bending_moment"][1])) == pytest.approx(expected, rel=1e-6)


def test_the_tension_at_the_end_of_the_riser_is_that_of_the_whole_body(scene):
    rest = simulate(scene(**STIFF))
    assert float(rest["effective_tension"][1]) == pytest.approx(WEIGHT, rel=1e-6)


@pytest.mark.parametrize("method", [None, "explicit"])
def test_a_swinging_body_keeps_its_energy(scene, method):
    """Towed by a ramp and left to swing; both ways of stepping."""
    run = {
        "riser[0].bending_stiffness": "2.7e8 N*m^2",
        "riser[0].axial_stiffness": "8e9 N",
        "riser[0].mass": "300 kg/m",
        "top": {"x": "platform", "z": "platform", "elevation": "0 m", "rotation": "free"},
        "platform": {"cruise": {"speed": "1 m/s", "ramp": "5 s"}},
        "analysis": {
            "duration": "30 s",
            "output": {"interval": "0.1 s"},
            "mesh": {"elements": 16},
            "step": "0.0002 s" if method else "0.01 s",
            "method": method,
        },
    }
    run["analysis"] = {k: v for k, v in run["analysis"].items() if v is not None}
    found = simulate(scene(**run))
    assert json.loads(found.attrs["audit"])["unexplained_share"] < 1e-4
    assert float(abs(found["x"][:, 0] - found["x"][:, -1]).max()) > 1.0


def test_advice_knows_the_sections_of_the_file(scene, tmp_path):
    from riserstudy.advice.changes import fitting

    heavier = {"riser[0].mass": "300 kg/m", "riser[0].submerged_weight": "2 kN/m"}
    labels = [change.label for change, _ in fitting(scene(**(STIFF | heavier)))]
    assert "without weight" in labels


def test_refusals(scene):
    from riserstudy.errors import InputError

    for sets, text in (
        ({"bottom.body.centre_below": None}, "rotary_inertia requires centre_below"),
        ({"bottom.hold": "wellhead", "bottom.elevation": "-30 m"}, "write 'hold: free'"),
    ):
        with pytest.raises(InputError, match=text):
            scene(**sets).resolved()
