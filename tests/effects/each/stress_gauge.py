"""Stress gauge: a case, the plain version, and a tensioned beam under a load."""

from __future__ import annotations

import numpy as np
import pytest
from plain import along
from surroundings import Case, pipe

from riserstudy import simulate
from riserstudy.effects.stress_gauge import StressGauge


def stress_gauge(record, s):
    out = s.probe.copy()
    size = np.sqrt((s.moment**2).sum(axis=0))
    ends = np.maximum(size[:-1], size[1:])
    axial = abs((s.segment * along(s)[1]).sum(axis=0)) / record.area
    out[record.probe] = (axial + record.fibre * ends)[record.first : record.last].max()
    return {"probe": out}


CASES = {StressGauge: Case(lambda d: StressGauge(1, 4, 0.05, 120.0, 0), lambda d: [pipe(d)], (2, 3))}

PLAIN = {StressGauge: [("probe", stress_gauge)]}


SCENE = """\
title: pinned beam
riser:
  - name: beam
    length: 100 m
    outer_diameter: 0.5 m
    inner_diameter: 0.4 m
    young_modulus: 200 GPa
    mass: 500 kg/m
    submerged_weight: 0 N/m
    lateral_load: 100 N/m
water: {density: 1025 kg/m^3}
bottom: {hold: wellhead, elevation: 0 m, rotation: free}
top: {x: held, z: free, tension: TENSION, rotation: free}
analysis: {duration: 1 s, output: {interval: 0.5 s, stress_in: beam}, mesh: {elements: 40}, step: 0.5 s}
"""


@pytest.mark.parametrize("tension", [2e5, 1e6])
def test_a_tensioned_beam_under_a_load_has_naviers_stress_at_its_middle(scene_of, tension):
    """T / A + M D / 2 I, M = (w / k^2) (1 - sech(k L / 2)), k^2 = T / EI."""
    found = simulate(scene_of(SCENE.replace("TENSION", f"{tension} N")))
    area = 0.25 * np.pi * (0.5**2 - 0.4**2)
    second = np.pi / 64.0 * (0.5**4 - 0.4**4)
    k = np.sqrt(tension / (200e9 * second))
    moment = 100.0 / k**2 * (1.0 - 1.0 / np.cosh(0.5 * k * 100.0))
    expected = tension / area + moment * 0.25 / second
    assert moment * 0.25 / second > 0.2 * expected
    # slopes of up to 0.01: their squares, 1e-4
    np.testing.assert_allclose(found["largest_stress"], expected, rtol=1e-4)
