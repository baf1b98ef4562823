"""What the workflow has to do, without Snakemake."""

import ast
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.files import digests
from riserstudy.files.chapters import chapter_files
from riserstudy.files.digests import dependencies, digest, source_of
from riserstudy.folders import PACKAGE
from riserstudy.jobs.workplan import Workplan

pytestmark = pytest.mark.long

CONFIG = Path(__file__).parents[2] / "config"
FIGURES = sorted((CONFIG.parent / "chapters/numerics/figures").glob("[a-z]*.py"))
PLAN = Workplan.read(CONFIG, {"tier": "preview"})


def outputs_that_read(file):
    """Figures, derived datasets and tables that a source file makes stale."""
    path = (CONFIG.parent if file.startswith("chapters/") else PACKAGE) / file
    found = {f"{p}/{n}" for p, n in PLAN.figures() if path in PLAN.figure_code(p, n)}
    for paper, of in PLAN.files.items():
        found |= {f"{paper}/{n}.nc" for n in of.derived if path in PLAN.derived_code(paper, n)}
    return found | {f"{paper}.csv" for paper in PLAN.published if path in PLAN.grade_code(paper)}


def calls(paper, part, names):
    """Names of the functions that a file of a chapter defines, among some."""
    tree = ast.parse((CONFIG.parent / f"chapters/{paper}/{part}.py").read_text())
    return {node.name for node in tree.body if isinstance(node, ast.FunctionDef)} & set(names)


def test_no_derived_dataset_is_called_as_a_study_of_any_chapter():
    """Rules tell the two apart by name alone, in all chapters at once."""
    studies = {name for of in PLAN.files.values() for name in of.studies}
    derived = {name for of in PLAN.files.values() for name in of.derived}
    assert not studies & derived


def test_an_edit_of_a_chapter_s_figures_redraws_those_it_defines():
    figures = PLAN.files["liu2020"].figures
    drawn = calls("liu2020", "figures/motion", figures)
    assert len(drawn) > 5
    assert outputs_that_read("chapters/liu2020/figures/motion.py") == {f"liu2020/{n}" for n in drawn}


def test_inputs_of_a_rule_are_the_files_of_its_chapter_and_only_where_one_works(monkeypatch, tmp_path):
    for paper, name in [pair for pair in PLAN.figures() if not PLAN.files[pair[0]].figures.get(pair[1])]:
        assert chapter_files(paper, PLAN.figure_code(paper, name)) == []  # a schematic
    code = PLAN.figure_code("liu2020", "fig23") | PLAN.grade_code("fem_riser")
    monkeypatch.chdir(CONFIG.parent)
    folder = "chapters/liu2020"
    files = chapter_files("liu2020", code)
    assert f"{folder}/figures/__init__.py" in files
    assert len(files) > 2
    assert all(name.startswith(folder) for name in files)
    monkeypatch.chdir(tmp_path)
    assert chapter_files("liu2020", code) == []


def test_an_edit_of_what_one_chapter_shares_stays_in_that_chapter():
    for file in ("chapters/mao_hangoff/towed.py", "chapters/fem_riser/claims.py"):
        paper = file.split("/")[1]
        stale = outputs_that_read(file)
        assert f"{paper}.csv" in stale
        assert all(name.startswith(paper) for name in stale)
    assert "fem_riser/fig05" in outputs_that_read("chapters/fem_riser/claims.py")


def test_an_edit_of_how_figures_look_redraws_figures_and_derives_nothing():
    every = {f"{p}/{n}" for p, n in PLAN.figures()}
    stale = outputs_that_read("figures/style.py")
    assert stale <= every
    assert {"chang2020/fig14", "liu2020/fig13", "bench/heave"} <= stale


@pytest.mark.parametrize(
    "module",
    [
        *("riserstudy.simulation.refine", "riserstudy.report", "riserstudy.schematic"),
        *("riserstudy.study.collect", "riserstudy.grading.grade", "chapters.numerics.measured.stability"),
        *("chapters.liu2020.derived.codes", "chapters.fem_riser.figures"),
    ],
)
def test_what_is_imported_is_behind_the_digest(module):
    names = f"import sys, {module}; print(*(m.__file__ for m in list(sys.modules.values())"
    names += " if m.__name__.startswith(('riserstudy', 'chapters.'))), sep='\\n')"
    ran = subprocess.run([sys.executable, "-c", names], capture_output=True, text=True, check=True)
    imported = {Path(line) for line in ran.stdout.splitlines()}
    assert source_of(module) in imported
    assert imported <= dependencies(module)


@pytest.mark.parametrize("module", ["riserstudy.report", "riserstudy.schematic"])
def test_what_draws_and_reports_loads_no_kernels(module):
    assert "numba" not in modules_loaded_by(module)


