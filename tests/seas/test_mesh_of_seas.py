"""One mesh for all sea states of a heading: the coarsest whose demands are those of runs by accuracy."""

import math

import numpy as np
import pytest
from platform_in_a_sea import RISER, in_a_sea

from riserstudy import load_scene
from riserstudy.seas import mesh_of_seas as module
from riserstudy.seas.cover import off_by, scale_of
from riserstudy.seas.mesh_of_seas import SHARE, mesh_of_seas, on_mesh, probes
from riserstudy.seas.riser_downtime import riser_downtime
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import sea_states
from riserstudy.seas.synthetic import synthetic

LIMITS = [
    {"output": "ufj_angle", "largest": "0.6 deg", "mode": "drilling"},
    {"output": "effective_tension", "smallest": "2250.5 kN", "mode": "connected"},
]
SEA = in_a_sea(LIMITS, (1, 6, 12, 60), components=20, duration="60 s")
BY_ACCURACY = {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": "5 %"}


@pytest.fixture(scope="module")
def record():
    """A row in eight days of two years."""
    return synthetic(2, 8).isel(time=slice(None, None, 197))


@pytest.fixture(scope="module")
def file():
    """A riser under a platform in a sea, whose runs find mesh and step by an accuracy."""
    return load_scene(RISER).with_values(SEA | BY_ACCURACY, "test")


def faked(monkeypatch, by_mesh, by_step, fails_below=0):
    """Responses in closed form, with errors of second order in mesh and step."""
    calls = []

    class Response:
        limits, allowed = [None], np.array([1.0])

        def __init__(self, file, seeds, interval, cores):
            self.file, self.seeds, self.interval, self.cores = file, seeds, interval, cores

        def __call__(self, states):
            tree = self.file.tree["analysis"]
            calls.append(tree)
            if tree.get("mesh") is None:
                return 0.5 + 0.1 * states[:, :1]
            n, step = tree["mesh"]["elements"], float(tree["step"].split()[0])
            if n < fails_below:
                return np.full((len(states), 1), math.nan)
            error = by_mesh * (160 / n) ** 2 + by_step * (step / 0.1) ** 2
            return 0.5 + 0.1 * states[:, :1] + error

        def facts(self, states):
            return [{"elements": 160, "step": 0.1}] * len(states)

    monkeypatch.setattr(module, "RiserResponse", Response)
    return Response, calls


@pytest.mark.parametrize("seed", range(12))
def test_the_coarsest_mesh_and_the_longest_step_that_serve_are_taken(monkeypatch, file, record, seed):
    """Against every mesh and step of the ladder, by the error in closed form."""
    draw = np.random.default_rng(seed)
    by_mesh, by_step = 10.0 ** draw.uniform(-5.0, -1.5, 2)
    fails = int(draw.choice([0, 50]))
    made, _ = faked(monkeypatch, by_mesh, by_step, fails)
    found = mesh_of_seas(made(file, 5, 3600.0, 1), sea_states(record), 0.05, lambda _: None)
    # the errors count against what is allowed, 1, or the demand where that is more
    allowed = SHARE * 0.05 * max(1.0, 0.5 + 0.1 * float(record["significant_wave_height"].min()))
    # the fewest elements that serve with the step of the runs, then the longest step
    meshes = [a for a in range(4) if math.ceil(160 / 2**a) >= fails and by_mesh * 4.0**a + by_step <= allowed]
    a = max(meshes, default=0)
    steps = [b for b in range(4) if by_mesh * 4.0**a + by_step * 4.0**b <= allowed]
    b = max(steps, default=0)
    if not a and not b:
        assert found is None
        return
    assert found.values["analysis.mesh"]["elements"] == 160 / 2**a
    assert float(found.values["analysis.step"].split()[0]) == pytest.approx(0.1 * 2**b)
    assert 0.0 < found.error.max() <= SHARE * 0.05


def test_a_scene_with_a_mesh_keeps_it(record):
    own = load_scene(RISER).with_values(SEA, "test")
    riser = RiserResponse(own, 1, 3600.0, 1)
    assert mesh_of_seas(riser, sea_states(record), 0.1, lambda _: None) is None


def test_sea_states_that_a_mesh_is_chosen_by_are_the_hard_ones(record):
    of = sea_states(record)
    chosen = probes(of)
    assert 2 <= len(chosen) <= 3
    assert chosen[:, 0].max() == of.states[:, 0].max()
    high = of.states[of.states[:, 0] >= np.median(of.states[:, 0])]
    assert chosen[:, 1].min() == high[:, 1].min()


@pytest.mark.long
def test_demands_on_the_mesh_are_those_by_accuracy_in_other_sea_states(file, record):
    of = sea_states(record)
    accurate = RiserResponse(file, 1, 147 * 3600.0, 1)
    found = mesh_of_seas(accurate, of, 0.1, lambda _: None)
    draw = np.random.default_rng(1)
    states = of.states[draw.choice(len(of.states), 5, replace=False)]
    by_accuracy = accurate(states)
    meshed = RiserResponse(on_mesh(file, found.values), 1, 147 * 3600.0, 1)(states)
    off = off_by(meshed, by_accuracy, scale_of(accurate.allowed, by_accuracy))
    assert off.max() <= 0.1
    told = riser_downtime(file, record, seeds=1, error=0.1)
    (line,) = [line for line in told.lines if "meet the scene's accuracy" in line]
    assert found.words in line
