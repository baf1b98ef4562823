"""The upper flex joint turns with the platform: its angle, and the moment of its spring."""

import numpy as np
import pytest
from engine import SCENES, off, scene

from riserstudy import load_scene
from riserstudy.model.mesh import even
from riserstudy.simulation.run import single

LEAN = np.radians(4.0)
PITCHED = {"pitch": "4 deg"}
STILL = {"amplitude": "0 m", "period": "15 s"}
ROCKING = {"amplitude": "4 deg", "period": "10 s"}
SURGING = {"amplitude": "2 m", "period": "15 s", "ramp": "15 s"}
SPRING = 1e7  # N m/rad
SPRUNG = {"top__rotation": {"stiffness": f"{SPRING} N*m/rad"}}


def ran(elements=28, still=False, **values):
    """S2 about the riser's top, so that tilt moves the direction there and nothing else."""
    about = {"platform__centre_of_rotation": {"elevation": "533 m"}}
    time = {"analysis__duration": "1 s" if still else "30 s", "analysis__output": {"interval": "0.5 s"}}
    surge = {"platform__surge": None if still else SURGING}
    tight = {"analysis__newton_tolerance": 1e-12, "analysis__mesh": {"elements": elements}}
    file = scene("s2", analysis__step="0.1 s", **(about | time | surge | tight | values)).resolved()
    return single(file, even(file, elements), 0.1).arrays


def test_the_top_leans_away_from_a_platform_that_leans_and_hardly_moves():
    found = ran(still=True, platform__position=PITCHED)
    assert abs(found["x_static"][-1]) < 0.2 * np.sin(LEAN)  # m, the riser stretches by less than 0.2 m
    # about the top at rest, so that the riser is not aside and bends by nothing
    centre = {"elevation": f"{float(ran(still=True)['z_static'][-1])!r} m"}
    found = ran(still=True, platform__position=PITCHED, platform__centre_of_rotation=centre)
    straight = np.arctan2(np.diff(found["x_static"])[-1], np.diff(found["z_static"])[-1])
    np.testing.assert_allclose(found["ufj_angle"], straight - LEAN, rtol=1e-9)
    assert found["ufj_angle"][0] == pytest.approx(-LEAN, rel=1e-3)


def test_in_space_the_angle_against_a_leaning_platform_is_a_size():
    flat = ran(still=True, platform__position=PITCHED)["ufj_angle"]
    space = ran(still=True, platform__position=PITCHED, platform__sway=STILL)["ufj_angle"]
    np.testing.assert_allclose(space, -flat, rtol=1e-9)
    both = ran(still=True, platform__position=PITCHED | {"roll": "3 deg"})["ufj_angle"]
    # an upright riser against a vertical that was turned about x, then about y
    upright = np.arccos(np.cos(LEAN) * np.cos(np.radians(3.0)))
    np.testing.assert_allclose(both, upright, rtol=1e-3)


def test_a_rocking_platform_adds_its_tilt_to_what_surge_does():
    alone = ran()
    tilt = LEAN * np.sin(2.0 * np.pi * alone["time"] / 10.0)
    pitching = ran(platform__pitch=ROCKING)
    rolling = ran(platform__roll=ROCKING)
    assert np.abs(alone["ufj_angle"]).max() > 0.02
    # the riser's stretch lifts the top above the centre by less than 0.2 m, which tilt moves aside
    apart = 0.2 * LEAN / 19.0
    np.testing.assert_allclose(pitching["ufj_angle"], alone["ufj_angle"] - tilt, atol=apart)
    across = np.arccos(np.cos(alone["ufj_angle"]) * np.cos(tilt))
    np.testing.assert_allclose(rolling["ufj_angle"], across, atol=apart)


@pytest.mark.parametrize("motion", ["pitch", "roll"])
def test_a_sprung_joint_carries_its_stiffness_times_its_angle(motion):
    # with surge across it rolling leaves the plane, where turns add up to third order only
    surge = SURGING if motion == "pitch" else None
    found = ran(**SPRUNG | {f"platform__{motion}": ROCKING, "platform__surge": surge})
    moment = found["bending_moment"][:, -1]
    assert np.abs(moment).max() > 1e5
    # along x a riser that leans back from the platform is bent towards it
    expected = -found["ufj_angle"] if motion == "pitch" else found["ufj_angle"]
    assert off(moment, SPRING * expected) < 1e-9


# of the ring's moment, a hundredth of the joint's, 6e-7 is left, whose cause is not known
@pytest.mark.parametrize("radius, within", [("0 m", 1e-9), ("1 m", 1e-6)])
def test_a_sprung_joint_above_a_telescopic_joint_does_so_too(radius, within):
    """Cylinders beside the pipe's axis give the ring a moment, with which the joint does not bend."""
    values = {
        "top.rotation": {"stiffness": f"{SPRING} N*m/rad"},
        "top.tensioners.arrangement.ring_radius": radius,
        "platform.pitch": ROCKING | {"ramp": "10 s"},
        "riser[0].structural_damping": None,
        "analysis": {
            "duration": "20 s",
            "output": {"interval": "0.5 s"},
            "mesh": {"elements": 40},
            "step": "0.1 s",
            "newton_tolerance": 1e-12,
        },
    }
    file = load_scene(SCENES.parent / "liu2020/system.yaml", **values).resolved()
    found = single(file, even(file, 40), 0.1).arrays
    assert np.abs(found["bending_moment"][:, -1]).max() > 1e5
    assert off(-found["bending_moment"][:, -1], SPRING * found["ufj_angle"]) < within


def test_the_moment_of_a_sprung_joint_is_that_of_a_tensioned_beam():
    """EI w'''' = T w'' between pinned ends, one of them turned by a spring that is held at an angle."""
    found = ran(400, still=True, platform__position=PITCHED, **SPRUNG)
    stiff = 206e9 * np.pi / 64.0 * (0.5334**4 - 0.4826**4)
    tension = 2275e3 - 10.9 * 141.264  # where it bends, sqrt(EI/T) below the top
    k = np.sqrt(tension / stiff)
    softness = (k / np.tanh(533.0 * k) - 1.0 / 533.0) / tension  # slope by a moment (rad/(N m))
    moment = SPRING * LEAN / (1.0 + SPRING * softness)
    assert found["bending_moment_static"][-1] == pytest.approx(moment, rel=2e-3)
