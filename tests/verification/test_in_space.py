"""Models in space: a plane in any direction gives the planar result, and true bends in space the rod's."""

from functools import cache

import numpy as np
import pytest
from engine import off, rms, scene, slopes
from scipy.integrate import solve_bvp

from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single

STILL = {"amplitude": "0 m", "period": "15 s"}
TIGHT = {"analysis__newton_tolerance": 1e-12}
ANGLE = np.radians(30.0)


def ran(name, elements, step, **values):
    file = scene(name, analysis__mesh={"elements": elements}, analysis__step=f"{step} s", **values)
    return single(file.resolved(), even(file.resolved(), elements), step)


@pytest.mark.parametrize("name", ["s2", "s2c"])
def test_planar_motion_in_space_is_that_of_the_plane(name):
    flat = ran(name, 28, 0.1, **TIGHT).arrays
    space = ran(name, 28, 0.1, platform__sway=STILL, **TIGHT).arrays
    for quantity in ("x", "z"):
        assert np.abs(space[quantity] - flat[quantity]).max() < 1e-9 * 2.0  # surge of 2 m
    assert np.abs(space["y"]).max() == 0.0
    assert off(space["bending_moment"], np.abs(flat["bending_moment"])) < 1e-9
    assert off(space["effective_tension"], flat["effective_tension"]) < 1e-9
    np.testing.assert_allclose(space["ufj_angle"], np.abs(flat["ufj_angle"]), atol=1e-9)


@pytest.mark.parametrize("step", [0.1, 2.0], ids=["short steps", "moments turn within a step"])
def test_envelopes_in_space_are_those_of_the_plane(step):
    """Of sizes, which in space is all that there is; long steps see a moment on both sides of zero."""
    flat = ran("s2c", 40, step, **TIGHT).arrays
    space = ran("s2c", 40, step, platform__sway=STILL, **TIGHT).arrays
    assert (flat["bending_moment_min"] < 0.0).any()
    assert (flat["bending_moment_max"] > 0.0).any()
    for name in ("x_max", "x_min", "z_max", "z_min", "effective_tension_max", "effective_tension_min"):
        assert off(space[name], flat[name]) < 1e-9, name
    assert off(space["bending_moment_absmax"], flat["bending_moment_absmax"]) < 1e-9
    between = np.abs([flat["mesh_moment_max"], flat["mesh_moment_min"]]).max(axis=0)
    assert off(space["mesh_moment_max"], between) < 1e-9


def test_a_scene_turned_about_the_vertical_gives_the_turned_result():
    flat = ran("s2", 28, 0.1, **TIGHT).arrays
    surge = {"period": "15 s", "ramp": "15 s"}
    turned = ran(
        "s2",
        28,
        0.1,
        platform__surge=surge | {"amplitude": f"{float(2.0 * np.cos(ANGLE))!r} m"},
        platform__sway=surge | {"amplitude": f"{float(2.0 * np.sin(ANGLE))!r} m"},
        **TIGHT,
    ).arrays
    along = np.cos(ANGLE) * turned["x"] + np.sin(ANGLE) * turned["y"]
    assert np.abs(along - flat["x"]).max() < 1e-9 * 2.0
    assert np.abs(np.cos(ANGLE) * turned["y"] - np.sin(ANGLE) * turned["x"]).max() < 1e-9
    assert off(turned["bending_moment"], np.abs(flat["bending_moment"])) < 1e-9


def test_a_small_circle_of_the_top_is_the_sum_of_two_small_lines():
    """Without drag the riser answers small motions linearly, so surge and sway do not meet."""
    tiny = {"amplitude": "1 mm", "period": "15 s", "ramp": "15 s"}
    quarter = tiny | {"phase": "90 deg"}
    dry = {"riser[0].drag": None}
    both = ran("s2", 20, 0.1, platform__surge=tiny, platform__sway=quarter, **dry).arrays
    for name, one in (("x", {"platform__surge": tiny}), ("y", {"platform__surge": quarter})):
        alone = ran("s2", 20, 0.1, **one, **dry).arrays["x"]
        assert np.abs(both[name] - alone).max() < 1e-6 * np.abs(alone).max()


