"""Gas spring: a case, the plain version, and the law of a gas by integration."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from small_scenes import simulated
from surroundings import Case, N, cylinders, pair

from riserstudy.effects.gas_spring import GasSpring

SCENE = """\
title: bar on gas cylinders
riser: [{name: bar, length: 100 m, axial_stiffness: 1e13 N}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  z: free
  tensioners:
    count: 4
    gas: {area: 0.1 m^2, pressure: 25 bar absolute, volume: 0.5 m^3, exponent: 1.4}
    mid_stroke: riser in equilibrium
platform: {position: {heave: 2 m}}
analysis: {mesh: {elements: 5}}
"""


def gas_spring(record, s):
    left = record.volume - record.area * s.reach
    return {"pull": record.area * record.pressure * (record.volume / left) ** record.exponent}


CASES = {
    GasSpring: Case(
        lambda d: GasSpring(pair(0.17, 0.16), pair(190e5, 180e5), pair(3.2, 3.0), pair(1.4, 1.2)),
        lambda d: [cylinders(d)],
    )
}

PLAIN = {GasSpring: [("law", gas_spring)]}


def stirred_rig(*args, **changes):
    from rig import Rig  # which imports this file

    return Rig(*args, **changes)


@pytest.mark.parametrize("heave", [2.0, -2.5])
def test_the_pull_follows_the_differential_law_of_a_gas(tmp_path, heave):
    """dp / p = -k dV / V, integrated from mid-stroke by numbers."""
    found = simulated(tmp_path, SCENE, {"platform.position.heave": f"{heave} m"})
    path = solve_ivp(lambda v, p: -1.4 * p / v, (0.5, 0.5 - 0.1 * heave), [25e5], rtol=1e-11)
    # the bar stretches by 1e-5 m
    np.testing.assert_allclose(found["effective_tension"], 4 * 0.1 * path.y[0, -1], rtol=1e-4)


def test_at_an_exponent_of_one_pressure_times_volume_stays(tmp_path):
    found = simulated(tmp_path, SCENE, {"top.tensioners.gas.exponent": 1.00001})
    np.testing.assert_allclose(found["effective_tension"], 1e6 * 0.5 / (0.5 - 0.1 * 2.0), rtol=1e-4)


def test_the_gas_stores_the_work_that_its_pressure_does():
    """Minus the integral of p dV; at an exponent of 5 / 3, the internal energy is 3 / 2 p V."""
    exponent = np.full(2, 5.0 / 3.0)
    rig = stirred_rig(GasSpring, 1, exponent=exponent)
    gas, stored = rig.record, []
    for height in (59.0, 61.0):
        rig.s.r[-1, N] = height
        rig.evaluate()
        pull = rig.s.pull.copy()
        inner_energy = 1.5 * (pull / gas.area * (gas.volume - gas.area * rig.s.reach)).sum()
        stored.append((inner_energy, rig.potential()))
    inner_energy, potential = np.diff(stored, axis=0)[0]
    assert potential == pytest.approx(inner_energy, rel=1e-9)
