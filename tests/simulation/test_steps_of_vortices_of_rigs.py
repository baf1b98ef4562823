"""Time steps resolve the vortices of risers on inclined tensioners in waves, below a cruise or a vessel."""

import copy

import numpy as np
import pytest
from random_rigs import HIGHEST, rig, shed_vortices, timed, written

from riserstudy.model.vortices import shortest_shedding_period
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import march
from riserstudy.simulation.starting_mesh import coarsest_mesh, period

RAMP = 20.0  # s, of the vortices
DEEPEST = 700.0  # m; deeper risers have modes of similar frequencies, and runs differ by chance
DRIFT = 2e6  # N
HEADING = {"heading": "rad"}


def shallow(seed, draw):
    """A rig in a slow current, in a plane or in space, that sheds vortices."""
    spatial = bool(seed % 2)
    rigs = (rig(k, spatial=spatial, conductor=False) for k in range(seed, seed + 2000, 97))
    tree = next(tree for tree in rigs if tree["water"]["seabed"] > -DEEPEST)
    shed_vortices(tree, RAMP)
    tree["current"]["profile"]["surface_speed"] = float(draw.uniform(0.03, 0.1))
    return tree, float(draw.uniform(0.0, 6.0)) if spatial else np.pi


@pytest.mark.parametrize("seed", range(8))
def test_the_chosen_step_is_short_enough_below_a_cruise(seed):
    """Across the cruise, the vibration is that of steps four times as short on the same mesh."""
    draw = np.random.default_rng((seed, 77))
    tree, heading = shallow(seed, draw)
    tree["platform"]["cruise"] = {"speed": float(draw.uniform(0.3, 0.6)), "heading": heading, "ramp": 20.0}
    tree["analysis"] = timed(120.0, 0.1, 40, 0.2)
    scene = SceneFile("rig.yaml", written(tree, unit_of=HEADING)).resolved()
    mesh, step = coarsest_mesh(scene), 0.2 * max(1, round(period(scene) / 24.0 / 0.2))
    found = []
    for one in (step, 0.25 * step):
        output = scene.analysis.output.replaced(interval=max(one, 0.2))
        arrays = march(scene.replaced(analysis=scene.analysis.replaced(output=output)), mesh, one).arrays
        late = arrays["time"] > 50.0
        across = (arrays["y"] * np.cos(heading) - arrays["x"] * np.sin(heading))[late]
        found.append(np.sqrt(across.var(axis=0).mean()))
    assert found[0] == pytest.approx(found[1], rel=0.04)


@pytest.mark.parametrize("seed", range(6))
def test_a_step_too_long_for_the_drift_of_a_run_is_warned_of(seed):
    """A twentieth of the shedding period at the vessel's largest speed is the limit, to either side."""
    draw = np.random.default_rng((seed, 78))
    tree, heading = shallow(seed, draw)
    tree["top"]["x"] = "vessel"
    if seed % 3:
        del tree["platform"]
        tree["top"]["z"] = "held"
    else:  # motion in waves, too
        motion = {"amplitude": float(draw.uniform(0.5, 2.0)), "period": 10.0, "ramp": 10.0}
        tree["platform"] = {"surge": motion}
    hull = {"added_mass": "3e6 kg", "hull_drag": "6e5 N*s^2/m^2"}
    vessel = hull | {"mass": "6e6 kg", "wave_drift": {"force": f"{DRIFT} N", "heading": f"{heading} rad"}}
    vessel |= {"sway": hull} if seed % 2 else {}
    tree["analysis"] = timed(60.0, 0.1, 40, 0.5)
    tree = written(tree, unit_of=HEADING) | {"vessel": vessel}

    def found(step):
        tree["analysis"]["step"] = f"{step} s"
        return run(SceneFile("rig.yaml", tree).resolved(), estimated=False)

    arrays = found(0.25).arrays
    drift = np.hypot(*(np.gradient(arrays[name][:, -1], arrays["time"]) for name in ("x", "y"))).max()
    current = float(tree["current"]["profile"]["surface_speed"].split()[0])
    diameter = float(tree["riser"][-1]["viv"]["diameter"].split()[0])
    limit = diameter / (HIGHEST * (current + drift)) / 20.0
    assert drift > 5.0 * current
    for share, warned in ((0.9, False), (1.1, True)):
        warnings = sentences(found(share * limit).facts["warnings"])
        assert any("the time step is too long" in text for text in warnings) == warned


@pytest.mark.parametrize("seed", range(20))
def test_a_section_through_the_surface_has_the_vortices_of_its_part_below(seed):
    """Short waves move the water only close to the surface."""
    draw = np.random.default_rng((seed, 79))
    tree = shed_vortices(rig(seed, conductor=False), RAMP)
    tree["wave"] = {"amplitude": 1.0, "period": float(draw.uniform(4.0, 10.0)), "above_mean_level": "none"}
    tree["analysis"] = timed(60.0, 0.1, 40, 0.2)
    last = tree["riser"][-1]
    length = sum(section["length"] for section in tree["riser"])
    low = -tree["bottom"]["elevation"] - (length - last["length"])  # m, of its part below the surface
    divided = copy.deepcopy(tree)
    if 0.0 < low < last["length"]:
        divided["riser"][-1]["length"] = low
        divided["riser"].append(last | {"name": "above", "length": last["length"] - low})
    whole, parts = (SceneFile("rig.yaml", written(one)).resolved() for one in (tree, divided))
    assert shortest_shedding_period(whole) == pytest.approx(shortest_shedding_period(parts), rel=1e-9)
