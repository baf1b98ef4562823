"""What follows a release: valves, bottles, contents that run out, the stack below; and what else may fail."""

import json
import math

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError, SimulationError
from riserstudy.model.mud_column import Column, flow
from riserstudy.scene.resolve import resolve

EA, MASS = 1e10, 1000.0
IMPEDANCE, SPEED = math.sqrt(EA * MASS), math.sqrt(EA / MASS)
STRING = """\
title: a stiff string on cylinders
gravity: 10 m/s^2
water: {density: 1025 kg/m^3, surface: 120 m, seabed: 0 m}
riser: [{name: string, length: 100 m, axial_stiffness: 1e13 N, mass: 1000 kg/m, submerged_weight: 8 kN/m}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  z: free
  tensioners:
    count: 5
    gas: {area: 0.1 m^2, pressure: 20 bar absolute, volume: 2000 m^3, exponent: 1.3}
    mid_stroke: riser in equilibrium
platform: {heave: {amplitude: 1e-9 m, period: 10 s}}
disconnect: {at: 1 s, over: 20 ms, MORE}
analysis: {duration: 4 s, output: {interval: 0.05 s}, accuracy: 0.05 %}
"""
VALVE = "recoil_valve: {oil_density: 900 kg/m^3, opening: 0.01 m^2, discharge: 0.7, residual: 1.0, over: 1 s}"


def run(tmp_path, text):
    return simulate(scene(tmp_path, text))


def scene(tmp_path, text):
    file = tmp_path / "scene.yaml"
    file.write_text(text)
    return load_scene(file)


def test_a_throttled_string_rises_to_the_speed_at_which_the_oil_takes_the_overpull(tmp_path):
    """v = V tanh((t - t0)/tau), V = sqrt(F / c), tau = M / sqrt(F c), of a constant pull on a rigid mass."""
    text = STRING.replace("volume: 2000", "volume: 2e5").replace("duration: 4 s", "duration: 10 s")
    found = run(tmp_path, text.replace("MORE", VALVE))
    pull, mass = 5 * 20e5 * 0.1 - 8e5, 1e5
    drop = 5 * 900.0 * 0.1**3 / (2.0 * (0.7 * 0.01) ** 2)
    t, v = found["time"].values, found["lift_rate"].values
    late = t > 1.1
    speed, tau = math.sqrt(pull / drop), mass / math.sqrt(pull * drop)
    np.testing.assert_allclose(v[-1], speed, rtol=1e-3)
    begun = np.arctanh(v[late][0] / speed) * tau  # the connector fades for 20 ms
    assert begun == pytest.approx(t[late][0] - 1.01, abs=2e-3)
    np.testing.assert_allclose(v[late], speed * np.tanh((begun + t[late] - t[late][0]) / tau), rtol=1e-3)
    assert json.loads(found.attrs["audit"])["unexplained_share"] < 1e-3


def test_a_closed_valve_pulls_nothing_and_the_string_falls_back(tmp_path):
    """The oil takes all of the pull while the string goes up: m a = -w."""
    shut = VALVE.replace("residual: 1.0, over: 1 s", "residual: 0.005, over: 0.2 s, delay: 0.5 s")
    text = STRING.replace("duration: 4 s", "duration: 2 s").replace("interval: 0.05", "interval: 0.01")
    found = run(tmp_path, text.replace("accuracy: 0.05 %", "accuracy: 2 %").replace("MORE", shut))
    t, v = found["time"].values, found["lift_rate"].values
    free = (t > 1.65) & (v > 0.1)
    assert free.sum() > 5
    np.testing.assert_allclose(np.diff(v[free]) / np.diff(t[free]), -8e5 / 1e5, rtol=1e-3)
    assert float(found["tensioner_force"].min()) >= 0.0


