"""The environment with which strangers run the study: it finds our packages wherever these are."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).with_name("run.py")
#: the encoding of files and of names of files is ASCII
ASCII = {"LC_ALL": "C", "PYTHONUTF8": "0", "PATH": os.environ["PATH"]}


@pytest.fixture(scope="module")
def program():
    """The program that runs the study as strangers do, as a module."""
    spec = importlib.util.spec_from_file_location("run_of_strangers", PROGRAM)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where dataclasses look their module up
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", ["plain", "mein Rîser", "a 'B' \"c\" \\d", "河"])
@pytest.mark.parametrize("locale", [{}, ASCII])
def test_packages_are_found_in_a_folder_of_any_name_in_any_locale(
    name, locale, program, tmp_path, monkeypatch
):
    packages = tmp_path / name / "site-packages"
    packages.mkdir(parents=True)
    (packages / "module_of_ours.py").write_text("")
    (packages / "of_a_checkout.pth").write_text(f"{packages}\n", "utf-8")  # as installers write it
    monkeypatch.setattr(sys, "path", [str(packages), *sys.path])
    python = program.environment(tmp_path / "environment", sys.executable)
    command = [python, "-c", "import module_of_ours, riserstudy; module_of_ours.__file__.encode()"]
    done = subprocess.run(command, env=locale or None, capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, done.stderr
