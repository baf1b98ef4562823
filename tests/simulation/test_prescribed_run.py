"""The error that a run with its own mesh and step tells, beside runs that are much finer."""

from pathlib import Path

import pytest

from riserstudy.errors import SimulationError
from riserstudy.records.warning import sentences
from riserstudy.scene.load import read_scene
from riserstudy.simulation import prescribed_run as module
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run

SCENES = Path(__file__).parents[2] / "config/scenes"
SUDDEN_WAVE = {  # its jolt leaves an error of the step that does not fall, behind one of the mesh that does
    "analysis.duration": "12 s",
    "analysis.output.interval": "0.5 s",
    "vessel.thrusters": None,
}
SURGE = {"analysis.duration": "30 s", "analysis.output.interval": "0.5 s"}


def of(scene, values, segments, step):
    """The scene with a mesh and a step."""
    own = {"analysis.mesh.elements": segments, "analysis.step": f"{step} s"}
    return read_scene(SCENES / scene).with_values(values | own, "test").resolved()


@pytest.mark.long
@pytest.mark.parametrize(
    "scene, values, segments, step",
    [("liu2017/ref_0.yaml", SUDDEN_WAVE, 428, 0.05), ("bench/s2c.yaml", SURGE, 64, 0.1)],
)
def test_the_error_told_is_that_beside_a_much_finer_run(scene, values, segments, step):
    asked = run(of(scene, values, segments, step))
    finest = run(of(scene, values, 4 * segments, step / 16), estimated=False)
    off = difference(asked, finest)
    told = asked.facts["error_estimate"]
    for name in ("displacement", "moment"):
        assert 0.8 * off[name] <= told[name] <= 5.0 * off[name]


def test_an_error_of_the_step_alone_is_not_that_of_a_run(monkeypatch):
    """Where a coarser mesh cannot be run no error is told, though one of the step is known."""
    march = module.march

    def only_as_fine(scene, mesh, step, **options):
        if len(mesh.l0) < 64:
            raise SimulationError("no equilibrium")
        return march(scene, mesh, step, **options)

    monkeypatch.setattr(module, "march", only_as_fine)
    result = run(of("bench/s2c.yaml", SURGE, 64, 0.1))
    assert result.facts["error_estimate"] == {}
    assert "error is not estimated" in sentences(result.facts["warnings"])[-1]