def test_a_failed_valve_stays_open(tmp_path):
    shut = VALVE.replace("residual: 1.0, over: 1 s", "residual: 0.01, over: 0.2 s, failed: [0, 1, 2, 3, 4]")
    failed = run(tmp_path, STRING.replace("MORE", shut))
    opened = run(tmp_path, STRING.replace("MORE", VALVE))
    np.testing.assert_allclose(failed["lift"], opened["lift"], atol=1e-9)


@pytest.mark.parametrize("event", ["connector", "bottles", "lines"])
def test_energy_passes_through_events_while_the_platform_is_away_from_its_middle(tmp_path, event):
    """Gas holds another energy at the top of a heave than at its middle: events there take none of it."""
    text = STRING.replace("volume: 2000 m^3", "volume: 4 m^3").replace("accuracy: 0.05 %", "accuracy: 0.5 %")
    text = text.replace("amplitude: 1e-9 m, period: 10 s", "amplitude: 1.5 m, period: 10 s, ramp: 2.5 s")
    text = text.replace("duration: 4 s", "duration: 9 s").replace("at: 1 s", "at: 2.5 s")
    if event == "lines":
        text = text.replace("count: 5", "count: 5\n    failing: {at: 2.5 s, cylinders: [1]}")
        text = text.replace("disconnect: {at: 2.5 s, over: 20 ms, MORE}\n", "")
        # a pull that jumps has no limit in a string without damping: its energy is that of the steps
        text = text.replace("accuracy: 0.5 %", "mesh: {elements: 128}, step: 0.01 s")
    isolated = VALVE[:-1] + ", isolation: {after: 0.1 s, volume: 2 m^3}}"
    found = run(tmp_path, text.replace("MORE", isolated if event == "bottles" else VALVE))
    audit = json.loads(found.attrs["audit"])
    assert abs(audit["unexplained"]) < 1e-3 * max(audit["exchanged"], abs(audit["stored"]))


def test_bottles_that_are_shut_off_leave_their_pressure_and_less_gas(tmp_path):
    """The pull goes on where it was; from there P V^k = const on what is left."""
    small = STRING.replace("volume: 2000 m^3", "volume: 2 m^3").replace("accuracy: 0.05 %", "accuracy: 0.5 %")
    isolated = VALVE[:-1] + ", isolation: {after: 0.5 s, volume: 1.2 m^3}}"
    found = run(tmp_path, small.replace("MORE", isolated).replace("opening: 0.01", "opening: 10"))
    t, lift = found["time"].values, found["lift"].values
    pull = found["tensioner_force"].sum("cylinder").values
    before = (t > 1.1) & (t < 1.5 - 1e-9)
    volume = 2.0 + 0.1 * lift
    np.testing.assert_allclose(pull[before], 1e6 * (2.0 / volume[before]) ** 1.3, rtol=1e-5)
    k = int(np.argmin(abs(t - 1.5)))
    after = t > 1.5 + 1e-9
    at_event = 1e6 * (2.0 / volume[k]) ** 1.3
    left = volume - 1.2
    np.testing.assert_allclose(pull[after], at_event * (left[k] / left[after]) ** 1.3, rtol=1e-5)
    assert json.loads(found.attrs["audit"])["unexplained_share"] < 1e-3


def test_a_column_of_mud_runs_out_as_the_closed_forms_say():
    """V = V_e tanh(t / tau) while its length hardly changes; how fast, when it stops, of a draining riser."""
    column = Column(1500.0, 1500.0, (0.4953,), 1440.0, 1025.0, 9.80665, 0.02, 0.0)
    early = flow(column, 1.0)
    speed = 11.833 * np.tanh(early.time / 4.186)
    np.testing.assert_allclose(early.speed[5:], speed[5:], rtol=2e-3)  # 1.4 m of 1500 m have gone
    drained = flow(column._replace(length=1520.0), 100.0)
    assert drained.speed.max() == pytest.approx(11.2088, rel=1e-4)
    assert drained.time[drained.speed.argmax()] == pytest.approx(9.555, abs=0.05)
    assert drained.time[np.flatnonzero(drained.speed < 0.0)[0]] == pytest.approx(72.192, abs=0.02)
    assert not drained.water[drained.time < 72.0].any()
    assert drained.water.max() > 1.0


