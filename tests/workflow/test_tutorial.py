"""The tutorial, executed on the results of the workflow in small."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from typed_commands import typed

from riserstudy.files.cache import cache_folder

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[2]
#: scenes that pages simulate, in small
SHORTER = [
    ("chang2020/heave.yaml", "{assumed: 0.01 %", "{assumed: 1 %"),
    ("bench/s2c.yaml", "duration: 150 s", "duration: 30 s"),
]


@pytest.mark.parametrize("page", ["docs/tutorial.md", "README.md"])
def test_the_python_of_a_page_runs(page, finished, tmp_path):
    for part in ("results", "config"):
        shutil.copytree(finished / part, tmp_path / part)
    for name, text, shorter in SHORTER:
        file = tmp_path / "config/scenes" / name
        assert file.read_text("utf-8").count(text) == 1
        file.write_text(file.read_text("utf-8").replace(text, shorter), "utf-8")
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text("utf-8"), re.DOTALL)
    assert blocks
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", "\n".join(blocks)],
        cwd=tmp_path,
        env=os.environ | {"RISERSTUDY_CACHE": str(cache_folder().absolute())},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    if page == "docs/tutorial.md":
        assert (tmp_path / "asymmetry.png").stat().st_size > 10_000
        assert "assumed - the table gives bar without stating" in done.stdout


def test_the_commands_of_the_readme_run_with_its_scene(commands, tmp_path, monkeypatch):
    text = (ROOT / "README.md").read_text("utf-8")
    (scene,) = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    (lines,) = re.findall(r"```\n(riserstudy .*?)```", text, re.DOTALL)
    (tmp_path / "my.yaml").write_text(scene, "utf-8")
    monkeypatch.chdir(tmp_path)
    code, said, complained = typed(lines, commands)
    assert code == 0, said + complained
    assert "lfj_angle" in said
