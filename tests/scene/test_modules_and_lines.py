"""Joints with buoyancy modules, choke and kill lines: sums by hand, and the engine against them."""

from math import pi, sqrt

import numpy as np
import pytest

from chapters.numerics.closed_forms import taut_beam_frequency, taut_beam_under_load
from riserstudy import simulate
from riserstudy.dataset.tables import stack_up
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.modes import modes_of

INCH, G, WATER, STEEL = 0.0254, 9.80665, 1025.0, 7850.0
JOINT, COUNT = 22.86, 20
LENGTH = COUNT * JOINT
TENSION = 2e6


def disc(diameter):
    return 0.25 * pi * diameter**2


def tube(outer, inner, power=2):
    """Area (2) or second moment (4) of a ring."""
    return {2: disc(outer) - disc(inner), 4: pi / 64.0 * (outer**4 - inner**4)}[power]


# A pipe of 21 in by 19.25 in; two lines of 6.5 in by 4.5 in that share tension, full of mud of 1300 kg/m3;
# one of 5 in by 4 in that slides, empty; a hose of 3 in by 2 in, 4 kg/m, without stiffness, full of water.
PIPE = STEEL * tube(21 * INCH, 19.25 * INCH)
MUD = 1300.0 * 2 * disc(4.5 * INCH)
LINES = (
    2 * STEEL * tube(6.5 * INCH, 4.5 * INCH) + MUD + STEEL * tube(5 * INCH, 4 * INCH)
) + 4.0 + WATER * disc(2 * INCH)  # fmt: skip
LINES_DISPLACE = 2 * disc(6.5 * INCH) + disc(5 * INCH) + disc(3 * INCH)
MODULES = 8000.0  # kg a joint
AXIAL = 207e9 * (tube(21 * INCH, 19.25 * INCH) + 2 * tube(6.5 * INCH, 4.5 * INCH))
BENDING = 207e9 * (tube(21 * INCH, 19.25 * INCH, 4) + 2 * tube(6.5 * INCH, 4.5 * INCH, 4)) + 200e9 * tube(
    5 * INCH, 4 * INCH, 4
)
OWN_WEIGHT = G * (PIPE - WATER * disc(21 * INCH))
LINES_WEIGHT = G * (LINES - WATER * LINES_DISPLACE)
NEUTRAL = (OWN_WEIGHT + LINES_WEIGHT) * JOINT  # lift of one joint's modules at which nothing weighs


def inches(outer, inner):
    return {"outer_diameter": f"{outer} in", "inner_diameter": f"{inner} in"}


STEEL_OF = {"wall_density": f"{STEEL} kg/m^3"}
DRESSED = {
    "name": "buoyed",
    "joints": {"count": COUNT, "length": f"{JOINT} m"},
    **inches(21, 19.25),
    **STEEL_OF,
    "young_modulus": "207 GPa",
    "submerged_weight": f"{OWN_WEIGHT!r} N/m",
    "lateral_load": "1 N/m",
    "modules": {"mass": f"{MODULES} kg", "lift": f"{NEUTRAL!r} N"},
    "lines": [
        {"name": "choke and kill", "count": 2, **inches(6.5, 4.5), **STEEL_OF, "contents": "1300 kg/m^3",
         "young_modulus": "207 GPa", "tension": "shared"},
        {"name": "booster", **inches(5, 4), **STEEL_OF, "young_modulus": "200 GPa", "tension": "sliding"},
        {"name": "hose", **inches(3, 2), "mass": "4 kg/m", "contents": f"{WATER} kg/m^3"},
    ],
}  # fmt: skip


def file_of(**values):
    tree = {
        "title": "dressed",
        "gravity": f"{G} m/s^2",
        "water": {"density": f"{WATER} kg/m^3"},
        "riser": [DRESSED],
        "bottom": {"hold": "wellhead", "elevation": "-600 m", "rotation": "free"},
        "top": {"x": "held", "z": "free", "tension": f"{TENSION} N", "rotation": "free"},
        "analysis": {"mesh": {"elements": 200}},
    }
    return SceneFile("dressed", tree).with_values(values, "test")


def test_mass_weight_and_stiffness_are_the_sums_by_hand():
    (section,) = file_of().resolved().riser
    assert section.mass == pytest.approx(PIPE + LINES + MODULES / JOINT, rel=1e-12)
    assert section.submerged_weight == pytest.approx(0.0, abs=1e-9)
    assert section.buoyancy_lift == pytest.approx(NEUTRAL / JOINT, rel=1e-12)
    np.testing.assert_allclose(section.elasticity, (AXIAL, BENDING), rtol=1e-12)


def test_neutral_joints_hang_stretch_and_bend_as_the_closed_form_has_it():
    """Without weight tension is the same throughout: a beam under it and an even load has a closed form."""
    run = simulate(file_of())
    slope = 0.5 * LENGTH / TENSION  # at the ends, of the load of 1 N/m: tension is that over its cosine
    np.testing.assert_allclose(run["effective_tension"], TENSION, rtol=slope**2)
    stretch = 1.0 + TENSION / AXIAL
    rise = float(run["z"].isel(s=-1)) + 600.0
    assert rise == pytest.approx(stretch * LENGTH, rel=slope**2)
    exact = taut_beam_under_load(LENGTH, TENSION / stretch, BENDING / stretch**2, 1.0)
    assert float(run["x"].max()) == pytest.approx(exact.displacement, rel=1e-6)
    middle = abs(run["bending_moment"]).sel(s=0.5 * LENGTH, method="nearest")
    assert float(middle) == pytest.approx(stretch * exact.moment, rel=1e-6)


