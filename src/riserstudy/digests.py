"""Digests of sources: what changes when code that a result depends on changes.

Dependence is read from the import statements, without running them. Of a Python file only what has a
meaning when it runs counts (``syntax``): an edit of its prose changes no digest. Files that a module reads
from beside itself count where it names them: ``DATA_FILES = ("table.yaml",)``.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from riserstudy.errors import InputError
from riserstudy.folders import PACKAGE, keep, recall
from riserstudy.syntax import meaning

#: folders of the packages whose sources count: ours, and the chapters of a study of one's own; of modules
#: that chapters import those count, too, that lie in the folder where one works
ROOTS = {"riserstudy": PACKAGE, "chapters": Path("chapters")}
ENGINE = "riserstudy.simulation.refine"  # what simulates
KEPT = "sources"  # in the cache: what was found out about sources, by hash of their content
MOST_KEPT = 10_000


class Facts(NamedTuple):
    """What is known of a Python file by its content."""

    #: hash of what has a meaning when it runs
    meaning: str
    #: what it imports: leading dots, module, names
    imports: list[tuple[int, str, list[str]]]
    #: functions that it defines: names of arguments that each must be given, and of all, None for any
    functions: dict[str, tuple[list[str], list[str] | None]]
    #: files beside it that it names in ``DATA_FILES``
    data: list[str]


def digest(files: Iterable[Path]) -> str:
    """Hash of the names of files and of what counts of their content, 16 hexadecimal digits."""
    return _digest(frozenset(files))


@cache
def _digest(files: frozenset[Path]) -> str:
    parts = sorted(f"{file.name} {_counted(file)} " for file in files)  # wherever they lie
    _keep_facts()
    return _hash("".join(parts).encode())[:16]


def _counted(file: Path) -> str:
    return facts(file).meaning if file.suffix == ".py" else _hash(file.read_bytes())


@cache
def kernel_digest() -> str:
    """Digest of everything that is compiled."""
    return digest([*PACKAGE.glob("effects/*.py"), *PACKAGE.glob("solve/*.py")])


@cache
def engine_digest() -> str:
    """Digest of all sources that a simulated number depends on."""
    return digest(dependencies(ENGINE))


# What a module depends on


def dependencies(module: str) -> frozenset[Path]:
    """Source files of a module, of all that it imports, and what they read from beside themselves."""
    return _dependencies(module, (Path.cwd(), *(root.absolute() for root in ROOTS.values())))


@cache
def _dependencies(module: str, _roots: tuple[Path, ...]) -> frozenset[Path]:
    seen: set[str] = set()
    files: set[Path] = set()
    left = [(module, False)]
    while left:
        name, of_chapter = left.pop()
        file = source_of(name) or (_beside_chapters(name) if of_chapter else None)
        if file is None or name in seen:
            continue
        seen.add(name)
        files |= {file, *data_of(file)}
        own = not file.is_relative_to(PACKAGE)
        left += [(other, own) for other in (*imported_by(name, file), _above(name))]
    _keep_facts()
    return frozenset(files)


def source_of(module: str) -> Path | None:
    """File of a module, or None: a name that is imported may be no module, or another package's."""
    first, *steps = module.split(".")
    return _source_of(ROOTS[first].absolute(), *steps) if first in ROOTS else None


def _beside_chapters(module: str) -> Path | None:
    """File of a module of neither package in the folder where one works, where chapters find it."""
    first, *steps = module.split(".")
    return None if first in {"", *ROOTS} else _source_of(Path(first).absolute(), *steps)


@cache
def _source_of(root: Path, *steps: str) -> Path | None:
    place = root.joinpath(*steps)
    file = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
    return file if file.exists() else None


def defining(modules: Iterable[str], function: str) -> str | None:
    """The one of some modules that defines a function of that name, if one does."""
    for module in modules:
        file = source_of(module)
        if file and function in facts(file).functions:
            return module
    return None


class Arguments(NamedTuple):
    """Names that a function must be given, and all that it takes; None: it takes any."""

    needed: set[str]
    taken: set[str] | None


def arguments_of(modules: Iterable[str], function: str) -> Arguments:
    """Arguments of the function of that name, by reading its source.

    Raises
    ------
    LookupError
        When no module defines it.
    InputError
        When the module is not Python.
    """
    module = defining(modules, function)
    file = source_of(module) if module else None
    if file is None:
        raise LookupError(function)
    needed, taken = facts(file).functions[function]
    return Arguments({*needed}, None if taken is None else {*taken})


def data_of(file: Path) -> tuple[Path, ...]:
    """Files beside a source file that it names in ``DATA_FILES``: what it reads.

    Raises
    ------
    InputError
        When there is no such file.
    """
    found = tuple(file.parent / name for name in facts(file).data)
    for path in found:
        if not path.is_file():
            found_none = f"no file {path.name} is next to it"
            raise InputError(file, "DATA_FILES", found_none, "name the files that it reads")
    return found


@cache
def imported_by(module: str, file: Path) -> tuple[str, ...]:
    """Names that a module imports: modules, and what may be modules."""
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


# What is known of a file


@cache
def facts(file: Path) -> Facts:
    """What is known of a Python file; to read its syntax takes long, so it is done once for each content.

    Raises
    ------
    InputError
        When it is not Python.
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
    """It says by which code the facts were found."""
    code = b"".join(Path(file).read_bytes() for file in (__file__, PACKAGE / "syntax.py"))
    return f"{KEPT}-{_hash(code)}"


def _keep_facts() -> None:
    """Keep what was learnt in this process, beside what others have kept meanwhile."""
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
        raise InputError(file, line, "this is not Python", str(error)) from None


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
    """Names of arguments that a function must be given, and of all that it takes, None for any."""
    if node.decorator_list:  # which may change them
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
    """All nodes but those that only tell types."""
    for node in ast.iter_child_nodes(tree):
        test = node.test if isinstance(node, ast.If) else None
        if isinstance(node, ast.If) and isinstance(test, ast.Name) and test.id == "TYPE_CHECKING":
            for other in node.orelse:  # which is what runs
                yield other
                yield from _executed(other)
        else:
            yield node
            yield from _executed(node)


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:32]
