"""The lower end lets go: waves of release, a string on gas, and balances that must stay."""

import json
import math

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError, SimulationError

WALL = 0.25 * math.pi * ((21 * 0.0254) ** 2 - (19 * 0.0254) ** 2)
EA, MASS, LENGTH, BODY, PULL = 206e9 * WALL, 1006.0, 2000.0, 1e5, 1e6
BAR = f"""\
title: a bar under tension whose lower end lets go
riser:
  - {{name: bar, length: {LENGTH} m, axial_stiffness: {EA!r} N, mass: {MASS} kg/m}}
bottom: {{hold: wellhead, elevation: 0 m, body: {{name: LMRP, mass: {BODY} kg}}}}
top: {{z: held, held_at_tension: {PULL} N}}
disconnect: {{at: 0.1 s}}
analysis: {{duration: 1.4 s, output: {{interval: 0.05 s}}, mesh: {{elements: 200}}, step: 1 ms}}
"""
RISER = """\
title: a riser in a current that lets go
gravity: 9.81 m/s^2
water: {density: 1025 kg/m^3, surface: 520 m, seabed: 0 m}
riser:
  - name: riser
    length: 500 m
    outer_diameter: 0.5334 m
    inner_diameter: 0.4826 m
    young_modulus: 206 GPa
    mass: 600 kg/m
    submerged_weight: 2 kN/m
    drag: {coefficient: 1.0, diameter: 1 m}
    added_mass: {coefficient: 1.0, diameter: 1 m}
bottom:
  {hold: wellhead, elevation: 20 m, rotation: JOINT, body: {name: LMRP, mass: 60 t, submerged_weight: 500 kN}}
top: {x: held, z: free, offset: 5 m, tension: 2000 kN}
current: {profile: {shape: uniform, surface_speed: 0.8 m/s}}
disconnect: {at: 2 s, over: 0.2 s, valve: {hold: 0.98, over: 2.5 s}}
analysis: {duration: 40 s, output: {interval: 0.25 s}}
"""


def scene(tmp_path, text):
    file = tmp_path / "scene.yaml"
    file.write_text(text)
    return load_scene(file)


def test_a_bar_with_a_mass_at_its_end_recoils_as_the_wave_equation_says(tmp_path):
    """v = P/Z (1 - exp(-t/tau)) until the wave is back from the top, Z = sqrt(EA m), tau = M/Z."""
    found = simulate(scene(tmp_path, BAR))
    impedance = math.sqrt(EA * MASS)
    tau = BODY / impedance
    t = found["time"].values - 0.1
    t = t[(t > 1e-9) & (t < 2.0 * LENGTH / math.sqrt(EA / MASS))]
    assert len(t) > 20
    after = found.sel(time=t + 0.1, method="nearest")
    speed = PULL / impedance * (1.0 - np.exp(-t / tau))
    lift = PULL / impedance * (t - tau * (1.0 - np.exp(-t / tau)))
    np.testing.assert_allclose(after["lift_rate"], speed, rtol=1e-3)
    np.testing.assert_allclose(after["lift"], lift, rtol=1e-3)
    before = found["lift"].where(found["time"] < 0.1 - 1e-9, drop=True)
    assert not before.values.any()


def test_a_string_on_gas_rises_as_the_work_of_the_gas_says(tmp_path):
    """m v^2 / 2 grows by N P V / (k - 1) (1 - (V / (V + A x))^(k - 1)) - w x of a stiff string.

    The connector fades over many travel times of a wave, so that the string does not ring; what it takes
    until then is the first difference.
    """
    text = """\
title: a stiff string on gas
gravity: 9.81 m/s^2
water: {density: 1025 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 1e13 N, mass: 1000 kg/m, submerged_weight: 8 kN/m}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  z: free
  tensioners:
    count: 6
    gas: {area: 0.1 m^2, pressure: 20 bar absolute, volume: 2 m^3, exponent: 1.3}
    mid_stroke: riser in equilibrium
platform: {heave: {amplitude: 1e-9 m, period: 10 s}}
disconnect: {at: 1 s, over: 20 ms}
analysis: {duration: 2.5 s, output: {interval: 0.05 s}, accuracy: 0.05 %}
"""
    found = simulate(scene(tmp_path, text))
    x, v = found["lift"].values, found["lift_rate"].values
    n, pressure, volume, area, k, weight, mass = 6, 20e5, 2.0, 0.1, 1.3, 8e5, 1e5
    gas = n * pressure * volume / (k - 1) * (1 - (volume / (volume + area * x)) ** (k - 1))
    moving = x > 0.05
    assert moving.sum() > 10
    moved, worked = 0.5 * mass * v[moving] ** 2, (gas - weight * x)[moving]
    assert 0.0 < worked[0] - moved[0] < 0.02 * worked[0]
    np.testing.assert_allclose((moved - moved[0])[1:], (worked - worked[0])[1:], rtol=1e-3)


