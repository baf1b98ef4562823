"""Scenes moved or mirrored give results moved or mirrored; the gas law has its shape."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import gases, shares, shifts

from riserstudy.effects.gas_spring import GasSpring, energy
from riserstudy.model.mesh import even
from riserstudy.model.tensioner_law import gas_force, linear_law
from riserstudy.scene.models import Scene
from riserstudy.scene.resolve import resolve
from riserstudy.scene.tensioners import Gas, Linearised, Tensioners
from riserstudy.simulation.run import single


def scene(east=1.0, shift=(0.0, 0.0)):
    """A riser in current and surge; mirrored by ``east`` = -1, shifted by (x, z) as a whole."""
    away, up = shift
    pipe = {
        "name": "riser",
        "length": "300 m",
        "outer_diameter": "0.5334 m",
        "inner_diameter": "0.4826 m",
        "young_modulus": "206 GPa",
        "mass": "900 kg/m",
        "submerged_weight": "1 kN/m",
        "drag": {"coefficient": 1.1, "diameter": "1 m"},
        "added_mass": {"coefficient": 1.0, "diameter": "1 m"},
    }
    profile = [
        {"elevation": f"{z + up!r} m", "speed": f"{east * u!r} m/s"}
        for z, u in ((0.0, 0.2), (150.0, 0.4), (300.0, 1.2))
    ]
    surge = {"amplitude": "2 m", "period": "9 s", "phase": "0 deg" if east > 0 else "180 deg"}
    return resolve(
        Scene.model_validate(
            {
                "title": "mirror",
                "water": {"density": "1025 kg/m^3"},
                "riser": [pipe],
                "bottom": {
                    "hold": "wellhead",
                    "elevation": f"{up!r} m",
                    "rotation": {"stiffness": "30 kN*m/deg"},
                },
                "top": {"x": "platform", "z": "free", "tension": "900 kN", "rotation": "free"},
                "platform": {"surge": surge | {"ramp": "9 s"}, "position": {"surge": f"{east * 12.0!r} m"}},
                "current": {"profile": profile},
                "analysis": {
                    "duration": "12 s",
                    "output": {"interval": "0.5 s"},
                    "mesh": {"elements": 20},
                    "step": "0.1 s",
                },
            }
        )
    )


def solved(east=1.0, shift=(0.0, 0.0)):
    file = scene(east, shift)
    return single(file, even(file, 20), 0.1).arrays


def test_a_mirrored_scene_gives_the_mirrored_result():
    one, other = solved(), solved(east=-1.0)
    scale = np.abs(one["bending_moment"]).max()
    assert scale > 1e4
    np.testing.assert_allclose(other["x"], -one["x"], atol=1e-9)
    np.testing.assert_allclose(other["z"], one["z"], atol=1e-9)
    np.testing.assert_allclose(other["bending_moment"], -one["bending_moment"], atol=1e-8 * scale)
    np.testing.assert_allclose(other["lfj_angle"], -one["lfj_angle"], atol=1e-11)
    np.testing.assert_allclose(other["ufj_angle"], -one["ufj_angle"], atol=1e-11)


@settings(max_examples=6)
@given(shift=shifts)
def test_a_scene_moved_up_or_down_gives_the_result_moved(shift):
    up = shift[1]
    one, other = solved(), solved(shift=(0.0, up))
    # statics stops at corrections of 1e-10 of the length; elevations carry rounding of 2 km
    np.testing.assert_allclose(other["x"], one["x"], atol=1e-6)
    np.testing.assert_allclose(other["z"] - up, one["z"], atol=1e-6)
    scale = np.abs(one["bending_moment"]).max()
    np.testing.assert_allclose(other["bending_moment"], one["bending_moment"], atol=1e-5 * scale)


@given(gas=gases, share=shares)
def test_the_gas_law_rises_with_extension_and_is_the_slope_of_its_energy(gas, share):
    room = gas["volume"] / gas["area"]
    reach = share * room
    law = Gas.model_construct(**gas)
    h = 1e-4 * room
    places = reach + h * np.arange(-2, 3)
    force = gas_force(law, places)
    assert (np.diff(force) > 0.0).all()

    record = GasSpring(*(np.array([gas[k]]) for k in ("area", "pressure", "volume", "exponent")))

    class At:
        def __init__(self, x):
            self.reach = np.array([x])

    stored = [energy.py_func(record, At(x)) for x in places]
    slope = (stored[0] - 8.0 * stored[1] + 8.0 * stored[3] - stored[4]) / (12.0 * h)
    # exponents near one leave the energy as a small difference over (k - 1)
    assert slope == pytest.approx(force[2], rel=1e-6)
    assert gas_force(law, np.zeros(1))[0] == pytest.approx(gas["area"] * gas["pressure"])


@given(gas=gases, half=st.floats(0.05, 0.6))
def test_the_least_squares_line_leaves_the_least_squares(gas, half):
    room = gas["volume"] / gas["area"]
    law = Gas.model_construct(**gas)
    made = Linearised.model_construct(by="least squares", shortest=-half * room, longest=half * room)
    rig = Tensioners.model_construct(gas=law, two_chamber_gas=None, linearised=made, linear=None)
    tension, slope = linear_law(rig)
    x = np.linspace(-half * room, half * room, 4001)
    weight = np.full(x.size, 1.0)
    weight[[0, -1]] = 0.5
    fitted = np.polynomial.polynomial.polyfit(x, gas_force(law, x), 1, w=np.sqrt(weight))
    # trapezoidal sampling of 4001 points against the exact integrals
    assert tension == pytest.approx(fitted[0], rel=1e-5)
    assert slope == pytest.approx(fitted[1], rel=1e-4)
