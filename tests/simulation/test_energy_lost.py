"""A run whose energy balance does not hold is no result, however well each step converged."""

import pytest
from random_rigs import moving, written

from riserstudy.errors import SimulationError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation import run as module
from riserstudy.simulation.refine import run


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_a_run_that_gains_energy_is_refused(seed, spatial, monkeypatch):
    """Rigs in motion; a twentieth of the energy is warned of, twice all of it is refused."""
    tree = moving(seed, spatial=spatial, conductor=False)
    tree["analysis"]["mesh"]["elements"] *= 5
    scene = SceneFile("rig.yaml", written(tree)).resolved()
    kept = run(scene, estimated=False).facts["audit"]
    assert kept["unexplained_share"] < 1e-3
    energy = module.audit.energy

    def with_gain(share):
        def entered(facts, sums, before, after, step):
            energy(facts, sums, before, after + share * kept["exchanged"], step)

        return entered

    monkeypatch.setattr(module.audit, "energy", with_gain(0.05))
    found = run(scene, estimated=False).facts
    assert any("energy" in warning for warning in found["warnings"])
    monkeypatch.setattr(module.audit, "energy", with_gain(2.0))
    with pytest.raises(SimulationError, match="the balance does not account for"):
        run(scene, estimated=False)
