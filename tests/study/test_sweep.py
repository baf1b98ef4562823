"""A grid in one call: its points are those that ``simulate`` makes, and what cannot be completed is told."""

import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene, simulate, sweep
from riserstudy.errors import InputError, SimulationError
from riserstudy.study import simulate_points, store

ROOT = Path(__file__).parents[2]
COARSE = {
    "analysis.mesh": {"elements": 30},
    "analysis.step": "0.1 s",
    "analysis.duration": "12 s",
    "analysis.output": {"interval": "0.5 s"},
}
PERIODS = [8, 12]
TWO_WAYS = {"free": {"bottom.rotation": "free"}, "fixed": {"bottom.rotation": "fixed"}}


@pytest.fixture(autouse=True)
def own_store(tmp_path, monkeypatch):
    """No point is there before a test."""
    monkeypatch.setattr(store, "_file", lambda key: tmp_path / f"{key}.point")


def scene(**overrides):
    return load_scene(ROOT / "config/scenes/hard/surge.yaml", **(COARSE | overrides))


def swept(axes, **options):
    return sweep(scene(), axes, progress=False, cores=1, **options)


def test_a_point_of_a_sweep_is_what_simulate_makes_of_its_scene():
    found = swept(
        {"platform.surge.period": PERIODS, "bottom": TWO_WAYS}, keep=["x", "bending_moment_absmax"]
    )
    assert found["x"].dims[:2] == ("platform_surge_period", "bottom")
    assert found["platform_surge_period"].attrs["units"] == "s"
    for period in PERIODS:
        for label, sets in TWO_WAYS.items():
            alone = simulate(scene(**{"platform.surge.period": f"{period} s"}, **sets))
            point = found.sel(platform_surge_period=period, bottom=label)
            np.testing.assert_array_equal(point["x"], alone["x"])
            np.testing.assert_array_equal(
                point["bending_moment_absmax"], alone["bending_moment_absmax"]
            )
    assert (found["failure"] == "").all()


def test_numbers_count_in_the_unit_of_the_scene_and_texts_as_they_stand():
    numbers = swept({"top.tension": [2000, 2500]}, keep=["ufj_angle"])
    texts = swept({"top.tension": ["2 MN", "2.5 MN"]}, keep=["ufj_angle"])
    np.testing.assert_array_equal(numbers["ufj_angle"], texts["ufj_angle"])
    assert list(texts["top_tension"].values) == ["2 MN", "2.5 MN"]


def test_what_is_stored_is_not_simulated_again(monkeypatch):
    first = swept({"platform.surge.period": PERIODS}, keep=["x"])
    monkeypatch.setattr(simulate_points, "_simulate", lambda *_: pytest.fail("simulated"))
    again = swept({"platform.surge.period": PERIODS[::-1]}, keep=["x"])
    np.testing.assert_array_equal(again["x"].values[::-1], first["x"].values)


def test_a_point_that_cannot_be_completed_has_no_numbers_and_says_why():
    """20 kN do not carry a riser of 75 kN in water."""
    found = swept({"top.tension": [20, 2000]}, keep=["x", "ufj_angle"])
    weak, strong = (found.isel(top_tension=k) for k in (0, 1))
    assert "buckles under its own weight" in str(weak["failure"].item())
    assert strong["failure"].item() == ""
    for name in ("x", "ufj_angle", "largest_bending_moment", "smallest_tension", "wall_seconds"):
        assert np.isnan(weak[name]).all(), name
        assert np.isfinite(strong[name]).all(), name
    alone = simulate(scene(**{"top.tension": "2000 kN"}))
    np.testing.assert_array_equal(strong["x"], alone["x"])


@pytest.mark.parametrize(
    "axes, options",
    [({"top.tension": [2000, 20]}, {"on_error": "raise"}), ({"top.tension": [10, 20]}, {})],
    ids=["asked for", "nothing is left"],
)
def test_failure_is_an_error_where_it_must_be(axes, options):
    with pytest.raises(
        SimulationError, match=r"points? cannot be completed; at top_tension = (10|20):"
    ):
        swept(axes, **options)


@pytest.mark.parametrize(
    "axes, options, fault",
    [
        ({}, {}, "name at least one path"),
        ({"top.tension": []}, {}, "values, each once"),
        ({"top.tension": [1, 1]}, {}, "values, each once"),
        ({"top.pull": [1, 2]}, {}, "pull"),
        ({"platform.surge.period": [8, -8]}, {}, "platform.surge.period"),
        ({"platform.surge.phase": [0, 90]}, {}, "platform.surge.phase"),  # no unit is there
        ({"top.tension": [2000]}, {"keep": ["moment"]}, "moment"),
        ({"top.tension": [2000]}, {"on_error": "skip"}, "'nan' and 'raise'"),
        ({"x": TWO_WAYS}, {}, "variable"),
    ],
)
def test_what_cannot_be_meant_is_refused_before_anything_runs(axes, options, fault, monkeypatch):
    monkeypatch.setattr(simulate_points, "_simulate", lambda *_: pytest.fail("simulated"))
    with pytest.raises(InputError, match=fault):
        swept(axes, **options)


def test_the_notebook_of_its_page_runs_as_it_stands(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs/_extensions")
    page = ROOT / "docs/sweep.md"
    cells = import_module("notebooks").notebook(page)["cells"]
    code = [cell["source"] for cell in cells if cell["cell_type"] == "code"]
    blocks = re.findall(r"```python\n(.*?)\n```", page.read_text("utf-8"), re.DOTALL)
    assert [cell.startswith(block) for cell, block in zip(code, blocks, strict=True)] == [True] * 3
    (picture,) = (output for cell in cells for output in cell.get("outputs", []))
    assert picture["data"]["image/png"].startswith("iVBOR")  # as PNG begins in base64
    (tmp_path / "config").symlink_to(ROOT / "config")
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", "\n".join(code)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "sweep.png").stat().st_size > 5_000
    assert "raise the top tension" in done.stdout
