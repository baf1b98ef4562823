"""Screening for vortex-induced vibration: closed forms of strings and cylinders, and what may not matter."""

import math

import numpy as np
import pytest
from random_rigs import rig, written
from scipy.integrate import quad

from riserstudy.cli import app
from riserstudy.design.vortex_screening import Coefficients, Flow, amplitude_of, screening
from riserstudy.errors import InputError, SimulationError
from riserstudy.scene.load import SceneFile

LENGTH, TENSION, MASS, DIAMETER = 300.0, 2e6, 400.0, 0.5
OFFSET = 100.0


def string(profile, **more):
    """A taut string without weight in a current over elevation (m, m/s)."""
    section = {
        "name": "string",
        "length": f"{LENGTH} m",
        "axial_stiffness": "1 TN",
        "mass": f"{MASS} kg/m",
        "submerged_weight": "0 N/m",
        "outer_diameter": f"{DIAMETER} m",
        "drag": {"coefficient": 1.1, "diameter": f"{DIAMETER} m"},
    }
    return {
        "title": "string",
        "water": {"density": "1025 kg/m^3", "surface": f"{LENGTH} m"},
        "riser": [section],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "free", "tension": f"{TENSION} N"},
        "analysis": {"mesh": {"elements": 200}},
        "current": {"profile": [{"elevation": f"{z} m", "speed": f"{u} m/s"} for z, u in profile]},
        **more,
    }


def screened(tree, *given, **named):
    """What screening finds of a scene."""
    return screening(SceneFile("scene.yaml", tree), Coefficients(*given, **named))


@pytest.mark.parametrize("speed", [0.2, 0.5, 1.3])
def test_modes_of_a_string_lock_in_where_its_closed_form_says(speed):
    found = screened(string([(0.0, speed), (LENGTH, speed)]))
    n = np.arange(1, 60)
    frequency = n / (2.0 * LENGTH) * math.sqrt(TENSION / MASS)
    reduced = speed / (frequency * DIAMETER)
    expected = n[(reduced >= 4.0) & (reduced <= 8.0)]
    assert found["mode"].values.tolist() == expected.tolist()
    np.testing.assert_allclose(found["natural_frequency"], frequency[expected - 1], rtol=2e-3)
    np.testing.assert_allclose(found["excited_length"], LENGTH, rtol=1e-9)
    np.testing.assert_allclose(found["shedding_frequency"], 0.2 * speed / DIAMETER, rtol=2e-3)
    np.testing.assert_allclose(
        found["slowest_current"], 4.0 * found["natural_frequency"] * DIAMETER, rtol=1e-9
    )


@pytest.mark.parametrize("lift, drag", [(1.2, 1.1), (0.6, 2.0)])
def test_a_cylinder_that_moves_as_a_whole_has_the_amplitude_of_the_closed_form(lift, drag):
    n, speed, frequency = 7, 0.8, 0.2
    one = np.ones(n)
    flow = Flow(np.arange(n), one, speed * one, DIAMETER * one, drag * one)
    found = amplitude_of(flow, one, one.astype(bool), frequency, lift)
    assert found / DIAMETER == pytest.approx(
        lift / drag / (2.0 * math.pi * frequency * DIAMETER / speed), rel=1e-9
    )


@pytest.mark.parametrize("speed, lift", [(0.5, 1.2), (1.3, 0.7)])
def test_the_limit_of_the_amplitude_is_that_of_a_cylinder_which_moves_as_a_whole(speed, lift):
    """In a sheared current: of the place where the water is fastest, among those that are excited."""
    found = screened(string([(0.0, 0.5 * speed), (LENGTH, speed)]), lift=lift)
    one = np.ones(1)
    for k, frequency in enumerate(found["natural_frequency"].values):
        fastest = min(speed, Coefficients().fastest * frequency * DIAMETER)
        flow = Flow(one, one, fastest * one, DIAMETER * one, 1.1 * one)
        whole = amplitude_of(flow, one, one.astype(bool), frequency, lift)
        assert float(found["amplitude_limit"][k]) == pytest.approx(whole / DIAMETER, rel=5e-4)