@pytest.mark.long
@pytest.mark.parametrize("joint", ["fixed", "{stiffness: 60 kN*m/deg}", "free"])
def test_energy_and_shape_pass_through_the_release(tmp_path, joint):
    found = simulate(scene(tmp_path, RISER.replace("JOINT", joint)))
    audit = json.loads(found.attrs["audit"])
    assert audit["unexplained_share"] < 1e-3
    assert (found.attrs["taken_by_the_release"] == 0.0) == (joint == "free")
    assert "does not account" not in found.attrs["warnings"]
    assert found.attrs["lift_max"] > 0.1
    near = found["x"].sel(time=[2.0, 2.25])
    assert float(abs(near.diff("time")).max()) < 0.2  # nothing leaps


def test_half_the_step_changes_the_lift_by_less_than_one_per_cent(tmp_path):
    text = RISER.replace("JOINT", "{stiffness: 60 kN*m/deg}")
    lifts = []
    for step in (0.05, 0.025):
        given = f"mesh: {{elements: 60}}, step: {step} s"
        found = simulate(scene(tmp_path, text.replace("analysis: {", f"analysis: {{{given}, ")))
        lifts.append(float(found["lift"].max()))
    assert lifts[0] == pytest.approx(lifts[1], rel=0.01)


def test_nothing_moves_where_nothing_was_pulled(tmp_path):
    """Tension is the weight: overpull zero, released at rest."""
    text = """\
title: a string that hangs
gravity: 10 m/s^2
water: {density: 1000 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 1 GN, mass: 500 kg/m, submerged_weight: 2 kN/m}]
bottom: {hold: wellhead, elevation: 0 m, body: {name: LMRP, mass: 10 t, submerged_weight: 50 kN}}
top: {z: free, tension: 250 kN}
disconnect: {at: 1 s}
analysis: {duration: 5 s, output: {interval: 0.5 s}, mesh: {elements: 10}, step: 0.1 s}
"""
    found = simulate(scene(tmp_path, text))
    assert float(abs(found["lift"]).max()) < 1e-8


def test_a_riser_that_stands_on_the_stack_is_not_let_go(tmp_path):
    text = RISER.replace("JOINT", "free").replace("tension: 2000 kN", "tension: 1300 kN")
    text = text.replace(", valve: {hold: 0.98, over: 2.5 s}", "")
    with pytest.raises(SimulationError, match="presses on the BOP stack"):
        simulate(scene(tmp_path, text))


@pytest.mark.parametrize(
    "old, new, message",
    [
        (
            "top: {x: held, z: free, offset: 5 m, tension: 2000 kN}",
            "top: {x: held, z: held, elevation: 520 m}",
            "requires a constant top.tension",
        ),
        ("at: 2 s", "at: 40 s", "before the end"),
        (
            "output: {interval: 0.25 s}",
            "output: {interval: 0.25 s}, method: explicit, mesh: {elements: 9}, step: 0.1 ms",
            "implicit",
        ),
        ("hold: 0.98", "hold: 2.0", "not less than top.tension"),
        ("tension: 2000 kN", "tension: 2000 kN, tension_loss: {share: 0.5, at: 1 s, over: 1 s}", "valve"),
    ],
)
def test_what_cannot_be_let_go_is_refused(tmp_path, old, new, message):
    text = RISER.replace("JOINT", "free")
    assert old in text
    with pytest.raises(InputError, match=message):
        scene(tmp_path, text.replace(old, new)).resolved()
