"""A checkout in small: the real workflow on two heave amplitudes of one figure."""

import fcntl
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from planning import dry_run, jobs_in
from ruamel.yaml import YAML

from riserstudy.files.cache import cache_folder
from riserstudy.solve.kernel_cache import kernel_cache

ROOT = Path(__file__).parents[2]
PAPER = "chang2020"
AMPLITUDES = [1.0, 5.0]
PYCACHE = shutil.ignore_patterns("__pycache__")


class Checkout:
    """A folder with the workflow in it, and what one does there."""

    def __init__(self, folder):
        self.folder = folder
        # Relative, so that a copied checkout means its own; and this package, not an installed one.
        self.environment = os.environ | {"RISERSTUDY_CACHE": ".cache"}
        self.environment.pop("MAKELEVEL", None)

    def __truediv__(self, path):
        return self.folder / path

    def start(self, *targets):
        """Start a run of the study."""
        command = [sys.executable, "workflow/scripts/run_study.py", "--cores", "2", *targets]
        return subprocess.Popen(
            command,
            cwd=self.folder,
            env=self.environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )

    def run(self, *targets, timeout=300):
        """Run the study; its exit status and what it printed and complained."""
        process = self.start(*(targets or [PAPER]))
        said, complained = process.communicate(timeout=timeout)
        return process.returncode, said, complained

    def planned(self, target=PAPER):
        """Jobs that a run would do, as their messages say."""
        status, said = dry_run(self.folder, self.environment, target)
        assert status == 0, said
        return jobs_in(said)

    def done(self):
        """Jobs that the last run did, as its log says."""
        return jobs_in(max((self / ".snakemake/log").iterdir()).read_text())

    def stored(self):
        """Stored points: file and the moment it was written."""
        points = (self / ".cache/points").glob("*/*.point2")
        return {(path.name, path.stat().st_mtime_ns) for path in points}

    def edit(self, path, old, new):
        """Replace text that stands once in a file."""
        text = (self / path).read_text("utf-8")
        assert text.count(old) == 1, (path, old)
        (self / path).write_text(text.replace(old, new), "utf-8")

    def own_kernels(self):
        """Copy the compiled kernels, which otherwise are shared; the folder of those in use."""
        shared = self / ".cache/numba"
        shared.unlink()
        shutil.copytree(kernel_cache(), shared / kernel_cache().name)
        return shared / kernel_cache().name

    def own_package(self, place=None):
        """Copy the package, which otherwise is shared, and use the copy, which is returned."""
        place = place or self.folder.parent / "src of my own"
        copy = place / "riserstudy"
        source = ROOT / "src/riserstudy"
        shutil.copytree(source, copy, ignore=PYCACHE)
        self.environment["PYTHONPATH"] = str(place)
        return copy


def in_small(folder):
    """Lay out the workflow with the studies of one figure on few points."""
    shutil.copy(ROOT / "Snakefile", folder)
    for part in ("workflow", "profiles", "config"):
        shutil.copytree(ROOT / part, folder / part)
    shutil.copytree(ROOT / "chapters" / PAPER, folder / "chapters" / PAPER, ignore=PYCACHE)
    shutil.rmtree(folder / "config/published")  # which needs more studies than these
    yaml = YAML()
    path = folder / "config/studies/chang2020.yaml"
    file = yaml.load(path)
    figures = file["figures"] = {"fig14": file["figures"]["fig14"]}
    del file["schematics"]
    derived = file["derived"] = {name: file["derived"][name] for name in figures["fig14"]["reads"]}
    reads = {study for studies in derived.values() for study in studies}
    file["studies"] = {name: study for name, study in file["studies"].items() if name in reads}
    ends = sorted({0.0, *AMPLITUDES, *(-a for a in AMPLITUDES)})
    values_of = {"heave_amplitude": AMPLITUDES, "heave_position": ends}
    for study in file["studies"].values():
        axes = study["axes"]
        for axis, values in values_of.items():
            if axis in axes:
                axes[axis].pop("preview", None)
                axes[axis]["values"] = [*values]
    yaml.dump(file, path)
    path = folder / "config/config.yaml"
    settings = yaml.load(path)
    yaml.dump(settings | {"papers": ["chang2020"]}, path)
    (folder / ".cache").mkdir()
    (cache_folder() / "numba").mkdir(parents=True, exist_ok=True)
    (folder / ".cache/numba").symlink_to(cache_folder() / "numba")


@pytest.fixture
def laid_out(tmp_path):
    """A checkout of one's own, nothing run."""
    in_small(tmp_path)
    return Checkout(tmp_path)


@pytest.fixture(scope="session")
def finished(tmp_path_factory, worker_id):
    """A checkout whose study has run; shared by all workers, so only to look at."""
    base = tmp_path_factory.getbasetemp()
    shared = base if worker_id == "master" else base.parent
    folder = shared / "a finished checkout"  # with blanks, as paths have
    with (shared / "finished.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (folder / "results").exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            in_small(folder)
            status, said, complained = Checkout(folder).run()
            assert status == 0, said + complained
    return Checkout(folder)


@pytest.fixture
def checkout(finished, tmp_path):
    """A checkout of one's own whose study has run."""
    folder = tmp_path / "a checkout"
    shutil.copytree(finished.folder, folder, symlinks=True)
    return Checkout(folder)


@pytest.fixture
def fresh(checkout):
    """A checkout of one's own as after a clone."""
    for part in ("results", "logs", ".snakemake", ".cache/points"):
        shutil.rmtree(checkout / part)
    return checkout


@pytest.fixture(scope="session")
def page(tmp_path_factory):
    """The report of two runs and a small graded table."""
    from report_in_browser import report_in  # other tests need no browser

    return report_in(tmp_path_factory.mktemp("page"))


@pytest.fixture(scope="session")
def chromium(tmp_path_factory):
    """A browser without a network."""
    from report_in_browser import started

    browser = started(tmp_path_factory.mktemp("chromium"))
    yield browser
    browser.quit()


@pytest.fixture
def browser(chromium, page):
    """The page, just opened, with its tables ready; at the end nothing may have complained."""
    from report_in_browser import open_page

    open_page(chromium, page)
    yield chromium
    # a browser that draws without graphics hardware warns that this is slow
    assert [row for row in chromium.get_log("browser") if row["level"] != "WARNING"] == []
