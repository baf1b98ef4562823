"""What `tune --write` leaves of a study file: its line ends and empty lines; and when it writes nothing."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
import short_study

from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.study.setting import Setting
from riserstudy.study.tune import Tuned
from riserstudy.study.write_tuned import write_tuned

FOUND = Tuned("3 %", Setting(40, (), 0.1, "TR-BDF2"), [(0,)], [(1,)], 0.5, 0.6, 0.7, None)


def sets_of(draw):
    """Lines of the values that a study sets, in one of the ways that YAML has."""
    paths = ['"riser[0].mass": 600 kg/m', "top.tension: 2000 kN", "analysis.accuracy: 2 %",
             "analysis.step: 0.5 s", "analysis.mesh.elements: 30"]  # fmt: skip
    chosen = [paths[k] for k in draw.permutation(len(paths))[: int(draw.integers(1, 6))]]
    kind = draw.integers(5)
    if kind == 0:
        return []
    if kind == 1:
        return [f"    set: {{{', '.join(chosen)}}}   # as agreed"]
    inside = ["duration: 30 s", "accuracy: 2 %", "output: {interval: 0.5 s}"]
    if kind == 2:
        return ["    set:", f"      analysis: {{{', '.join(inside)}}}", "      riser[0].mass: 600 kg/m"]
    if kind == 3:
        return ["    set:", "      analysis:", *(f"        {one}" for one in inside)]
    return ["    set:", *(f"      {one}   # as agreed" for one in chosen)]


def drawn(draw, more=""):
    """Lines of a study file, with remarks and empty lines at random places."""
    lines = [
        "paper: own", "studies:", "  heave:", "    scene: scenes/riser.yaml", "    caption: heave",
        *sets_of(draw), *([more] if more else []), "    axes:",
        "      mass: {path: platform.surge.amplitude, unit: m, values: {start: 1, stop: 2, step: 0.01}}",
        "  rest:", "    scene: scenes/riser.yaml", "    caption: rest", "    axes: {}",
    ]  # fmt: skip
    text = []
    for line in lines:
        above = int(draw.integers(0, 3))
        text += [["", "# a remark"][int(draw.integers(2))] for _ in range(above)] + [line]
    return [*text, *[""] * int(draw.integers(0, 3))]


def folder_of(tmp_path, name):
    folder = tmp_path / name
    (folder / "scenes").mkdir(parents=True)
    (folder / "studies").mkdir()
    (folder / "scenes/riser.yaml").write_text(short_study.SCENE)
    (folder / "scenes/current.csv").write_text(short_study.CURRENT)
    return folder


def is_kept(line):
    """Whether tuning leaves a line as it is."""
    return not re.search(r"analysis|accuracy|mesh|step|method|tuned|set:", line)


@pytest.mark.parametrize("seed", range(40))
def test_line_ends_remarks_and_empty_lines_stay(tmp_path, seed):
    draw = np.random.default_rng(seed)
    lines = drawn(draw)
    texts = []
    for name, end in (("unix", "\n"), ("windows", "\r\n")):
        config = folder_of(tmp_path, name)
        path = config / "studies/own.yaml"
        path.write_bytes((end.join(lines) + end).encode())
        study = SimpleNamespace(name="heave", config=config, model=SimpleNamespace(scene="scenes/riser.yaml"))
        before = read_yaml(path)["studies"]
        for _ in range(2):
            write_tuned(path, study, FOUND, {"accuracy": "3 %"})
            text = path.read_bytes().decode()
            assert text.count("\r") == (text.count("\n") if end == "\r\n" else 0)
            texts.append(text.replace("\r\n", "\n").split("\n"))
        after = read_yaml(path)["studies"]
        assert after.pop("rest") == before.pop("rest")
        heave = after["heave"]
        values = heave.pop("set")
        assert heave.pop("tuned") == {"accuracy": "3 %"}
        rest = {path: value for path, value in before["heave"].pop("set", {}).items() if is_kept(path)}
        inside = values.get("analysis") or {
            path.partition(".")[2]: value for path, value in values.items() if path.startswith("analysis.")
        }
        assert {path: value for path, value in values.items() if is_kept(path)} == rest
        assert {key: inside[key] for key in FOUND.setting.analysis} == FOUND.setting.analysis
        assert not inside.get("accuracy")
        assert "mesh.elements" not in inside
        assert after == before
    assert all(text == texts[0] for text in texts)
    assert [line for line in texts[0] if is_kept(line)] == [line for line in [*lines, ""] if is_kept(line)]


@pytest.mark.parametrize("seed", range(8))
def test_a_study_that_its_runs_tune_is_refused_before_tuning(commands, tmp_path, monkeypatch, seed):
    draw = np.random.default_rng(seed)
    points, of = draw.integers(2, 9), draw.integers(1, 9)
    settings = ("tuned", f"{{points: {points}, seed: {of}}}")[seed % 2]
    path = folder_of(tmp_path, "config") / "studies/own.yaml"
    lines = drawn(draw, f"    settings: {settings}")
    path.write_text("\n".join(line for line in lines if "step" not in line or "start" in line))
    before, calls = path.read_bytes(), []
    monkeypatch.setattr("riserstudy.study.tune.tune", lambda *_: calls.append(1) or FOUND)
    code, out, said = commands("tune", path, "heave", "--write")
    assert (code, out, calls, said.count("\n")) == (2, "", [], 1)
    assert "studies.heave.settings" in said
    assert "omit --write" in said
    assert path.read_bytes() == before
    assert commands("tune", path, "heave")[0] == 0
    assert calls == [1]