def test_a_column_without_friction_keeps_its_energy_until_contents_leave():
    """Lighter than the sea: water comes in below, and the column swings about its balance for ever."""
    swung = flow(Column(1000.0, 990.0, (0.5,), 1000.0, 1025.0, 9.81, 0.0, 0.0), 300.0)
    mass = 1000.0 * (swung.top - swung.water) + 1025.0 * swung.water
    kinetic = 0.5 * mass * swung.speed**2
    contents, sea = swung.top - swung.water, swung.water
    height = 9.81 * (1000.0 * contents * (sea + 0.5 * contents) + 0.5 * 1025.0 * sea**2)
    # each metre of sea water brings its speed in, and the pressure of the sea
    given = -1025.0 * np.concatenate(
        [[0.0], np.cumsum(np.diff(swung.time) * _mean(swung.speed * (9.81 * 990.0 + 0.5 * swung.speed**2)))]
    )
    total = kinetic + height - given
    assert np.ptp(total) < 1e-4 * np.ptp(height)


def _mean(x):
    return 0.5 * (x[1:] + x[:-1])


DRAINED = """\
title: a riser that hangs from its top while its contents run out
gravity: 9.81 m/s^2
water: {density: 1025 kg/m^3, surface: 500 m, seabed: 0 m}
riser:
  - name: riser
    length: 500 m
    outer_diameter: 0.5334 m
    inner_diameter: 0.4826 m
    young_modulus: 206 GPa
    mass: 600 kg/m
    submerged_weight: 2 kN/m
    contents: {density: 1600 kg/m^3}
    structural_damping: {ratio: 0.3, at_period: 0.5 s}
    added_mass: {coefficient: 1.0, diameter: 0.5334 m}
bottom: {hold: wellhead, elevation: 20 m, body: {name: LMRP, mass: 60 t, submerged_weight: 500 kN}}
top: {x: TOP, z: held, held_at_tension: 3200 kN}
platform: {surge: {amplitude: 2 m, period: 9 s, ramp: 5 s}}
disconnect: {at: 2 s, over: 0.5 s, drain: {friction: 0.02, losses: 1.5}}
analysis: {duration: 60 s, output: {interval: 0.5 s}, mesh: {elements: 60}, step: 0.05 s}
"""


@pytest.mark.parametrize("top", ["platform", "held"])
def test_what_hangs_is_pipe_and_what_the_column_leaves_of_its_weight(tmp_path, top):
    """Along a riser that no longer rings, T = W + the integral of rho A (g - dV/dt); energy is kept."""
    text = DRAINED.replace("TOP", top)
    if top == "held":
        text = text.replace("platform: {surge: {amplitude: 2 m, period: 9 s, ramp: 5 s}}\n", "")
    found = run(tmp_path, text)
    assert json.loads(found.attrs["audit"])["unexplained_share"] < 1e-3
    if top == "platform":
        return
    column = flow(Column(500.0, 480.0, (0.4826,), 1600.0, 1025.0, 9.81, 0.02, 1.5), 58.0)
    t = found["time"].values
    late = t > 8.0
    bore = 0.25 * math.pi * 0.4826**2
    level, water, rate = (
        np.interp(t - 2.0, column.time, x)
        for x in (column.top, column.water, np.gradient(column.speed, column.time))
    )
    inside = bore * (1600.0 * (level - water) + 1025.0 * water)
    hanging = 500e3 + 500.0 * 2000.0 + inside * (9.81 - rate)
    tension = found["effective_tension"].isel(s=-1).values
    np.testing.assert_allclose(tension[late], hanging[late], rtol=1e-3)
    assert hanging[late].max() / hanging[late].min() > 1.05


