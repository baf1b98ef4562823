"""An effect that a scene does not call for costs nothing and changes nothing."""

from pathlib import Path

import numpy as np
import pytest
from rig import FILES

import riserstudy.simulation.equilibrium
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
UNLOADED = {name: make for file in FILES for name, make in getattr(file, "UNLOADED", {}).items()}


def history(monkeypatch, *extra):
    """Histories of the surge with effects added by hand."""

    def with_extra(scene, mesh, elevation=None, d=None):
        model = build(scene, mesh, elevation, d)
        # Under a name of their own: statics goes to its tolerance another way where there is a current.
        more = [Effect(f"no {name}", UNLOADED[name](N), "test") for name in extra]
        pairs = [tuple(pair) for pair in model.fixed]
        built = type(model)(model.unknowns, [*more, *model.effects], pairs)
        built.s.r[:] = model.s.r
        return built

    monkeypatch.setattr(riserstudy.simulation.equilibrium, "build", with_extra)
    scene = SURGE.resolved()
    return single(scene, even(scene, N), scene.analysis.step, True).arrays


@pytest.mark.parametrize("effect", UNLOADED)
def test_an_effect_of_no_load_changes_nothing(effect, monkeypatch):
    without, full = history(monkeypatch), history(monkeypatch, effect)
    for name in ("x", "z", "effective_tension", "bending_moment"):
        off = np.abs(full[name] - without[name]).max()
        assert off <= 1e-12 * np.abs(without[name]).max()


def test_a_model_calls_the_effects_of_its_scene_and_no_others():
    scene = SURGE.resolved()
    model = build(scene, even(scene, N), 533.0)
    on = {row.name for row in ledger(scene) if row.on} - {"lateral freedom"}
    assert {effect.name for effect in model.effects} == on
    addresses = {record.address for record in model.records}
    for program in model.programs.value:
        assert {int(record) for _, record in program} <= addresses


def test_an_effect_taken_out_takes_its_calls_with_it():
    calls = []
    for values in ({}, {"riser[0].drag": None}, {"riser[0].drag": None, "riser[0].added_mass": None}):
        scene = SURGE.with_values(values, "test").resolved()
        model = build(scene, even(scene, N), 533.0)
        calls.append(sum(len(program) for program in model.programs.value))
    drag, added_mass = 3, 3  # force, tangent, power; inertia, mass, kinetic energy
    assert calls[0] - calls[1] == drag
    assert calls[1] - calls[2] == added_mass
