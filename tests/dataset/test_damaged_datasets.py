"""A dataset with a wrong bit is refused by every command that reads one, and never gives another number."""

import os
import random
import subprocess
import sys

import netCDF4
import pytest
from random_rigs import moving, written

from riserstudy.dataset.label import to_dataset
from riserstudy.dataset.netcdf import LINE, MARK
from riserstudy.dataset.open import open_dataset, open_results
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

BITS = 60  # flipped per rig


@pytest.fixture(scope="module", params=range(4))
def dataset(request, tmp_path_factory):
    """The run of a rig on inclined cylinders, in plane or space, as `run` writes it."""
    tree = moving(request.param, spatial=bool(request.param % 2))
    file = SceneFile("rig.yaml", written(tree))
    path = tmp_path_factory.mktemp("rig") / "run.nc"
    write_dataset(to_dataset(run(file.resolved(), estimated=False), file, {}), path)
    return request.param, path


def test_a_flipped_bit_is_refused_or_of_no_account(dataset, tmp_path):
    seed, path = dataset
    draw, whole, right = random.Random(seed), path.read_bytes(), open_dataset(path)
    copy, refused = tmp_path / "copy.nc", 0
    for place in draw.sample(range(len(whole)), BITS):
        spoilt = bytearray(whole)
        spoilt[place] ^= 1 << draw.randrange(8)
        copy.write_bytes(spoilt)
        try:
            assert open_dataset(copy).identical(right), place
        except InputError:
            refused += 1
    assert refused >= BITS - 5  # a bit of the mark itself changes no number


def test_a_tree_of_results_has_no_damaged_dataset(dataset, tmp_path):
    seed, path = dataset
    draw, whole = random.Random(seed), path.read_bytes()
    copy = tmp_path / "rig" / "copy.nc"
    copy.parent.mkdir()
    copy.write_bytes(whole)
    with open_results(tmp_path) as tree:
        assert tree["rig/copy"].to_dataset().load().sizes == open_dataset(path).sizes
    for place in draw.sample(range(len(whole) - LINE), 20):
        spoilt = bytearray(whole)
        spoilt[place] ^= 1 << draw.randrange(8)
        copy.write_bytes(spoilt)
        with pytest.raises(InputError, match=r"copy\.nc: the file is damaged"):
            open_results(tmp_path)


@pytest.mark.parametrize("words", [("statistics", "-o", "x.csv"), ("table", "-o", "x.csv")])
def test_commands_name_the_damaged_file(dataset, commands, tmp_path, monkeypatch, words):
    seed, path = dataset
    monkeypatch.chdir(tmp_path)
    spoilt = bytearray(path.read_bytes())
    spoilt[random.Random(seed).randrange(len(spoilt) - LINE)] ^= 4
    (tmp_path / "spoilt.nc").write_bytes(spoilt)
    code, _, said = commands(words[0], "spoilt.nc", *words[1:])
    assert code == 2
    assert "spoilt.nc: the file is damaged; repeat the command that writes it" in said
    assert not (tmp_path / "x.csv").exists()


@pytest.mark.long
@pytest.mark.parametrize(
    "words",
    [
        *(("statistics", "pipe.nc", "-o", "x.csv"), ("table", "pipe.nc", "-o", "x.csv")),
        *(("plot", "pipe.nc", "-o", "x.png"), ("check", "pipe.nc")),
        ("fatigue", "pipe.nc"),
    ],
)
def test_commands_do_not_wait_for_a_pipe(tmp_path, words):
    """Nobody writes into it, so that the library would wait forever."""
    os.mkfifo(tmp_path / "pipe.nc")
    command = [sys.executable, "-c", "from riserstudy.cli import main; main()", *words]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 2
    assert "pipe.nc: this is not a regular file" in done.stderr


def test_the_library_and_other_programs_read_and_change_it(dataset, tmp_path):
    """They do not see the line at the end; where they change the file, it is theirs."""
    _, path = dataset
    copy = tmp_path / "copy.nc"
    copy.write_bytes(path.read_bytes())
    assert copy.read_bytes()[-LINE:].startswith(MARK)
    with netCDF4.Dataset(copy, "a") as file:
        file.setncattr("title", "edited by somebody")
    assert open_dataset(copy).attrs["title"] == "edited by somebody"
    former = tmp_path / "former.nc"  # by an older version, without the line
    former.write_bytes(path.read_bytes()[:-LINE])
    assert open_dataset(former).identical(open_dataset(path))
