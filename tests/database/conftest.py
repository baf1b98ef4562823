"""The workspace, made once; tests that change it get a copy."""

import shutil

import pytest
import workspace

from riserstudy.files.cache import cache_folder


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    """A folder with a small workspace, and its store."""
    folder = tmp_path_factory.mktemp("small") / "it's a workspace"
    (folder / ".cache").mkdir(parents=True)
    (cache_folder() / "numba").mkdir(parents=True, exist_ok=True)
    (folder / ".cache/numba").symlink_to(cache_folder() / "numba")
    with pytest.MonkeyPatch.context() as patch:
        _enter(folder, patch)
        workspace.make()
    return folder


@pytest.fixture
def here(made, monkeypatch):
    """In the workspace, to look at."""
    _enter(made, monkeypatch)
    return made


@pytest.fixture
def mine(made, tmp_path, monkeypatch):
    """In a copy of the workspace, to change."""
    folder = tmp_path / "copy"
    shutil.copytree(made, folder, symlinks=True)
    _enter(folder, monkeypatch)
    return folder


def _enter(folder, patch):
    patch.chdir(folder)
    patch.setenv("RISERSTUDY_CACHE", str(folder / ".cache"))
