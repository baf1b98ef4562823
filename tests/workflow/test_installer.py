"""uv and pip install the same from the same places, and pip takes over where uv cannot."""

import os
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from package_index import certificate, lay_out, lock, served, source, wheel
from some_seeds import seeds

import installer

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[2]
PYTHON = Path(sys.executable)
NAME = "weightless"
FILE, CONTENT = wheel(NAME)


@pytest.fixture(scope="module")
def uv():
    found = installer.uv_for(PYTHON)
    if found is None:
        pytest.skip("no uv for this machine")
    return found


@pytest.fixture
def reached(tmp_path, monkeypatch):
    """An environment that leads to no index, and no settings of this machine's."""
    for name in list(os.environ):
        if re.match(r"PIP_|UV_|SSL_|REQUESTS_|CURL_|.*_proxy$", name, re.IGNORECASE):
            monkeypatch.delenv(name)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("XDG_CONFIG_DIRS", str(tmp_path / "none"))
    monkeypatch.setenv("PIP_CONFIG_FILE", str(tmp_path / "pip.conf"))
    monkeypatch.setenv("PIP_NO_CACHE_DIR", "1")
    monkeypatch.setenv("PIP_RETRIES", "0")
    installer.pip_settings.cache_clear()
    yield monkeypatch
    installer.pip_settings.cache_clear()


def by_uv(uv, tmp_path, text):
    """Whether uv installs what a lock names."""
    target, words = request(tmp_path / "by uv", text)
    installer.pip_settings.cache_clear()
    done = installer.uv_installs(uv, PYTHON, words, dict(os.environ))
    assert done == (target / f"{NAME}.py").exists()
    return done


def by_pip(tmp_path, text):
    """Whether pip does."""
    target, words = request(tmp_path / "by pip", text)
    command = [*installer.pip_of(PYTHON), "install", "-q", *words]
    subprocess.run([str(word) for word in command], capture_output=True)
    return (target / f"{NAME}.py").exists()


def request(folder, text):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "one.lock").write_text(text)
    target = folder / "target"
    return target, (*installer.LOCKED, "--no-deps", "--target", target, "-r", folder / "one.lock")


@pytest.mark.parametrize("seed", seeds(10, few=5))
def test_uv_finds_a_package_where_pip_finds_it_and_nowhere_else(seed, uv, tmp_path, reached):
    """Indexes that have it and that do not, named in a file or by variables, in any mixture."""
    draw = random.Random(seed)
    folders = [tmp_path / f"place{k}" for k in range(4)]
    has = [draw.random() < 0.4 for _ in folders]
    for folder, here in zip(folders, has, strict=True):
        folder.mkdir()
        lay_out(folder, NAME if here else "other", {FILE: CONTENT})
    packages = {NAME: {FILE: CONTENT}} if draw.random() < 0.4 else {}
    with served(packages) as (address, _):
        settings = {"index-url": f"{address}/simple"}
        if draw.random() < 0.7:
            one, two = draw.sample(folders, 2)
            settings["extra-index-url"] = " ".join(f"{(x / 'simple').as_uri()}" for x in (one, two))
        if draw.random() < 0.5:
            settings["find-links"] = str(draw.choice(folders) / "simple" / NAME)
        if draw.random() < 0.3:
            settings["no-index"] = "true"
        parts = {"global": [], "install": []}
        for option, value in settings.items():
            if draw.random() < 0.5:
                reached.setenv(f"PIP_{option.upper().replace('-', '_')}", value)
            else:
                parts[draw.choice(list(parts))].append(f"{option} = {value}")
        text = "".join(f"[{part}]\n" + "\n".join(lines) + "\n" for part, lines in parts.items())
        Path(os.environ["PIP_CONFIG_FILE"]).write_text(text)
        found = by_pip(tmp_path, lock(NAME, CONTENT))
        assert by_uv(uv, tmp_path, lock(NAME, CONTENT)) == found


def test_a_later_place_of_settings_wins_as_with_pip(uv, tmp_path, reached):
    with served({NAME: {FILE: CONTENT}}) as (full, _), served({}) as (empty, asked):
        config = "[global]\nindex-url = {0}/simple\n[install]\nindex-url = {1}/simple\n"
        Path(os.environ["PIP_CONFIG_FILE"]).write_text(config.format(empty, full))
        assert by_uv(uv, tmp_path, lock(NAME, CONTENT))
        assert not asked
        reached.setenv("PIP_INDEX_URL", f"{empty}/simple")
        assert not by_uv(uv, tmp_path, lock(NAME, CONTENT))
        reached.setenv("UV_DEFAULT_INDEX", f"{full}/simple")
        assert by_uv(uv, tmp_path, lock(NAME, CONTENT))


def test_a_proxy_and_a_host_without_encryption_are_handed_over(uv, tmp_path, reached):
    with served({NAME: {FILE: CONTENT}}) as (address, asked):
        reached.setenv("PIP_INDEX_URL", "http://index.invalid/simple")
        reached.setenv("PIP_TRUSTED_HOST", "index.invalid other.invalid")
        reached.setenv("PIP_PROXY", address)
        assert by_pip(tmp_path, lock(NAME, CONTENT))
        assert by_uv(uv, tmp_path, lock(NAME, CONTENT))
        assert all(path.startswith("http://index.invalid/") for path in asked)


