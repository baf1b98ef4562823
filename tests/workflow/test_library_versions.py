"""A simulated number is recomputed where a library has another version, and only then."""

import sys
from pathlib import Path

import pytest

from riserstudy.files import digests
from riserstudy.files.digests import ENGINE, LIBRARIES, dependencies, engine_digest, facts
from riserstudy.scene.load import read_scene
from riserstudy.study import store

SCENE = Path(__file__).parents[2] / "config/scenes/bench/s1.yaml"
#: read and check scenes, lock and find files, label results
WITHOUT_INFLUENCE = {"filelock", "platformdirs", "pydantic", "pydantic_core", "ruamel", "xarray"}
NO_LIBRARY = {"__future__", "riserstudy", *sys.stdlib_module_names}


@pytest.fixture
def versions(monkeypatch):
    """Installed versions, which a test may change."""
    known = {name: digests.version(name) for name in LIBRARIES}
    monkeypatch.setattr(digests, "version", lambda name: known[name])
    yield known
    engine_digest.cache_clear()


def key():
    engine_digest.cache_clear()
    return store.key_of(read_scene(SCENE).resolved())


@pytest.mark.parametrize("library", LIBRARIES)
def test_a_point_has_another_key_with_another_version_of_a_library(library, versions):
    before, installed = key(), versions[library]
    versions[library] = installed + ".1"
    assert key() != before
    versions[library] = installed
    assert key() == before


def test_every_library_that_the_engine_imports_is_known_to_change_numbers_or_not():
    sources = [file for file in dependencies(ENGINE) if file.suffix == ".py"]
    imports = [one for file in sources for one in facts(file).imports]
    libraries = {module.split(".")[0] for level, module, _ in imports if level == 0} - NO_LIBRARY
    assert libraries == {*LIBRARIES} | WITHOUT_INFLUENCE
