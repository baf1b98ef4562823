"""A held top whose acceleration jumps: no moments that are not there, however fine the mesh."""

import numpy as np
import pytest
from engine import SCENES

from riserstudy import load_scene
from riserstudy.mesh import even
from riserstudy.single import EVERYWHERE, single

RAMP = {"platform.cruise": {"speed": "1 m/s", "ramp": "5 s"}, "platform.heave": None}
HANG_OFF = SCENES.parent / "hard" / "hang_off.yaml"


def run(elements, step, **values):
    wanted = RAMP | {"analysis.duration": "8 s", "analysis.output.interval": "0.25 s"} | values
    scene = load_scene(HANG_OFF, **wanted).scene()
    return single(scene, even(scene, elements), step, EVERYWHERE).arrays


def error_at_the_top(**values):
    """Of the moments in the uppermost 10 m with a step of 0.1 s, on segments of 0.25 m."""
    long, short = run(2400, 0.1, **values), run(2400, 0.0125)
    near = long["s"] > 590.0
    off = np.abs(long["bending_moment"] - short["bending_moment"])[:, near].max()
    return off / np.abs(short["bending_moment"]).max()


def test_steps_much_longer_than_periods_of_segments_make_no_moments_at_a_jolt():
    assert error_at_the_top() < 0.05
    # a step that the scene gives goes on across the jolt: 2.5 times the largest moment there is
    own = {"analysis.mesh": {"elements": 2400}, "analysis.step": "0.1 s"}
    assert error_at_the_top(**own) > 1.0


def test_outputs_and_the_energy_balance_go_on_across_a_jolt():
    plain = {"platform.cruise.ramp": "4.9 s"}
    found = run(60, 0.1, **plain)
    assert found["time"] == pytest.approx(0.25 * np.arange(33))
    top = found["x"][:, -1]
    t = found["time"]
    assert top == pytest.approx(np.where(t < 4.9, 0.5 * t**2 / 4.9, t - 2.45), abs=1e-9)
    scene = load_scene(HANG_OFF, **(RAMP | {"analysis.duration": "8 s"})).scene()
    assert single(scene, even(scene, 120), 0.05).facts["audit"]["unexplained_share"] < 1e-3


@pytest.mark.parametrize(
    "values, jolts",
    [
        ({"platform.cruise": None, "platform.heave.ramp": "20 s"}, []),
        ({"platform.cruise": None, "platform.heave.ramp": "12 s"}, [12.0]),
        (
            {"platform.cruise": None, "platform.heave": {"amplitude": "1 m", "period": "10 s"}},
            [0.0],
        ),
        ({"platform.heave": None}, [0.0, 20.0]),
        ({"platform.heave": None, "platform.cruise.ramp": "50 s"}, [0.0]),
    ],
)
def test_a_scene_tells_when_accelerations_jump(values, jolts):
    assert load_scene(HANG_OFF, **values).scene().jolts == pytest.approx(jolts)