@pytest.mark.parametrize("share", [0.2, 0.7])
def test_power_taken_and_lost_are_equal_where_part_of_a_riser_stands_in_still_water(share):
    n, frequency = 200, 0.15
    z = (np.arange(n) + 0.5) / n
    excited = z < share
    speed = np.where(excited, 0.6, 0.0)
    flow = Flow(z, np.full(n, 1.0 / n), speed, np.full(n, DIAMETER), np.ones(n))
    amplitude = amplitude_of(flow, np.sin(math.pi * z), excited, frequency, 1.2)

    def still(at):  # the mean of |v| v^2 of a sine
        return (2.0 * math.pi * frequency * amplitude * math.sin(math.pi * at)) ** 3 * 4 / 3 / math.pi

    def flowing(at):
        v = 2.0 * math.pi * frequency * amplitude * math.sin(math.pi * at)

        def power(phase):
            across = v * math.cos(phase)
            lift = 1.2 * 0.6 * math.cos(phase) - across
            return math.hypot(0.6, across) * lift * across / (2.0 * math.pi)

        return quad(power, 0.0, 2.0 * math.pi)[0]

    taken = quad(flowing, 0.0, share)[0]
    assert quad(still, share, 1.0)[0] == pytest.approx(taken, rel=2e-3)


def test_a_riser_without_excitation_does_not_swing_and_one_without_drag_has_no_end():
    one = np.ones(3)
    flow = Flow(one, one, one, one, 0.0 * one)
    assert amplitude_of(flow, one, np.zeros(3, bool), 0.1, 1.2) == 0.0
    assert amplitude_of(flow, one, np.ones(3, bool), 0.1, 1.2) == math.inf


def test_only_the_flow_across_a_riser_counts():
    upright, leaning = (
        screened(
            string(
                [(0.0, 0.1), (LENGTH, 0.1)],
                top={"x": "held", "z": "free", "tension": "200 MN", "offset": f"{offset} m"},
            )
        )
        for offset in (0.0, OFFSET)
    )
    lean = math.sqrt(1.0 - (OFFSET / LENGTH) ** 2)
    np.testing.assert_allclose(leaning["current_speed"][50:150], 0.1 * lean, rtol=2e-3)
    assert float(upright["current_speed"][100]) == pytest.approx(0.1, rel=1e-3)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_the_speed_beside_a_jump_is_that_of_the_profile(seed, spatial):
    tree = rig(seed, spatial=spatial, conductor=False)
    chance = np.random.default_rng(seed)
    seabed = tree["water"]["seabed"]
    level, high, low = seabed * chance.uniform(0.3, 0.7), *chance.uniform(0.1, 1.0, 2)
    points = [(seabed, 0.0), (level, 0.0), (level, high), (0.5 * level, high), (0.5 * level, low), (0.0, low)]
    tree["current"] = {
        "profile": [{"elevation": float(z), "speed": float(u)} for z, u in points],
        "beyond": "hold",
    }
    tree["platform"]["position"] = {"surge": 0.0} | ({"sway": 0.0} if spatial else {})
    found = screening(SceneFile("rig.yaml", written(tree)))
    elevations, speeds = np.array(points).T
    wet = found["z"].values <= 0.0
    right = np.interp(found["z"].values[wet], elevations, speeds)
    np.testing.assert_allclose(found["current_speed"].values[wet], right, rtol=1e-3, atol=1e-9)


def test_a_stronger_current_excites_higher_modes():
    slow, fast = (screened(string([(0.0, 0.1), (LENGTH, u)])) for u in (0.5, 1.0))
    assert fast["mode"].max() > slow["mode"].max()
    highest = 1.0 / (4.0 * DIAMETER)  # that the fastest water can excite
    spacing = math.sqrt(TENSION / MASS) / (2.0 * LENGTH)
    assert highest - spacing < float(fast["natural_frequency"].max()) <= highest


@pytest.mark.parametrize("seed", range(4))
def test_a_screening_can_be_repeated_by_the_coefficients_that_its_dataset_states(seed):
    """And it is the same without a surface, above which the string only rises by its stretch."""
    draw = np.random.default_rng(seed)
    tree = string([(0.0, 0.2), (LENGTH, float(draw.uniform(0.4, 0.8)))])
    given = {"strouhal": draw.uniform(0.17, 0.25), "slowest": draw.uniform(3.5, 4.5)}
    given |= {"drag": float(draw.uniform(0.8, 1.2))} if seed % 2 else {}
    found = screened(tree, **{name: float(value) for name, value in given.items()})
    stated = {k.removeprefix("assumed_"): v for k, v in found.attrs.items() if k.startswith("assumed_")}
    assert ("drag" in stated) == ("drag" in given)
    assert stated.keys() | {"drag"} == {*Coefficients._fields}
    again, without = screened(tree, **stated), tree | {"water": {"density": "1025 kg/m^3"}}
    for same, rel in ((again, 1e-12), (screened(without, **stated), 1e-3)):
        assert same.sizes == found.sizes
        for name in ("amplitude", "excited_length", "shedding_frequency", "drag_factor"):
            np.testing.assert_allclose(same[name], found[name], rtol=rel)


