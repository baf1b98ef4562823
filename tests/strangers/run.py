"""Run the shortest real study as machines differ, and compare its numbers with those of this one.

``python tests/strangers/run.py [NAME ...] [--write docs/machines.md]``
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

import psutil

from riserstudy.folders import PACKAGE
from riserstudy.simulation.compile import compile_once
from riserstudy.solve.kernel_cache import kernel_cache

sys.path.append(str(Path(__file__).parents[1]))
from short_study import lay_out, numbers, same

MARKS = ("<!-- table -->\n", "<!-- end -->\n")
SAME = "same numbers, bit for bit"
NOT_TRIED = "not tried: "
MEMORY = 4 * 1024**3
GUEST = f"stranger{os.getpid()}"


@dataclass
class Varied:
    """One way in which machines differ: variables (None: not set), and words before the command."""

    what: str
    environment: dict[str, str | None] = field(default_factory=dict)
    before: list[str] = field(default_factory=list)
    folder: str = "study"
    needs: str = ""


def table(place):
    """What is varied, by name."""
    return {
        "user": Varied(
            "an ordinary user without permission to write to the source tree",
            before=["runuser", "-u", GUEST, "--"],
            needs="runuser",
        ),
        "umask": Varied(
            "umask 077: only the owner can read new files", before=["sh", "-c", 'umask 077; exec "$@"', "sh"]
        ),
        "locale": Varied(
            "locale de_DE.UTF-8, with a decimal comma",
            {"LC_ALL": "de_DE.UTF-8", "LOCPATH": f"{place}/locales"},
            needs="localedef",
        ),
        "ASCII": Varied("locale C, without UTF-8 mode", {"LC_ALL": "C", "LANG": None, "PYTHONUTF8": "0"}),
        "time zone": Varied("time zone 14 hours ahead of Greenwich", {"TZ": "Pacific/Kiritimati"}),
        "path": Varied("folder name with blanks, quotes, brackets, ß and 河", folder="a 'B' [c] {d} ß 河"),
        "no git": Varied("the program git is not found", {"PATH": f"{place}/tools"}),
        "no home": Varied("environment variable HOME not set", {"HOME": None}),
        "home gone": Varied(
            "environment variable HOME names a folder that does not exist", {"HOME": "/nowhere/at/all"}
        ),
        "hash seed 0": Varied("environment variable PYTHONHASHSEED=0", {"PYTHONHASHSEED": "0"}),
        "hash seed 4711": Varied("environment variable PYTHONHASHSEED=4711", {"PYTHONHASHSEED": "4711"}),
        "one core": Varied("one core", before=["taskset", "-c", "0"], needs="taskset"),
        "memory": Varied(
            "4 GB of memory for each process", before=["prlimit", f"--as={MEMORY}"], needs="prlimit"
        ),
        "other systems": Varied(
            "without the POSIX functions fcntl, os.fork and AF_UNIX",
            {"PYTHONPATH": str(Path(__file__).with_name("hidden"))},
        ),
    }


def main(place, names):
    """Rows of the table: what was varied, what came of it."""
    compile_once(print)
    python = environment(place / "environment", sys.executable)
    tools(place)
    plain = Varied("nothing")
    status, said, peak = study(place, "plain", plain, python)
    if status:
        sys.exit(said)
    expected = numbers(place / "plain" / plain.folder)
    rows = []
    for name in names:
        varied = table(place)[name]
        try:
            rows.append((varied.what, outcome(place, name, varied, python, expected)))
        except NotPossible as why:
            rows.append((varied.what, f"{NOT_TRIED}{why}"))
        print(*rows[-1], sep=" | ", flush=True)
    rows.append(
        ("without a changed condition: largest memory of all processes together", f"{peak / 1e9:.1f} GB")
    )
    return rows


class NotPossible(Exception):
    """This machine cannot be varied so."""


def outcome(place, name, varied, python, expected):
    """Vary it, run the study twice."""
    if varied.needs and not shutil.which(varied.needs):
        raise NotPossible(f"no {varied.needs} here")
    if name == "locale":
        german(place / "locales")
    if name == "user":
        with guest():
            python = python_of_guest(place, python)
            return judged(place, name, varied, python, expected)
    return judged(place, name, varied, python, expected)


def judged(place, name, varied, python, expected):
    """What came of it."""
    status, said, _ = study(place, name, varied, python)
    if status:
        return f"EXIT {status}: {said[-1500:]}"
    if not same(numbers(place / name / varied.folder), expected):
        return "OTHER NUMBERS"
    _, said, _ = study(place, name, varied, python)
    shutil.rmtree(place / name)
    return SAME if "Nothing to do" in said else "same numbers, BUT NOT DONE WITH THAT"


def study(place, name, varied, python):
    """The study in a shell that has nothing of ours: exit status, what it said, most memory (bytes)."""
    home, folder, cache = (place / name / part for part in ("home", varied.folder, "cache"))
    if not folder.exists():
        home.mkdir(parents=True)
        lay_out(folder)
        shutil.copytree(kernel_cache(), cache / "numba" / kernel_cache().name)
        if name == "user":
            for path in (place / name, *(place / name).rglob("*")):
                shutil.chown(path, GUEST)
    shell = {"HOME": str(home), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
    shell |= {"RISERSTUDY_CACHE": str(cache)} | varied.environment
    words = [f"{key}={value}" for key, value in shell.items() if value is not None]
    command = [*varied.before, "env", "-i", *words, python, "-m", "snakemake", "--cores", "2"]
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace"
    ) as run:
        most = Most(run.pid)
        said, _ = run.communicate()
    return run.returncode, said, most.end()


class Most(threading.Thread):
    """The most memory that a process and all below it hold of their own at once (bytes)."""

    def __init__(self, pid):
        super().__init__(daemon=True)
        self.of, self.bytes, self.ended = psutil.Process(pid), 0, False
        self.start()

    def run(self):
        while not self.ended:
            with suppress(psutil.Error):
                every = [self.of, *self.of.children(recursive=True)]
                self.bytes = max(self.bytes, sum(p.memory_full_info().pss for p in every))
            time.sleep(0.2)

    def end(self):
        """Stop watching."""
        self.ended = True
        return self.bytes


def environment(folder, base):
    """An environment of a Python with the packages that are installed here."""
    subprocess.run([base, "-m", "venv", "--without-pip", folder], check=True)
    packages = next(folder.glob("lib/python*/site-packages"))
    ours = next(path for path in sys.path if path.endswith("site-packages"))
    # Links, since netCDF4 cannot be imported from a folder with letters that the locale lacks; and not by
    # the file of the checkout's installation, which names its folder in UTF-8 where Python reads ASCII.
    (folder / "checkout").symlink_to(PACKAGE.parents[1])
    (folder / "installed").symlink_to(ours)
    paths = [folder / "checkout" / PACKAGE.parent.name, folder / "installed"]
    line = f"import os, sys; sys.path += map(os.fsdecode, {[*map(os.fsencode, paths)]})"
    (packages / "ours.pth").write_text(f"{line}\n", "ascii")
    return str(folder / "bin/python")


def python_of_guest(place, python):
    """This Python or the system's, whichever another user can run; the second compiles for itself."""
    pythons = [python]
    system = Path("/usr/bin", f"python{sys.version_info[0]}.{sys.version_info[1]}")
    if system.exists():
        pythons.append(environment(place / "environment of the system", system))
    for one in pythons:
        command = ["runuser", "-u", GUEST, "--", one, "-c", "import riserstudy"]
        if not subprocess.run(command, capture_output=True).returncode:
            return one
    raise NotPossible("no Python that another user can run")