BAR = f"""\
title: a bar
riser: [{{name: bar, length: 2000 m, axial_stiffness: {EA} N, mass: {MASS} kg/m}}]
bottom: {{hold: wellhead, elevation: 0 m}}
top: {{z: free, tension: 1 MN, tension_loss: {{share: 0.6, at: 0.1 s}}}}
analysis: {{duration: 0.6 s, output: {{interval: 0.02 s}}, mesh: {{elements: 400}}, step: 0.5 ms}}
"""


def test_tension_lost_at_once_sends_a_wave(tmp_path):
    """The top falls at dF / Z until the wave is back from the well, where tension falls by twice dF."""
    found = run(tmp_path, BAR)
    t, top = found["time"].values, found["z"].isel(s=-1).values
    assert t[-1] < 0.1 + 2.0 * 2000.0 / SPEED
    fallen = 0.6e6 / IMPEDANCE * np.maximum(t - 0.1, 0.0)
    np.testing.assert_allclose(top[0] - top, fallen, atol=2e-3 * fallen[-1])
    sent = 0.6e6**2 / IMPEDANCE * (t[-1] - 0.1)  # energy of the wave
    assert abs(json.loads(found.attrs["audit"])["unexplained"]) < 1e-3 * sent


def test_a_bar_that_comes_down_on_the_stack_pushes_with_z_times_its_speed(tmp_path):
    """Z v between stiff contact and the wave's return; from a rest that gravity takes it out of."""
    text = f"""\
title: a bar that falls
gravity: 10 m/s^2
water: {{density: 1000 kg/m^3}}
riser:
  - {{name: bar, length: 2000 m, axial_stiffness: {EA} N, mass: {MASS} kg/m, submerged_weight: 1 kN/m}}
bottom: {{hold: wellhead, elevation: 0 m}}
top: {{z: free, tension: 2400 kN, tension_loss: {{share: 0.5, at: 1 s, over: 0.5 s}}}}
disconnect: {{at: 0.2 s, over: 0.1 s, stack: {{stiffness: 1e9 N/m}}}}
analysis: {{duration: 6 s, output: {{interval: 5 ms}}, mesh: {{elements: 400}}, step: 2.5 ms}}
"""
    found = run(tmp_path, text)
    assert "re-contacts the stack" in found.attrs["warnings"]
    lift = found["lift"].values
    k = int(np.flatnonzero(lift < 0.0)[0])
    push = found["effective_tension"].isel(s=0).values
    after = np.arange(4, 16)
    height = SPEED * 5e-3 * after  # of what arrives then, with the tension and the speed that it has now
    segments = found["s"].values
    speed = np.gradient(found["z"].values[k - 4 : k], 5e-3, axis=0)[-1]
    tension = found["effective_tension"].values[k - 1]
    arriving = (
        np.interp(height, segments, tension) + IMPEDANCE * np.interp(height, segments, speed) - 1e3 * height
    )
    assert arriving.max() < -8e5
    np.testing.assert_allclose(push[k - 1 + after].mean(), arriving.mean(), rtol=0.01)
    np.testing.assert_allclose(-1e9 * lift[k - 1 + after].mean(), -push[k - 1 + after].mean(), rtol=0.01)
    assert json.loads(found.attrs["audit"])["unexplained_share"] < 1e-3


