"""Faults, each a function of a finished checkout that does the damage and returns its result.

The docstring is what the table of docs/faults.md says was done.
"""

import contextlib
import os
import random
import shutil
import subprocess
import time

import psutil
from small import forget, kill, run, start

from riserstudy.solve.kernel_cache import kernel_cache

DAY = 86400.0


def said(status, text):
    """Exit status and first line of what a run said, for the table."""
    line = next((x for x in text.splitlines() if x.startswith("riserstudy:")), "")
    return f"exit {status}" + (f": {line.removeprefix('riserstudy: ')[:120].rstrip(':')}" if line else "")


def results_deleted_half_way(folder):
    """The results folder is deleted during a run."""
    forget(folder)
    process = start(folder)
    while process.poll() is None and not any((folder / "results").glob("*/*.nc")):
        time.sleep(0.02)
    shutil.rmtree(folder / "results", ignore_errors=True)
    text = "".join(process.communicate())
    return said(process.returncode, text)


def server_of_jobs_killed(folder):
    """The process that starts the jobs is killed while a job waits for it."""
    forget(folder)
    process, servers = start(folder), []
    while process.poll() is None and not (servers := servers_of(process)):
        time.sleep(0.02)
    log = folder / "logs/bench"
    while process.poll() is None and not any(log.glob("*.log")):
        time.sleep(0.02)
    for server in servers:
        server.kill()
    text = "".join(process.communicate())
    return f"{len(servers)} process killed, {said(process.returncode, text)}"


def servers_of(run):
    """Processes of a run that jobs are forks of."""
    found = []
    for process in psutil.Process(run.pid).children(recursive=True):
        with contextlib.suppress(psutil.Error):
            if "riserstudy.jobs.server" in process.cmdline():
                found.append(process)
    return found


def two_runs_at_once(folder):
    """Two runs are started at the same time."""
    forget(folder)
    processes = [start(folder), start(folder)]
    texts = ["".join(process.communicate()) for process in processes]
    ends = [said(p.returncode, text) for p, text in zip(processes, texts, strict=True)]
    return "one run: {}; the other run: {}".format(*sorted(ends))


