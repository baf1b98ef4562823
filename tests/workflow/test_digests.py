"""An edit changes the digests of what depends on it, and of nothing else."""

import ast
import os
import random
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from edits import edit, forget_sources, prose_edit

from riserstudy.errors import InputError
from riserstudy.files import digests
from riserstudy.files.cache import cache_folder
from riserstudy.files.digests import ENGINE, dependencies, digest
from riserstudy.files.syntax import ANNOTATION_READERS, DOCSTRING_READERS, _names
from riserstudy.folders import PACKAGE
from riserstudy.jobs.workplan import COLLECT, DATABASE, DERIVE, GRADE, REPORT, Workplan

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[2]
CHAPTERS = [
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in sorted((ROOT / "chapters").rglob("*.py"))
    if not path.stem.startswith("__")
]
PARTS = [ENGINE, COLLECT, DERIVE, GRADE, REPORT, DATABASE, "riserstudy.schematic"]
PARTS += CHAPTERS


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A copy of the package whose sources count."""
    copy = tmp_path / "riserstudy"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setitem(digests.ROOTS, "riserstudy", copy)
    monkeypatch.setattr(digests, "PACKAGE", copy)
    yield copy
    monkeypatch.undo()
    forget_sources()


def found():
    """Digests of everything that a rule carries."""
    forget_sources()
    kernels = digests.kernel_digest()
    return {"kernels": kernels} | {part: digest(dependencies(part)) for part in PARTS}


def behind(file):
    """Names of the digests that a file counts in."""
    kernels = {"kernels"} if file.parent.name in ("solve", "effects") else set()
    return kernels | {part for part in PARTS if file in dependencies(part)}


@pytest.mark.parametrize("seed", range(4))
def test_edits_of_prose_change_no_digest(seed, package):
    draw = random.Random(seed)
    before = found()
    for folder in ("solve", "effects", "scene", "simulation", "model", "study"):
        for file in draw.sample(sorted((package / folder).glob("*.py")), 3):
            file.write_text(prose_edit(file.read_text(), draw)[1])
    assert found() == before


@pytest.mark.parametrize("seed", range(8))
def test_an_edit_of_code_changes_the_digests_of_what_imports_it_and_no_others(seed, package):
    draw = random.Random(seed)
    file = draw.choice(sorted(package.rglob("*.py")))
    before, expected = found(), behind(file)
    kind, text = edit(file.read_text(), draw)
    file.write_text(text)
    changed = {part for part, now in found().items() if now != before[part]}
    assert changed == (expected if kind else set()), (file, kind)


def test_every_file_beside_the_sources_is_named_by_one_that_reads_it():
    template = PACKAGE / "study/template"
    others = {
        path
        for path in PACKAGE.rglob("*")
        if path.is_file() and path.suffix not in (".py", ".pyc") and template not in path.parents
    }
    named = {path for module in PACKAGE.rglob("*.py") for path in digests.data_of(module)}
    assert others == named
    assert len(others) > 5


def test_what_runs_reads_no_file_of_the_package_that_does_not_count(tmp_path):
    """Seen from outside: files that a run of a scene opens, against those behind its digests."""
    program = (
        "import sys; opened = []\n"
        "sys.addaudithook(lambda e, a: e == 'open' and opened.append(str(a[0])))\n"
        "from riserstudy import load_scene, simulate\n"
        f"simulate(load_scene({str(ROOT / 'config/scenes/bench/s1.yaml')!r}))\n"
        "import riserstudy\n"
        "print(*(p for p in opened if p.startswith(riserstudy.__path__[0])), sep='\\n')"
    )
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    opened = {Path(line) for line in ran.stdout.splitlines()}
    data = {path for path in opened if path.suffix not in (".py", ".pyc") and path.is_file()}
    assert {path.name for path in data} >= {"usual_units.json"}
    assert data <= dependencies(ENGINE) | dependencies(COLLECT)


def test_names_of_variables_are_no_part_of_the_engine(package):
    """Points stay as they are; datasets, in which the names are, are joined again."""
    before = found()
    file = package / "dataset/variables.yaml"
    file.write_text(file.read_text() + '\nanother_name: {units: "1", long_name: "edited"}\n')
    changed = {part for part, now in found().items() if now != before[part]}
    assert COLLECT in changed
    assert not {ENGINE, "kernels"} & changed


@pytest.mark.parametrize("name", ["report/page.css", "dataset/variables.yaml"])
def test_an_edit_of_a_file_that_a_module_names_changes_what_depends_on_the_module(name, package):
    before = found()
    with (package / name).open("a") as file:
        file.write("\n")
    changed = {part for part, now in found().items() if now != before[part]}
    assert REPORT in changed
    assert (ENGINE in changed) == (package / name in dependencies(ENGINE))


def test_nothing_behind_a_result_reads_docstrings_or_annotations():
    """What is left out of digests, because nothing reads it, is read by nothing."""
    plan = Workplan.read(ROOT / "config", {"tier": "preview"})
    files = set().union(*map(dependencies, PARTS), plan.figure_code("liu2020", "fig05"))
    readers = DOCSTRING_READERS | (ANNOTATION_READERS - {"inspect"}) | {"model_json_schema"}
    reading = {
        file.relative_to(ROOT).as_posix(): words
        for file in files
        if file.suffix == ".py" and (words := set(_names(ast.parse(file.read_text()))) & readers)
    }
    # fields of a class of its own file, and annotations of classes count
    assert reading == {"src/riserstudy/records/facts.py": {"get_type_hints"}}


# Chapters of a study of one's own


@pytest.fixture
def chapter(tmp_path, monkeypatch):
    folder = tmp_path / "chapters/mine"
    folder.mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    yield folder
    forget_sources()


def names_behind(module):
    forget_sources()
    return {path.name for path in dependencies(module)}


def test_a_chapter_s_data_counts_where_the_module_names_it(chapter):
    (chapter / "measured.csv").write_text("1\n")
    (chapter / "figures.py").write_text("FILE = 'measured.csv'\n")
    assert "measured.csv" not in names_behind("chapters.mine.figures")
    (chapter / "figures.py").write_text("DATA_FILES = ['measured.csv']\n")
    assert "measured.csv" in names_behind("chapters.mine.figures")


@pytest.mark.parametrize("seed", range(8))
def test_an_edit_of_what_a_chapter_imports_from_where_one_works_changes_its_digest(seed, chapter, tmp_path):
    draw = random.Random(seed)
    name = draw.choice(["shared", "lib.tools", "lib.deep.table", "chapters.common.shared"])
    file = tmp_path.joinpath(*name.split(".")).with_suffix(".py")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(f"FACTOR = {draw.random()}\n")
    package, _, last = name.rpartition(".")
    ways = [f"import {name}", f"from {name} import FACTOR", f"from {name} import *"]
    ways += [f"from {package} import {last}"] if package else []
    line = draw.choice(ways)
    checked = f"if TYPE_CHECKING:\n    import math\nelse:\n    {line}"
    text = draw.choice([line, f"def inner():\n    {line}", checked])
    (chapter / "figures.py").write_text("from . import near\n")
    (chapter / "near.py").write_text(f"import numpy\n{text}\n")
    forget_sources()
    before = digest(dependencies("chapters.mine.figures"))
    file.write_text(f"FACTOR = {draw.random()}\n")
    forget_sources()
    assert digest(dependencies("chapters.mine.figures")) != before


@pytest.mark.parametrize("seed", range(8))
def test_the_file_that_python_imports_counts_beside_a_folder_with_its_name(seed, chapter, tmp_path):
    """A package that became a module leaves a folder of compiled files; figures may have a folder of data."""
    draw = random.Random(seed)
    where = draw.choice([tmp_path, tmp_path / "chapters", chapter])
    name = ".".join([*where.relative_to(tmp_path).parts, "tools"])
    (chapter / "claims.py").write_text(f"from {name} import FACTOR\n\n\ndef check():\n    return FACTOR\n")
    file, beside = where / "tools.py", draw.choice(["__pycache__/tools.pyc", "notes.csv", "part.py"])
    file.write_text("FACTOR = 1\n")
    (where / "tools" / beside).parent.mkdir(parents=True)
    (where / "tools" / beside).write_text("")
    if draw.random() < 0.5:
        (where / "tools/__init__.py").write_text("FACTOR = 2\n")
    command = [sys.executable, "-c", f"import sys; sys.path[0] = ''; import {name} as m; print(m.__file__)"]
    imported = Path(subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip())
    forget_sources()
    assert [path for path in dependencies("chapters.mine.claims") if path.name != "claims.py"] == [imported]


def test_a_file_where_one_works_is_behind_nothing_of_the_package(chapter, tmp_path):
    forget_sources()
    before = dependencies(ENGINE), dependencies(DERIVE)
    for name in ("numpy", "json", "time", "xarray"):
        (tmp_path / f"{name}.py").write_text("")
    forget_sources()
    assert (dependencies(ENGINE), dependencies(DERIVE)) == before


@pytest.mark.parametrize(
    "text, told",
    [
        ("DATA_FILES = ('absent.csv',)\n", "figures.py: DATA_FILES: the file absent.csv does not exist"),
        ("x = 1\ny = (\n", "figures.py: line 2: this is not valid Python"),
        ("x = '\0'\n", "figures.py"),
    ],
)
def test_what_cannot_be_meant_in_a_chapter_is_told_in_one_line(chapter, text, told):
    (chapter / "figures.py").write_text(text)
    with pytest.raises(InputError, match=told):
        names_behind("chapters.mine.figures")


# What is known of a file is kept


def test_what_was_found_out_is_kept_and_damage_of_it_changes_nothing(tmp_path, monkeypatch, package):
    """Of a few files, so that it can be damaged often: a flipped bit must meet what counts to be seen."""
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "cache"))

    def now():
        forget_sources()
        return digest(dependencies("riserstudy.inputs.plain_yaml"))

    first = now()
    (kept,) = (tmp_path / "cache").glob("sources-*.json")
    with monkeypatch.context() as context:
        context.setattr(ast, "parse", None)
        assert now() == first
    draw = random.Random(4)
    for _ in range(60):
        content = bytearray(kept.read_bytes())
        content[draw.randrange(len(content))] ^= 1 << draw.randrange(8)
        kept.write_bytes(content)
        assert now() == first


def test_only_what_was_edited_is_read_again(tmp_path, monkeypatch, package):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(sys.modules[__name__], "PARTS", [ENGINE])
    found()
    (package / "solve/newton.py").open("a").write("# edited\n")
    read, parse = [], ast.parse
    monkeypatch.setattr(ast, "parse", lambda text: read.append(text) or parse(text))
    found()
    assert len(read) == 1


# The numbers of a package without prose


class WithoutProse(ast.NodeTransformer):
    """Takes away what digests are blind to, in files that postpone annotations and read none."""

    def visit(self, node):
        within_class = isinstance(node, ast.ClassDef)
        fields = [n for n in node.body if isinstance(n, ast.AnnAssign)] if within_class else []
        node = super().generic_visit(node) if not isinstance(node, ast.expr) else node
        if isinstance(node, ast.FunctionDef) and not node.decorator_list:
            node.returns = None
            for one in [*node.args.args, *node.args.kwonlyargs]:
                one.annotation = None
        if hasattr(node, "body") and isinstance(node.body, list):
            node.body = [
                ast.Assign([n.target], n.value)
                if isinstance(n, ast.AnnAssign) and n.value and n not in fields
                else n
                for n in node.body
                if not (isinstance(n, ast.Expr) and isinstance(n.value, ast.Constant))
            ] or [ast.Pass()]
        return node


def numbers_by(place):
    """Where a package is, digest and size of the numbers of a run by it; and how many kernels it compiled."""
    scene, short = ROOT / "config/scenes/bench/s2.yaml", {"analysis.duration": "10 s"}
    program = (
        "import riserstudy, hashlib\n"
        "from riserstudy.simulation.compile_times import while_compiling\n"
        f"out, scene = {{}}, riserstudy.load_scene({str(scene)!r}, **{short})\n"
        "compiled = while_compiling(lambda: out.update(riserstudy.simulate(scene).variables))\n"
        "numbers = b''.join(out[n].values.tobytes() for n in sorted(out) if out[n].dtype == float)\n"
        "print(riserstudy.__file__, hashlib.sha256(numbers).hexdigest(), len(numbers), sep='\\n')\n"
        "print(len(compiled))"
    )
    env = os.environ | {"PYTHONPATH": str(place), "RISERSTUDY_CACHE": str(cache_folder())}
    ran = subprocess.run([sys.executable, "-c", program], env=env, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    *about, compiled = ran.stdout.splitlines()
    return about, compiled


def test_without_prose_the_package_has_the_same_digests_and_gives_the_same_numbers(tmp_path, package):
    before, shortened = found(), 0
    for file in package.rglob("*.py"):
        text = file.read_text()
        words = set(_names(ast.parse(text)))
        if "annotations" in words and not words & (ANNOTATION_READERS | DOCSTRING_READERS):
            new = ast.unparse(ast.fix_missing_locations(WithoutProse().visit(ast.parse(text))))
            shortened += len(text) - len(new)
            file.write_text(new)
    assert shortened > 100_000
    assert found() == before
    whole, compiled = numbers_by(PACKAGE.parent)
    if compiled != "0":  # the process that compiles rounds otherwise than those that load
        whole, compiled = numbers_by(PACKAGE.parent)
    other, again = numbers_by(tmp_path)
    assert (compiled, again) == ("0", "0")
    assert whole[0] != other[0]
    assert whole[1:] == other[1:]
    assert int(whole[2]) > 1000
