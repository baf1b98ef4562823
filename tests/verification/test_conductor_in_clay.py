"""Statics of a riser on a conductor in Matlock's clay, far aside: found, and that of a beam on p-y curves."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from riserstudy.errors import SimulationError
from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation import continuation
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import single
from riserstudy.solve.statics import NoEquilibrium

STRENGTH, GRADIENT, UNIT_WEIGHT, STRAIN, STRAIGHT, FACTOR = 5e3, 1.5e3, 6e3, 0.02, 0.01, 0.5
DIAMETER, BELOW, TENSION, JOINT = 0.9144, 78.0, 2e6, 127e3 * 180.0 / math.pi
#: length (m), EI (N m2), weight in water (N/m)
PARTS = (
    (81.0, 207e9 * math.pi / 64.0 * (DIAMETER**4 - 0.8382**4), 7e3),
    (15.0, 1e11, 170e3),
    (994.0, 207e9 * math.pi / 64.0 * (0.5334**4 - 0.48895**4), 1e3),
)
CLAY = {
    "strength_at_mudline": f"{STRENGTH} Pa", "strength_gradient": f"{GRADIENT} N/m^3",
    "submerged_unit_weight": f"{UNIT_WEIGHT} N/m^3", "strain_at_half_strength": STRAIN,
    "depth_factor": FACTOR, "straight_up_to": STRAIGHT,
}  # fmt: skip
SCENE = {
    "title": "riser on a conductor",
    "water": {"density": "1025 kg/m^3", "surface": "1000 m", "seabed": "0 m"},
    "riser": [
        {"name": "conductor", "length": "81 m", "outer_diameter": "36 in", "inner_diameter": "33 in",
         "young_modulus": "207 GPa", "submerged_weight": "7 kN/m"},
        {"name": "stack", "length": "15 m", "axial_stiffness": "1e11 N",
         "bending_stiffness": "1e11 N*m^2", "submerged_weight": "170 kN/m"},
        {"name": "riser", "length": "994 m", "outer_diameter": "21 in", "inner_diameter": "19.25 in",
         "young_modulus": "207 GPa", "submerged_weight": "1 kN/m",
         "flex_joint_below": {"stiffness": "127 kN*m/deg"}},
    ],
    "bottom": {"hold": "foot", "elevation": "-78 m", "rotation": "free"},
    "top": {"x": "held", "z": "free", "tension": "2 MN", "rotation": "free"},
    "soil": {"mudline": "0 m", "resistance": CLAY},
    "analysis": {},
}  # fmt: skip
CURRENT = {
    "riser[2].drag": {"coefficient": 1.0, "diameter": "1.2 m"},
    "current": {"profile": {"shape": "power", "power": 1.0, "surface_speed": "1.2 m/s"}},
}
AFLOAT = {"top": {"x": "platform", "z": "free", "tension": "2 MN", "rotation": "free"}}
SLIDING = {
    "top": {
        "x": "platform", "z": "platform", "elevation": "1032 m", "rotation": "free",
        "telescopic_joint": {"length": "20 m", "bending_stiffness": "600 MN*m^2"},
        "tensioners": {
            "count": 6, "mid_stroke": "riser unstretched",
            "linear": {"tension": "350 kN", "stiffness": "20 kN/m"},
        },
    }
}  # fmt: skip


def scene(offset, **changes):
    file = SceneFile("clay.yaml", SCENE).with_values(changes, "test")
    where = "top.offset" if file.tree["top"]["x"] == "held" else "platform.position.surge"
    if "platform" in where:
        file = file.with_values({"platform": {"position": {"surge": f"{offset} m"}}}, "test")
        return file.resolved()
    return file.with_values({where: f"{offset} m"}, "test").resolved()


def resistance(depth, y):
    """Matlock's p (N/m) at a depth (m) and displacement (m)."""
    strength = STRENGTH + GRADIENT * depth
    wedge = 3.0 * strength + UNIT_WEIGHT * depth + FACTOR * strength * depth / DIAMETER
    ultimate = np.minimum(wedge, 9.0 * strength) * DIAMETER
    q = np.abs(y) / (2.5 * STRAIN * DIAMETER)
    root = 0.5 * np.cbrt(np.minimum(np.maximum(q, STRAIGHT), 8.0))
    return np.sign(y) * ultimate * np.where(q < STRAIGHT, q / STRAIGHT, 1.0) * root


