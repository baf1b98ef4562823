"""A checkout in small: the real workflow on two studies of the chapter bench."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import psutil
from ruamel.yaml import YAML

from riserstudy.dataset.diff import changes
from riserstudy.files.cache import cache_folder

ROOT = Path(__file__).parents[2]
KEPT = ("s3", "s4b")
FIGURE = "heave"


def lay_out(folder):
    """Put the workflow there, with the studies that are kept, and the compiled kernels by a link."""
    folder.mkdir(parents=True)
    shutil.copy(ROOT / "Snakefile", folder)
    for part in ("workflow", "profiles", "chapters"):
        shutil.copytree(ROOT / part, folder / part)
    for part in ("studies", "scenes/bench"):
        shutil.copytree(ROOT / "config" / part, folder / "config" / part)
    yaml = YAML()
    path = folder / "config/studies/bench.yaml"
    file = yaml.load(path)
    file["studies"] = {name: file["studies"][name] for name in KEPT}
    file["studies"]["s4b"]["axes"] = {
        "top_tension": {"path": "top.tension", "unit": "kN", "values": [300.0, 400.0, 500.0]}
    }
    file["figures"] = {FIGURE: file["figures"][FIGURE]}
    yaml.dump(file, path)
    settings = yaml.load(ROOT / "config/config.yaml")
    yaml.dump(settings | {"papers": ["bench"]}, folder / "config/config.yaml")
    (folder / ".cache").mkdir()
    (folder / ".cache/numba").symlink_to(cache_folder() / "numba")


def start(folder):
    """Start a run of the study, in a process group of its own."""
    environment = os.environ | {"RISERSTUDY_CACHE": ".cache"}
    environment.pop("MAKELEVEL", None)
    return subprocess.Popen(
        [sys.executable, "workflow/scripts/run_study.py", "--tier", "preview", "--cores", "1"],
        cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


def run(folder):
    """Run the study; exit status, and all it said."""
    process = start(folder)
    said, complained = process.communicate(timeout=1800)
    return process.returncode, said + complained


def kill(process, everything):
    """Kill a run as the system would, with all it started or alone."""
    victims = psutil.Process(process.pid).children(recursive=True) if everything else []
    for victim in [process, *victims]:
        try:
            victim.kill()
        except (ProcessLookupError, psutil.NoSuchProcess):
            continue
    process.communicate()


def differs(folder, reference):
    """How results differ from those of an undisturbed run, "" when bit for bit they do not."""
    files = [{str(f.relative_to(x)) for f in (x / "results").rglob("*")} for x in (folder, reference)]
    if files[0] != files[1]:
        return f"other files: {sorted(files[0] ^ files[1])}"
    found = changes(reference / "results", folder / "results")
    return f"changed: {found.varied[:3]}" if found.varied else ""


def forget(folder):
    """Take away what runs made, but not the compiled kernels."""
    for part in ("results", "logs", ".snakemake", ".cache/points"):
        shutil.rmtree(folder / part, ignore_errors=True)
