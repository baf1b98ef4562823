"""The tutorial, executed on the results of the workflow in small."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("page", ["docs/tutorial.md", "README.md"])
def test_the_python_of_a_page_runs(page, finished, tmp_path):
    for part in ("results", "config"):
        shutil.copytree(finished / part, tmp_path / part)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text("utf-8"), re.DOTALL)
    assert blocks
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", "\n".join(blocks)],
        cwd=tmp_path,
        env={name: value for name, value in os.environ.items() if name != "RISERSTUDY_CACHE"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    if page == "docs/tutorial.md":
        assert (tmp_path / "asymmetry.png").stat().st_size > 10_000
        assert "assumed - the table gives bar without stating" in done.stdout


def test_the_commands_of_the_readme_run_with_its_scene(tmp_path):
    text = (ROOT / "README.md").read_text("utf-8")
    (scene,) = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    (commands,) = re.findall(r"```\n(riserstudy .*?)```", text, re.DOTALL)
    (tmp_path / "my.yaml").write_text(scene, "utf-8")
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-ec", commands],
        cwd=tmp_path,
        env=os.environ | {"PATH": path},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "lfj_angle" in done.stdout
