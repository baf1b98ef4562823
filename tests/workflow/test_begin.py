"""Before a run: what is damaged does not count as there, what a killed run left is out of the way."""

import base64
import hashlib
import json
import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.jobs import begin, seals

HOLDS_THE_LOCK = """
from riserstudy.jobs import begin
assert begin._is_alone()
print("held", flush=True)
input()
"""


@pytest.fixture
def results(tmp_path, monkeypatch):
    """Two results of a paper with their seals."""
    monkeypatch.chdir(tmp_path)
    files = [Path("results/paper/a.nc"), Path("results/paper/b.png"), Path("results/all.csv")]
    for k, file in enumerate(files):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(random.Random(k).randbytes(3000))
    seals.seal(*files)
    monkeypatch.setattr(begin, "_held", begin.FileLock(".snakemake/riserstudy.lock"))
    yield files
    begin._held.release()


def start(wanted, at_work=True, tier="preview"):
    return begin.begin(["paper"], [str(file) for file in wanted], at_work, tier)


def test_whole_results_count(results):
    assert start(results) == ([], [])
    assert all(file.exists() for file in results)


@pytest.mark.long
def test_every_flipped_bit_and_every_cut_is_seen(results):
    rng = random.Random(20261123)
    whole = {file: file.read_bytes() for file in results}
    for _ in range(100):
        file = rng.choice(results)
        content = bytearray(whole[file])
        if rng.random() < 0.7:
            content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
        else:
            del content[rng.randrange(len(content)) :]
        file.write_bytes(content)
        (found,), (line,) = start(results)
        assert found == str(file)
        assert line.startswith(f"{file} is not as its job wrote it")
        file.write_bytes(whole[file])
        assert start(results) == ([], [])


@pytest.mark.parametrize("damage", ["swap", "both swapped", "no seal", "empty seal"])
def test_a_result_counts_by_its_own_seal_only(results, damage):
    a, b, _ = results
    seal = Path("results/.seals/paper/a.nc")
    if damage == "swap":
        a.write_bytes(b.read_bytes())
    elif damage == "both swapped":
        a.write_bytes(b.read_bytes())
        seal.write_bytes(seal.with_name("b.png").read_bytes())
    elif damage == "no seal":
        seal.unlink()
    else:
        seal.write_bytes(b"")
    assert start(results)[0] == [str(a)]


def test_a_dry_run_tells_and_touches_nothing(results):
    results[0].write_bytes(b"other")
    half = Path("results/paper/.b.png.123")
    half.write_bytes(b"half")
    _, (line,) = start(results, at_work=False)
    assert line.startswith("results/paper/a.nc is not as its job wrote it")
    assert results[0].read_bytes() == b"other"
    assert half.exists()


def test_what_killed_runs_left_is_removed(results):
    half = Path("results/paper/.b.png.123")
    half.write_bytes(b"half")
    lock = Path(".snakemake/locks/0.input.lock")
    lock.parent.mkdir(parents=True)
    lock.touch()
    assert start(results) == ([], [])
    assert lock.parent.exists()
    assert not half.exists()
    assert not lock.exists()
    assert seals.damaged(map(str, results)) == []


@pytest.mark.parametrize("seed", range(5))
def test_hidden_files_of_users_stay(results, seed):
    draw = random.Random(seed)
    words = ["gitignore", "gitkeep", "DS_Store", "notes.txt", "nfs000000a1", "b.png.swp", "b.png"]
    words += ["~lock.all.csv#", f"v1.{draw.randrange(10)}-draft", "git/config", "deadbeef"]
    folders = ["results", "results/paper", "results/paper/mine"]
    files = [Path(draw.choice(folders), f".{word}") for word in words]
    for file in files:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("mine")
    name = draw.choice(["paper/.b.png", ".all.csv", "paper/.a.nc.77", "paper/.0-of-3"])
    half = Path(f"results/{name}.{draw.choice(['4711', '0a1b2c3d'])}")
    half.write_bytes(b"half")
    assert start(results) == ([], [])
    assert [file.read_text() for file in files] == ["mine"] * len(files)
    assert not half.exists()