def broken_store(folder):
    """Stored points are truncated, overwritten or emptied, and the datasets are deleted."""
    points = sorted((folder / ".cache/points").glob("*/*.point2"))
    for k, point in enumerate(points):
        content = bytearray(point.read_bytes())
        content[len(content) // 2] ^= 255
        point.write_bytes([content, content[: len(content) // 2], b""][k % 3])
    for dataset in (folder / "results").glob("*/*.nc"):
        dataset.unlink()
    return f"{len(points)} stored points damaged"


def broken_kernels(folder):
    """Compiled functions are truncated or overwritten, and stored points and datasets are deleted."""
    shared = folder / ".cache/numba"
    shared.unlink()
    own = shared / kernel_cache().name
    shutil.copytree(kernel_cache(), own)
    files = sorted(own.rglob("*weight*.nb[ci]"))
    for k, file in enumerate(files):
        size = file.stat().st_size
        file.write_bytes([file.read_bytes()[: size // 2], b"", bytes(size)][k % 3])
    shutil.rmtree(folder / ".cache/points")
    for dataset in (folder / "results").glob("*/*.nc"):
        dataset.unlink()
    return f"{len(files)} files damaged"


def damaged_results(folder):
    """A dataset, a figure and the report are truncated, and an incomplete file remains."""
    files = [f for f in sorted((folder / "results").rglob("*")) if f.suffix in (".nc", ".png", ".html")]
    for file in files:
        os.truncate(file, file.stat().st_size // 2)
    (folder / "results/bench/.s3.nc.1").write_bytes(b"half")
    return f"{len(files)} files truncated, or left incomplete"


def flipped_results(folder):
    """One bit of every result is changed; the file times remain the same."""
    rng = random.Random(2311)
    files = [f for f in (folder / "results").rglob("*") if f.is_file() and ".seals" not in f.parts]
    for file in files:
        content, times = bytearray(file.read_bytes()), file.stat()
        content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
        file.write_bytes(content)
        os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))
    return f"{len(files)} files, one bit changed in each"


def swapped_results(folder):
    """Two datasets are exchanged, and a stored checksum is deleted."""
    one, other = sorted((folder / "results").glob("*/*.nc"))[:2]
    one.rename(folder / "aside")
    other.rename(one)
    (folder / "aside").rename(other)
    (folder / "results/.seals/report.html").unlink()
    return "3 files exchanged or deleted"


def broken_records(folder):
    """Snakemake's records of earlier runs are truncated, and half of them are deleted."""
    files = sorted(f for f in (folder / ".snakemake/metadata").rglob("*") if f.is_file())
    for k, file in enumerate(files):
        if k % 2:
            file.unlink()
        else:
            os.truncate(file, file.stat().st_size // 2)
    return f"{len(files)} records damaged"


def clock_set_back(folder):
    """The clock is set back by a day, so results have a future date, and then an input is edited."""
    for file in (*(folder / "results").rglob("*"), *(folder / ".cache/points").rglob("*")):
        os.utime(file, (time.time() + DAY, time.time() + DAY))
    scene = folder / "config/scenes/bench/s3.yaml"
    text = scene.read_text()
    scene.write_text(text.replace("density: 1025", "density: 1000"))
    before = (folder / "results/bench/s3.nc").read_bytes()
    status, _ = run(folder)
    seen = (folder / "results/bench/s3.nc").read_bytes() != before
    scene.write_text(text)
    return f"exit {status}, the edit is {'detected' if seen else 'NOT DETECTED'}"


def clock_set_forward(folder):
    """Half of the inputs have a date in the future, and the results are dated ten years ago."""
    for k, file in enumerate(sorted((folder / "config").rglob("*.yaml"))):
        if k % 2:
            os.utime(file, (time.time() + DAY, time.time() + DAY))
    for file in (folder / "results").rglob("*"):
        os.utime(file, (time.time() - 3650 * DAY,) * 2)
    return "no effect"


def read_only_results(folder):
    """The results folder is mounted read-only, and the datasets are out of date."""
    scene = folder / "config/scenes/bench/s3.yaml"
    text = scene.read_text()
    scene.write_text(text.replace("density: 1025", "density: 1000"))
    with mounted("--bind", folder / "results", folder / "results"):
        mount("-o", "remount,bind,ro", folder / "results")
        end = said(*run(folder))
    scene.write_text(text)
    return end


def read_only_cache(folder):
    """The cache of compiled functions is mounted read-only, and stored points and datasets are missing."""
    cache = folder / ".cache"
    (cache / "numba").unlink()
    shutil.copytree(kernel_cache(), cache / "numba" / kernel_cache().name)
    forget(folder)
    with mounted("--bind", cache, cache):
        mount("-o", "remount,bind,ro", cache)
        return said(*run(folder))


def disk_full(folder):
    """The disk for the results is full during the run; space is freed later."""
    forget(folder)
    disk = folder / "disk"
    disk.mkdir()
    with mounted("-t", "tmpfs", "-o", "size=64k", "tmpfs", disk):
        for part in ("results", ".cache/points", ".snakemake", "logs"):
            (disk / part).mkdir(parents=True)
            (folder / part).symlink_to(disk / part)
        ends = [said(*run(folder))]
        for size in ("200k", "400k"):
            mount("-o", f"remount,size={size}", disk)
            ends.append(said(*run(folder)))
        mount("-o", "remount,size=200m", disk)
        for part in ("results", ".cache/points", ".snakemake", "logs"):
            (folder / part).unlink()
            shutil.copytree(disk / part, folder / part)
    return "; ".join(ends)


@contextlib.contextmanager
def mounted(*words):
    """Mount something for a while."""
    mount(*words)
    try:
        yield
    finally:
        subprocess.run(["umount", words[-1]], check=True)


def mount(*words):
    """Mount something; PermissionError where that is not allowed."""
    done = subprocess.run(["mount", *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise PermissionError(done.stderr.strip())


FAULTS = (
    results_deleted_half_way,
    server_of_jobs_killed,
    two_runs_at_once,
    broken_store,
    broken_kernels,
    damaged_results,
    flipped_results,
    swapped_results,
    broken_records,
    clock_set_back,
    clock_set_forward,
    read_only_results,
    read_only_cache,
    disk_full,
)


def killed(folder, shares, longest, rng: random.Random):
    """Kill runs one after the other, each after a share of the time of a whole run; the moments (s).

    The first starts from nothing, the others from what the last one left. A run that had come to its end
    before that is no killed run: it is done again, and killed earlier.
    """
    moments = []
    forget(folder)
    for share in shares:
        moment = share * longest
        while not kill_after(folder, moment, everything=rng.random() < 0.5):
            forget(folder)
            moment *= 0.9
        moments.append(moment)
    return moments


def kill_after(folder, moment, everything):
    """Kill a run after so many seconds; whether it was at work still."""
    process = start(folder)
    try:
        process.communicate(timeout=moment)
    except subprocess.TimeoutExpired:
        kill(process, everything)
        return True
    return False
