"""An effect that a scene does not call for costs nothing and changes nothing."""

from pathlib import Path

import numpy as np
import pytest

import riserstudy.simulation.equilibrium
from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.axial_damping import AxialDamping
from riserstudy.effects.bending_damping import BendingDamping
from riserstudy.effects.current import Current
from riserstudy.effects.dead_load import DeadLoad
from riserstudy.effects.drag import Drag
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.inertia import Inertia
from riserstudy.effects.platform_motion import Position
from riserstudy.effects.tangential_drag import TangentialDrag
from riserstudy.effects.tension_loss import TensionLoss
from riserstudy.effects.wave_force import WaveForce
from riserstudy.effects.weight import Weight
from riserstudy.model.active_effects import ledger
from riserstudy.model.build import build
from riserstudy.model.mesh import even
from riserstudy.model.model import Effect
from riserstudy.scene.load import read_scene
from riserstudy.simulation.run import single

SURGE = read_scene(Path(__file__).parents[2] / "config/scenes/hard/surge.yaml").with_values(
    {"analysis.mesh.elements": 20, "analysis.step": "0.1 s", "analysis.duration": "20 s"}, "test"
)
N = 20
LINE, NODES, FIELD = np.zeros(N), np.zeros(N + 1), np.zeros((2, N + 1))
ZERO_LOAD = {
    "drag": lambda: Drag(LINE.copy(), LINE.copy(), FIELD.copy(), 0),
    "tangential drag": lambda: TangentialDrag(LINE.copy()),
    "added mass": lambda: AddedMass(LINE.copy(), LINE.copy(), 0),
    "inertia": lambda: Inertia(LINE.copy(), LINE.copy()),
    "wave force": lambda: WaveForce(LINE.copy(), FIELD.copy()),
    "weight": lambda: Weight(1, NODES.copy()),
    "axial damping": lambda: AxialDamping(LINE.copy()),
    "bending damping": lambda: BendingDamping(0.0, NODES[None].copy(), NODES[None].copy()),
    "lateral force": lambda: DeadLoad(N, np.zeros(2)),
    "tension loss": lambda: TensionLoss(N, np.zeros(2), 1.0, 1.0),
    "end mass": lambda: EndMass(N, 0.0, np.zeros(2), np.zeros(2)),
    "current": lambda: Current(
        np.array([0.0, 533.0]), np.zeros(2), np.array([1.0]), np.zeros(N + 1, np.int64), 0.0
    ),
    "platform position": lambda: Position(np.zeros(6)),
}


def history(monkeypatch, *extra):
    """Histories of the surge with effects added by hand."""

    def with_extra(scene, mesh, elevation=None, d=None):
        model = build(scene, mesh, elevation, d)
        # Under a name of their own: statics goes to its tolerance another way where there is a current.
        more = [Effect(f"no {name}", ZERO_LOAD[name](), "test") for name in extra]
        pairs = [tuple(pair) for pair in model.fixed]
        built = type(model)(model.unknowns, [*more, *model.effects], pairs)
        built.s.r[:] = model.s.r
        return built

    monkeypatch.setattr(riserstudy.simulation.equilibrium, "build", with_extra)
    scene = SURGE.scene()
    return single(scene, even(scene, N), scene.analysis.step, True).arrays


@pytest.mark.parametrize("effect", ZERO_LOAD)
def test_an_effect_of_no_load_changes_nothing(effect, monkeypatch):
    without, full = history(monkeypatch), history(monkeypatch, effect)
    for name in ("x", "z", "effective_tension", "bending_moment"):
        off = np.abs(full[name] - without[name]).max()
        assert off <= 1e-12 * np.abs(without[name]).max()


def test_a_model_calls_the_effects_of_its_scene_and_no_others():
    scene = SURGE.scene()
    model = build(scene, even(scene, N), 533.0)
    on = {row.name for row in ledger(scene) if row.on} - {"lateral freedom"}
    assert {effect.name for effect in model.effects} == on
    addresses = {record.address for record in model.records}
    for program in model.programs.value:
        assert {int(record) for _, record in program} <= addresses


def test_an_effect_taken_out_takes_its_calls_with_it():
    calls = []
    for values in (
        {},
        {"riser[0].drag": None},
        {"riser[0].drag": None, "riser[0].added_mass": None},
    ):
        scene = SURGE.with_values(values, "test").scene()
        model = build(scene, even(scene, N), 533.0)
        calls.append(sum(len(program) for program in model.programs.value))
    drag, added_mass = 3, 3  # force, tangent, power; inertia, mass, kinetic energy
    assert calls[0] - calls[1] == drag
    assert calls[1] - calls[2] == added_mass
