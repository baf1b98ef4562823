"""Effects that are off say what is missing, and nothing that is there."""

from pathlib import Path

from riserstudy.effects.catalogue import catalogue
from riserstudy.model.absent_effects import absent
from riserstudy.model.active_effects import ledger
from riserstudy.scene.load import read_scene

STILL = Path(__file__).parents[2] / "config/scenes/liu2020/system.yaml"


def test_a_riser_with_bending_stiffness_that_nothing_moves_sideways_is_not_said_to_lack_it():
    scene = read_scene(STILL).resolved()
    assert not scene.lateral
    off = {row.name: row.because for row in ledger(scene) if not row.on}
    assert off["bending"] == off["lateral freedom"] == "no lateral load or motion"
    assert off["wave"] == "no wave"


def test_a_riser_that_moves_sideways_lacks_what_is_missing_and_not_the_freedom():
    off = absent({"bending", "inertia"})
    assert off["drag"] == "no riser.drag"
    assert "lateral freedom" not in off


def test_every_effect_is_on_or_off():
    assert set(absent({"drag"})) | {"drag", "lateral freedom"} == set(catalogue())
