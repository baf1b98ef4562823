"""Torsion: a case, the plain version, and a torsion pendulum."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from scipy.integrate import solve_ivp
from surroundings import Case, N
from vessel_alone import alone, vessel_scene

from riserstudy.effects.torsion import Torsion
from riserstudy.effects.vessel import Vessel
from riserstudy.simulation.modes import modes_of


def torsion(record, s):
    out = np.zeros_like(s.force)
    out[-1, record.yaw] = -record.stiffness * s.r[-1, record.yaw]
    return {"force": out}


CASES = {Torsion: Case(lambda d: Torsion(N + 1, 2e5), directions=(3,), loose=1)}

PLAIN = {Torsion: [("device", torsion)]}


@pytest.mark.parametrize("lag", [None, "8 s"])
def test_a_twisted_riser_is_the_spring_of_a_torsion_pendulum(tmp_path, lag):
    """I psi'' + (G I_p / L) psi = G_psi (psi_c - psi): two degrees of step response, with lag too."""
    long = {"analysis.duration": "4000 s", "analysis.step": "2 s", "analysis.output.interval": "20 s"}
    run = alone(tmp_path, **long, **{"vessel.thrusters.lag": lag, "vessel.thrusters.command": "0 m"})
    spring = 79e9 * np.pi / 32.0 * (0.5**4 - 0.45**4) / 1000.0
    gain, inertia, told = 4e5, 3e10, np.deg2rad(2.0)
    tau = float((lag or "0").split()[0])

    def rates(t, y):
        moment = y[2] if lag else gain * (told - y[0])
        following = (gain * (told - y[0]) - y[2]) / tau if lag else 0.0
        return y[1], (moment - spring * y[0]) / inertia, following

    exact = solve_ivp(rates, (0.0, 4000.0), (0.0,) * 3, t_eval=run["time"], rtol=1e-10, atol=1e-14)
    if not lag:
        still = gain * told / (gain + spring)
        closed = still * (1.0 - np.cos(np.sqrt((gain + spring) / inertia) * run["time"]))
        np.testing.assert_allclose(exact.y[0], closed, atol=1e-9)
    np.testing.assert_allclose(run["platform_yaw"], exact.y[0], atol=2e-3 * np.abs(exact.y[0]).max())


def test_its_natural_frequency_is_among_the_modes(tmp_path):
    modes = modes_of(vessel_scene(tmp_path).resolved(), 12)
    spring = 79e9 * np.pi / 32.0 * (0.5**4 - 0.45**4) / 1000.0
    yaw = modes["frequency"].values[modes["motion"].values == "yaw"]
    assert yaw == pytest.approx([np.sqrt((4e5 + spring) / 3e10) / (2.0 * np.pi)], rel=1e-6)


def test_a_vessel_that_turns_back_has_left_its_energy_in_the_riser_in_between():
    """Half a period later it turns as fast the other way; after a quarter it is at rest."""
    turning, stiffness, speed = 6e7, 1.5e5, 0.5
    none = np.zeros(2)
    hull = Vessel(UPPER, UPPER + 1, 50.0, 0.0, none + 5e7, turning, none, 0.0, none, 0.0, none, none, 0, 0)
    model = bodies(hull, Torsion(UPPER + 1, stiffness), held=[(UPPER, 2)], yaw=True, probes="abcdefg")
    model.s.v[2, UPPER + 1] = speed
    slowness = np.sqrt(turning / stiffness)
    for rate, arc in ((0.0, speed * slowness), (-speed, 0.0)):
        motion(model, 0.5 * np.pi * slowness, 500)
        assert model.s.v[2, UPPER + 1] == pytest.approx(rate, abs=1e-4 * speed)
        assert model.s.r[2, UPPER + 1] == pytest.approx(arc, abs=1e-4 * speed * slowness)
        assert energy(model) == pytest.approx(0.5 * turning * speed**2, rel=1e-6)
