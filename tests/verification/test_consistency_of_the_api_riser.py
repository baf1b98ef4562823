"""The riser of API Bulletin 2J: lumped masses, Hermite beam and a boundary value solver agree."""

from functools import cache

import numpy as np
import pytest
from engine import scene
from scipy.integrate import solve_bvp

from riserstudy.model.layout import stiffness
from riserstudy.model.mesh import even
from riserstudy.simulation.run import single

LENGTH = 463.3
ELEMENTS, STEP = 463, 0.05  # of 1 m; the wave's load ends at a node


@cache
def moving(solver, **surge):
    changes = {f"platform__surge__{name}": value for name, value in surge.items()}
    if solver:
        changes["analysis__solver"] = solver
    mesh = {"analysis__mesh": {"elements": ELEMENTS}, "analysis__step": f"{STEP} s"}
    file = scene("api2j", **mesh, **changes).resolved()
    return single(file, even(file, ELEMENTS), STEP).arrays


@pytest.mark.parametrize(
    "surge", [{}, {"amplitude": "1.2 m", "phase": "200 deg"}], ids=["as assumed", "another surge"]
)
def test_both_solvers_agree_under_wave_current_and_surge(surge):
    lumped, beam = moving(None, **surge), moving("hermite", **surge)
    assert off(lumped["x"], beam["x"]) < 0.002
    assert off(lumped["bending_moment"], beam["bending_moment"]) < 0.01


def off(found, expected):
    return np.abs(found - expected).max() / np.abs(expected).max()


@cache
def at_rest():
    """Geometrically exact rod in the current, by collocation: s, x and moment."""
    file = scene("api2j").resolved()
    section, current = file.riser[0], file.current.profile
    pipe = stiffness(section)
    drag = 0.5 * file.water.density * section.drag.coefficient * section.drag.diameter
    heights, speeds = [p.elevation for p in current], [p.speed for p in current]

    def slope(s, y):  # the current's load ends over 0.1 m, for the collocation's sake
        x, z, angle, moment, across, up = y
        sine, cosine = np.sin(angle), np.cos(angle)
        longer = 1.0 + (across * sine + up * cosine) / pipe.axial
        normal = np.interp(z, heights, speeds) * cosine
        load = drag * np.abs(normal) * normal * 0.5 * (1.0 - np.tanh((s - section.total_length) / 0.05))
        return np.array([
            longer * sine, longer * cosine, moment / pipe.bending,
            longer * (up * sine - across * cosine),
            -load * cosine, section.submerged_weight + load * sine,
        ])  # fmt: skip

    def ends(low, high):
        top = [high[0] - file.top.offset, high[3], high[5] - file.top.tension]
        return np.array([low[0], low[1], low[3], *top])

    s = np.linspace(0.0, LENGTH, 2001)
    guess = np.zeros((6, len(s)))
    guess[0], guess[1], guess[2] = 13.7 * s / LENGTH, s, 0.03
    guess[5] = file.top.tension - section.submerged_weight * (LENGTH - s)
    found = solve_bvp(slope, ends, s, guess, tol=1e-6, max_nodes=100_000)
    assert found.success
    return found.sol


def test_statics_agree_with_a_boundary_value_solver():
    file = scene("api2j").resolved()
    rest = single(file, even(file, 400), None).arrays
    x, _, _, moment, _, _ = at_rest()(rest["s_node"])
    assert off(rest["x_static"], x) < 1e-4
    assert off(rest["bending_moment_static"], moment) < 1e-3


def test_the_beam_of_small_slopes_agrees_in_statics_to_the_square_of_its_slope():
    file = scene(
        "api2j", analysis__solver="hermite", analysis__mesh={"elements": 400}, analysis__step="1 s"
    ).resolved()
    rest = single(file, even(file, 400), None).arrays
    x, _, _, moment, _, _ = at_rest()(rest["s_node"])
    # slopes of 0.05
    assert off(rest["x_static"], x) < 5e-4
    assert off(rest["bending_moment_static"], moment) < 2.5e-3