def test_no_chapter_of_a_paper_loads_kernels():
    modules = [
        ".".join(path.relative_to(CONFIG.parent).with_suffix("").parts)
        for paper in PLAN.papers
        for path in sorted((CONFIG.parent / "chapters" / paper).rglob("*.py"))
        if path.name != "__init__.py" and paper != "numerics"
    ]
    assert "numba" not in modules_loaded_by(*modules)


def test_what_plans_draws_and_reports_the_engine_s_chapter_loads_no_kernels():
    parts = [
        "models",
        "answers",
        *(f"figures.{file.stem}" for file in FIGURES),
        "report.tiles",
        "report.section",
    ]
    assert "numba" not in modules_loaded_by(*(f"chapters.numerics.{part}" for part in parts))


def test_planning_a_chapter_that_measures_loads_nothing_large():
    loaded = modules_loaded_by("chapters.numerics.models")
    assert not {"numba", "numpy", "xarray"} & {*loaded}


def modules_loaded_by(*modules):
    names = f"import sys, {', '.join(modules)}; print(*sys.modules)"
    ran = subprocess.run([sys.executable, "-c", names], capture_output=True, text=True, check=True)
    return ran.stdout.split()


def test_what_a_source_reads_from_beside_it_counts(tmp_path, monkeypatch):
    names = {path.name for path in dependencies("riserstudy.report")}
    assert {"page.html", "page.js"} <= names
    assert "variables.yaml" in {path.name for path in dependencies("riserstudy.study.collect")}


def test_bytecode_beside_the_sources_is_nothing_that_counts(tmp_path, monkeypatch):
    made = []
    for name in ("clean", "compiled"):
        package = tmp_path / name
        shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
        for folder in [path for path in package.rglob("*") if path.is_dir()]:
            if name == "compiled":
                (folder / "__pycache__").mkdir()
                (folder / "__pycache__/module.cpython-313.pyc").write_bytes(b"\0")
        monkeypatch.setitem(digests.ROOTS, "riserstudy", package)
        made.append([digest(dependencies(f"riserstudy.{x}")) for x in ("chapters.measure", "report")])
    assert made[0] == made[1]


def test_chapters_of_a_study_of_one_s_own_count_with_all_that_they_import(tmp_path, monkeypatch):
    chapter = tmp_path / "chapters/mine"
    chapter.mkdir(parents=True)
    (chapter / "figures.py").write_text("from .helpers import colour\ndef fig01(a): ...\n")
    (chapter / "helpers.py").write_text("from riserstudy.figures.style import COLOURS\ncolour = 1\n")
    monkeypatch.chdir(tmp_path)
    names = {path.name for path in dependencies("chapters.mine.figures")}
    assert {"figures.py", "helpers.py", "style.py"} <= names


@pytest.mark.parametrize("units", [None, "si", "field", "us"])
def test_the_units_of_plots_and_limits_are_those_of_the_configuration(units):
    settings = {"tier": "preview"} | ({"units": units} if units else {})
    assert Workplan.read(CONFIG, settings, only=[]).units == (units or "field")


def test_units_that_there_are_not_are_refused():
    with pytest.raises(InputError, match="units"):
        Workplan.read(CONFIG, {"tier": "preview", "units": "imperial"}, only=[])


def test_early_results_come_first_then_kernels_then_what_takes_long():
    """Kernels are compiled before most studies, so that what needs all of them does not come last."""
    from riserstudy.jobs.workplan import COMPILED_IN_ORDER, FIRST, STUDIES
    from riserstudy.simulation.kernel_groups import GROUPS

    assert sorted(COMPILED_IN_ORDER) == sorted(GROUPS)
    plan = PLAN
    compiled = [plan.compile_priority(group) for group in COMPILED_IN_ORDER]
    assert compiled == sorted(compiled, reverse=True)
    assert min(compiled) > STUDIES
    for paper, file in plan.files.items():
        for study in file.studies:
            early = plan.study_priority(paper, study) > max(compiled)
            assert not early or plan.study(paper, study).kernel_groups == [FIRST]
        for name in file.measured:
            assert (plan.measure_priority(paper, name) > STUDIES) != plan.measured(paper, name).timed


def test_counts_that_cannot_be_written_end_no_plan(tmp_path):
    """They serve the time left alone."""
    PLAN.write_point_counts(tmp_path / "new/points.json")
    assert set(json.loads((tmp_path / "new/points.json").read_text())) == {
        f"{study.paper}/{study.name}" for study in PLAN.studies
    }
    (tmp_path / "full").write_text("a file, not a folder")
    PLAN.write_point_counts(tmp_path / "full/points.json")


def test_a_job_that_the_server_does_imports_no_libraries_before():
    names = "import sys, riserstudy.jobs.__main__; print(*sys.modules)"
    ran = subprocess.run([sys.executable, "-c", names], capture_output=True, text=True, check=True)
    loaded = set(ran.stdout.split())
    assert {"riserstudy.jobs.__main__", "json", "socket"} <= loaded
    assert not {"subprocess", "multiprocessing", "concurrent.futures", "numpy", "typer"} & loaded
