"""Shared by all tests; being here, it also lets them import ``strategies``."""

import copy
import gc
import math
import sys
from collections import defaultdict

import pytest
from hypothesis import HealthCheck, settings

from riserstudy.blas import use_one_thread
from riserstudy.inputs import plain_yaml as reading

use_one_thread()  # several processes test at once

parse, parsed = reading.plain_yaml, {}


def parsed_once(text, source):
    """Data of a text, which is parsed once in a process; faults are found each time."""
    if text not in parsed:
        parsed[text] = parse(text, source)
    return copy.deepcopy(parsed[text])


reading.plain_yaml = parsed_once

# Seeded by the test itself, so that a run can be repeated; no deadline, since kernels may compile.
settings.register_profile(
    "riserstudy",
    deadline=None,
    derandomize=True,
    max_examples=30,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("riserstudy")


def pytest_configure(config):
    """Compile the kernels on all cores before all tests: each of several processes would compile them."""
    whole = config.args_source == config.ArgsSource.TESTPATHS and not config.option.collectonly
    if whole and config.getoption("numprocesses", None):
        from riserstudy.simulation.compile import compile_once

        compile_once(print)


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Collect without looking for garbage, of which there is hardly any: a quarter of the time."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark as long all but the first quarter of the seeds of a test."""
    drawn = defaultdict(list)
    for item in items:
        values = getattr(item, "callspec", None)
        if values and "seed" in values.params and not item.get_closest_marker("slow"):
            drawn[item.path, item.originalname].append(item)
    for tests in drawn.values():
        seeds = sorted({test.callspec.params["seed"] for test in tests})
        few = seeds[: math.ceil(len(seeds) / 4)]
        for test in tests:
            if test.callspec.params["seed"] not in few:
                test.add_marker("long")


@pytest.fixture
def scene_of(tmp_path):
    """Loads the scene of a text, with other values by path."""
    from riserstudy import load_scene  # other tests need not load it

    def load(text, **changes):
        file = tmp_path / "scene.yaml"
        file.write_text(text)
        return load_scene(file, **changes)

    return load


@pytest.fixture
def own_store(tmp_path, monkeypatch):
    """A store of points that is empty before a test, and its folder."""
    from riserstudy.study import store  # other tests need not load it

    monkeypatch.setattr(store, "_file", lambda key: tmp_path / f"{key}.point")
    return tmp_path


@pytest.fixture
def commands(monkeypatch, capsys):
    """Runs commands of the command line; exit code, output and messages."""
    from riserstudy.cli import main  # other tests need not load it

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["riserstudy", *map(str, arguments)])
        try:
            main()
            code = 0
        except SystemExit as done:
            code = done.code or 0
        said = capsys.readouterr()
        return code, said.out, said.err

    return run
