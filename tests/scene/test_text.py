"""Only regular text files are read: no links, no devices, nothing that waits, nothing that runs."""

import os
from itertools import pairwise

import pytest

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.text import read_text
from riserstudy.scene.tables import fill_in_tables


def link(path):
    path.with_name("other").write_text("a: 1")
    path.symlink_to("other")


KINDS = {
    "a link": (link, "a symbolic link"),
    "a link to itself": (lambda path: path.symlink_to(path), "a symbolic link"),
    "a pipe that nobody fills": (os.mkfifo, "not a regular file"),
    "a folder": (lambda path: path.mkdir(), "directory"),
    "a large file": (lambda path: path.write_bytes(bytes(101)), "larger"),
    "bytes": (lambda path: path.write_bytes(b"a\xff"), "byte 1 is not UTF-8 text"),
    "nothing": (lambda path: None, "No such file"),
}


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_no_text_file_is_refused(kind, tmp_path):
    make, why = KINDS[kind]
    path = tmp_path / "scene.yaml"
    make(path)
    with pytest.raises(InputError, match=why):
        read_text(path, 100, named_in_scene=True)


@pytest.mark.parametrize("name", ["/dev/zero", "a\0b", "x" * 300])
def test_a_name_of_no_file_is_refused(name, tmp_path):
    with pytest.raises(InputError):
        read_text(tmp_path / name, 100)


BOMBS = {
    "aliases": "a: &a [1, 1]\n" + "".join(f"{y}: &{y} [*{x}, *{x}]\n" for x, y in pairwise("abcdefgh")),
    "an alias of itself": "a: &a [*a]",
    "a merge": "a: &a {b: 1}\nc: {<<: *a}",
    "a tag": "a: !!python/object/apply:os.system ['true']",
    "deep lists": "a: " + "[" * 5000,
    "deep mappings": "{a: " * 5000,
    "deep blocks": "".join(" " * k + "a:\n" for k in range(900)),
    "a number of many digits": "a: " + "9" * 5000,
    "infinity": "a: 1e400",
}


@pytest.mark.parametrize("kind", BOMBS)
def test_a_bomb_is_refused(kind, tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(BOMBS[kind])
    with pytest.raises(InputError) as refusal:
        read_yaml(path)
    assert len(str(refusal.value)) < 1000


@pytest.mark.parametrize("name", ["/etc/passwd", "../secret", "", 3, None])
def test_only_tables_are_read_as_tables(name, tmp_path):
    with pytest.raises(InputError, match="csv"):
        fill_in_tables({"current": {"profile": {"file": name}}}, tmp_path)
