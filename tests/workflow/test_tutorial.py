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
