"""What `make` installs from, and with which Python."""

import json
import re
import subprocess
import tomllib
from collections import Counter
from pathlib import Path

import pytest

import make_locks

ROOT = Path(__file__).parents[2]
PLACES = (
    *("README.md", "Makefile", ".github/workflows/ci.yml", "workflow/scripts/with_python.sh"),
    *("docs/index.md", "docs/own_study.md"),
)
LOCKS = sorted(ROOT.glob("*.lock"))


@pytest.mark.parametrize("lock", LOCKS, ids=lambda lock: lock.stem)
def test_a_lock_pins_each_package_once_with_hashes_and_names_no_place(lock):
    text = lock.read_text()
    entries = re.split(r"\n(?=\S)", text.strip())
    names = Counter(entry.partition("==")[0] for entry in entries)
    assert set(names.values()) == {1}
    assert all("--hash=sha256:" in entry for entry in entries)
    assert not re.search(r"[:@]/|^-|#", text, re.MULTILINE)


def test_the_locks_agree_where_they_share_a_package():
    """But for that of the validator of run crates, which is installed into an environment of its own."""
    together = [lock for lock in LOCKS if lock.name != "crate.lock"]
    pins = {pin for lock in together for pin in re.findall(r"^(\S+==\S+)", lock.read_text(), re.M)}
    names = Counter(pin.partition("==")[0] for pin in pins)
    assert max(names.values()) == 1


def test_all_that_names_the_supported_pythons_names_the_same():
    """A new Python must enter package, workflow, make and pages at once."""
    about = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    first, beyond = map(int, re.findall(r"3\.(\d+)", about["requires-python"]))
    pythons = [f"3.{minor}" for minor in range(first, beyond)]
    last = pythons[-1]
    classified = " ".join(about["classifiers"])
    assert re.findall(r"Python :: (3\.\d+)", classified) == pythons
    texts = {name: (ROOT / name).read_text() for name in PLACES}
    assert f"python: {json.dumps(pythons)}" in texts[".github/workflows/ci.yml"]
    assert " ".join(f"python{one}" for one in pythons) in texts["Makefile"]
    script = texts["workflow/scripts/with_python.sh"]
    assert " ".join(f"python{one}" for one in reversed(pythons)) in script
    assert f"(3, {first}) <= sys.version_info[:2] <= (3, {beyond - 1})" in script
    assert set(re.findall(r"python find .*'(.*)'", script)) == {about["requires-python"]}
    listed = f"{', '.join(pythons[:-1])} or {last}"
    for name in ("README.md", "docs/index.md", "workflow/scripts/with_python.sh"):
        assert f"Python {listed}" in " ".join(texts[name].split()), name
    for name in ("README.md", "docs/own_study.md"):
        assert f"Python {pythons[0]} to {last}" in " ".join(texts[name].split()), name  # lines are wrapped


def with_python(path, python=""):
    return subprocess.run(
        ["/bin/sh", ROOT / "workflow/scripts/with_python.sh", "-c", "print('ran')"],
        env={"PATH": str(path), "PYTHON": str(python)},
        capture_output=True,
        text=True,
    )


def program(path, text):
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return path


def test_another_python_is_refused_in_one_line(tmp_path):
    old = program(tmp_path / "python3", "exit 1")
    for python in ("", old):
        done = with_python(tmp_path, python)
        assert done.returncode == 1
        assert "needs Python 3.11, 3.12, 3.13 or 3.14" in done.stderr
        assert done.stderr.count("\n") == 1


def test_a_python_that_is_not_there_is_said_not_to_be(tmp_path):
    said = with_python(tmp_path, tmp_path / "absent").stderr.splitlines()
    assert said[0] == "no such program"
    assert "needs Python 3.11, 3.12, 3.13 or 3.14" in said[-1]


def test_a_python_without_venv_is_named_with_what_to_install(tmp_path):
    program(
        tmp_path / "python3.12", 'case "$2" in *ensurepip*) exit 1;; *-venv*) echo python3.12-venv;; esac'
    )
    done = with_python(tmp_path)
    assert done.returncode == 1
    assert "apt install python3.12-venv" in done.stderr
    assert done.stderr.count("\n") == 1


def test_uv_is_asked_for_a_python_where_none_serves(tmp_path):
    """With a uv that only looks like one: first it has a Python, then it must bring it."""
    program(tmp_path / "python3", "exit 1")
    program(tmp_path / "found", "echo ran")
    there = f'case "$2" in find) echo {tmp_path}/found;; *) exit 9;; esac'
    program(tmp_path / "uv", there)
    done = with_python(tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ran\n", "")
    brought = f"if [ -e {tmp_path}/brought ]; then echo {tmp_path}/found; else exit 2; fi"
    program(tmp_path / "uv", f'case "$2" in install) : > {tmp_path}/brought;; find) {brought};; esac')
    done = with_python(tmp_path)
    assert (done.returncode, done.stdout) == (0, "ran\n")
    assert "uv brings 3.13" in done.stderr


def test_where_uv_brings_none_its_reason_and_the_other_remedy_are_told(tmp_path):
    program(tmp_path / "python3", "exit 1")
    program(tmp_path / "uv", 'case "$2" in install) echo no network >&2; exit 2;; *) exit 2;; esac')
    done = with_python(tmp_path)
    assert done.returncode == 1
    assert "no network" in done.stderr
    assert "your system's package" in done.stderr.splitlines()[-1]


@pytest.mark.parametrize(
    "answer, told",
    [
        ("exit 0", "has a wheel"),
        ("echo immutables has no usable wheels >&2; exit 1", "no wheel for Python 3.14 yet"),
        ("echo no network >&2; exit 2", "not known: no network"),
    ],
)
def test_a_lock_says_whether_the_last_package_has_a_wheel_now(tmp_path, answer, told):
    uv = program(tmp_path / "uv", f'read asked; [ "$asked" = immutables ] || exit 9; {answer}')
    assert told in make_locks.about_pure(uv, {})


def test_where_there_is_no_uv_both_remedies_are_named(tmp_path):
    program(tmp_path / "python3", "exit 1")
    (line,) = with_python(tmp_path).stderr.splitlines()
    assert "uv" in line
    assert "your system's package" in line


@pytest.mark.parametrize("code", [1, 2, 127])
def test_what_a_named_python_says_itself_is_passed_on(tmp_path, code):
    shim = program(tmp_path / "shim", f"echo 'no version is set for this command' >&2; exit {code}")
    done = with_python(tmp_path, shim)
    *said, last = done.stderr.splitlines()
    assert (done.returncode, said) == (1, ["no version is set for this command"])
    assert f"PYTHON={shim} is not, as it says above" in last


def test_a_name_with_nothing_behind_is_passed_over(tmp_path):
    program(tmp_path / "python3.13", "exit 127")
    program(tmp_path / "python3.12", 'case "$2" in print*) echo ran;; esac')
    done = with_python(tmp_path)
    assert (done.returncode, done.stdout) == (0, "ran\n")
