"""Soil: a case, the plain version, bodies that it stops, and a conductor as a beam on elastic foundation.

Conductors in clay and sand are compared with beams on their p-y curves in tests/verification.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from scipy.interpolate import PchipInterpolator
from surroundings import Case

from riserstudy import simulate
from riserstudy.effects.soil import LinearSoil, SoftClay, TabulatedSprings

PILE = """\
title: a long conductor pushed at the mudline
riser:
  - name: conductor
    length: 80 m
    outer_diameter: 36 in
    axial_stiffness: 2e10 N
    bending_stiffness: 2e9 N*m^2
bottom: {hold: foot, elevation: -80 m}
top: {x: free, z: free, lateral_force: 10 kN}
soil: {mudline: 0 m, resistance: {stiffness: 1 MPa}}
analysis: {mesh: {elements: 160}}
"""
CLAY = """{strength_at_mudline: 3 kPa, strength_gradient: 1.5 kPa/m, submerged_unit_weight: 6 kN/m^3,
  strain_at_half_strength: 0.02, depth_factor: 0.5, straight_up_to: 0.1}"""


def radial(s, node):
    """Horizontal distance of nodes and unit vectors away from where they stood."""
    aside = s.r[:-1, node]
    away = np.sqrt((aside**2).sum(axis=0))
    return away, aside / np.where(away > 0.0, away, 1.0)


def soft_clay(record, s):
    away, outwards = radial(s, record.node)
    q = away / record.y50
    line = 0.5 * np.cbrt(record.origin) * q / record.origin
    share = np.where(q <= record.origin, line, np.minimum(0.5 * np.cbrt(q), 1.0))
    out = np.zeros_like(s.force)
    out[:-1, record.node] = -record.ultimate * share * outwards
    return {"force": out}


def linear_soil(record, s):
    out = np.zeros_like(s.force)
    out[:-1, record.node] = -record.stiffness * s.r[:-1, record.node]
    return {"force": out}


def tabulated(record, s):
    """By numpy's polynomials, piece by piece."""
    away, outwards = radial(s, record.node)
    out = np.zeros_like(s.force)
    for k, (y, way) in enumerate(zip(away, outwards.T, strict=True)):
        places = record.places[k]
        piece = int(np.clip(np.searchsorted(places, y, "right") - 1, 0, len(places) - 2))
        p = np.polyval(record.force[:, k, piece], min(y, places[-1]) - places[piece])
        out[:-1, record.node[k]] = -p * way
    return {"force": out}


def springs(_):
    """Two pieces each, rising with a continuous slope, constant from the last place on."""
    places = np.array([9.0, 2.0, 1.0, 0.8, 0.9])[:, None] * np.array([0.0, 0.3, 2.5])
    most = 1e6 * np.linspace(1.0, 2.0, 5)
    curves = [PchipInterpolator(y, [0.0, 0.4 * p, p]) for y, p in zip(places, most, strict=True)]
    energies = [curve.antiderivative() for curve in curves]
    return TabulatedSprings(
        np.arange(5),
        places,
        np.stack([c.c for c in curves], axis=1),
        np.stack([e.c for e in energies], axis=1),
    )


CASES = {
    TabulatedSprings: Case(springs, directions=(2, 3)),
    SoftClay: Case(
        lambda d: SoftClay(
            np.arange(5), 1e6 * np.linspace(1.0, 2.0, 5), np.array([9.0, 2.0, 1.0, 0.8, 0.9]), 0.1
        ),
        directions=(2, 3),
    ),
    LinearSoil: Case(lambda d: LinearSoil(np.arange(4), 1e6 * np.linspace(1.0, 2.0, 4)), directions=(2, 3)),
}

PLAIN = {
    TabulatedSprings: [("device", tabulated)],
    SoftClay: [("device", soft_clay)],
    LinearSoil: [("device", linear_soil)],
}

ASIDE = np.array([0.6, 0.8])  # direction in which a body is thrown
MASS, MOST = 2e4, 5e5  # kg, N
Y50, PLASTIC = 0.02, 0.05  # m
UPPERMOST = np.array([UPPER])

