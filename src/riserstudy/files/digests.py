"""Digests of sources, which change when code that a result depends on changes.

Dependencies are read from the import statements, without running them. Only those parts of a Python file
count that have a meaning when it runs (``syntax``): an edit of docstrings or comments changes no digest.
Files in the folder of a module count if the module names them: ``DATA_FILES = ("table.yaml",)``.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from riserstudy.errors import InputError
from riserstudy.files.cache import keep, recall
from riserstudy.files.syntax import meaning
from riserstudy.folders import PACKAGE

#: folders of the packages whose sources count: this package, and the chapters of a user's study; modules in
#: the current folder that chapters import count, too
ROOTS = {"riserstudy": PACKAGE, "chapters": Path("chapters")}
ENGINE = "riserstudy.simulation.refine"  # module that simulates
#: libraries whose versions may change simulated numbers
LIBRARIES = ("fatpack", "llvmlite", "numba", "numpy", "pint", "scipy", "wavespectra")
KEPT = "sources"  # name in the cache: facts about sources, by hash of their content
MOST_KEPT = 10_000


class Facts(NamedTuple):
    """Facts about a Python file, from its content."""

    #: hash of the parts that have a meaning when it runs
    meaning: str
    #: its imports: leading dots, module, names
    imports: list[tuple[int, str, list[str]]]
    #: functions that it defines: names of required arguments, and of all arguments (None: any)
    functions: dict[str, tuple[list[str], list[str] | None]]
    #: files in its folder that it names in ``DATA_FILES``
    data: list[str]


def digest(files: Iterable[Path]) -> str:
    """Return a hash of the names of files and of the counting parts of their contents, 16 hex digits."""
    return _digest(frozenset(files))


@cache
def _digest(files: frozenset[Path]) -> str:
    # independent of their folders
    parts = sorted(f"{file.name} {_counted(file)} " for file in files)
    _keep_facts()
    return _hash("".join(parts).encode())[:16]


def _counted(file: Path) -> str:
    return facts(file).meaning if file.suffix == ".py" else _hash(file.read_bytes())


@cache
def kernel_digest() -> str:
    """Digest of all compiled code."""
    return digest([*PACKAGE.glob("effects/*.py"), *PACKAGE.glob("solve/*.py")])


@cache
def engine_digest() -> str:
    """Digest of all sources and library versions that a simulated number depends on, 16 hex digits."""
    versions = " ".join(f"{name} {version(name)}" for name in LIBRARIES)
    return _hash(f"{digest(dependencies(ENGINE))} {versions}".encode())[:16]


# Dependencies of a module


def dependencies(module: str) -> frozenset[Path]:
    """Return the source files of a module and of all its imports, and the data files that they name."""
    return _dependencies(module, (Path.cwd(), *(root.absolute() for root in ROOTS.values())))


@cache
def _dependencies(module: str, _roots: tuple[Path, ...]) -> frozenset[Path]:
    files: set[Path] = set()
    left = [(module, False)]
    met = {*left}  # thousands of names are imported again and again
    while left:
        name, of_chapter = left.pop()
        file = source_of(name) or (_source_in_study(name) if of_chapter else None)
        if file is None:
            continue
        files |= {file, *data_of(file)}
        own = not file.is_relative_to(PACKAGE)
        others = {(other, own) for other in (*imported_by(name, file), _above(name))} - met
        met |= others
        left += others
    _keep_facts()
    return frozenset(files)


def source_of(module: str) -> Path | None:
    """Return the file of a module; None for a name that is not a module, or belongs to another package."""
    first, *steps = module.split(".")
    return _source_of(ROOTS[first].absolute(), *steps) if first in ROOTS else None


def _source_in_study(module: str) -> Path | None:
    """Return the file of a module in the current folder, where chapters find it, outside both packages."""
    first, *steps = module.split(".")
    return None if first in {"", *ROOTS} else _source_of(Path(first).absolute(), *steps)


@cache
def _source_of(root: Path, *steps: str) -> Path | None:
    place = root.joinpath(*steps)
    # as Python: a folder is a package only with this file, else a file of the same name is the module
    files = (place / "__init__.py", place.with_suffix(".py"))
    return next((file for file in files if file.is_file()), None)


def defining(modules: Iterable[str], function: str) -> str | None:
    """Return the module, of the given ones, that defines a function of that name; None if none does."""
    for module in modules:
        file = source_of(module)
        if file and function in facts(file).functions:
            return module
    return None


class Arguments(NamedTuple):
    """Names of the required arguments of a function, and of all its arguments; None: it accepts any."""

    needed: set[str]
    taken: set[str] | None


def arguments_of(modules: Iterable[str], function: str) -> Arguments:
    """Return the arguments of the function of that name, read from its source.

    Raises LookupError when no module defines it. Raises InputError when the module is not valid Python.
    """
    module = defining(modules, function)
    file = source_of(module) if module else None
    if file is None:
        raise LookupError(function)
    needed, taken = facts(file).functions[function]
    return Arguments({*needed}, None if taken is None else {*taken})


def data_of(file: Path) -> tuple[Path, ...]:
    """Return the files that a source file names in ``DATA_FILES``; they are in its folder.

    Raises InputError when such a file does not exist.
    """
    found = tuple(file.parent / name for name in facts(file).data)
    for path in found:
        if not path.is_file():
            found_none = f"the file {path.name} does not exist in this folder"
            raise InputError(file, "DATA_FILES", found_none, "name only files that are next to this module")
    return found


@cache
def imported_by(module: str, file: Path) -> tuple[str, ...]:
    """Return the names that a module imports: modules, and names that may be modules."""
    package = module if file.stem == "__init__" else _above(module)
    return tuple(_imported(facts(file).imports, package))


def _imported(imports: Iterable[tuple[int, str, list[str]]], package: str) -> Iterator[str]:
    for level, module, names in imports:
        start = package
        for _ in range(level - 1):
            start = _above(start)
        name = ".".join(part for part in (start if level else "", module) if part)
        yield name
        yield from (f"{name}.{one}" for one in names)


def _above(module: str) -> str:
    return module.rpartition(".")[0]


# Facts about a file


@cache
def facts(file: Path) -> Facts:
    """Return the facts about a Python file. Parsing is slow: it is done once for each content.

    Raises InputError when the file is not valid Python.
    """
    content = file.read_bytes()
    name = _hash(content)
    if name not in _kept():
        _learnt[name] = [*_read(_parsed(content, file))]
    return Facts(*(_kept().get(name) or _learnt[name]))


_learnt: dict[str, list[Any]] = {}


@cache
def _kept() -> dict[str, list[Any]]:
    return dict(recall(_name_kept()) or {})


@cache
def _name_kept() -> str:
    """Return the name in the cache, which contains a digest of the code that finds the facts."""
    code = b"".join(Path(file).read_bytes() for file in (__file__, PACKAGE / "files/syntax.py"))
    return f"{KEPT}-{_hash(code)}"


def _keep_facts() -> None:
    """Store the facts found by this process, in addition to those that other processes stored meanwhile."""
    if not _learnt:
        return
    kept = recall(_name_kept()) or {}
    keep(_name_kept(), (kept if len(kept) < MOST_KEPT else {}) | _kept() | _learnt)
    _kept().update(_learnt)
    _learnt.clear()


def _parsed(content: bytes, file: Path) -> ast.Module:
    try:
        return ast.parse(content)
    except (SyntaxError, ValueError) as error:  # a null byte is a ValueError for older Pythons
        line = f"line {error.lineno}" if isinstance(error, SyntaxError) else ""
        raise InputError(
            file, line, "this is not valid Python", f"correct the syntax error: {error}"
        ) from None


def _read(tree: ast.Module) -> Facts:
    imports: list[tuple[int, str, list[str]]] = []
    for node in _executed(tree):
        if isinstance(node, ast.Import):
            imports += [(0, alias.name, []) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [alias.name for alias in node.names]
            imports.append((node.level, node.module or "", names))
    functions = {node.name: _taken(node) for node in tree.body if isinstance(node, ast.FunctionDef)}
    data = [name for node in tree.body for name in _data_named(node)]
    return Facts(_hash(meaning(tree).encode()), imports, functions, data)


def _taken(node: ast.FunctionDef) -> tuple[list[str], list[str] | None]:
    """Return the names of required arguments of a function, and of all its arguments, None for any."""
    if node.decorator_list:  # decorators may change the arguments
        return [], None
    plain, named = [a.arg for a in node.args.args], [a.arg for a in node.args.kwonlyargs]
    filled = plain[len(plain) - len(node.args.defaults) :]
    filled += [n for n, value in zip(named, node.args.kw_defaults, strict=True) if value]
    needed = [name for name in plain + named if name not in filled]
    return needed, None if node.args.kwarg else plain + named


def _data_named(node: ast.stmt) -> list[str]:
    targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
    named = any(isinstance(target, ast.Name) and target.id == "DATA_FILES" for target in targets)
    value = getattr(node, "value", None)
    if not named or not isinstance(value, ast.Tuple | ast.List):
        return []
    return [str(one.value) for one in value.elts if isinstance(one, ast.Constant)]


def _executed(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield all nodes except those under ``if TYPE_CHECKING``."""
    for node in ast.iter_child_nodes(tree):
        test = node.test if isinstance(node, ast.If) else None
        if isinstance(node, ast.If) and isinstance(test, ast.Name) and test.id == "TYPE_CHECKING":
            for other in node.orelse:  # only this branch runs
                yield other
                yield from _executed(other)
        else:
            yield node
            yield from _executed(node)


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:32]
