"""A dataset in a path with a backslash, which the netCDF library cannot write, is refused before any run."""

import os
from pathlib import Path

import pytest

SCENE = Path(__file__).parents[2] / "config/scenes/bench/s1.yaml"


@pytest.mark.skipif(os.name != "posix", reason="elsewhere a backslash separates folders")
@pytest.mark.parametrize("name", ["a\\b.nc", "a\\b/c.nc"])
@pytest.mark.parametrize("words", [("run", SCENE), ("modes", SCENE), ("recoil", SCENE)])
def test_it_is_refused_at_once(commands, tmp_path, monkeypatch, words, name):
    monkeypatch.chdir(tmp_path)
    Path(name).parent.mkdir(exist_ok=True)
    monkeypatch.setattr("riserstudy.simulation.refine.run", None)
    code, out, err = commands(*words, "-o", name)
    assert (code, out) == (2, "")
    assert "the path contains a backslash" in err
    assert not Path(name).exists()
    assert "the path contains a backslash" not in commands("run", "no such scene.yaml", "-o", "plain.nc")[2]
