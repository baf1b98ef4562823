"""The list of effects is that of the files, and small scenes compile all of them beforehand."""

import pytest

from riserstudy.effects.catalogue import catalogue, changes
from riserstudy.effects.registry import NAMES, ROLES, Called, call, register
from riserstudy.model.build import build
from riserstudy.model.disconnect import fading, stack_contact
from riserstudy.model.draining import draining
from riserstudy.model.mesh import even
from riserstudy.scene.models import Scene
from riserstudy.simulation.warm_up import scenes

WITHOUT_A_RECORD = {"lateral freedom"}


def built():
    """Effects of small scenes, before and after what lets go."""
    for scene in [scene for group in scenes().values() for scene in group]:
        mesh = even(scene, 4)
        model = build(scene, mesh, ring_elevation=100.0)
        yield from model.effects
        if scene.disconnect:
            model.s.moment[:] = 1.0
            yield from fading(model, 0.5, 0.2)
            yield from stack_contact(scene)
            if scene.disconnect.drain:
                yield from draining(scene, mesh, model)


BUILT = list(built())


def test_every_effect_of_a_model_is_registered_under_its_name():
    for effect in BUILT:
        assert effect.name in NAMES[type(effect.record)]


def test_scenes_that_compile_kernels_have_every_effect():
    assert {effect.name for effect in BUILT} | WITHOUT_A_RECORD == set(catalogue())
    exchanged = {kind for kind in ROLES if not NAMES[kind]}  # between a riser and a vessel
    assert {type(effect.record) for effect in BUILT} == set(ROLES) - exchanged


def test_names_lead_to_effects():
    assert {name for names in NAMES.values() for name in names} <= set(catalogue())


def test_a_name_belongs_to_one_effect():
    call(catalogue()["guide"])  # the same again
    with pytest.raises(TypeError, match="two effects are called 'guide'"):
        call(Called("guide", "elsewhere"))
    with pytest.raises(TypeError, match="no such role"):
        register(Scene, Called("new", "new"), dance=print)
    assert "new" not in catalogue()


def test_changes_have_names_of_their_own():
    labels = [change.label for change in changes()]
    assert len(set(labels)) == len(labels)
    assert labels == [*sorted(labels, key=lambda x: x.startswith("with "))]