def test_what_cannot_be_screened_is_refused():
    still = string([(0.0, 0.0), (LENGTH, 0.0)])
    with pytest.raises(SimulationError, match="does not flow across"):
        screened(still)
    still.pop("current")
    with pytest.raises(InputError, match="current"):
        screened(still)
    with pytest.raises(InputError, match="fastest"):
        screened(string([(0.0, 1.0), (LENGTH, 1.0)]), slowest=9.0)
    with pytest.raises(InputError, match="lift"):
        screened(string([(0.0, 1.0), (LENGTH, 1.0)]), lift=math.nan)


def test_the_command_prints_a_table_and_draws(tmp_path, capsys):
    from ruamel.yaml import YAML

    scene = tmp_path / "scene.yaml"
    YAML().dump(string([(0.0, 0.3), (LENGTH, 0.9)]), scene)
    table, picture = tmp_path / "viv.csv", tmp_path / "viv.png"
    app(["viv", str(scene), "--csv", str(table), "--plot", str(picture)], standalone_mode=False)
    lines = table.read_text().splitlines()
    assert lines[0].startswith("mode,natural_frequency (Hz)")
    said = capsys.readouterr().out.splitlines()
    assert len(lines) + 3 == len(said)  # two files are named, and frequencies of shedding
    assert picture.stat().st_size > 10_000
    (shed,) = (line for line in said if "Strouhal" in line)
    app(["viv", str(scene), "--strouhal", "0.1"], standalone_mode=False)
    (half,) = (line for line in capsys.readouterr().out.splitlines() if "Strouhal" in line)
    frequencies = [[float(word) for word in line.split()[4:7:2]] for line in (shed, half)]
    np.testing.assert_allclose(frequencies[0], 2.0 * np.array(frequencies[1]), rtol=0.01)


@pytest.mark.parametrize("share", [1e-3, 1e-7, 1e-9, 1e-12, 1e-300])
def test_the_amplitude_of_a_mode_along_the_flow_vanishes(share):
    """In space a mode has a component across the flow that may be tiny; its amplitude is then zero."""
    z = np.linspace(5.0, LENGTH - 5.0, 30)
    ones = np.ones_like(z)
    flow = Flow(z, 10.0 * ones, 0.5 * ones, DIAMETER * ones, 1.1 * ones)
    shape = np.sin(np.pi * z / LENGTH)
    whole = amplitude_of(flow, shape, ones > 0.0, 0.2, 1.2)
    part = amplitude_of(flow, shape, ones > 0.0, 0.2, 1.2, share * shape)
    assert 0.0 <= part < 2.0 * share * whole


@pytest.mark.parametrize("seed", range(4))
def test_a_part_without_diameter_has_an_amplitude_but_no_ratio_to_a_diameter(seed):
    """On a string whose upper half has no diameter, lift and drag act on the lower half only."""
    draw = np.random.default_rng(seed)
    diameter, speed = float(draw.uniform(1.1, 1.5)), float(draw.uniform(0.8, 1.6))
    tree = string([(0.0, speed), (2000.0, speed)])
    whole = tree["riser"][0]
    bare = {k: v for k, v in whole.items() if k not in ("drag", "outer_diameter")}
    half = float(whole["length"].split()[0]) / 2.0
    whole |= {"length": f"{half} m", "drag": {"coefficient": 1.1, "diameter": f"{diameter} m"}}
    tree["riser"].append(bare | {"name": "without diameter", "length": f"{half} m"})
    found = screened(tree)
    assert found.sizes["mode"] > 0
    upper = found["z"].values > half * 1.01
    assert np.isnan(found["relative_amplitude"][:, upper]).all()
    lower = found["relative_amplitude"][:, found["z"].values < 0.99 * half]
    np.testing.assert_allclose(found["amplitude"], lower.max("z"), rtol=0.01)