def beam(offset):
    """Displacement at the mudline (m) and largest moment of the conductor (N m): a beam-column.

    EI y'''' - (T y')' + p(y) = 0 by y, slope, moment, Q = EI y''' - T y': parts, each on [0, 1].
    """
    (conductor, stiff, heavy), stack, riser = PARTS
    parts = ((BELOW, stiff, heavy), (conductor - BELOW, stiff, heavy), stack, riser)
    above = [sum(n * w for n, _, w in parts[k + 1 :]) for k in range(4)]

    def slope(u, state):
        rates = []
        for k, (length, stiff, weight) in enumerate(parts):
            y, turn, moment, q = state[4 * k : 4 * k + 4]
            held = TENSION - above[k] - weight * length * (1.0 - u)
            soil = resistance(BELOW * (1.0 - u), y) if k == 0 else 0.0 * y
            rates += [length * turn, length * moment / stiff, length * (q + held * turn), -length * soil]
        return np.array(rates)

    def ends(low, up):
        joined = []
        for k in range(3):
            jump = np.array([0.0, up[4 * k + 2] / JOINT if k == 2 else 0.0, 0.0, 0.0])
            joined += list(low[4 * k + 4 : 4 * k + 8] - up[4 * k : 4 * k + 4] - jump)
        return np.array([low[2], low[3], *joined, up[12] - offset, up[14]])

    u = np.linspace(0.0, 1.0, 1001)
    guess = np.zeros((16, len(u)))
    guess[12], guess[13] = offset * u, offset / riser[0]
    found = solve_bvp(slope, ends, u, guess, tol=1e-4, max_nodes=50000)
    assert found.success, found.message
    return found.y[0, -1], np.abs(found.y[[2, 6]]).max()


@pytest.mark.parametrize("offset", [12.0, 20.0])
def test_the_conductor_is_that_of_a_beam_on_its_p_y_curves(offset):
    of = scene(offset)
    found = single(of, even(of, 1090), None).arrays
    head, moment = beam(offset)
    s = found["s_node"]
    # slopes of 2 % are small to 4e-4; springs stand 1 m apart
    assert np.interp(BELOW, s, found["x_static"]) == pytest.approx(head, rel=0.01)
    assert np.abs(found["bending_moment_static"][s <= 81.0]).max() == pytest.approx(moment, rel=0.01)


@pytest.mark.parametrize("elements", [40, 160])
@pytest.mark.parametrize("strength", [0.5, 20.0])
@pytest.mark.parametrize("top", [{}, AFLOAT, SLIDING], ids=["held", "afloat", "sliding"])
@pytest.mark.parametrize("flow", [{}, CURRENT], ids=["calm", "current"])
def test_an_equilibrium_is_found_however_far_aside(elements, strength, top, flow):
    clay = {"soil.resistance.strength_at_mudline": f"{strength} kPa"}
    for offset in (5.0, 12.0, 20.0, 80.0):
        of = scene(offset, **top, **flow, **clay)
        model, found = settle(of, even(of, elements))
        assert found.unstable == 0
        # displacements are right to 1e-10 of the length: of MN there are a few N left
        assert found.residual < 1e-5 * TENSION


def test_a_riser_that_stands_is_not_refused_for_a_coarse_mesh():
    """On ten segments it looks as if it buckled; the refined run and one on given segments agree."""
    aside = scene(20.0, **SLIDING)
    refined = run(aside)
    given, _ = settle(aside, even(aside, 240))
    assert refined.facts["warnings"] == []
    angle = np.arctan2(*(given.s.r[c, -1] - given.s.r[c, -2] for c in (0, 1)))
    x, z = (refined.arrays[name + "_static"] for name in "xz")
    assert np.arctan2(x[-1] - x[-2], z[-1] - z[-2]) == pytest.approx(angle, rel=0.01)


def test_an_equilibrium_by_parts_is_that_found_at_once(monkeypatch):
    of = scene(12.0, **CURRENT)
    mesh = even(of, 160)
    at_once, _ = settle(of, mesh)
    search, lost = continuation.search, []

    def fails_first(model, mesh):
        if not lost:
            lost.append(model)
            raise NoEquilibrium(3, 1.0, 1.0)
        return search(model, mesh)

    monkeypatch.setattr("riserstudy.simulation.equilibrium.search", fails_first)
    by_parts, _ = settle(of, mesh)
    assert lost
    assert np.abs(by_parts.s.r - at_once.s.r).max() < 1e-6


def test_what_is_not_found_names_the_soil_and_how_far_it_came(monkeypatch):
    of = scene(12.0)

    def never(model, mesh):
        raise NoEquilibrium(3, 1e5, 1.0)

    for module in ("continuation", "equilibrium"):
        monkeypatch.setattr(f"riserstudy.simulation.{module}.search", never)
    with pytest.raises(SimulationError, match=r"beyond 0.0% of 12 m.* m below the mudline.*soil"):
        settle(of, even(of, 160))
