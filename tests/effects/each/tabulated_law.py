"""Tabulated law: a case, the plain version, equilibria at points of a table, and a table that is a spring."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion, on_two_cylinders
from scipy.interpolate import PPoly
from surroundings import Case, cylinders, pair

from riserstudy import simulate
from riserstudy.effects.tabulated_law import TabulatedLaw
from riserstudy.model.tensioner_law import table_law
from riserstudy.scene.tensioners import TableRow


def tabulated(d: int) -> TabulatedLaw:
    table = [(-9.0, 6e5), (-4.0, 7e5), (-1.5, 7e5), (0.5, 7.4e5), (3.0, 9e5), (9.0, 9.3e5)]
    law = table_law([TableRow.model_construct(reach=x, force=f) for x, f in table])
    return TabulatedLaw(law.x, law.c, law.antiderivative().c, pair(1.0, 0.5))


def tabulated_law(record, s):
    return {"pull": record.working * PPoly(record.force, record.reach)(s.reach)}


CASES = {TabulatedLaw: Case(tabulated, lambda d: [cylinders(d)])}

PLAIN = {TabulatedLaw: [("law", tabulated_law)]}


SCENE = """\
title: string on tabulated tensioners
water: {density: 1025 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 1 TN, mass: 500 kg/m, submerged_weight: 8 kN/m}]
bottom: {hold: free}
top:
  z: free
  tensioners:
    count: 4
    mid_stroke: riser unstretched
    table:
      - {reach: -4 m, force: 100 kN}
      - {reach: -1 m, force: 160 kN}
      - {reach: 0.5 m, force: 200 kN}
      - {reach: 3 m, force: 266.66666666666667 kN}
      - {reach: 5 m, force: 400 kN}
analysis: {mesh: {elements: 10}}
"""


@pytest.mark.parametrize("failed, reach", [([], 0.5), ([1], 3.0), ([1, 2], 5.0)])
def test_a_string_hangs_at_the_point_of_the_table_that_carries_it(scene_of, failed, reach):
    """800 kN on four, three or two cylinders."""
    found = simulate(scene_of(SCENE, **{"top.tensioners.failed": failed}))
    working = [c for c in range(4) if c not in failed]
    np.testing.assert_allclose(found["tensioner_force_static"][working], 800e3 / len(working), rtol=1e-9)
    np.testing.assert_allclose(found["tensioner_force_static"][failed], 0.0)
    np.testing.assert_allclose(found["tensioner_stroke_static"][working], reach, rtol=1e-6)


def test_a_straight_table_makes_a_body_an_oscillator():
    """Also beyond the table, where its last lines continue."""
    mass, stiff, weight, most = 2e4, 4e4, 5e5, 0.3
    table = [(x, weight + stiff * x) for x in (-most, -0.1, 0.05, most)]
    law = table_law([TableRow.model_construct(reach=x, force=f) for x, f in table])
    record = TabulatedLaw(law.x, law.c, law.antiderivative().c, pair(1.0, 0.0))
    model = bodies(record, on_two_cylinders(), mass=mass, weight=weight, cylinders=2)
    w, speed = np.sqrt(stiff / mass), 1.0
    assert speed / w > 2.0 * most
    model.s.v[-1, UPPER] = speed
    before = energy(model)
    found = motion(model, 5.0 * np.pi / w, 1000)  # two periods and a half
    # 400 steps a period: the trapezoidal rule delays by 2e-5 of the phase, 16 rad
    expected = speed * np.sin(w * found.time) / w
    np.testing.assert_allclose(found.place[:, -1, UPPER] - 1.0, expected, atol=1e-3 * speed / w)
    assert energy(model) == pytest.approx(before, abs=1e-3 * 0.5 * mass * speed**2)


def test_a_table_has_the_energy_that_extended_it():
    """The area of the trapezium below straight lines."""
    rows = [(-2.0, 1e5), (-1.0, 2e5), (0.0, 3e5)]
    law = table_law([TableRow.model_construct(reach=x, force=f) for x, f in rows], "linear")
    record = TabulatedLaw(law.x, law.c, law.antiderivative().c, pair(1.0, 0.0))
    model = bodies(record, on_two_cylinders(), cylinders=2)
    shortest = 2.0
    still = energy(model)
    model.s.r[-1, UPPER] = 1.0 + shortest
    assert energy(model) - still == pytest.approx(-0.5 * (3e5 + 1e5) * shortest, rel=1e-12)