def tools(place):
    """A folder with what a shell has, but not git."""
    (place / "tools").mkdir()
    found = {tool.name: tool for folder in ("/bin", "/usr/bin") for tool in Path(folder).iterdir()}
    for name, tool in found.items():
        if not name.startswith("git"):
            (place / "tools" / name).symlink_to(tool)


def german(folder):
    """Make the locale, which few systems have installed."""
    folder.mkdir()
    command = ["localedef", "-i", "de_DE", "-f", "UTF-8", folder / "de_DE.UTF-8"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise NotPossible(done.stderr.strip())


@contextmanager
def guest():
    """A user who is there for a while."""
    if os.getuid() != 0:
        raise NotPossible("only root can make users")
    subprocess.run(["useradd", "--no-create-home", GUEST], check=True)
    try:
        yield
    finally:
        subprocess.run(["userdel", GUEST], check=True)


def write(page, rows):
    """Put rows into the table of a page, between its marks; a row stays where nothing was tried anew."""
    head, _, rest = page.read_text("utf-8").partition(MARKS[0])
    before, _, tail = rest.partition(MARKS[1])
    heading = ["| difference | result |", "|---|---|"]
    lines = {line.split(" | ")[0]: line for line in before.splitlines()[len(heading) :]}
    for what, result in rows:
        if NOT_TRIED not in result or f"| {what}" not in lines:
            lines[f"| {what}"] = f"| {what} | {' '.join(result.replace('|', '/').split())} |"
    table = "\n".join([*heading, *lines.values()])
    page.write_text(head + MARKS[0] + table + "\n" + MARKS[1] + tail, "utf-8")


if __name__ == "__main__":
    every = list(table(""))
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=every, help="only these: " + ", ".join(every))
    parser.add_argument("--write", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        Path(temporary).chmod(0o755)
        found = main(Path(temporary), options.names)
    if options.write:
        write(options.write, found)
    sys.exit(any(end != SAME and NOT_TRIED not in end for _, end in found[:-1]))
