"""Digests of sources: what changes when code that a result depends on changes.

Dependence is read from the import statements, without running them.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from riserstudy.folders import PACKAGE, remembered

#: folders of the packages whose sources count: ours, and the chapters of a study of one's own
ROOTS = {"riserstudy": PACKAGE, "chapters": Path("chapters")}
ENGINE = "riserstudy.simulation.refine"  # what simulates


def digest(files: Iterable[Path]) -> str:
    """Hash of the names and contents of source files, 16 hexadecimal digits."""
    total = hashlib.sha256()
    for file in sorted(files):
        total.update(f"{file.name} {_content(file)} ".encode())
    return total.hexdigest()[:16]


@cache
def _content(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


@cache
def kernel_digest() -> str:
    """Digest of everything that is compiled."""
    return digest([*PACKAGE.glob("effects/*.py"), *PACKAGE.glob("solve/*.py")])


@cache
def engine_digest() -> str:
    """Digest of all sources that a simulated number depends on."""
    return digest(sources_behind(ENGINE))


def sources_behind(module: str) -> frozenset[Path]:
    """Source files of a module, of all that it imports, and what they read from beside themselves."""
    return _sources_behind(module, tuple(root.absolute() for root in ROOTS.values()))


@cache
def _sources_behind(module: str, roots: tuple[Path, ...]) -> frozenset[Path]:
    """To read the import statements takes longer than most runs, so what they said is remembered."""
    places = dict(zip(ROOTS, roots, strict=True))

    def found() -> list[list[str]]:
        return sorted(_place(file, places) for file in _followed(module))

    names = remembered(f"imports/{_state_of(roots)}-{module}", found)
    return frozenset(places[root].joinpath(file) for root, file in names)


def _place(file: Path, places: dict[str, Path]) -> list[str]:
    """The root that a file lies below, and its path from there."""
    root = next(name for name, place in places.items() if file.is_relative_to(place))
    return [root, file.relative_to(places[root]).as_posix()]


@cache
def _state_of(roots: tuple[Path, ...]) -> str:
    """Hash of all that import statements and names of files could say."""
    files = [file for root in roots for file in root.rglob("*") if "__pycache__" not in file.parts]
    total = hashlib.sha256()
    for file in sorted(file for file in files if file.is_file()):
        total.update(f"{file} {_content(file)} ".encode())
    return total.hexdigest()[:32]


def _followed(module: str) -> set[Path]:
    """Source files of a module, of all that it imports, and their data, by reading them."""
    seen: set[str] = set()
    files: set[Path] = set()
    left = [module]
    while left:
        name = left.pop()
        file = source_of(name)
        if file is None or name in seen:
            continue
        seen.add(name)
        files |= {file, *data_of(file)}
        left += [*imported_by(name, file), _above(name)]
    return files


def source_of(module: str) -> Path | None:
    """File of a module, or None: a name that is imported may be no module, or another package's."""
    first, *steps = module.split(".")
    if first not in ROOTS:
        return None
    place = ROOTS[first].joinpath(*steps)
    file = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
    return file.absolute() if file.exists() else None


def defining(modules: Iterable[str], function: str) -> str | None:
    """The one of some modules that defines a function of that name, if one does."""
    return next((module for module in modules if function in _defined(module)), None)


def _defined(module: str) -> dict[str, ast.FunctionDef]:
    file = source_of(module)
    nodes = _tree(file).body if file else []
    return {node.name: node for node in nodes if isinstance(node, ast.FunctionDef)}


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
    """
    module = defining(modules, function)
    if module is None:
        raise LookupError(function)
    node = _defined(module)[function]
    plain, named = [a.arg for a in node.args.args], [a.arg for a in node.args.kwonlyargs]
    filled = plain[len(plain) - len(node.args.defaults) :]
    filled += [n for n, value in zip(named, node.args.kw_defaults, strict=True) if value]
    if node.decorator_list:  # which may change them
        return Arguments(set(), None)
    any_name = node.args.kwarg is not None
    return Arguments({*plain, *named}.difference(filled), None if any_name else {*plain, *named})


@cache
def data_of(file: Path) -> tuple[Path, ...]:
    """Files beside a source file that it names: what it reads."""
    constants = (node for node in ast.walk(_tree(file)) if isinstance(node, ast.Constant))
    names = {node.value for node in constants if isinstance(node.value, str)}
    beside = [path for path in file.parent.iterdir() if path.suffix != ".py" and path.is_file()]
    return tuple(path for path in beside if path.name in names)


@cache
def imported_by(module: str, file: Path) -> tuple[str, ...]:
    """Names that a module imports: modules, and what may be modules."""
    return tuple(_imported(_tree(file), module if file.stem == "__init__" else _above(module)))


@cache
def _tree(file: Path) -> ast.Module:
    return ast.parse(file.read_bytes())


def _imported(tree: ast.AST, package: str) -> Iterator[str]:
    for node in _executed(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            start = package
            for _ in range(node.level - 1):
                start = _above(start)
            name = ".".join(part for part in (start if node.level else "", node.module) if part)
            yield name
            yield from (f"{name}.{alias.name}" for alias in node.names)


def _executed(tree: ast.AST) -> Iterator[ast.AST]:
    """All nodes but those that only tell types."""
    for node in ast.iter_child_nodes(tree):
        test = node.test if isinstance(node, ast.If) else None
        if not (isinstance(test, ast.Name) and test.id == "TYPE_CHECKING"):
            yield node
            yield from _executed(node)


def _above(module: str) -> str:
    return module.rpartition(".")[0]
