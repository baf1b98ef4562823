"""What other systems lack, imitated here: the package does its work, and finds the same numbers."""

import os
from pathlib import Path

import pytest
from short_study import lay_out, numbers, same, shared_kernels, snakemake

from riserstudy.errors import InputError
from riserstudy.scene.load import read_scene
from riserstudy.study.read import read_studies
from riserstudy.study.store import key_of

HIDDEN = Path(__file__).with_name("hidden")


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """The study where nothing is hidden."""
    folder = tmp_path_factory.mktemp("plain") / "a study"
    lay_out(folder)
    cache = shared_kernels(folder.parent / "cache")
    status, said = snakemake(folder, os.environ | {"RISERSTUDY_CACHE": str(cache)})
    assert status == 0, said
    return folder


@pytest.mark.parametrize(
    "name", ["..\\riser.yaml", "scenes\\riser.yaml", "C:\\riser.yaml", "C:/riser.yaml", "/riser.yaml"]
)
def test_a_study_names_its_scene_as_every_system_does(tmp_path, name):
    lay_out(tmp_path / "study")
    file = tmp_path / "study/config/studies/example.yaml"
    text = file.read_text("utf-8").replace("scene: scenes/riser.yaml", f"scene: '{name}'")
    file.write_text(text, "utf-8")
    with pytest.raises(InputError, match=r"studies\.tension\.scene: .*(below this folder|/ between)"):
        read_studies(tmp_path / "study/config", "example")


@pytest.mark.parametrize("name", ["tables\\current.csv", "C:\\current.csv", "C:/current.csv"])
def test_a_scene_names_its_tables_as_every_system_does(tmp_path, name):
    lay_out(tmp_path / "study")
    file = tmp_path / "study/config/scenes/riser.yaml"
    file.write_text(file.read_text("utf-8").replace("current.csv", f"'{name}'"), "utf-8")
    with pytest.raises(InputError, match="/ between folders"):
        read_scene(file).resolved()


@pytest.mark.parametrize("ends", ["\r\n", "\n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_line_ends_and_marks_of_spreadsheets_change_no_scene(tmp_path, ends, mark):
    lay_out(tmp_path / "plain")
    lay_out(tmp_path / "other", ends)
    for name in ("riser.yaml", "current.csv"):
        file = tmp_path / "other/config/scenes" / name
        file.write_bytes(mark.encode() + file.read_bytes())
    read = [read_scene(tmp_path / n / "config/scenes/riser.yaml").resolved() for n in ("plain", "other")]
    assert key_of(read[0]) == key_of(read[1])


@pytest.mark.slow
def test_a_study_runs_without_locks_forks_and_sockets_of_posix(plain, tmp_path):
    folder = tmp_path / "ein Riser – größer"
    lay_out(folder, ends="\r\n")  # as an editor elsewhere writes them
    cache = shared_kernels(tmp_path / "cache")
    environment = os.environ | {"RISERSTUDY_CACHE": str(cache), "PYTHONPATH": str(HIDDEN)}
    status, said = snakemake(folder, environment)
    assert status == 0, said
    assert same(numbers(folder), numbers(plain))
    assert (folder / "results/report.html").exists()
    assert not (folder / "logs/server.log").exists()
    status, said = snakemake(folder, environment)
    assert "Nothing to be done" in said
