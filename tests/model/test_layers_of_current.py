"""A named profile is, at every elevation, the speed that its description gives."""

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.model.sea import current_table, current_velocity
from riserstudy.scene.load import SceneFile


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(10))
def test_layers_have_their_speed_at_every_elevation(seed, spatial):
    """Sums of layers: full speed above the layer's lower edge, none below the depth where it vanishes."""
    draw = np.random.default_rng((seed, 17))
    tree = rig(seed, spatial=spatial, conductor=False)
    depth = -tree["water"]["seabed"]
    parts, ends = [], []
    for _ in range(int(draw.integers(1, 4))):
        edge, below = np.sort(draw.uniform(0.02, 0.9, 2)) * depth
        speed = float(draw.uniform(-0.5, 1.5))
        parts.append(
            {"shape": "layer", "surface_speed": speed, "layer": float(edge), "vanishes": float(below)}
        )
        ends.append((speed, edge, below))
    profile = parts[0] if len(parts) == 1 else {"sum": parts}
    tree["current"] = {"profile": profile, "beyond": "hold"}
    if spatial:
        tree["current"]["heading"] = "30 deg"
    units = {"surface_speed": "m/s", "layer": "m", "vanishes": "m"}
    scene = SceneFile("rig.yaml", written(tree, unit_of=units)).resolved()
    z = np.concatenate([draw.uniform(-depth, 0.0, 200), *[(-edge, -below) for _, edge, below in ends]])
    wanted = np.zeros_like(z)
    for speed, edge, below in ends:
        for k, elevation in enumerate(z):
            if -elevation <= edge:
                wanted[k] += speed
            elif -elevation < below:
                wanted[k] += speed * (below + elevation) / (below - edge)
    elevations, speeds = current_table(scene.current, scene.water)
    assert np.interp(z, elevations, speeds) == pytest.approx(wanted, abs=1e-9)
    at, velocity = current_velocity(scene.current, scene.water)
    found = np.hypot(*[np.interp(z, at, part) for part in velocity])
    assert found == pytest.approx(abs(wanted), abs=1e-9)