#: a spring, the speed of a body that meets it (m/s), and how far the body moves (m): where the work of the
#: spring is the kinetic energy; Matlock's clay takes 6 p_u y50 until it yields at 8 y50
THROWN = {
    "linear": (LinearSoil(UPPERMOST, np.array([MOST])), 2.0, 2.0 * np.sqrt(MASS / MOST)),
    # straight up to a thousandth of y50, which changes its energy by 2e-6
    "clay": (
        SoftClay(UPPERMOST, np.array([MOST]), np.array([Y50]), 1e-3),
        4.0,
        0.5 * MASS * 4.0**2 / MOST + 2.0 * Y50,
    ),
    "table": (
        TabulatedSprings(
            UPPERMOST,
            np.array([[0.0, PLASTIC]]),
            MOST / PLASTIC * np.array([0.0, 0.0, 1.0, 0.0]).reshape(4, 1, 1),
            MOST / PLASTIC * np.array([0.0, 0.0, 0.5, 0.0, 0.0]).reshape(5, 1, 1),
        ),
        4.0,
        0.5 * MASS * 4.0**2 / MOST + 0.5 * PLASTIC,
    ),
}


@pytest.mark.parametrize("soil, speed, far", THROWN.values(), ids=THROWN)
def test_a_body_thrown_at_soil_moves_until_the_soil_has_its_energy(soil, speed, far):
    model = bodies(soil, mass=MASS)
    model.s.v[:2, UPPER] = speed * ASIDE
    place = motion(model, 0.5, 2000).place[:, :2, UPPER]
    assert (place @ ASIDE).max() == pytest.approx(far, rel=1e-3)
    # it moves along a straight line
    np.testing.assert_allclose(place @ [-0.8, 0.6], 0.0, atol=1e-9 * far)
    assert energy(model) == pytest.approx(0.5 * MASS * speed**2, rel=1e-3)


def pile(tmp_path, text):
    file = tmp_path / "pile.yaml"
    file.write_text(text)
    return simulate(file)


def test_a_conductor_in_linear_soil_is_a_beam_on_elastic_foundation(tmp_path):
    """Hetényi's beam of length L with free ends and a force P at one of them.

    At a distance u / b from this end and v / b from the other,
    y = 2 P b / (k D) (S cos u cosh v - s cosh u cos v) and M = P / (b D) (S sin u sinh v - s sinh u sin v)
    with S = sinh b L, s = sin b L and D = S^2 - s^2.
    """
    run = pile(tmp_path, PILE.replace("elements: 160", "elements: 320"))
    b, load, k, length = (1e6 / (4.0 * 2e9)) ** 0.25, 1e4, 1e6, 80.0
    v = b * run["s"]
    u = b * length - v
    large, small = np.sinh(b * length), np.sin(b * length)
    both = large**2 - small**2
    shape = large * np.cos(u) * np.cosh(v) - small * np.cosh(u) * np.cos(v)
    shape = 2.0 * load * b / (k * both) * shape
    moment = large * np.sin(u) * np.sinh(v) - small * np.sinh(u) * np.sin(v)
    moment = load / (b * both) * moment
    # springs stand at the nodes: an error of second order, 2e-4 for segments of 0.25 m
    np.testing.assert_allclose(run["x"], shape, atol=3e-4 * float(shape.max()))
    np.testing.assert_allclose(abs(run["bending_moment"]), abs(moment), atol=3e-4 * float(moment.max()))


@pytest.mark.parametrize("load", ["1 kN", "100 kN", "200 kN"])
def test_soft_clay_needs_few_newton_iterations(tmp_path, load):
    """From rest; 3 MN of tension at a lower joint of 4 degrees push with 200 kN. 1 MN takes 11."""
    text = PILE.replace("{stiffness: 1 MPa}", CLAY).replace("lateral_force: 10 kN", f"lateral_force: {load}")
    run = pile(tmp_path, text)
    assert run.attrs["statics_iterations"] <= 6
