"""The worked example, executed: its commands in a copy of its folder, and what its page prints."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from typed_commands import typed

from riserstudy import load_scene, simulate

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "examples/drilling_riser"
PAGE = (ROOT / "docs/worked_example.md").read_text("utf-8")
BLOCK = re.compile(r"```sh\n(.*?)```(?:\s*```text\n(.*?)```)?", re.DOTALL)
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?")
BLOCKS = BLOCK.findall(PAGE)
WHOLE = "snakemake"


def run(lines, folder):
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    return subprocess.run(["bash", "-ec", lines], cwd=folder, env=environment, capture_output=True, text=True)


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    folder = tmp_path_factory.mktemp("example") / "drilling"
    shutil.copytree(FOLDER, folder)
    return folder


def test_the_page_shows_commands_and_what_they_say():
    assert len(BLOCKS) == 5
    assert sum(bool(said) for _, said in BLOCKS) == 2
    assert BLOCKS[-1][0].startswith(WHOLE)


@pytest.mark.parametrize("number", range(len(BLOCKS) - 1))
def test_commands_say_what_the_page_prints(commands, copy, monkeypatch, number):
    lines, printed = BLOCKS[number]
    monkeypatch.chdir(copy)
    code, out, complained = typed(lines, commands)
    assert code == int("exceeded" in printed), complained
    if printed:
        said, page = (" ".join(NUMBER.sub("#", t).split()) for t in (out, printed))
        assert said == page  # but for the width of columns
        told, numbers = ([float(x) for x in NUMBER.findall(text)] for text in (out, printed))
        assert told == pytest.approx(numbers, rel=0.02)  # the accuracy asked for
    for name in re.findall(r"-o (\S+)", lines):
        assert (copy / name).stat().st_size > 200


def test_the_stack_up_of_the_page_is_what_the_tension_loses(commands, copy, monkeypatch):
    """Sum of the table against the engine: what tensioners pull less what is left at the lower end."""
    monkeypatch.chdir(copy)
    typed(BLOCKS[0][0].replace(" -o ", " --force -o "), commands)
    last = (copy / "stack_up.csv").read_text().splitlines()[-1].split(",")
    plumb = "--set current=null --set platform=null --set top.x=held --set top.z=held"
    plumb += " --set analysis.duration=null --set analysis.output=null"
    code, _, complained = typed(f"riserstudy table config/scenes/riser.yaml -o rest.csv {plumb}", commands)
    assert code == 0, complained
    rows = [row.split(",") for row in (copy / "rest.csv").read_text().splitlines()]
    value = {(row[0], row[1]): float(row[3]) for row in rows[1:]}
    lost = value["effective_tension", "upper end of pup joint"] - value["lower_end_tension", ""]
    assert 1e3 * float(last[-1]) == pytest.approx(lost, rel=1e-6)


MEAN, UPPER = "drilling: mean lfj_angle", "drilling: largest ufj_angle"
HALF = {"current.profile": {"file": "half_current.csv"}}


@pytest.mark.parametrize(
    "current, exceeded",
    [
        ({}, {-30: [UPPER], -20: [], -10: [], 0: [MEAN], 10: [MEAN], 30: [MEAN]}),
        (HALF, {-30: [MEAN], -20: [], -10: [], 0: [], 10: [MEAN], 30: [MEAN]}),
    ],
)
def test_the_offsets_of_the_page_exceed_the_limits_that_it_names(current, exceeded):
    still = {"analysis.duration": None, "analysis.output": None, "platform.response": None}
    for offset, named in exceeded.items():
        place = {"platform.position.surge": f"{offset} m"}
        scene = load_scene(FOLDER / "config/scenes/riser.yaml", **still, **current, **place)
        rows = json.loads(simulate(scene).attrs["limits"])
        found = [label(row) for row in rows if row["verdict"] != "within"]
        assert found == named, offset


def label(row):
    return f"{row['mode']}: {row['side']} {row['output']}"


def test_the_snakefile_is_that_of_new_folders():
    template = ROOT / "src/riserstudy/study/template/Snakefile"
    assert (FOLDER / "Snakefile").read_text() == template.read_text()


@pytest.mark.slow
def test_the_study_gives_the_page_to_sign(copy):
    done = run(BLOCKS[-1][0], copy)
    assert done.returncode == 0, done.stderr
    page = (copy / "results/report.html").read_text("utf-8")
    table = re.search(r'id="drilling-limits".*?</table>', page, re.DOTALL)[0]
    assert "drilling: mean lower flex joint angle" in table
    assert "exceeded at 8" in table
