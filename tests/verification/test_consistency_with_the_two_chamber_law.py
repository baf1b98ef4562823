"""Liu et al. 2020, Eq. 11, through the public door: pull over stroke, its lines, pistons, the end stop."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from riserstudy import load_scene, simulate
from riserstudy.errors import SimulationError
from riserstudy.simulation.modes import modes_of

SCENE = Path(__file__).parents[2] / "config/scenes/liu2020/heave.yaml"
STATICS = {"platform.heave": None, "analysis": {}}
BORE, ROD, GAMMA, G = 0.560, 0.230, 1.4, 9.81
A_P, A_R = 0.25 * np.pi * BORE**2, 0.25 * np.pi * ROD**2
PISTON = 6050.0 / 6.0
STIFFNESS = 206e9 * 0.25 * np.pi * (0.5334**2 - 0.4826**2) / 533.0  # EA/L of the riser
HANGING = 220.0 / 15.24 * G * 533.0


def printed(stroke):
    """Eq. 11 with the paper's stroke, positive where the cylinder shortens."""
    high = 2.08e6 * 9.38**GAMMA * (A_P - A_R) / (9.38 + (A_P - A_R) * stroke) ** GAMMA
    low = 0.15e6 * 2.25**GAMMA * A_P / (2.25 - A_P * stroke) ** GAMMA
    return high - low - PISTON * G


def at_rest(position, **more):
    file = load_scene(SCENE, **STATICS | {"platform.position.heave": f"{position} m"} | more)
    return simulate(file)


@pytest.mark.parametrize("position", [-7.0, -3.0, 0.0, 2.0, 7.0])
def test_the_pull_at_rest_is_the_printed_one_and_balances_the_riser(position):
    run = at_rest(position)
    reach = run["tensioner_stroke_static"].values
    np.testing.assert_allclose(run["tensioner_force_static"], printed(-reach), rtol=1e-6)
    top = float(run["effective_tension"].isel(s=-1))
    assert float(run["tensioner_force_static"].sum()) == pytest.approx(top, rel=1e-9)
    # six cylinders and the riser in series take up the platform's rise
    stretch = (top - 0.5 * HANGING) / STIFFNESS
    rest = (6.0 * printed(0.0) - 0.5 * HANGING) / STIFFNESS
    assert reach[0] == pytest.approx(position - (stretch - rest), abs=1e-5)


def test_at_mid_stroke_six_cylinders_pull_232_tonnes():
    total = float(at_rest(0.0)["tensioner_force_static"].sum())
    assert total / G / 1e3 == pytest.approx(231.83, abs=0.01)


def line(**how):
    """Stiffness and force at mid-stroke of one cylinder made linear."""
    linearised = {"top.tensioners.linearised": how}
    up, down = (at_rest(position, **linearised) for position in (1.0, -1.0))
    rise = [
        float(up[f"tensioner_{what}_static"][0] - down[f"tensioner_{what}_static"][0])
        for what in ("force", "stroke")
    ]
    slope = rise[0] / rise[1]
    force, reach = (float(up[f"tensioner_{what}_static"][0]) for what in ("force", "stroke"))
    return slope, force - slope * reach


def test_the_tangent_has_the_slope_at_mid_stroke():
    slope, tension = line(by="tangent")
    h = 1e-4
    assert slope == pytest.approx((printed(-h) - printed(h)) / (2.0 * h), rel=1e-6)
    assert tension == pytest.approx(printed(0.0), rel=1e-6)


def test_a_tangent_elsewhere_touches_the_law_there():
    # the reach is longer where the platform is higher: printed() counts the other way
    slope, tension = line(by="tangent", at="2 m")
    h = 1e-4
    assert slope == pytest.approx((printed(-2.0 - h) - printed(-2.0 + h)) / (2.0 * h), rel=1e-6)
    assert tension + 2.0 * slope == pytest.approx(printed(-2.0), rel=1e-6)


def test_a_chord_meets_the_law_at_both_ends():
    slope, tension = line(by="chord", shortest="-3 m", longest="6 m")
    assert tension - 3.0 * slope == pytest.approx(printed(3.0), rel=1e-6)
    assert tension + 6.0 * slope == pytest.approx(printed(-6.0), rel=1e-6)


def test_the_least_squares_line_is_that_of_the_continuous_law():
    slope, tension = line(by="least squares", shortest="-6 m", longest="6 m")
    mean = quad(printed, -6.0, 6.0, epsrel=1e-12)[0] / 12.0
    tilt = -quad(lambda z: z * printed(z), -6.0, 6.0, epsrel=1e-12)[0] / (2.0 * 6.0**3 / 3.0)
    assert slope == pytest.approx(tilt, rel=1e-6)
    assert tension == pytest.approx(mean, rel=1e-6)


@pytest.mark.parametrize("counted, each", [("once", PISTON), ("each", 6050.0)])
def test_pistons_add_their_inertia_to_the_ring(counted, each):
    file = load_scene(SCENE, **{"top.tensioners.two_chamber_gas.pistons.counted": counted})
    found = modes_of(file.resolved(), 1)
    mass, spring = 15334.0 / 15.24, 6.0 * (printed(-1e-4) - printed(1e-4)) / 2e-4
    rigidity = STIFFNESS * 533.0

    def unbalanced(omega):  # of a bar with a mass and a spring at its end
        wave = omega * np.sqrt(mass / rigidity)
        end = (6.0 * each * omega**2 - spring) * np.sin(wave * 533.0)
        return rigidity * wave * np.cos(wave * 533.0) - end

    exact = brentq(unbalanced, 1.0, 9.0) / (2.0 * np.pi)
    assert float(found["frequency"][0]) == pytest.approx(exact, rel=1e-6)


def test_beyond_the_stroke_the_stop_touches_and_the_run_goes_on():
    run = at_rest(8.0)
    reach = float(run["tensioner_stroke_static"][0])
    pull = float(run["tensioner_force_static"][0])
    assert reach > 7.5
    assert pull == pytest.approx(printed(-reach) + 1e8 * (reach - 7.5), rel=1e-6)


def test_without_a_stop_a_closed_volume_is_no_equilibrium():
    with pytest.raises(SimulationError):
        at_rest(-12.0, **{"top.tensioners.stroke": None})
