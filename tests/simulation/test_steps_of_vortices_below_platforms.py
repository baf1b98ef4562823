"""Time steps resolve the vortices of a riser whose upper end moves with a platform."""

import copy

import numpy as np
import pytest
from short_riser import SCENE

from riserstudy.model.vortices import shortest_shedding_period
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.simulation.run import march
from riserstudy.simulation.starting_mesh import coarsest_mesh, period

LENGTH, END = 400.0, 160.0  # m, s
WEIGHT = LENGTH * (500.0 + 1025.0 * 9.81 * 0.183)  # N, with contents

AT_REST = {"cruise": {"speed": "0 m/s"}}


def tree_below(speed, platform, **more):
    """A riser of 400 m in a uniform current (m/s), whose top moves with a platform."""
    tree = copy.deepcopy(SCENE)
    tree["riser"][0] |= {"length": f"{LENGTH} m"}
    tree["riser"][0]["viv"]["ramp"] = "30 s"
    tree["water"] |= {"seabed": "-1 m", "surface": f"{LENGTH - 20.0} m"}
    tree["top"] = {"x": "platform", "z": "free", "tension": f"{1.6 * WEIGHT} N"}
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": f"{speed} m/s"}}
    if platform:
        tree["platform"] = platform
    tree["analysis"] |= {"duration": f"{END} s", "output": {"interval": "0.2 s"}} | more
    return tree


def below(*args, **more):
    return SceneFile("riser.yaml", tree_below(*args, **more), {}).resolved()


@pytest.mark.parametrize("seed", range(3))
def test_a_cruise_calls_for_the_steps_of_a_current_as_fast(seed):
    """The upper end meets still water as fast as a riser at rest meets a current."""
    speed, heading = np.random.default_rng((seed, 1)).uniform([0.2, 0.0], [1.5, 6.0])
    cruise = {"cruise": {"speed": f"{speed} m/s", "heading": f"{heading} rad", "ramp": "20 s"}}
    assert period(below(0.0, cruise)) == pytest.approx(period(below(speed, AT_REST)), rel=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_a_surge_calls_for_the_steps_of_its_speed_however_it_is_written(seed):
    draw = np.random.default_rng((seed, 2))
    amplitude, length = draw.uniform([1.0, 8.0], [4.0, 14.0])
    fast = 2.0 * np.pi * amplitude / length
    times = np.linspace(0.0, 4.0 * length, 200)
    away = amplitude * np.sin(2.0 * np.pi * times / length)
    series = [{"time": f"{t} s", "value": f"{x} m"} for t, x in zip(times, away, strict=True)]
    motions = {"amplitude": f"{amplitude} m", "period": f"{length} s"}, {"points": series}
    still = shortest_shedding_period(below(0.1 + fast, AT_REST))
    for motion in motions:
        found = shortest_shedding_period(below(0.1, {"surge": motion}))
        assert found == pytest.approx(still, rel=1e-3)


@pytest.mark.parametrize("seed", range(3))
def test_the_chosen_step_is_short_enough_below_a_cruise(seed):
    """Across the flow, the vibration is that of a step of a twentieth of the period at 0.6 m/s."""
    draw = np.random.default_rng((seed, 33))
    speed, cruise = draw.uniform([0.03, 0.3], [0.1, 0.6])
    platform = {"cruise": {"speed": f"{cruise} m/s", "heading": "180 deg", "ramp": "20 s"}}
    scene = below(speed, platform)
    mesh, step = coarsest_mesh(scene), 0.2 * max(1, round(period(scene) / 24.0 / 0.2))
    across = []
    for one in (step, 0.05):
        output = scene.analysis.output.replaced(interval=max(one, 0.2))
        arrays = march(scene.replaced(analysis=scene.analysis.replaced(output=output)), mesh, one).arrays
        late = arrays["time"] > 95.0
        across.append(np.sqrt((arrays["y"][late] ** 2).mean()))
    assert across[0] == pytest.approx(across[1], rel=0.04)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
def test_below_a_cruise_a_finer_mesh_may_change_the_mode_but_not_its_size(seed):
    """Initial phases decide between two modes on either mesh; in one mode, both meshes vibrate alike."""
    speed, cruise = np.random.default_rng((seed, 33)).uniform([0.03, 0.3], [0.1, 0.6])
    platform = {"cruise": {"speed": f"{cruise} m/s", "heading": "180 deg", "ramp": "20 s"}}
    found = {}
    for phases in range(12):
        tree = tree_below(speed, platform, duration="300 s")
        tree["riser"][0]["viv"]["seed"] = phases
        scene = SceneFile("riser.yaml", tree, {}).resolved()
        mesh = coarsest_mesh(scene)
        for fine, one in enumerate((mesh, mesh.halved().halved())):
            arrays = march(scene, one, 0.1).arrays
            away = arrays["y"][arrays["time"] > 180.0]
            shape = np.sin(np.pi / LENGTH * np.multiply.outer(np.arange(1, 9), arrays["s"]))
            size = ((away @ (shape * np.gradient(arrays["s"])).T) ** 2).mean(axis=0)
            if size.max() > 0.78 * size.sum():  # of one mode, steadily
                each = np.sqrt(np.trapezoid((away**2).mean(axis=0), arrays["s"]) / LENGTH)
                found.setdefault(int(size.argmax()), ([], []))[fine].append(each)
    assert len(found) == 2
    for coarse, fine in found.values():
        if coarse and fine:
            assert np.mean(coarse) == pytest.approx(np.mean(fine), rel=0.04)


def test_a_step_too_long_below_a_surge_is_warned_of():
    surge = {"surge": {"amplitude": "3 m", "period": "10 s", "ramp": "20 s"}}
    for step, warned in (("0.2 s", True), ("0.05 s", False)):
        warnings = sentences(run(below(0.05, surge, step=step), estimated=False).facts["warnings"])
        assert any("the time step is too long" in text for text in warnings) == warned


def test_a_step_too_long_below_a_vessel_that_drifts_is_warned_of():
    """Only the run knows how fast the vessel drifts."""
    for force, warned in ((0.0, False), (4e6, True)):
        tree = tree_below(0.05, None, step="0.2 s", duration="80 s")
        tree["top"]["x"] = "vessel"
        vessel = {"mass": "6e6 kg", "added_mass": "3e6 kg", "hull_drag": "6e5 N*s^2/m^2"}
        tree["vessel"] = vessel | {"wave_drift": {"force": f"{force} N", "heading": "0 deg"}}
        found = run(SceneFile("riser.yaml", tree, {}).resolved(), estimated=False)
        fastest = np.gradient(found.arrays["x"][:, -1], found.arrays["time"]).max()
        assert (fastest > 0.5) == warned
        said = sentences(found.facts["warnings"])
        assert any("the time step is too long" in text for text in said) == warned
