"""On a full disk a command leaves what was there, and nothing half written."""

import errno
from pathlib import Path
from types import SimpleNamespace

import pytest
from drawn_decks import drawn
from ruamel.yaml import YAML

from riserstudy.dataset.netcdf import written_whole
from riserstudy.errors import SimulationError
from riserstudy.files.whole import whole_file
from riserstudy.study.write_tuned import write_tuned

STUDY = "paper: own\nstudies:\n  heave:\n    set: {analysis.accuracy: 1 %}  # as agreed\n    axes: {}\n"


@pytest.fixture
def full(monkeypatch):
    """From its call on, files are written by half."""
    write = Path.write_text

    def half(path, text, *arguments, **named):
        write(path, text[: len(text) // 2], *arguments, **named)
        raise OSError(errno.ENOSPC, "No space left on device")

    return lambda: monkeypatch.setattr(Path, "write_text", half)


@pytest.fixture
def full_for_bytes(monkeypatch):
    def no_room(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    return lambda: monkeypatch.setattr(Path, "write_bytes", no_room)


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("command, target", [("export", "deck.yml"), ("import", "back.yaml")])
def test_a_model_or_scene_is_whole_or_as_it_was(commands, full, tmp_path, seed, command, target):
    YAML().dump(drawn(seed), tmp_path / "scene.yaml")
    assert commands("export", tmp_path / "scene.yaml", "-o", tmp_path / "deck.yml")[0] == 0
    assert commands("import", tmp_path / "deck.yml", "-o", tmp_path / "back.yaml")[0] == 0
    before = files(tmp_path)
    full()
    source = tmp_path / ("scene.yaml" if command == "export" else "deck.yml")
    code, _, said = commands(command, source, "-o", tmp_path / target, "--force")
    assert (code, said.count("\n")) == (3, 1)
    assert "see whether the disk is full" in said
    assert files(tmp_path) == before


def test_a_study_file_that_tuning_writes_into_is_whole_or_as_it_was(full, tmp_path):
    path = tmp_path / "own.yaml"
    path.write_text(STUDY)
    path.chmod(0o640)
    YAML().dump(drawn(0), tmp_path / "scene.yaml")
    found = SimpleNamespace(setting=SimpleNamespace(analysis={"step": "0.1 s"}))
    model = SimpleNamespace(scene="scene.yaml")
    study = SimpleNamespace(name="heave", config=tmp_path, model=model)
    write_tuned(path, study, found, {"accuracy": "1 %"})
    assert "tuned: {accuracy: 1 %}" in path.read_text()
    assert path.stat().st_mode & 0o777 == 0o640
    before = files(tmp_path)
    full()
    with pytest.raises(SimulationError, match="see whether the disk is full"):
        write_tuned(path, study, found, {"accuracy": "2 %"})
    assert files(tmp_path) == before


@pytest.mark.parametrize("said", ["the file is read-only", "NetCDF: HDF error"])
def test_a_dataset_on_a_full_disk_is_not_called_forbidden(full_for_bytes, tmp_path, said):
    def write():
        with written_whole(tmp_path / "one.nc"):
            full_for_bytes()
            raise PermissionError(errno.EACCES, said)

    with pytest.raises(SimulationError, match="No space left on device; see whether the disk"):
        write()
    assert files(tmp_path) == {}


@pytest.mark.parametrize("writer", [whole_file, written_whole])
def test_of_a_system_that_is_read_only_it_is_told(monkeypatch, tmp_path, writer):
    def refused(*_, **__):
        raise OSError(errno.EROFS, "Read-only file system")

    def write():
        with writer(tmp_path / "one.zip") as path:
            path.write_bytes(b"")

    monkeypatch.setattr(Path, "write_bytes", refused)
    monkeypatch.setattr(Path, "unlink", refused)
    with pytest.raises(SimulationError, match=r"one.zip cannot be written: Read-only file system"):
        write()


def test_a_folder_that_was_not_filled_can_be_made_later(commands, full, monkeypatch, tmp_path):
    full()
    code, _, said = commands("new", tmp_path / "own")
    assert (code, said.count("\n")) == (2, 1)
    monkeypatch.undo()
    assert not any((tmp_path / "own").iterdir())