@pytest.mark.skipif(not shutil.which("openssl"), reason="makes a certificate with openssl")
@pytest.mark.parametrize("told", ["PIP_CERT", "REQUESTS_CA_BUNDLE", "PIP_TRUSTED_HOST", ""])
def test_a_certificate_is_trusted_by_uv_where_pip_trusts_it(told, uv, tmp_path, reached):
    authority, files = certificate(tmp_path)
    with served({NAME: {FILE: CONTENT}}, files) as (address, _):
        reached.setenv("PIP_INDEX_URL", f"{address}/simple")
        if told:
            reached.setenv(told, "127.0.0.1" if "HOST" in told else str(authority))
        assert by_pip(tmp_path, lock(NAME, CONTENT)) == bool(told)
        assert by_uv(uv, tmp_path, lock(NAME, CONTENT)) == bool(told)


def test_another_file_than_the_locked_one_is_refused_by_both(uv, tmp_path, reached, capfd):
    other = wheel(NAME, "answer = 43\n")[1]
    with served({NAME: {FILE: other}}) as (address, _):
        reached.setenv("PIP_INDEX_URL", f"{address}/simple")
        target, words = request(tmp_path / "both", lock(NAME, CONTENT))
        with pytest.raises(subprocess.CalledProcessError):
            installer.install(PYTHON, *words)
    assert not (target / f"{NAME}.py").exists()
    said = capfd.readouterr().err
    assert "uv could not install, so pip installs" in said
    assert "hash" in said.partition("\n")[0].lower()
    assert "DO NOT MATCH THE HASHES" in said


@pytest.mark.parametrize("fault", ["exit 2", "not a program"])
def test_pip_installs_where_uv_fails_and_one_line_says_why(fault, tmp_path, reached, monkeypatch, capfd):
    broken = tmp_path / "uv"
    broken.write_text("#!/bin/sh\necho its reason >&2\nexit 2\n" if fault == "exit 2" else "\0\0")
    broken.chmod(0o755)
    monkeypatch.setattr(installer, "uv_for", lambda _: broken)
    with served({NAME: {FILE: CONTENT}}) as (address, _):
        reached.setenv("PIP_INDEX_URL", f"{address}/simple")
        target, words = request(tmp_path / "target", lock(NAME, CONTENT))
        installer.install(PYTHON, *words)
    assert (target / f"{NAME}.py").exists()
    (line,) = capfd.readouterr().err.splitlines()
    assert "so pip installs" in line
    assert ("its reason" if fault == "exit 2" else "format") in line


def test_where_the_index_has_no_uv_pip_installs_and_one_line_says_why(tmp_path, reached, monkeypatch, capfd):
    monkeypatch.setattr(installer, "UV_CACHE", tmp_path / "cache")
    with served({NAME: {FILE: CONTENT}}) as (address, _):
        reached.setenv("PIP_INDEX_URL", f"{address}/simple")
        target, words = request(tmp_path / "target", lock(NAME, CONTENT))
        installer.install(PYTHON, *words)
    assert (target / f"{NAME}.py").exists()
    (line,) = capfd.readouterr().err.splitlines()
    assert "uv was not found, so pip installs" in line


@pytest.mark.parametrize(
    "name", ["requirements", "build", "slurm", "bench", "formats", "container", "installer"]
)
def test_a_lock_is_the_blocks_of_its_packages(name):
    text = (ROOT / f"{name}.lock").read_text()
    names = re.findall(r"^([\w.-]+)==", text, re.MULTILINE)
    assert "".join(installer.block_of(one, text) for one in names) == text
    assert installer.block_of("absent", text) == ""


COMPILED = {
    "pyproject.toml": '[build-system]\nrequires = ["setuptools"]\nbuild-backend = "setuptools.build_meta"\n',
    "setup.py": "from setuptools import setup, Extension\n"
    f'setup(name="{NAME}", version="1.0", packages=["{NAME}"],'
    f' ext_modules=[Extension("{NAME}._fast", ["fast.c"])])\n',
    "fast.c": "this compiles nowhere\n",
    f"{NAME}/__init__.py": "try:\n    from ._fast import answer\nexcept ImportError:\n    answer = 42\n",
}


@pytest.mark.parametrize("with_uv", [True, False])
def test_a_package_that_works_without_its_compiled_part_needs_no_compiler(
    with_uv, uv, tmp_path, reached, monkeypatch
):
    file, content = source(NAME, COMPILED)
    monkeypatch.setattr(installer, "uv_for", lambda _: uv if with_uv else None)
    monkeypatch.setenv("PATH", "/usr/bin:/bin")
    with served({NAME: {file: content}}) as (address, _):
        reached.setenv("PIP_INDEX_URL", f"{address}/simple")
        target = tmp_path / "target"
        monkeypatch.setattr(installer, "LOCKED", (*installer.LOCKED, "--target", str(target)))
        installer.install_pure(PYTHON, lock(NAME, content))
    ran = [PYTHON, "-c", f"import {NAME}; print({NAME}.answer)"]
    told = subprocess.run(ran, env={"PYTHONPATH": str(target)}, capture_output=True, text=True)
    assert told.stdout == "42\n"
