"""Misspelt keys of scenes: they are refused, and the error names the key that was meant."""

import random
from difflib import SequenceMatcher
from pathlib import Path

import pytest
import yaml

from riserstudy.errors import InputError
from riserstudy.scene.load import read_scene
from riserstudy.scene.origin import COMPANIONS

SCENES = [p for p in sorted(Path("config/scenes").rglob("*.yaml")) if "file:" not in p.read_text()]
# the error names all keys that may stand beside these
OF_ORIGINS = set(COMPANIONS).union(*COMPANIONS.values())


def misspelt(key: str, draw: random.Random) -> str:
    """Drop, double or exchange one letter."""
    k = draw.randrange(1, len(key) - 1)
    return draw.choice(
        [key[:k] + key[k + 1 :], key[:k] + key[k] + key[k:], key[:k] + key[k + 1] + key[k] + key[k + 2 :]]
    )


def places(tree: object, place: tuple = ()) -> list[tuple]:
    """Place of every key of mappings and lists."""
    if isinstance(tree, dict):
        return [p for key, part in tree.items() for p in [(*place, key), *places(part, (*place, key))]]
    if isinstance(tree, list):
        return [p for k, part in enumerate(tree) for p in places(part, (*place, k))]
    return []


def rename(tree, place: tuple, key: str) -> None:
    *before, last = place
    for step in before:
        tree = tree[step]
    tree[key] = tree.pop(last)


@pytest.mark.parametrize("seed", range(80))
def test_an_error_names_the_key_of_a_scene_that_was_meant(seed, tmp_path):
    draw = random.Random(seed)
    path = draw.choice(SCENES)
    tree = yaml.safe_load(path.read_text())
    place = draw.choice([p for p in places(tree) if len(str(p[-1])) > 3 and p[-1] not in OF_ORIGINS])
    key = misspelt(place[-1], draw)
    if key == place[-1]:
        return
    rename(tree, place, key)
    changed = tmp_path / "scene.yaml"
    changed.write_text(yaml.safe_dump(tree, sort_keys=False))
    with pytest.raises(InputError, match="unknown key") as error:
        read_scene(changed).resolved()
    named = error.value.allowed.split()[1].rstrip(",")
    alike = SequenceMatcher(None, key, named).ratio()
    assert named == place[-1] or alike > SequenceMatcher(None, key, place[-1]).ratio()
