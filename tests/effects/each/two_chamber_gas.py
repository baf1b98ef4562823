"""Two-chamber gas: a case, the plain version, Boyle's law, and a piston that oscillates on its gas.

tests/verification/test_consistency_with_the_two_chamber_law.py compares scenes with the printed law.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion, on_two_cylinders
from surroundings import Case, cylinders, pair

from riserstudy import load_scene, simulate
from riserstudy.effects.two_chamber_gas import TwoChamberGas


def two_chamber_gas(record, s):
    high = 1.0 - record.high_area * s.reach / record.high_volume
    low = 1.0 + record.low_area * s.reach / record.low_volume
    up = record.high_area * record.high_pressure * high**-record.exponent
    down = record.low_area * record.low_pressure * low**-record.exponent
    return {"pull": up - down - record.weight}


CASES = {
    TwoChamberGas: Case(
        lambda d: TwoChamberGas(
            *(pair(0.20, 0.21), pair(20e5, 21e5), pair(9.4, 9.0)),
            *(pair(0.25, 0.24), pair(1.5e5, 1.4e5), pair(2.2, 2.3)),
            *(pair(1.4, 1.2), pair(9.9e3, 5.9e4)),
        ),
        lambda d: [cylinders(d)],
    )
}

PLAIN = {TwoChamberGas: [("law", two_chamber_gas)]}


SCENE = """\
title: string on gas that keeps its temperature
gravity: 10 m/s^2
water: {density: 1025 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 1 TN, mass: 500 kg/m, submerged_weight: 7 kN/m}]
bottom: {hold: free}
top:
  z: free
  tensioners:
    count: 2
    mid_stroke: riser unstretched
    two_chamber_gas:
      high: {area: 0.2 m^2, pressure: 10 bar absolute, volume: 2 m^3}
      low: {area: 0.3 m^2, pressure: 2 bar absolute, volume: 1.5 m^3}
      exponent: 1.0000001
      pistons: {mass: 2000 kg, counted: each}
analysis: {mesh: {elements: 10}}
"""


def test_half_the_volume_has_twice_the_pressure_at_one_temperature(tmp_path):
    """5 m make half of the high chamber and twice the low one: 20 bar on 0.2 m2, less 1 bar on 0.3 m2."""
    file = tmp_path / "scene.yaml"
    file.write_text(SCENE)
    hanging = 2 * (20e5 * 0.2 - 1e5 * 0.3 - 2e4)
    found = simulate(load_scene(file, **{"riser[0].submerged_weight": f"{hanging / 100.0} N/m"}))
    # the exponent exceeds one by 1e-7
    np.testing.assert_allclose(found["tensioner_force_static"], hanging / 2, rtol=1e-6)
    np.testing.assert_allclose(found["tensioner_stroke_static"], 5.0, rtol=1e-6)


#: areas, pressures and volumes of high and low chamber
CHAMBERS = (pair(0.2, 0.2), pair(10e5, 10e5), pair(2.0, 2.0), pair(0.3, 0.3), pair(2e5, 2e5), pair(1.5, 1.5))
UPRIGHT = on_two_cylinders()


def test_gas_at_one_temperature_has_the_work_of_its_pressure():
    """P V log(V / V0) for half of one volume and twice the other, and the work against the weight."""
    model = bodies(TwoChamberGas(*CHAMBERS, pair(1.0, 1.0) + 1e-7, pair(2e4, 2e4)), UPRIGHT, cylinders=2)
    still = energy(model)
    model.s.r[-1, UPPER] = 1.0 - 5.0
    work = 2.0 * (10e5 * 2.0 * np.log(2.0) - 2e5 * 1.5 * np.log(2.0) - 2e4 * 5.0)
    assert energy(model) - still == pytest.approx(work, rel=1e-6)


def test_a_piston_oscillates_on_its_gas_as_in_ruchardts_experiment():
    """w^2 = k A^2 P / (V m), summed over chambers and cylinders, for a small displacement."""
    mass, exponent, small = 5e4, 1.4, 1e-3
    law = TwoChamberGas(*CHAMBERS, pair(exponent, exponent), pair(2e4, 2e4))
    carried = 2.0 * (10e5 * 0.2 - 2e5 * 0.3 - 2e4)
    model = bodies(law, UPRIGHT, mass=mass, weight=carried, cylinders=2)
    w = np.sqrt(2.0 * exponent * (0.2**2 * 10e5 / 2.0 + 0.3**2 * 2e5 / 1.5) / mass)
    model.s.r[-1, UPPER] += small
    found = motion(model, 5.0 * np.pi / w, 1000)  # two periods and a half
    # the volumes change by 2e-4, and so does the stiffness; the mean of both sides by its square
    expected = small * np.cos(w * found.time)
    np.testing.assert_allclose(found.place[:, -1, UPPER] - 1.0, expected, atol=1e-3 * small)
