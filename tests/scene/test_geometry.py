"""A scene whose lengths and elevations do not close, or whose riser has no weight, is refused by name."""

import math

import pytest

from riserstudy.errors import InputError
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.scene.weight import doubts

#: 1000 m of water; riser of 985 m from a stack of 20 m to the ring, joint of 20 m to a deck 25 m up
DECK = {
    "title": "deck",
    "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3", "seabed": "-1000 m", "surface": "0 m"},
    "riser": [
        {
            "name": name,
            "length": length,
            "outer_diameter": "0.5334 m",
            "inner_diameter": "0.4826 m",
            "young_modulus": "210 GPa",
            "wall_density": "7850 kg/m^3",
            "contents": {"density": "1200 kg/m^3"},
            "drag": {"coefficient": 1.0, "diameter": "0.6 m"},
        }
        for name, length in (("slick joints", "980 m"), ("upper joints", "5 m"))
    ],
    "bottom": {"hold": "wellhead", "elevation": "-980 m", "rotation": "free"},
    "top": {
        "x": "held",
        "z": "held",
        "elevation": "25 m",
        "tension": "4 MN",
        "telescopic_joint": {"length": "20 m", "bending_stiffness": "300 MN*m^2"},
    },
    "current": {"profile": [{"depth": "0 m", "speed": "1 m/s"}, {"depth": "980 m", "speed": "0.2 m/s"}]},
    "analysis": {},
}
BORE, OUTER = 0.25 * math.pi * 0.4826**2, 0.25 * math.pi * 0.5334**2


def scene(**values):
    return SceneFile("deck.yaml", DECK).with_values(values, "test").resolved()


def test_a_deck_that_closes_runs():
    assert scene().riser[0].name == "slick joints"


#: a slip of the pen, and the field that the message names
SLIPS = {
    "feet for metres of riser": ({"riser[0].length": "980 ft"}, "too short between bottom.elevation -980 m"),
    "metres for feet of riser": ({"riser[0].length": "3215 m"}, "too long between bottom.elevation"),
    "feet for metres of water": ({"water.seabed": "-1000 ft"}, "the seabed at -304.8 m"),
    "a top 250 m up": ({"top.elevation": "250 m", "riser[1].length": "230 m"}, "the surface is at 0 m"),
    "a joint of 50 m": ({"top.telescopic_joint.length": "50 m"}, "too long"),
    "a riser below its seabed": (
        {"bottom.elevation": "-1080 m", "riser[0].length": "1080 m"}, "is below the seabed",
    ),
    "a stack of 100 m": ({"bottom.elevation": "-900 m", "riser[0].length": "900 m"}, "more than 50 m above"),
    "two sections of one name": ({"riser[1].name": "slick joints"}, "2 sections are named 'slick joints'"),
    "a current that ends above the foot": (
        {"current.profile": [{"depth": "0 m", "speed": "1 m/s"}, {"depth": "300 m", "speed": "0 m/s"}]},
        "from -300 m to 0 m only, but the riser is in water from -980 m",
    ),
    "depths given as elevations": (
        {"current.profile": [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (0, 980)]},
        "the elevations are from 0 m to 980 m, and the water surface is at 0 m",
    ),
    "a section without weight": ({"riser[1].contents": None}, "weight of section 'upper joints' is missing"),
}  # fmt: skip


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_of_the_pen_is_refused_and_named(slip):
    values, said = SLIPS[slip]
    with pytest.raises(InputError, match=r"deck\.yaml") as error:
        scene(**values)
    assert said in str(error.value)


def test_a_current_says_what_holds_beyond_its_ends():
    from riserstudy.model.sea import current_table

    short = [{"depth": "10 m", "speed": "1 m/s"}, {"depth": "300 m", "speed": "0.5 m/s"}]
    z, speed = current_table(scene(**{"current.profile": short, "current.beyond": "zero"}).current, None)
    assert list(speed) == [0.0, 0.5, 1.0, 0.0]
    assert z[0] == pytest.approx(-300.0, abs=1e-3)
    _, speed = current_table(scene(**{"current.profile": short, "current.beyond": "hold"}).current, None)
    assert list(speed) == [0.5, 1.0]


def test_a_weight_follows_from_archimedes():
    wet, dry = scene().riser
    steel = 7850.0 * (OUTER - BORE)
    assert wet.submerged_weight == pytest.approx(9.81 * (steel - 1025.0 * OUTER), rel=1e-12)
    assert dry.submerged_weight == pytest.approx(9.81 * steel, rel=1e-12)


def test_contents_of_sea_water_give_the_weight_of_an_open_pipe():
    """Steel in water displaces its own volume alone, whichever way the water inside is counted."""
    wet = scene(**{"riser[0].contents.density": "1025 kg/m^3"}).riser[0]
    whole = wet.submerged_weight + 9.81 * wet.contents_mass
    assert whole == pytest.approx(9.81 * (7850.0 - 1025.0) * (OUTER - BORE), rel=1e-12)


@pytest.mark.parametrize(
    "levels, said",
    [
        ({"riser[0].contents.level": "-300 m"}, "riser\\[0\\].contents.level: -300 m differs"),
        ({"riser[0].contents.level": "-300 m", "riser[1].contents.level": "25 m"}, "'upper joints'; give "),
        ({"riser[1].contents.level": "-40 m"}, "below the upper end of the section at 5 m"),
    ],
)
def test_contents_are_one_column_with_one_level(levels, said):
    with pytest.raises(InputError, match=said):
        SceneFile("deck.yaml", DECK).with_values(levels, "test").resolved()


def test_contents_may_stand_up_to_the_deck():
    levels = {f"riser[{k}].contents.level": "25 m" for k in (0, 1)}
    assert SceneFile("deck.yaml", DECK).with_values(levels, "test").resolved()


def test_contents_counted_twice_are_doubted():
    assert doubts(scene()) == []
    open_pipe = f"{9.81 * (7850.0 - 1025.0) * (OUTER - BORE)} N/m"
    told = sentences(doubts(scene(**{"riser[0].submerged_weight": open_pipe})))
    assert len(told) == 1
    assert "riser[0].submerged_weight" in told[0]
    assert "874.7 N/m" in told[0]


def test_a_string_or_cable_may_hang_slack_and_a_riser_may_not():
    cable = {"name": "cable", "length": "850 m", "axial_stiffness": "5e8 N", "submerged_weight": "1 kN/m"}
    hung = {
        "title": "catenary",
        "riser": [cable],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "held", "offset": "700 m", "elevation": "300 m"},
        "analysis": {},
    }
    assert SceneFile("c.yaml", hung).resolved().riser[0].length == 850.0
    stiff = hung | {"riser": [cable | {"bending_stiffness": "1 MN*m^2"}]}
    with pytest.raises(InputError, match="too long"):
        SceneFile("c.yaml", stiff | {"top": hung["top"] | {"offset": "70 m"}}).resolved()
    assert SceneFile("c.yaml", stiff).resolved().riser[0].length == 850.0
