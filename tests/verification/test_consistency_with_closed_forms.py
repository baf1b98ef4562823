"""S4 through the public door: frequencies, beams, the elastica, the elastic catenary."""

import numpy as np
import pytest
import reference as ref
from engine import dataset, off, scene, slopes

from riserstudy.errors import SimulationError
from riserstudy.simulation.modes import modes_of

TENSION = 2275e3
STRAIN = TENSION / ref.EA
#: the closed forms of a beam that does not stretch, for one that does: lengths along the beam are
#: unstretched, so slope and curvature are smaller by the stretch
TAUT, BENT = TENSION / (1.0 + STRAIN), ref.EI / (1.0 + STRAIN) ** 2
LENGTHS = 1.0 / np.array([32, 48, 64, 96, 128])


def frequencies(name, motion, elements):
    found = modes_of(scene(name, analysis__mesh={"elements": elements}).resolved(), 15)
    chosen = found["motion"].values == motion
    return 2.0 * np.pi * found["frequency"].values[chosen][:5]


LATERAL = ref.lateral_frequencies(5, 533.0, TAUT, BENT, 1006.0)
AXIAL = ref.axial_frequencies(5, 1800.0, 8.3505393e9, 318.0)


@pytest.mark.parametrize("name, motion, exact", [("s4a", "lateral", LATERAL), ("s4d", "axial", AXIAL)])
def test_natural_frequencies_are_found_with_fourth_order(name, motion, exact):
    elements = [20, 28, 40, 56, 80]
    errors = np.array([np.abs(frequencies(name, motion, n) / exact - 1.0) for n in elements])
    for mode in range(5):
        order = -np.polyfit(np.log(elements), np.log(errors[:, mode]), 1)[0]
        assert order == pytest.approx(4.0, abs=0.1)
    assert errors[-1].max() < 5e-6


def test_natural_frequencies_are_within_a_thousandth_of_the_beam_that_does_not_stretch():
    exact = ref.lateral_frequencies(5, 533.0, TENSION, ref.EI, 1006.0)
    # half the strain of 2.7e-4 is what the beam's stretching is worth
    np.testing.assert_allclose(frequencies("s4a", "lateral", 200), exact, rtol=2e-4)


@pytest.mark.parametrize("elements", [20, 28, 37, 56, 200])
def test_a_weightless_bar_is_not_called_unstable_for_a_rounding_error(elements):
    assert frequencies("s4d", "axial", elements)[0] == pytest.approx(AXIAL[0], rel=1e-6)


def test_a_tensioned_beam_under_uniform_load_converges_in_displacement_and_moment():
    # 1 N/m instead of 500: then finite slopes, which the closed form leaves out, are worth 1e-7
    x, moment = [], []
    for n in np.round(1.0 / LENGTHS).astype(int):
        found = dataset("s4b", int(n), **{"riser[0].lateral_load": "1 N/m"})
        w, _, bending = ref.uniform_load(found["s"].values, 533.0, TAUT, BENT, 1.0)
        x.append(off(found["x"], w))
        moment.append(off(found["bending_moment"], (1.0 + STRAIN) * bending))
    for errors in (x, moment):
        assert slopes(LENGTHS, errors).min() > 3.5  # fourth order, seen from 3.67 to 4.07
    assert x[-1] < 1e-7
    assert moment[-1] < 2e-5


def test_the_scene_under_uniform_load_is_within_its_small_slope_error():
    found = dataset("s4b")
    w, _, bending = ref.uniform_load(found["s"].values, 533.0, TENSION, ref.EI, 500.0)
    # slopes to 0.059 rad: their square, a sixth of which is 0.06 %, changes arc, tension and moment
    assert off(found["x"], w) < 1e-3
    assert off(found["bending_moment"], bending) < 4e-3


@pytest.mark.parametrize("load", [324054.15, 1000.0])
def test_a_cantilever_s_tip_and_root_moment_converge_with_second_order(load):
    along, across = ref.cantilever_tip(50.0, ref.EI, load)
    stiff = {  # as good as inextensible
        "riser": [
            {
                "name": "beam",
                "length": "50 m",
                "axial_stiffness": "1e14 N",
                "bending_stiffness": f"{ref.EI!r} N*m^2",
            }
        ],
        "top__lateral_force": f"{load} N",
    }
    tip, moment = [], []
    for n in np.round(1.0 / LENGTHS).astype(int):
        found = dataset("s4c", int(n), **stiff)
        top = found.isel(s=-1)
        tip.append(max(abs(float(top["x"]) - across), abs(float(top["z"]) - along)) / across)
        moment.append(abs(abs(float(found["bending_moment"][0])) / (load * along) - 1.0))
    assert slopes(LENGTHS, tip).min() > 1.9
    assert slopes(LENGTHS, moment).min() > 1.9
    assert tip[-1] < 2e-5
    assert moment[-1] < 1e-5


def test_the_cantilever_s_scene_agrees_with_the_elastica():
    along, across = ref.cantilever_tip(50.0, ref.EI, 324054.15)
    top = dataset("s4c").isel(s=-1)
    # the scene stretches: P / EA = 3.9e-5
    assert float(top["x"]) == pytest.approx(across, rel=1e-4)
    assert float(top["z"]) == pytest.approx(along, rel=1e-4)


def test_an_elastic_catenary_converges_with_second_order():
    shape, tension = [], []
    for n in np.round(1.0 / LENGTHS).astype(int):
        found = dataset("s4e", int(n))
        exact = ref.catenary(found["s"].values)
        miss = max(np.abs(found["x"] - exact.x).max(), np.abs(found["z"] - exact.z).max())
        shape.append(float(miss) / exact.sag)
        tension.append(off(found["effective_tension"], exact.tension))
    assert slopes(LENGTHS, shape).min() > 1.9
    assert slopes(LENGTHS, tension).min() > 1.9
    assert shape[-1] < 5e-5
    assert tension[-1] < 5e-5


@pytest.mark.parametrize("name", ["s4b", "s4c"])
def test_an_accuracy_asked_of_a_massless_beam_is_reached(name):
    found = dataset(name, analysis={"accuracy": "0.1 %"})
    best = dataset(name, 400)
    assert off(found["x"], np.interp(found["s"], best["s"], best["x"])) < 1e-3
    moment = np.interp(found["s"], best["s"], best["bending_moment"])
    assert off(found["bending_moment"], moment) < 1e-3


def test_modes_without_mass_are_refused_with_the_reason():
    with pytest.raises(SimulationError, match="modes require mass"):
        modes_of(scene("s1").resolved(), 3)
