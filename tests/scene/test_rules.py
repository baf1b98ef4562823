"""Rules say where a fault is, whatever is taken out of a scene or put in from another."""

import random
from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.scene.error_source import is_known
from riserstudy.scene.load import read_scene
from riserstudy.scene.parts import Parts
from riserstudy.scene.paths import leaves
from riserstudy.scene.tables import names_of_tables

CONFIG = Path(__file__).parents[2] / "config"
SCENES = [read_scene(path) for path in sorted((CONFIG / "scenes").glob("*/*.yaml"))]
SEEDS = range(400)


def broken(seed):
    """A scene of the repository in which something is missing, or that has something of another."""
    draw = random.Random(seed)
    scene, other = draw.sample(SCENES, 2)
    changes = {}
    for _ in range(draw.randint(1, 3)):
        if draw.random() < 0.5:
            changes[draw.choice([path for path, _ in leaves(scene.tree)])] = None
        else:
            names = [n for n in sorted(other.tree) if not [*names_of_tables(other.tree[n])]]
            name = draw.choice(names)  # tables lie beside their own scene
            changes[name] = other.tree[name]
    return scene, changes


def fault(scene):
    """What is wrong with a scene, None where nothing is."""
    try:
        scene.resolved()
    except InputError as error:
        return error
    return None


@pytest.mark.parametrize("seed", SEEDS)
def test_a_fault_has_a_place_and_two_parts(seed):
    scene, changes = broken(seed)
    try:
        changed = scene.with_values(changes, "changes")
    except InputError:  # what was to be changed went with what was before
        return
    error = fault(changed)
    if error is None:
        return
    assert error.found
    assert error.allowed
    assert all(is_known(path) for path in (error.field, *error.also) if path), error
    file = type(changed)(changed.source, changed.tree)  # as if it were written so
    same = fault(file)
    assert (same.field, same.found, same.allowed) == (error.field, error.found, error.allowed)
    assert same.where == scene.source


def test_some_of_them_are_faults_of_rules():
    errors = [fault(scene.with_values(changes, "changes")) for scene, changes in _whole()]
    fields = {error.field for error in errors if error and error.also}
    assert len(fields) > 15, fields


def _whole():
    for seed in SEEDS:
        scene, changes = broken(seed)
        try:
            scene.with_values(changes, "changes")
        except InputError:
            continue
        yield scene, changes


def test_sections_know_their_lines():
    for scene in SCENES:
        written, resolved = scene.scene(), scene.resolved()
        assert isinstance(resolved, Parts)
        lines = [section.line for section in resolved.riser]
        assert set(lines) - {"bottom.body"} == {f"riser[{k}]" for k in range(len(written.riser))}
        for section in resolved.riser:
            if section.line != "bottom.body":
                k = int(section.line[6:-1])
                assert section.name.startswith(written.riser[k].name)
