"""The pages for beginners: what they state of signs is so, and their commands run."""

import re
from pathlib import Path

import numpy as np
import pytest
from typed_commands import typed

from riserstudy import load_scene, simulate

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/five_minutes.md").read_text("utf-8")
SCENE = re.search(r"```yaml\n(.*?)```", PAGE, re.DOTALL)[1]


@pytest.fixture(scope="module", params=[20.0, -12.0])
def aside(request, tmp_path_factory):
    """A riser at rest whose top is aside, and by how much (m)."""
    file = tmp_path_factory.mktemp("aside") / "riser.yaml"
    file.write_text(SCENE)
    still = {"platform": None, "analysis.duration": None, "analysis.output": None, "top.x": "held"}
    return request.param, simulate(load_scene(file, **still, **{"top.offset": f"{request.param} m"}))


def test_an_offset_is_positive_along_x_and_arclength_grows_upwards(aside):
    offset, run = aside
    assert float(run["x_static"][-1]) == pytest.approx(offset)
    assert float(run["x_static"][0]) == pytest.approx(0.0, abs=1e-9)
    assert (np.diff(run["z_static"]) > 0.0).all()


def test_angles_are_positive_where_the_riser_leans_to_x(aside):
    offset, run = aside
    for name, end in (("lfj_angle", slice(0, 2)), ("ufj_angle", slice(-2, None))):
        lean = np.diff(run["x_static"][end])[0] / np.diff(run["z_static"][end])[0]
        angle = float(run[f"{name}_static"])
        assert np.sign(angle) == np.sign(offset)
        assert angle == pytest.approx(np.arctan(lean), rel=0.1)  # of the chord of the last segment


def test_the_moment_is_the_stiffness_times_the_change_of_lean(aside):
    _, run = aside
    s, x, z = (run[name].values for name in ("s_node", "x_static", "z_static"))
    lean = np.arctan2(np.diff(x), np.diff(z))
    curvature = np.diff(lean) / (0.5 * (s[2:] - s[:-2]))
    outer, inner = 21 * 0.0254, 19 * 0.0254
    stiffness = 207e9 * np.pi / 64.0 * (outer**4 - inner**4)
    moment = run["bending_moment_static"].values[1:-1]
    large = abs(moment) > 0.1 * abs(moment).max()
    assert (np.sign(moment) == np.sign(curvature))[large].all()
    middle = len(moment) // 2
    assert moment[middle] == pytest.approx(stiffness * curvature[middle], rel=0.05)


def test_the_shear_force_has_the_sign_of_the_slope_of_the_moment(aside):
    _, run = aside
    slope = np.gradient(run["bending_moment_static"].values, run["s_node"].values)
    shear = run["shear_force_static"].values
    large = abs(shear) > 0.1 * abs(shear).max()
    assert (np.sign(shear) == np.sign(slope))[large].all()


def test_the_moment_at_a_flex_joint_is_its_stiffness_times_the_angle(aside):
    _, run = aside
    for name, place, stiffness in (("lfj_angle", 0, 50e3), ("ufj_angle", -1, 10e3)):
        angle = np.rad2deg(float(run[f"{name}_static"]))
        moment = float(run["bending_moment_static"][place])
        assert abs(moment) == pytest.approx(stiffness * abs(angle), rel=1e-3)


def test_the_tension_changes_by_the_submerged_weight(aside):
    _, run = aside
    tension = run["effective_tension_static"].values
    height = float(run["z_static"][-1] - run["z_static"][0])
    assert tension[-1] - tension[0] == pytest.approx(3e3 * height, rel=0.02)


@pytest.mark.long
def test_the_commands_of_the_five_minutes_run_and_write_what_the_page_says(commands, tmp_path, monkeypatch):
    (tmp_path / "riser.yaml").write_text(SCENE)
    lines = "\n".join(re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL))
    monkeypatch.chdir(tmp_path)
    code, said, complained = typed(lines, commands)
    assert code == 0, complained
    assert "not evaluated" not in said
    for name in re.findall(r"-o (\S+)", lines):
        assert (tmp_path / name).stat().st_size > 1000
        assert f"written: {name}" in said
