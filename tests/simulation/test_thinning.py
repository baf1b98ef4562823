"""Runs that only tell the error of a finer one leave outputs out; the one that is given holds all."""

from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from riserstudy.records.warning import sentences
from riserstudy.scene.load import read_scene
from riserstudy.simulation.convergence import Convergence
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import march, single
from riserstudy.simulation.starting_mesh import coarsest_mesh, period
from riserstudy.simulation.thinning import A_PERIOD, STEPS, thinned
from riserstudy.simulation.time_limit import Watch

SCENE = Path(__file__).parents[2] / "config/scenes/bench/s2c.yaml"
SETS = {
    "analysis.mesh": None,
    "analysis.step": None,
    "analysis.method": None,
    "analysis.duration": "40 s",
    "analysis.accuracy": "3 %",
}


@pytest.fixture
def scene():
    return read_scene(SCENE).with_values(SETS, "test").resolved()


@pytest.mark.parametrize("step", [0.4, 0.1, 0.03, 0.01])
def test_outputs_that_stay_are_among_those_asked_for_and_often_enough(scene, step):
    less, thin = thinned(scene, step)
    every = less.analysis.output.interval / scene.analysis.output.interval
    assert every == 2 ** round(np.log2(every))
    assert thin == (every > 1)
    longest = min(period(scene) / A_PERIOD, STEPS * step)
    assert not thin or 0.5 * longest < less.analysis.output.interval <= longest


def test_thinned_runs_differ_as_whole_ones_do(scene):
    mesh, step = coarsest_mesh(scene), 0.1
    meshes = mesh, mesh.halved()
    whole = difference(*(march(scene, one, step) for one in meshes))
    less, _ = thinned(scene, step)
    few = difference(*(march(less, one, step) for one in meshes))
    mixed = difference(march(less, meshes[0], step), march(scene, meshes[1], step))
    assert few == pytest.approx(mixed, rel=1e-12)
    for name in whole:  # the largest of fewer differences, and the same envelopes
        assert 0.9 * whole[name] <= few[name] <= whole[name]


@pytest.mark.parametrize("foreseen", [True, False])
def test_what_is_given_holds_all_outputs(scene, monkeypatch, foreseen):
    if not foreseen:
        monkeypatch.setattr(Convergence, "may_suffice", False)
    found = run(scene)
    runs = found.facts["refinements"]
    repeated = runs[-1]["elements"] == runs[-2]["elements"] and runs[-1]["step"] == runs[-2]["step"]
    assert repeated != foreseen
    mesh = coarsest_mesh(scene)
    while len(mesh.l0) < found.facts["elements"]:
        mesh = mesh.halved()
    alone = single(scene, mesh, found.facts["step"])
    assert set(found.arrays) == set(alone.arrays)
    for name, values in alone.arrays.items():
        np.testing.assert_array_equal(found.arrays[name], values)
    assert found.facts["extremes"] == alone.facts["extremes"]


def test_what_patience_ends_says_which_outputs_are_not_there(scene, monkeypatch):
    ends = iter([False] * 4 + [True] * 9)

    class Short(Watch):
        @contextmanager
        def over(self, record, sums):
            sums.stop[0] = int(next(ends))
            yield

    monkeypatch.setattr(Convergence, "may_suffice", False)
    found = Refinement(scene, Short(1000.0)).result()
    assert found.facts["ended_by"] == "patience of 1000 s"
    apart = found.arrays["time"][1] - found.arrays["time"][0]
    assert apart > 2.0 * scene.analysis.output.interval
    assert any(f"outputs are {apart:g} s apart" in text for text in sentences(found.facts["warnings"]))