def test_they_swing_by_all_of_their_mass():
    first = float(modes_of(file_of(**{"riser[0].lateral_load": None}).resolved(), 1)["frequency"][0])
    mass = PIPE + LINES + MODULES / JOINT
    stretch = 1.0 + TENSION / AXIAL
    exact = taut_beam_frequency(1, stretch * LENGTH, TENSION, BENDING / stretch**2, mass / stretch) / (
        2.0 * pi
    )
    assert first == pytest.approx(exact, rel=1e-4)  # a stretched beam's EI is told to the first order


def test_tension_is_lost_on_the_way_down_by_what_the_sums_weigh():
    lift = 0.8 * NEUTRAL
    plumb = {"riser[0].lateral_load": None}
    run = simulate(file_of(**{"riser[0].modules.lift": f"{lift!r} N"}, **plumb))
    lost = TENSION - float(run["lower_end_tension"])
    assert lost == pytest.approx(COUNT * 0.2 * NEUTRAL, rel=1e-9)


def test_the_stack_up_tells_lines_and_modules_apart():
    table = stack_up(file_of().resolved())
    row = dict(zip(table.columns, table.rows[0], strict=True))
    assert row["joints"] == COUNT
    assert row["lines, dry"] == pytest.approx(G * LINES * LENGTH / 1e3, rel=1e-12)
    assert row["modules, dry"] == pytest.approx(G * MODULES * COUNT / 1e3, rel=1e-12)
    assert row["lift of modules"] == pytest.approx(NEUTRAL * COUNT / 1e3, rel=1e-12)
    dry = G * (PIPE + LINES) * LENGTH + G * MODULES * COUNT
    assert row["dry weight"] == pytest.approx(dry / 1e3, rel=1e-12)
    assert row["uplift"] == pytest.approx(dry / 1e3, rel=1e-12)  # neutral: all of it


def test_the_pipe_takes_its_share_of_tension_and_moment():
    """Stress of a wall without pressure: T/A and M r/I of what the pipe takes by its stiffness."""
    deep = {"water.surface": "-120 m", "water.density": "1e-9 kg/m^3"}
    empty = {"riser[0].contents": {"density": "1e-9 kg/m^3"}}
    run = simulate(file_of(**deep, **empty))
    mid = run.sel(s=0.5 * LENGTH, method="nearest")
    tension, moment = float(mid["effective_tension"]), abs(float(mid["bending_moment"]))
    own = 207e9 * tube(21 * INCH, 19.25 * INCH), 207e9 * tube(21 * INCH, 19.25 * INCH, 4)
    axial = tension * own[0] / AXIAL / tube(21 * INCH, 19.25 * INCH)
    bending = moment * own[1] / BENDING * 10.5 * INCH / tube(21 * INCH, 19.25 * INCH, 4)
    assert float(mid["von_mises_stress"]) == pytest.approx(axial + bending, rel=1e-9)


def test_above_the_water_modules_weigh_and_nothing_lifts():
    two, rest = ({"count": k, "length": f"{JOINT} m"} for k in (2, COUNT - 2))
    riser = [DRESSED | {"joints": rest}, DRESSED | {"name": "aloft", "joints": two}]
    surface = f"{-600.0 + (COUNT - 2) * JOINT!r} m"
    below, section = file_of(**{"riser": riser, "water.surface": surface}).resolved().riser
    assert below.submerged_weight == pytest.approx(0.0, abs=1e-9)
    expected = OWN_WEIGHT + G * (LINES + MODULES / JOINT)
    assert section.submerged_weight == pytest.approx(expected, rel=1e-12)
    assert section.buoyancy_lift == 0.0


def test_a_riser_s_other_sections_have_no_modules():
    bare = {name: DRESSED[name] for name in DRESSED if name not in ("modules", "lines", "name")}
    riser = [{"name": "slick", **bare}, DRESSED]
    slick, buoyed = file_of(riser=riser).resolved().riser
    assert slick.buoyancy_lift == 0.0
    assert buoyed.buoyancy_lift > 0.0
    assert slick.mass == pytest.approx(PIPE)


@pytest.mark.parametrize(
    "values, why",
    [
        ({"riser[0].buoyancy_lift": "1 kN/m"}, "modules and buoyancy_lift both give lift"),
        ({"riser[0].wall_density": None}, "require the mass of the pipe"),
        ({"riser[0].lines[0].tension": None}, "only one of young_modulus and tension"),
        ({"riser[0].lines[0].wall_density": None}, "mass or wall_density is required"),
        ({"riser[0].lines[1].name": "hose"}, "the same name"),
        ({"riser[0].lines[1].inner_diameter": "5 in"}, "is not smaller"),
        ({"gravity": None}, "require gravity"),
        (
            {"riser[0].submerged_weight": None},
            "the weight of section .* is missing|modules or lines require it",
        ),
        (
            {"buoyancy": {"factor": 0.5, "tension_ratio": 1.2, "reading": "R1"}, "top.tension": None},
            "does not work with modules or lines",
        ),
    ],
)
def test_what_does_not_fit_is_refused(values, why):
    with pytest.raises(InputError, match=why):
        file_of(**values).resolved()


def test_weights_that_follow_do_so_for_dressed_joints():
    """A pipe whose weight follows from mass, diameters and contents, dressed: the same sums."""
    follows = {"riser[0].submerged_weight": None, "riser[0].contents": {"density": "1100 kg/m^3"}}
    (section,) = file_of(**follows).resolved().riser
    assert section.submerged_weight == pytest.approx(0.0, abs=1e-6)
    assert sqrt(section.contents_mass) > 0.0
