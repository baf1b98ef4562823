"""Statics of a riser on a conductor in sand and in soil by a table: that of a beam on the same p-y curves."""

import math

import numpy as np
import pytest
import test_conductor_in_clay as clay
from test_conductor_in_clay import BELOW, CLAY, DIAMETER, SCENE, beam, scene

from riserstudy.errors import InputError
from riserstudy.model.mesh import even
from riserstudy.model.soil import sand_coefficients
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single

UNIT_WEIGHT, MODULUS = 9e3, 15e6
#: by hand at 30 degrees, from tangents of 15, 30 and 60 degrees
C1, C2, C3 = 1.9117, 2.6667, 28.745
SAND = {
    "friction_angle": "30 deg",
    "submerged_unit_weight": f"{UNIT_WEIGHT} N/m^3",
    "initial_modulus": f"{MODULUS} N/m^3",
}


def sand(loading):
    """p (N/m) at a depth (m) and displacement (m), by API's formula."""

    def resistance(depth, y):
        depth = np.maximum(depth, 1e-9)
        shallow = (C1 * depth + C2 * DIAMETER) * UNIT_WEIGHT * depth
        most = np.minimum(shallow, C3 * DIAMETER * UNIT_WEIGHT * depth)
        most = most * (0.9 if loading == "cyclic" else np.maximum(3.0 - 0.8 * depth / DIAMETER, 0.9))
        return most * np.tanh(MODULUS * depth * y / most)

    return resistance


def head_and_moment(of, elements=1090):
    found = single(of, even(of, elements), None).arrays
    s = found["s_node"]
    return (np.interp(BELOW, s, found["x_static"]), np.abs(found["bending_moment_static"][s <= 81.0]).max())


@pytest.mark.parametrize(
    "degrees, drawn", [(25.0, (1.2, 2.1, 16.0)), (30.0, (1.9, 2.7, 29.0)), (35.0, (3.0, 3.4, 55.0))]
)
def test_coefficients_of_sand_are_those_that_the_standard_draws(degrees, drawn):
    """Read off the curves of API RP 2A, to the width of their lines."""
    assert sand_coefficients(math.radians(degrees)) == pytest.approx(drawn, rel=0.06)


def test_coefficients_at_30_degrees_are_those_by_hand():
    assert sand_coefficients(math.pi / 6.0) == pytest.approx((C1, C2, C3), rel=1e-4)


@pytest.mark.parametrize("loading", ["static", "cyclic"])
@pytest.mark.parametrize("offset", [12.0, 60.0])
def test_a_conductor_in_sand_is_a_beam_on_its_p_y_curves(offset, loading, monkeypatch):
    of = scene(offset, **{"soil.resistance": SAND | {"loading": loading}})
    monkeypatch.setattr(clay, "resistance", sand(loading))
    assert head_and_moment(of) == pytest.approx(beam(offset), rel=0.015)


def table_of(resistance, depths, places):
    return {
        "table": [
            {"depth": f"{d} m", "displacement": f"{y!r} m", "resistance": f"{float(resistance(d, y))!r} N/m"}
            for d in depths
            for y in places
        ]
    }


def test_a_table_of_clay_is_that_clay():
    """Matlock's curve, tabulated at 20 depths and 60 displacements, and by its own springs."""
    shares = [0.0025, 0.005, *np.geomspace(0.01, 8.0, 60)]  # straight up to 0.01
    places = (2.5 * 0.02 * DIAMETER * np.array(shares)).tolist()
    depths = [0.0, *np.geomspace(1.0, 80.0, 40).tolist()]
    table = table_of(clay.resistance, depths, places)
    found = head_and_moment(scene(15.0, **{"soil.resistance": table}))
    assert found == pytest.approx(head_and_moment(scene(15.0)), rel=3e-3)


def test_a_straight_table_is_a_spring():
    table = table_of(lambda d, y: 4e6 * y, (0.0, 30.0, 80.0), (0.01, 0.4, 3.0))
    springs = scene(15.0, **{"soil.resistance": {"stiffness": "4 MPa"}})
    assert head_and_moment(scene(15.0, **{"soil.resistance": table}), 400) == pytest.approx(
        head_and_moment(springs, 400), rel=1e-9
    )


def test_a_table_beside_the_scene_is_that_written_out(tmp_path):
    curves = table_of(clay.resistance, (0.0, 20.0, 80.0), (0.01, 0.05, 0.4, 1.5))
    lines = ["resistance (kN/m),depth (m),displacement (mm)"]
    for row in curves["table"]:
        p, d, y = (float(row[n].split()[0]) for n in ("resistance", "depth", "displacement"))
        lines.append(f"{p / 1e3!r},{d!r},{y * 1e3!r}")
    (tmp_path / "soil.csv").write_text("\n".join(lines) + "\n")
    there = SceneFile(str(tmp_path / "scene.yaml"), SCENE)
    both = [
        there.with_values({"soil.resistance": one}, "test").resolved()
        for one in (curves, {"table": {"file": "soil.csv"}})
    ]
    found = [head_and_moment(one, 200) for one in both]
    assert found[0] == pytest.approx(found[1], rel=1e-9)


@pytest.mark.parametrize("soil", [CLAY, SAND | {"loading": "cyclic"}], ids=["clay", "sand"])
def test_a_conductor_of_two_sections_is_one(soil):
    """As where cement begins: both are in the soil, with the diameter of each."""
    whole = scene(15.0, **{"soil.resistance": soil})
    conductor, *above = SCENE["riser"]
    parts = [conductor | {"name": n, "length": f"{x} m"} for n, x in (("low", 45.0), ("high", 36.0))]
    cut = scene(15.0, **{"soil.resistance": soil, "riser": [*parts, *above]})
    assert head_and_moment(cut, 1090) == pytest.approx(head_and_moment(whole, 1090), rel=1e-6)


def test_a_softer_part_below_the_mudline_bends_more():
    conductor, *above = SCENE["riser"]
    soft = conductor | {"name": "high", "length": "36 m", "young_modulus": "100 GPa"}
    low = conductor | {"name": "low", "length": "45 m"}
    whole = head_and_moment(scene(15.0), 545)
    assert head_and_moment(scene(15.0, riser=[low, soft, *above]), 545)[0] > 1.05 * whole[0]


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"soil.resistance": {"table": [{"depth": "0 m", "displacement": "1 m", "resistance": "1 N/m"}]}},
         "from 0 m to the lower end of the conductor, 78 m"),
        ({"soil.resistance": {"table": [
            {"depth": "0 m", "displacement": "1 m", "resistance": "2 N/m"},
            {"depth": "0 m", "displacement": "2 m", "resistance": "1 N/m"}]}}, "does not increase"),
        ({"soil.mudline": "30 m", "water.seabed": "30 m"}, "is not on the conductor"),
        ({"riser[0].outer_diameter": None, "riser[0].inner_diameter": None, "riser[0].young_modulus": None,
          "riser[0].axial_stiffness": "1e10 N", "riser[0].bending_stiffness": "1e9 N*m^2"},
         "section 'conductor' is in the soil"),
    ],
)  # fmt: skip
def test_soil_that_cannot_be_meant_is_refused(changes, said):
    with pytest.raises(InputError, match=said):
        SceneFile("sand.yaml", SCENE).with_values(changes, "test").resolved()
