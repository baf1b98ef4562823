"""Lift gauge: a case, the plain version, and a string that an overpull raises."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import LOWER, bodies
from surroundings import CYLINDERS, Case

from riserstudy import simulate
from riserstudy.effects.lift_gauge import LiftGauge
from riserstudy.solve.evaluate import one_call


def lift_gauge(record, s):
    out = s.probe.copy()
    aside = np.linalg.norm(s.r[:-1, 0])
    out[record.probe : record.probe + 3] = s.r[-1, 0] - record.elevation, s.v[-1, 0], aside
    return {"probe": out}


CASES = {LiftGauge: Case(lambda d: LiftGauge(-3.0, 2 * CYLINDERS))}

PLAIN = {LiftGauge: [("probe", lift_gauge)]}


SCENE = """\
title: string that is raised
water: {density: 1025 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 10 TN, mass: 1000 kg/m, submerged_weight: 8 kN/m}]
bottom: {hold: wellhead, elevation: 30 m}
top: {z: free, tension: 1 MN}
disconnect: {at: 0.5 s, over: 0.2 s}
analysis: {duration: 3 s, output: {interval: 0.1 s}, mesh: {elements: 4}, step: 0.01 s}
"""


def test_an_overpull_raises_a_string_evenly_from_the_middle_of_its_release(scene_of):
    """The connector's force fades evenly about 0.6 s: from 0.7 s on, v = F / m (t - 0.6)."""
    found = simulate(scene_of(SCENE))
    t, gain = found["time"].values, (1e6 - 8e5) / 1e5
    late = t > 0.7 + 1e-9  # the string is so stiff that it does not ring by more than 1e-9
    assert late.sum() > 20
    np.testing.assert_allclose(found["lift_rate"][late], gain * (t[late] - 0.6), rtol=1e-6)
    # the way is the integral of the speed, from the first of these times on
    begun = float(found["lift"][late][0])
    way = 0.5 * gain * ((t[late] - 0.6) ** 2 - (t[late][0] - 0.6) ** 2)
    np.testing.assert_allclose(found["lift"][late] - begun, way, atol=1e-6 * way[-1])
    still = t < 0.5 - 1e-9
    np.testing.assert_allclose(found["lift"][still], 0.0, atol=1e-9)


@pytest.mark.parametrize("turn", [0.0, 0.9, 2.5])
def test_the_gauge_sees_a_triangle_wherever_the_well_is_looked_at_from(turn):
    """3 m and 4 m aside are 5 m; the lift is what the end was raised by."""
    model = bodies(LiftGauge(-3.0, 0), mass=1.0, free=(LOWER,), probes="abc")
    c, s = np.cos(turn), np.sin(turn)
    model.s.r[:, LOWER] = 3.0 * c - 4.0 * s, 3.0 * s + 4.0 * c, -3.0 + 1.25
    model.s.v[:, LOWER] = 7.0, 8.0, 0.5
    one_call(model.programs.value.probe, model.state)
    np.testing.assert_allclose(model.s.probe, [1.25, 0.5, 5.0], rtol=1e-12)
