"""Foreshortening: a case, the plain version, and a beam bent between held ends."""

from __future__ import annotations

import pytest
from plain import along
from scipy.integrate import simpson
from small_scenes import simulated
from surroundings import L0, Case, nodes, pipe

from riserstudy.effects.foreshortening import Foreshortening

SCENE = """\
title: bent beam between two held ends
riser:
  - {name: beam, length: 50 m, axial_stiffness: 100 MN, bending_stiffness: 300 MN*m^2, lateral_load: 100 N/m}
bottom: {hold: wellhead, elevation: 0 m, rotation: free}
top: {x: held, z: held, elevation: 50 m, rotation: free}
analysis: {mesh: {elements: 8}, newton_tolerance: 1e-12}
"""


def foreshortening(record, s):
    low, up = s.moment[:, :-1], s.moment[:, 1:]
    _, tangent = along(s)
    squares = (low**2 + low * up + up**2).sum(axis=0)
    return {"force": nodes(record.slope * squares * tangent)}


CASES = {
    Foreshortening: Case(
        lambda d: Foreshortening(8e9 * (L0 / 2.7e8) ** 2 / 72.0), lambda d: [pipe(d)], (2, 3)
    )
}

PLAIN = {Foreshortening: [("string", foreshortening)]}


def test_a_bent_beam_between_held_ends_has_the_tension_of_its_arc(tmp_path):
    """Its mean is EA / (2 L) times the integral of the squared slope, 17 / 35 L (q L^3 / (24 EI))^2."""
    found = simulated(tmp_path, SCENE)
    slope = 100.0 * 50.0**3 / (24.0 * 300e6)
    tension = 0.5 * 100e6 * 17.0 / 35.0 * slope**2
    # the tension itself lessens the deflection by 6e-5; chords of eight segments alone would lack 1.3 %
    mean = simpson(found["effective_tension"].values, found["s"].values) / 50.0
    assert mean == pytest.approx(tension, rel=5e-4)
