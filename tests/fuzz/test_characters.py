"""Texts of a scene are text: none controls a terminal, none is half of a character, which no file has."""

import json
import random

import pytest
from random_rigs import moving, written
from ruamel.yaml import YAML

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import plain_yaml
from riserstudy.scene.load import read_scene

PLAIN = [*"aZ9 =+-@$%&'\"\\{}[]#:,|>~", "\t", "\n", "é", "ß", "–", "°", "水", "\u2028", "😀", "𝛼"]
WRONG = ["\x00", "\x07", "\x08", "\x1b[31m", "\x1f", "\x7f", "\x9b2J", "\ud83d", "\ude00", "\ud83dx", "\x80"]


def text(seed, *also):
    draw = random.Random(seed)
    signs = [draw.choice(PLAIN) for _ in range(draw.randrange(1, 30))]
    for one in also:
        signs.insert(draw.randrange(len(signs) + 1), one)
    return f"a{''.join(signs)}b"


def scene(folder, seed, title, name):
    """A file in JSON, with escapes for all but ASCII, as other programs write it."""
    tree = written(moving(seed))
    tree["title"], tree["riser"][0]["name"] = title, name
    path = folder / "scene.yaml"
    path.write_text(json.dumps(tree), "ascii")
    return path


@pytest.mark.parametrize("seed", range(6))
def test_text_is_read_as_it_was_written(tmp_path, seed):
    title, name = text(seed), text(seed + 100)
    file = read_scene(scene(tmp_path, seed, title, name))
    assert (file.tree["title"], file.tree["riser"][0]["name"]) == (title, name)
    file.tree["title"].encode(), file.resolved().riser[0].name.encode()


@pytest.mark.parametrize("seed, wrong", list(enumerate(WRONG)))
@pytest.mark.parametrize("field", ["title", "riser[0].name"])
def test_what_is_no_text_is_refused_with_its_field(tmp_path, seed, wrong, field):
    texts = {"title": text(seed), "riser[0].name": text(seed + 100)}
    texts[field] = text(seed, wrong)
    path = scene(tmp_path, seed, texts["title"], texts["riser[0].name"])
    with pytest.raises(InputError) as refused:
        read_scene(path)
    assert (refused.value.where, refused.value.field) == (str(path), field)
    assert str(refused.value).isprintable()
    assert f"U+{ord(next(c for c in wrong if not c.isprintable())):04X}" in str(refused.value)


@pytest.mark.parametrize("wrong", WRONG)
def test_names_of_keys_are_text(wrong):
    source = json.dumps({f"key{wrong}": 1})
    with pytest.raises(InputError, match="U\\+"):
        plain_yaml(source, "file")
    assert YAML(typ="safe", pure=True).load(source)  # a file that YAML itself allows
