"""Inputs of a received crate are compared with their checksums: each that differs is named, in one line."""

import hashlib
import json
import random

import pytest

from riserstudy.crate.received import changed_inputs, inputs_in
from riserstudy.errors import InputError

NAME = "ro-crate-metadata.json"


def received(folder, draw):
    """A folder as unpacked, with a description by RO-Crate 1.1; the names of its inputs."""
    names = ["Snakefile", "config/config.yaml", "config/scenes/a riser.yaml", "chapters/ü/claims.py"]
    names += [f"config/studies/{k}.yaml" for k in range(draw.randint(1, 4))]
    entities = []
    for name in names:
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(draw.randbytes(draw.randint(1, 200)))
        quoted = name.replace(" ", "%20").replace("ü", "%C3%BC")
        checksum = hashlib.sha256(file.read_bytes()).hexdigest()
        entities.append({"@id": quoted, "@type": "File", "sha256": checksum})
    first, *others = ({"@id": entity["@id"]} for entity in entities)
    run = {"@id": "#run", "@type": "CreateAction", "instrument": first, "object": others}
    (folder / NAME).write_text(json.dumps({"@graph": [*entities, run]}))
    return names


def faults(folder):
    return [*changed_inputs(folder, inputs_in(folder))]


@pytest.mark.parametrize("seed", range(12))
def test_each_changed_or_missing_input_is_named(tmp_path, seed):
    draw = random.Random(seed)
    names = received(tmp_path, draw)
    assert faults(tmp_path) == []
    spoilt = draw.sample(names, draw.randint(1, 3))
    for name in spoilt:
        file = tmp_path / name
        content = bytearray(file.read_bytes())
        if draw.random() < 0.3:
            file.unlink()
            continue
        content[draw.randrange(len(content))] ^= 1 << draw.randrange(8)
        file.write_bytes(content)
    found = faults(tmp_path)
    assert len(found) == len(spoilt)
    for name in spoilt:
        assert sum(line.startswith(f"{tmp_path / name}: ") for line in found) == 1


def test_a_folder_that_was_not_received_has_nothing_to_compare(tmp_path):
    assert faults(tmp_path) == []


@pytest.mark.parametrize("name", ["../secret", "/etc/passwd", "config/../../secret"])
def test_a_description_of_files_elsewhere_is_not_followed(tmp_path, name):
    received(tmp_path, random.Random(0))
    file = tmp_path / NAME
    file.write_text(file.read_text().replace("config/config.yaml", name))
    (line,) = faults(tmp_path)
    assert "outside of the crate" in line


@pytest.mark.parametrize("seed", range(12))
def test_a_damaged_description_is_refused_by_name(tmp_path, seed):
    draw = random.Random(seed)
    received(tmp_path, draw)
    file = tmp_path / NAME
    content = file.read_bytes()
    spoilt = [content[: draw.randrange(len(content) - 1)], b"", b"[]", b'{"@graph": 3}', b'{"@graph": [{}]}']
    file.write_bytes(draw.choice([*spoilt, content.replace(b"sha256", b"sha1"), b"\xff\xfe"]))
    with pytest.raises(InputError, match="not the description of a run crate"):
        inputs_in(tmp_path)