# statics of a rod bent out of every plane: force along x at the top, current along y

ROD = {
    "title": "bent in space",
    "water": {"density": "1000 kg/m^3"},
    "riser": [
        {
            "name": "rod",
            "length": "100 m",
            "axial_stiffness": "1 GN",
            "bending_stiffness": "50 MN*m^2",
            "submerged_weight": "1 kN/m",
            "drag": {"coefficient": 1.0, "diameter": "0.5 m"},
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "fixed"},
    "top": {"x": "free", "z": "free", "tension": "300 kN", "lateral_force": "40 kN", "rotation": "free"},
    "current": {
        "profile": [{"elevation": "-1 m", "speed": "1 m/s"}, {"elevation": "101 m", "speed": "1 m/s"}],
        "heading": "90 deg",
    },
    "analysis": {"mesh": {"elements": 32}},
}


@cache
def kirchhoff():
    """Position, tangent, moment and force of the torsion-free elastic rod, by collocation."""
    stiff, bend, weight, drag = 1e9, 5e7, 1e3, 0.5 * 1000.0 * 0.5

    def slope(s, y):
        t, moment, force = y[3:6], y[6:9], y[9:12]
        stretch = 1.0 + (force * t).sum(axis=0) / stiff
        water = np.array([0.0, 1.0, 0.0])[:, None]
        across = water - (water * t).sum(axis=0) * t
        load = drag * np.sqrt((across**2).sum(axis=0)) * across
        load[2] -= weight
        return np.concatenate(
            [stretch * t, np.cross(moment, t, axis=0) / bend, -np.cross(stretch * t, force, axis=0), -load]
        )

    def ends(low, top):
        applied = np.array([4e4, 0.0, 3e5])
        return np.concatenate([low[:3], low[3:6] - [0.0, 0.0, 1.0], top[6:9], top[9:12] - applied])

    s = np.linspace(0.0, 100.0, 41)
    guess = np.zeros((12, len(s)))
    guess[2], guess[5], guess[11] = s, 1.0, 3e5
    return solve_bvp(slope, ends, s, guess, tol=1e-8, max_nodes=50000)


def bent(elements):
    file = SceneFile("rod.yaml", ROD).resolved()
    found = single(file, even(file, elements), None).arrays
    exact = kirchhoff().sol(found["s_node"])
    moment = np.sqrt((exact[6:9] ** 2).sum(axis=0))
    place = [off(found[f"{name}_static"], exact[k]) for k, name in enumerate("xyz")]
    return max(place), off(found["bending_moment_static"], moment)


def test_a_rod_bent_out_of_every_plane_is_kirchhoff_s():
    rod = kirchhoff()
    assert rod.success
    assert np.abs(rod.y[:2]).max(axis=1).min() > 3.0  # m, both ways
    elements = np.array([32, 64, 128])
    found = np.array([bent(int(n)) for n in elements])
    # what is left of lower order is the clamp's, see the plane's own tests
    assert slopes(1.0 / elements, found[:, 0]).min() > 1.8
    assert slopes(1.0 / elements, found[:, 1]).min() > 1.7
    assert found[-1, 0] < 2e-4
    assert found[-1, 1] < 2e-3


def test_energy_is_accounted_for_ever_better_in_space_too():
    sway = {"amplitude": "2 m", "period": "11 s", "ramp": "10 s"}
    share = [
        ran("s2", n, h, platform__sway=sway, analysis__duration="60 s").facts["audit"]["unexplained_share"]
        for n, h in ((20, 0.1), (40, 0.05))
    ]
    assert share[0] < 1e-3
    assert share[1] < 0.5 * share[0]


# the telescopic joint and cylinders in space

RIG = {
    "title": "rolling",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3"},
    "riser": [
        {
            "name": "riser",
            "length": "533.4 m",
            "outer_diameter": "0.5334 m",
            "inner_diameter": "0.4826 m",
            "young_modulus": "206 GPa",
            "mass": "1006 kg/m",
            "submerged_weight": "141.6 N/m",
            "drag": {"coefficient": 1.0, "diameter": "1.22 m"},
            "added_mass": {"coefficient": 1.0, "diameter": "1.22 m"},
        }
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": {"stiffness": "27 kN*m/deg"}},
    "top": {
        "x": "platform",
        "z": "platform",
        "elevation": "557.4 m",
        "rotation": "free",
        "telescopic_joint": {"length": "24 m", "bending_stiffness": "2.7e8 N*m^2"},
        "tensioners": {
            "count": 6,
            "mid_stroke": "riser in equilibrium",
            "linear": {"tension": "389 kN", "stiffness": "18.7 kN/m"},
            "arrangement": {
                "ring_radius": "1 m",
                "deck_radius": "2.5 m",
                "deck_elevation": "557.4 m",
                "first_bearing": "0 deg",
            },
        },
    },
    "platform": {"centre_of_rotation": {"elevation": "552.9 m"}},
    "analysis": {"duration": "40 s", "output": {"interval": "0.1 s"}},
}
LEAN = {"amplitude": "4 deg", "period": "10 s", "ramp": "20 s"}


def rolled(elements=35, **values):
    values = {key.replace("__", "."): value for key, value in values.items()}
    file = SceneFile("rig.yaml", RIG).with_values(values, "test").resolved()
    return single(file, even(file, elements), 0.1)


def test_roll_is_pitch_seen_from_the_side():
    pitch = rolled(platform__pitch=LEAN)
    roll = rolled(platform__roll=LEAN)
    assert pitch.facts["directions"] == 2
    assert roll.facts["directions"] == 3
    a, b = pitch.arrays, roll.arrays
    # six cylinders from another bearing: the same to first order in the tilt
    assert off(-b["y"], a["x"]) < 1e-6
    assert off(b["bending_moment"], np.abs(a["bending_moment"])) < 1e-5
    assert np.abs(b["x"]).max() < 1e-9
    np.testing.assert_allclose(b["ufj_angle"], np.abs(a["ufj_angle"]), atol=1e-7)
    np.testing.assert_allclose(b["stroke"], a["stroke"], atol=1e-6)


def test_cylinders_at_one_point_of_a_riser_without_joint_are_upright_ones():
    point = RIG["top"]["tensioners"]["arrangement"] | {"ring_radius": "0 m", "deck_radius": "0 m"}
    bare = {"top__telescopic_joint": None, "top__z": "free", "top__elevation": None}
    moved = {
        "platform__surge": {"amplitude": "2 m", "period": "15 s", "ramp": "15 s"},
        "platform__heave": {"amplitude": "1 m", "period": "12 s", "ramp": "12 s"},
    }
    point = {"top__tensioners__arrangement": point | {"deck_elevation": "560 m"}}
    found = rolled(**bare, **moved, **point).arrays
    upright = rolled(**bare, **moved, top__tensioners__arrangement=None).arrays
    for name in ("x", "effective_tension", "bending_moment", "tensioner_force"):
        assert off(found[name], upright[name]) < 1e-9, name


def leaning_riser(lean):
    """Slope and moment of the riser at the ring with the platform at rest at an angle: beam-column
    with the linear tensioners and the pinned joint as its upper boundary, small slopes in the riser only.
    """
    length, stiff, joint, weight = (533.4, 206e9 * np.pi / 64.0 * (0.5334**4 - 0.4826**4), 24.0, 141.6)
    tension = 6 * 389e3
    ring_z = 533.4 + (tension - 0.5 * weight * length) * length / (
        206e9 * np.pi / 4.0 * (0.5334**2 - 0.4826**2)
    )
    bearing = np.radians(60.0 * np.arange(6))
    around = np.stack([np.cos(bearing), np.sin(bearing)])
    middle = np.sqrt(1.5**2 + (557.4 - ring_z) ** 2)
    c, s = np.cos(lean), np.sin(lean)
    deck = np.stack([2.5 * around[0] * c + 4.5 * s, 2.5 * around[1], 552.9 + 4.5 * c - 2.5 * around[0] * s])
    top = np.array([4.5 * s, 552.9 + 4.5 * c])

    def at_ring(x, slope):
        """Moment and horizontal force of the cylinders."""
        arm = np.stack([around[0] * np.cos(slope), around[1], -around[0] * np.sin(slope)])
        line = deck - arm - np.array([x, 0.0, ring_z])[:, None]
        distance = np.sqrt((line**2).sum(axis=0))
        pull = (389e3 + 18.7e3 * (distance - middle)) * line / distance
        return (arm[2] * pull[0] - arm[0] * pull[2]).sum(), pull[0].sum()

    def slope(z, y):
        held = tension - weight * (length - z)
        return np.stack([y[1], y[2], y[3], (held * y[2] + weight * y[1]) / stiff])

    def ends(low, up):
        moment, force = at_ring(up[0], up[1])
        chord = np.array([top[0] - up[0], top[1] - ring_z])
        size = np.hypot(*chord)
        rest = stiff * up[2] - moment
        shear = rest / size * chord[1] / size
        return np.array(
            [
                low[0],
                stiff * low[2] - 27e3 * 180.0 / np.pi * low[1],
                np.arctan2(*chord) - up[1] - joint * rest / (3.0 * 2.7e8),
                (tension * up[1] - stiff * up[3] - force - shear) / tension,
            ]
        )

    z = np.linspace(0.0, length, 101)
    found = solve_bvp(slope, ends, z, np.zeros((4, len(z))), tol=1e-8, max_nodes=50000)
    assert found.success
    return found.y[0, -1], stiff * found.y[2, -1], at_ring(found.y[0, -1], found.y[1, -1])[0]


def test_the_moment_at_the_ring_is_that_of_a_beam_with_joint_and_cylinders():
    still = {"analysis__duration": None, "analysis__output": None}
    found = rolled(280, platform__position={"pitch": "4 deg"}, **still).arrays
    x, moment, unequal = leaning_riser(np.radians(4.0))
    assert abs(unequal) > 0.2 * abs(moment)  # the cylinders' moment matters
    assert found["x_static"][-2] == pytest.approx(x, rel=5e-3)
    assert found["bending_moment_static"][-2] == pytest.approx(moment, rel=5e-3)


def test_one_cylinder_lost_pulls_the_ring_aside():
    whole = rolled(platform__pitch=LEAN)
    lost = rolled(platform__pitch=LEAN, top__tensioners__failed=[1])
    assert lost.facts["directions"] == 3
    assert (lost.arrays["tensioner_force"][:, 1] == 0.0).all()
    here, there = (run.arrays["effective_tension_static"][-2] for run in (lost, whole))
    assert there - here == pytest.approx(389e3, rel=0.02)
    ring = np.array([lost.arrays[f"{name}_static"][-2] for name in "xy"])
    away = np.array([np.cos(np.radians(60.0)), np.sin(np.radians(60.0))])
    assert ring @ away < -1e-3  # m, away from the lost one
    assert abs(ring @ [away[1], -away[0]]) < 1e-6


def test_the_telescopic_joint_slides_without_force():
    found = rolled(platform__heave={"amplitude": "2 m", "period": "15 s", "ramp": "15 s"}).arrays
    np.testing.assert_allclose(found["effective_tension"][:, -1], 0.0, atol=1.0)
    ring = found["z"][:, -2] - found["z_static"][-2]
    top = found["z"][:, -1] - found["z_static"][-1]
    np.testing.assert_allclose(found["stroke"], top - ring, atol=1e-9)
    assert np.abs(top).max() > 1.9
    assert rms(found["effective_tension"][:, -2], found["effective_tension"][:, -3]) < 1e-3
