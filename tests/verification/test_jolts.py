"""A held top whose acceleration jumps: no moments that are not there, however fine the mesh."""

import numpy as np
import pytest
from engine import SCENES
from scipy.special import erfc

from riserstudy import load_scene
from riserstudy.errors import InputError
from riserstudy.model.mesh import even
from riserstudy.simulation.run import single

RAMP = {"platform.cruise": {"speed": "1 m/s", "ramp": "5 s"}, "platform.heave": None}
HANG_OFF = SCENES.parent / "hard" / "hang_off.yaml"
SURGE = SCENES.parent / "hard" / "surge.yaml"
OWN = {"analysis.mesh": {"elements": 10}, "analysis.step": "0.1 s"}


def run(elements, step, **values):
    wanted = RAMP | {"analysis.duration": "8 s", "analysis.output.interval": "0.25 s"} | values
    scene = load_scene(HANG_OFF, **wanted).resolved()
    return single(scene, even(scene, elements), step, True).arrays


def error_at_the_top(**values):
    """Of the moments in the uppermost 10 m with a step of 0.1 s, on segments of 0.25 m."""
    long, short = run(2400, 0.1, **values), run(2400, 0.0125)
    near = long["s"] > 590.0
    off = np.abs(long["bending_moment"] - short["bending_moment"])[:, near].max()
    return off / np.abs(short["bending_moment"]).max()


def test_steps_much_longer_than_periods_of_segments_make_no_moments_at_a_jolt():
    assert error_at_the_top() < 0.05
    # a step that the scene gives goes on across the jolt; outputs between steps take forces of steps
    own = {"analysis.mesh": {"elements": 2400}, "analysis.step": "0.1 s"}
    assert error_at_the_top(**own) < 0.05


def test_outputs_and_the_energy_balance_go_on_across_a_jolt():
    plain = {"platform.cruise.ramp": "4.9 s"}
    found = run(60, 0.1, **plain)
    assert found["time"] == pytest.approx(0.25 * np.arange(33))
    top = found["x"][:, -1]
    t = found["time"]
    assert top == pytest.approx(np.where(t < 4.9, 0.5 * t**2 / 4.9, t - 2.45), abs=1e-9)
    scene = load_scene(HANG_OFF, **(RAMP | {"analysis.duration": "8 s"})).resolved()
    assert single(scene, even(scene, 120), 0.05).facts["audit"]["unexplained_share"] < 1e-3


@pytest.mark.parametrize(
    "values, jolts",
    [
        ({"platform.cruise": None, "platform.heave.ramp": "20 s"}, []),
        ({"platform.cruise": None, "platform.heave.ramp": "12 s"}, [12.0]),
        (OWN | {"platform.cruise": None, "platform.heave.ramp": None}, [0.0]),
        ({"platform.heave": None}, [0.0, 20.0]),
        ({"platform.heave": None, "platform.cruise.ramp": "50 s"}, [0.0]),
    ],
)
def test_a_scene_tells_when_accelerations_jump(values, jolts):
    assert load_scene(HANG_OFF, **values).resolved().jolts == pytest.approx(jolts)


def test_a_top_that_starts_with_a_speed_bends_the_riser_as_much_however_soon_after():
    r"""The moment's peak only comes closer to it: it is one of x^2 / t.

    With w(0, t) = V t and no moment there, the beam EI d4w/dx4 = -m d2w/dt2 has
    M = -V sqrt(EI m) Im erfc(x sqrt(i / (4 a t))), a^2 = EI / m.
    """
    values = {
        "riser[0].length": "60 m",
        "riser[0].drag": None,
        "riser[0].added_mass": None,
        "riser[0].submerged_weight": "0 N/m",
        "top.tension": "20 kN",
        "platform.surge": {"amplitude": "2 m", "period": "15 s"},
        "analysis.duration": "0.004 s",
        "analysis.output.interval": "0.001 s",
        "analysis.mesh": {"elements": 600},
        "analysis.step": "5e-6 s",
    }
    scene = load_scene(SURGE, **values).resolved()
    found = single(scene, even(scene, 600), 5e-6, True).arrays
    bending, mass, speed = scene.riser[0].elasticity[1], 1006.0, 2.0 * 2.0 * np.pi / 15.0
    x = 60.0 - found["s"][300:]
    peaks = []
    for k in (1, 4):
        spread = np.sqrt(4.0 * np.sqrt(bending / mass) * found["time"][k])
        expected = -speed * np.sqrt(bending * mass) * erfc(np.sqrt(1j) * x / spread).imag
        moment = found["bending_moment"][k, 300:]
        near = x < 2.0 * spread  # farther off waves are short
        off = np.abs(np.abs(moment) - np.abs(expected))[near]
        assert off.max() < 0.01 * np.abs(expected).max()
        peaks.append(np.abs(moment).max())
    assert peaks[0] == pytest.approx(peaks[1], rel=0.005)


@pytest.mark.parametrize(
    "scene, line, values",
    [
        (SURGE, "surge", {"platform.surge.ramp": None}),
        (HANG_OFF, "heave", {"platform.heave.ramp": None}),
        (HANG_OFF, "cruise", {"platform.cruise.ramp": None}),
    ],
)
def test_no_accuracy_is_asked_for_where_a_top_starts_with_a_speed(scene, line, values):
    with pytest.raises(
        InputError, match=rf"platform\.{line}: the motion starts with a jump in velocity.*ramp"
    ):
        load_scene(scene, **values)
    load_scene(scene, **values, **OWN)
    damped = {"riser[0].structural_damping": {"ratio": 0.01, "at_period": "10 s"}}
    load_scene(scene, **values, **damped, **{"analysis.output.start": "2 s"})
    if line == "surge":  # at its farthest, where it turns
        load_scene(scene, **values, **{"platform.surge.phase": "90 deg"})


def test_envelopes_start_with_the_first_output_within_a_step():
    """Of a cruise the top has come less far there than at the end of the step."""
    found = run(12, 0.4, **{"analysis.output.start": "6.3 s"})
    assert found["time"][0] == pytest.approx(6.3)
    assert found["x_min"][-1] == pytest.approx(found["x"][0, -1], abs=1e-12)
