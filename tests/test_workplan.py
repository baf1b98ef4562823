"""What the workflow has to do, without Snakemake."""

import shutil
from pathlib import Path
from types import SimpleNamespace

from riserstudy.jobs import workplan

CONFIG = Path(__file__).parents[1] / "config"


def digests(plan):
    """Digests of the rules whose code is a folder of the package."""
    measured = SimpleNamespace(paper="numerics", study="effects")
    schematic = SimpleNamespace(paper="chang2020", figure=plan.figures()[0][1])
    return plan.measured_digest(measured), plan.figure_digest(schematic), plan.report_digest


def test_bytecode_beside_the_sources_is_nothing_that_counts(tmp_path, monkeypatch):
    plan = workplan.Workplan.read(CONFIG, {"papers": ["chang2020", "numerics"]})
    clean, compiled = tmp_path / "clean", tmp_path / "compiled"
    without = shutil.ignore_patterns("__pycache__")
    for package in (clean, compiled):
        shutil.copytree(workplan.PACKAGE, package, ignore=without)
    for folder in [path for path in compiled.rglob("*") if path.is_dir()]:
        (folder / "__pycache__").mkdir()
        (folder / "__pycache__/module.cpython-313.pyc").write_bytes(b"\0")
    made = []
    for package in (clean, compiled):
        monkeypatch.setattr(workplan, "PACKAGE", package)
        made.append(digests(plan))
    assert made[0] == made[1]
