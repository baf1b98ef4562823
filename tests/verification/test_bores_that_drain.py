"""A column that drains through bores of different diameter: conservation laws, Torricelli, one bore."""

import math

import numpy as np
import pytest
from random_rigs import written
from scipy.integrate import cumulative_trapezoid
from some_seeds import seeds

from riserstudy.model.mud_column import Column, flow
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

GRAVITY, SEA = 9.81, 1025.0


def column(seed, friction=0.0, losses=0.0, *, heavy=False):
    """A seeded riser of two to six parts in a sea whose level is near that of the contents.

    Contents that are lighter than the sea rise; in a scene they would leave the riser at its top.
    """
    rng = np.random.default_rng(seed)
    parts = int(rng.integers(2, 7))
    bore = tuple(rng.uniform(0.25, 0.5, parts).tolist())
    ends = np.cumsum(rng.uniform(40.0, 300.0, parts))
    lightest = 1100.0 if heavy else 900.0
    density = float(rng.choice([rng.uniform(lightest, 1200.0), rng.uniform(1200.0, 2000.0)]))
    length, depth = float(ends[-1]), float(ends[-1]) * rng.uniform(0.93, 1.0)
    return Column(length, depth, bore, density, SEA, GRAVITY, friction, losses, tuple(ends[:-1].tolist()))


def integral(column, found, weight):
    """Integral over the height of density times a weight (linear in the height) at each time of a flow."""
    area, out = np.array(column.area), []
    for top, water in zip(found.top, found.water, strict=True):
        cuts = np.unique([0.0, top, min(water, top), *(z for z in column.ends if z < top)])
        middle, half = 0.5 * (cuts[1:] + cuts[:-1]), 0.5 * np.diff(cuts)
        density = np.where(middle < water, SEA, column.contents)
        bore = area[np.searchsorted(column.ends, middle)]
        out.append(float((2.0 * half * density * weight(bore, middle)).sum()))
    return np.array(out)


@pytest.mark.parametrize("seed", seeds(12, few=4))
def test_energy_changes_by_what_passes_the_lower_end(seed):
    """Kinetic and potential energy, the work against the sea, and the energy of what flows in or out."""
    one = column(seed)
    found = flow(one, 20.0)
    kinetic = 0.5 * found.rate**2 * integral(one, found, lambda area, z: 1.0 / area)
    potential = GRAVITY * integral(one, found, lambda area, z: area * z)
    density = np.where((found.rate > 0.0) & (found.water <= 0.0), one.contents, SEA)
    head = SEA * GRAVITY * one.depth + 0.5 * density * (found.rate / one.area[0]) ** 2
    lost = cumulative_trapezoid(head * found.rate, found.time, initial=0.0)
    total = kinetic + potential + lost
    rounding = 1e-8 * potential[0]  # of a column that is almost in balance
    assert np.ptp(total) < 1e-3 * np.ptp(kinetic) + rounding


@pytest.mark.parametrize("diameters", [(0.1, 2.0), (0.1, 0.15), (0.3, 2.0, 0.15, 1.0)])
def test_a_reservoir_empties_with_the_speed_of_torricelli(diameters):
    """V = sqrt(2 g H / (1 - (A_exit/A_top)^2)) above a lower end in air, once the flow is steady."""
    parts = len(diameters)
    ends = tuple(0.5 * (k + 1) for k in range(parts - 1))
    one = Column(40.0, 0.0, diameters, 1000.0, SEA, GRAVITY, 0.0, 0.0, ends)
    narrow = diameters[0] / diameters[-1]
    found = flow(one, 30.0 * (1.0 if narrow < 0.2 else 0.08))
    k = len(found.time) - 1
    exit_speed = found.rate[k] / one.area[0]
    height = found.top[k]
    steady = math.sqrt(2.0 * GRAVITY * height / (1.0 - narrow**4))
    assert abs(found.acceleration[k] / found.rate[k]) < 0.2
    assert exit_speed == pytest.approx(steady, rel=0.01 if narrow < 0.2 else 0.2)


@pytest.mark.parametrize("seed", seeds(12, few=4))
def test_one_bore_written_in_parts_drains_as_one(seed):
    many = column(seed, friction=0.02, losses=1.5)
    same = many._replace(bore=(many.bore[0],) * len(many.bore))
    single = same._replace(bore=same.bore[:1], ends=())
    whole, parts = flow(single, 25.0), flow(same, 25.0)
    for name in whole._fields:
        scale = abs(getattr(whole, name)).max() or 1.0
        np.testing.assert_allclose(getattr(parts, name), getattr(whole, name), atol=1e-6 * scale)


def hanging(one, friction, losses):
    """A scene of that column in a riser that is held at its top, released after 2 s."""
    lengths = np.diff([0.0, *one.ends, one.length])
    riser = [
        {
            "name": f"part {k}", "length": float(length), "outer_diameter": 0.56, "inner_diameter": bore,
            "young_modulus": "206 GPa", "mass": 600.0, "submerged_weight": 2000.0,
            "contents": {"density": one.contents},
            "structural_damping": {"ratio": 0.3, "at_period": "0.5 s"},
        }
        for k, (length, bore) in enumerate(zip(lengths, one.bore, strict=True))
    ]  # fmt: skip
    return {
        "title": "a riser that hangs from its top while its contents drain through several bores",
        "gravity": GRAVITY,
        "water": {"density": SEA, "surface": 20.0 + one.depth, "seabed": 0.0},
        "riser": riser,
        "bottom": {"hold": "wellhead", "elevation": 20.0,
                   "body": {"name": "LMRP", "mass": "60 t", "submerged_weight": "500 kN"}},
        "top": {"x": "held", "z": "held", "held_at_tension": "8 MN"},
        "disconnect": {"at": "2 s", "over": "0.5 s", "drain": {"friction": friction, "losses": losses}},
        "analysis": {"duration": 22.0, "output": {"interval": 0.5}, "mesh": {"elements": 60}, "step": 0.05},
    }  # fmt: skip


@pytest.mark.parametrize("seed", seeds(6, few=2))
def test_the_top_holds_what_the_fluid_does_not_keep_as_momentum(seed):
    """Tension at the top = weights - the rate of the fluid's downward momentum - what leaves with it."""
    one = column(seed, friction=0.02, losses=1.5, heavy=True)
    found = run(SceneFile("hang", written(hanging(one, 0.02, 1.5))).resolved(), estimated=False)
    alone = flow(one, 20.0)
    downward = alone.rate * integral(one, alone, lambda area, z: 1.0)
    density = np.where((alone.rate > 0.0) & (alone.water <= 0.0), one.contents, SEA)
    leaves = density * alone.rate**2 / one.area[0]
    mass = integral(one, alone, lambda area, z: area)
    held = 500e3 + 2000.0 * one.length + GRAVITY * mass - np.gradient(downward, alone.time) - leaves
    t = found.arrays["time"]
    late = (t > 9.0) & (t < 21.5)
    expected = np.interp(t[late] - 2.0, alone.time, held)
    np.testing.assert_allclose(found.arrays["effective_tension"][late, -1], expected, rtol=1e-3)
    assert found.facts["audit"]["unexplained_share"] < 1e-3