def test_results_that_nobody_asks_for_go_and_what_users_made_stays(results):
    mine = Path("results/paper/mine.png")
    mine.write_bytes(b"mine")
    _, dropped, _ = results
    told = start([results[0], results[2]])
    assert told == ([], [f"{dropped} is no longer needed, and removed"])
    assert not dropped.exists()
    assert mine.exists()


def test_a_run_at_work_is_left_alone_until_it_is_killed(results):
    lock = Path(".snakemake/locks/0.input.lock")
    lock.parent.mkdir(parents=True)
    lock.touch()
    results[0].write_bytes(b"other")
    with subprocess.Popen(
        [sys.executable, "-c", HOLDS_THE_LOCK], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        assert other.stdout.readline() == b"held\n"
        assert start(results) == ([], [])
        assert lock.exists()
        other.kill()
    assert start(results)[0] == [str(results[0])]
    assert not lock.exists()


def test_it_is_said_that_another_tier_replaces_results(results):
    assert start(results) == ([], [])
    assert start(results, at_work=False, tier="standard") == ([], [])
    told = ["results of tier preview are replaced by those of standard"]
    assert start(results, tier="standard") == ([], told)
    assert start(results, tier="standard") == ([], [])


def test_many_are_told_in_short(results):
    files = [Path(f"results/paper/{k}.nc") for k in range(20)]
    for file in files:
        file.write_bytes(b"no seal")
    damaged, lines = start([*results, *files])
    assert len(damaged) == 20
    assert len(lines) == begin.FEW + 1
    assert lines[-1].startswith("15 more files")


@pytest.mark.skipif(os.name != "posix" or os.getuid() == 0, reason="root may write anywhere")
def test_a_folder_that_cannot_be_written_is_told(results):
    results[0].parent.chmod(0o500)
    with pytest.raises(InputError, match="allow writing to this folder"):
        start(results[1:])
    results[0].parent.chmod(0o700)


def record(out, read, began, ended, checksum):
    """Write what Snakemake records of a job that made a file from another one."""
    name = base64.urlsafe_b64encode(str(out).encode()).decode()
    sums = {str(read): f"sha256:{checksum}"} if checksum else {}
    about = {"rule": "figure", "starttime": began, "endtime": ended, "input": [str(read)]}
    text = json.dumps(about | {"params": [], "input_checksums": sums})
    (begin.SNAKEMAKE / "metadata").mkdir(parents=True, exist_ok=True)
    (begin.SNAKEMAKE / "metadata" / name).write_text(text)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("large", [False, True])
def test_results_of_former_results_are_made_again_whatever_their_file_times(results, seed, large):
    """Snakemake compares file times; of large files it records no checksum, but when jobs began and ended."""
    rng = random.Random(seed)
    data, figure, table = results
    before = hashlib.sha256(data.read_bytes()).hexdigest()
    record(data, "config/scenes/riser.yaml", 0.0, 10.0, None)
    record(figure, data, 20.0, 30.0, None if large else before)
    record(table, figure, 40.0, 50.0, None if large else "0" * 64)  # of a figure that is replaced
    record(figure, data, 20.0, 60.0 if large else 30.0, None if large else before)
    for file in results:  # a copy of the folder, or a wrong clock
        os.utime(file, (0.0, rng.uniform(0.0, 1e9)))
    (found,), (line,) = start(results)
    assert found == str(table)
    assert line == f"{table} is made from former results; it is made again when needed"
    data.write_bytes(rng.randbytes(3000))
    seals.seal(data)
    record(data, "config/scenes/riser.yaml", 70.0, 80.0, None)
    for file in results:
        os.utime(file, (0.0, rng.uniform(0.0, 1e9)))
    found, lines = start(results)
    assert sorted(found) == sorted(map(str, (figure, table)))
    assert len(lines) == 2
    assert start(results, at_work=False)[0] == found


@pytest.mark.parametrize("content", [b"", b"\xff", b"0"])
def test_a_damaged_seal_of_an_input_stops_nothing(results, content):
    data, figure, _ = results
    record(data, "config/scenes/riser.yaml", 0.0, 10.0, None)
    record(figure, data, 20.0, 30.0, hashlib.sha256(data.read_bytes()).hexdigest())
    (seals.SEALS / data.relative_to("results")).write_bytes(content)
    assert str(data) in start(results)[0]
