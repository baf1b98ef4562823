"""Equilibria that cannot stand are refused, sideways freedom counted; those that can are not."""

import pytest
from scenes import COLUMN, EULER, SCENES, changed, from_file

from riserstudy import simulate
from riserstudy.errors import PhysicallyUnstable, SimulationError
from riserstudy.model.mesh import even
from riserstudy.scene.load import read_scene
from riserstudy.simulation.equilibrium import settle

# mesh of 20 segments: Euler's load to 1e-4; the column is 3e-5 shorter under it
NEAR = 0.002
PINNED = {}
CANTILEVER = {"bottom__rotation": "fixed", "top__x": "free"}
CLAMPED = {"bottom__rotation": "fixed", "top__rotation": "fixed"}


def weight(share):
    return {"top__body__submerged_weight": f"{share * EULER} N"}


@pytest.mark.parametrize("ends, critical", [(PINNED, 1.0), (CANTILEVER, 0.25), (CLAMPED, 4.0)], ids=str)
@pytest.mark.parametrize("lateral", [False, True], ids=["axial", "planar"])
def test_a_column_stands_below_euler_s_load_and_buckles_above(ends, critical, lateral):
    values = dict(ends)
    if lateral:
        values["riser[0].lateral_load"] = "0 N/m"
    standing = simulate(changed(COLUMN, **values, **weight(critical * (1.0 - NEAR))))
    assert float(standing.attrs["smallest_tension"]) < 0.0
    with pytest.raises(SimulationError, match="unstable"):
        simulate(changed(COLUMN, **values, **weight(critical * (1.0 + NEAR))))


def test_a_massless_column_of_one_segment_buckles_too():
    values = {"analysis": {}, "riser[0].lateral_load": None}
    simulate(changed(COLUMN, **values, **weight(1.0 - NEAR)))
    with pytest.raises(SimulationError, match="unstable"):
        simulate(changed(COLUMN, **values, **weight(1.0 + NEAR)))


def test_an_axial_run_in_compression_says_that_it_has_no_lateral_freedom():
    standing = simulate(changed(COLUMN, **weight(0.5)))
    assert "excludes lateral motion" in standing.attrs["warnings"]


HEAVY = {
    "riser[0].submerged_weight": "1 kN/m",
    "riser[0].length": "1000 m",
    "top__body": None,
    "top__tension": "700 kN",  # of 1000 kN
}


def test_a_riser_with_too_little_top_tension_is_called_unstable():
    with pytest.raises(SimulationError, match=r"unstable.*increase the top tension"):
        simulate(changed(COLUMN, **HEAVY))
    simulate(changed(COLUMN, **(HEAVY | {"top__tension": "1200 kN"})))


def test_a_riser_with_too_little_top_tension_is_not_let_through_because_something_pushes_it():
    with pytest.raises(SimulationError):
        simulate(changed(COLUMN, **HEAVY, **{"riser[0].lateral_load": "1 N/m"}))


def test_a_string_in_compression_is_called_unstable():
    string = {
        "riser": [{"name": "s", "length": "100 m", "axial_stiffness": "1e9 N", "submerged_weight": "10 N/m"}],
        "top__body": None,
        "top__tension": "500 N",
    }
    with pytest.raises(SimulationError, match="unstable"):
        simulate(changed(COLUMN, **string))


def test_a_riser_that_nothing_holds_up_sideways_is_called_unstable():
    with pytest.raises(SimulationError, match="unstable"):
        simulate(changed(COLUMN, top__x="free", **weight(0.01)))


@pytest.mark.parametrize("elements", [8, 16, 50, 256, 600])
def test_a_slack_cable_hangs_on_any_mesh(elements):
    """A sagging string without tension may be drawn into kinks, which are no stable equilibria."""
    scene = read_scene(SCENES / "hard/snap.yaml").resolved()
    model, found = settle(scene, even(scene, elements))
    assert found.unstable == 0
    assert found.iterations <= 20
    assert float(model.s.r[-1].min()) == pytest.approx(-10.92, rel=0.03)


@pytest.mark.long
def test_a_slack_string_under_compression_is_given_up():
    with pytest.raises(PhysicallyUnstable, match=r"tension decreases to -.*buckles at any"):
        simulate(from_file("hard/snap"))