def test_a_cylinder_that_fails_is_missed_at_once(tmp_path):
    """One of five springs parts: what is left swings about its new place, z = (dF / k)(1 - cos(w t))."""
    text = """\
title: a stiff string on lines
gravity: 10 m/s^2
water: {density: 1025 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 1e10 N, mass: 1000 kg/m, submerged_weight: 8 kN/m}]
bottom: {hold: free}
top:
  z: free
  tensioners:
    count: 5
    linear: {tension: 160 kN, stiffness: 10 kN/m}
    mid_stroke: riser unstretched
    failing: {at: 1 s, cylinders: [3]}
platform: {heave: {amplitude: 1e-9 m, period: 10 s}}
analysis: {duration: 2 s, output: {interval: 0.05 s}, mesh: {elements: 4}, step: 5 ms}
"""
    found = run(tmp_path, text)
    t = found["time"].values
    fallen = found["z"].isel(s=0).values
    fallen = fallen[0] - fallen
    turn = math.sqrt(4 * 10e3 / 1e5) * np.maximum(t - 1.0, 0.0)
    expected = 160e3 / (4 * 10e3) * (1.0 - np.cos(turn))
    np.testing.assert_allclose(fallen, expected, atol=1e-3 * expected[-1])
    np.testing.assert_allclose(found["tensioner_force"].isel(cylinder=3)[t > 1.01], 0.0, atol=1e-9)
    swung = 160e3**2 / (4 * 10e3)
    assert abs(json.loads(found.attrs["audit"])["unexplained"]) < 1e-3 * swung


@pytest.mark.parametrize(
    "phase, at", [("0 deg", 20.0), ("90 deg", 12.5), ("180 deg", 15.0), ("300 deg", 55.0 / 3.0)]
)
def test_the_release_waits_for_its_phase(tmp_path, phase, at):
    text = STRING.replace("MORE", f"phase: {phase}").replace("at: 1 s", "at: 11 s")
    text = text.replace("duration: 4 s", "duration: 30 s")
    model = scene(tmp_path, text).resolved()
    assert model.disconnect.at == pytest.approx(at, rel=1e-12)
    assert resolve(model).disconnect.at == pytest.approx(at, rel=1e-12)


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("MORE", "phase: 270 deg", "before the end"),
        (
            "platform: {heave: {amplitude: 1e-9 m, period: 10 s}}\ndisconnect: {at: 1 s,",
            "disconnect: {at: 1 s, phase: 0 deg,",
            "phase: requires",
        ),
        ("MORE", "drain: {friction: 0.02}", "contents from the lowest section upwards"),
        ("MORE", VALVE[:-1] + ", failed: [5]}", "failed"),
        (
            "MORE",
            VALVE[:-1] + ", isolation: {after: 1 s, volume: 2000 m^3}}",
            "not less than the gas volume of a cylinder",
        ),
        (
            "gas: {area: 0.1 m^2, pressure: 20 bar absolute, volume: 2000 m^3, exponent: 1.3}",
            "linear: {tension: 200 kN, stiffness: 1 kN/m}",
            "requires top.tensioners with gas",
        ),
        ("count: 5", "count: 5\n    failing: {at: 5 s, cylinders: [0]}", "before the end"),
        ("count: 5", "count: 5\n    failing: {at: 1 s, cylinders: [5]}", "use numbers from 0 to"),
    ],
)
def test_a_recoil_that_does_not_fit_is_refused(tmp_path, old, new, message):
    text = STRING.replace(old, new).replace("MORE", VALVE)
    with pytest.raises(InputError, match=message):
        scene(tmp_path, text).resolved()


def test_more_bottles_than_there_is_gas_is_told_when_it_happens(tmp_path):
    small = STRING.replace("volume: 2000 m^3", "volume: 2 m^3").replace("accuracy: 0.05 %", "accuracy: 5 %")
    platform = "platform: {heave: {amplitude: 1e-9 m, period: 10 s}, position: {heave: 8 m}}"
    small = small.replace("platform: {heave: {amplitude: 1e-9 m, period: 10 s}}", platform)
    isolated = VALVE[:-1] + ", isolation: {after: 0.1 s, volume: 1.9 m^3}}"
    with pytest.raises(SimulationError, match="give a smaller volume"):
        run(tmp_path, small.replace("MORE", isolated).replace("riser in equilibrium", "riser unstretched"))


def test_contents_that_run_out_altogether_are_told():
    with pytest.raises(SimulationError, match="contents have drained"):
        flow(Column(100.0, 1.0, (0.5,), 2000.0, 1025.0, 9.81, 0.0, 0.0), 60.0)
