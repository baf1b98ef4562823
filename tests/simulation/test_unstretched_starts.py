"""A run that starts unstretched has no tension between its ends, wherever and however its riser hangs."""

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile

LEAST = 1e-13  # largest strain that counts as a rounding error


def started(tree):
    """Tensions at the first output (N), and EA (N)."""
    tree["analysis"] = timed(0.02, 0.01, 30, 0.01) | {"start": "unstretched"}
    run = simulate(SceneFile("start", written(tree), {}))
    part = tree["riser"][0]
    outer, inner = part["outer_diameter"], part["inner_diameter"]
    return run["effective_tension"].values[0], 2.07e11 * 0.25 * np.pi * (outer**2 - inner**2)


@pytest.mark.parametrize("seed", range(10))
def test_a_riser_on_tensioners_starts_without_tension(seed):
    """Aside of the well, in a current, in plane and space."""
    tree = rig(seed, conductor=False)
    draw = np.random.default_rng((seed, 3))
    tree["top"]["offset"] = float(draw.uniform(-0.05, 0.05)) * -tree["water"]["seabed"]
    tension, stiffness = started(tree)
    assert np.abs(tension[1:-3]).max() < LEAST * stiffness


@pytest.mark.parametrize("seed", range(6))
def test_a_hung_off_riser_starts_without_tension(seed):
    """Its top is held: its lower end rises by the stretch, instead of its top segment being stretched."""
    tree = rig(seed, conductor=False)
    top = tree["top"]
    tree["bottom"] = {"hold": "free"}
    tree["riser"] = tree["riser"][:1]
    tree["top"] = {"x": "platform", "z": "held", "elevation": top["elevation"], "rotation": "free"}
    tree["riser"][0]["submerged_weight"] = 1500.0
    tension, stiffness = started(tree)
    assert np.abs(tension[1:-1]).max() < LEAST * stiffness


@pytest.mark.parametrize("seed", range(4))
def test_a_riser_between_held_ends_cannot_start_unstretched(seed):
    tree = rig(seed, conductor=False)
    tree["top"] = {"x": "platform", "z": "held", "elevation": tree["top"]["elevation"]}
    tree["riser"][-1]["length"] += 15.0  # without its joint, up to the same elevation
    tree["analysis"] = timed(0.02, 0.01, 30, 0.01) | {"start": "unstretched"}
    with pytest.raises(InputError, match=r"analysis\.start: 'unstretched' requires a riser end that is free"):
        SceneFile("start", written(tree), {}).resolved()


@pytest.mark.parametrize("seed", range(6))
def test_an_upright_string_starts_with_no_tension_to_rounding(seed):
    """Its smallest tension over a run is often this start, which claims compare between tensioners."""
    draw = np.random.default_rng((seed, 2))
    tree = rig(seed, conductor=False, spatial=False)
    tree["riser"] = [{"name": "string", "length": float(draw.uniform(100.0, 2500.0)), "mass": 700.0}]
    scene = written(tree)
    scene["riser"][0] |= {"axial_stiffness": "8000 MN", "submerged_weight": f"{draw.uniform(0, 2000)} N/m"}
    tensioners = scene["top"]["tensioners"]
    tensioners.pop("arrangement")
    scene["top"] = {"z": "free", "tensioners": tensioners}
    scene["bottom"] = {"hold": "wellhead", "elevation": "0 m"}
    for name in ("water", "current", "platform"):
        scene.pop(name)
    scene["analysis"] = written(timed(0.02, 0.01, int(draw.integers(1, 5)), 0.01)) | {"start": "unstretched"}
    run = simulate(SceneFile("string", scene, {}))
    np.testing.assert_allclose(run["z"].values[0], run["s"].values, rtol=2e-12)
