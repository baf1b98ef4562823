"""Digests of sources: what changes when code that a result depends on changes.

Dependence is read from the import statements, without running them.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from riserstudy.folders import PACKAGE

NAME = PACKAGE.name
ENGINE = "riserstudy.simulation.refine"  # what simulates


def digest(files: Iterable[Path]) -> str:
    """Hash of the names and contents of source files, 16 hexadecimal digits."""
    total = hashlib.sha256()
    for file in sorted(files):
        total.update(file.name.encode() + b"\0" + file.read_bytes() + b"\0")
    return total.hexdigest()[:16]


@cache
def kernel_digest() -> str:
    """Digest of everything that is compiled."""
    return digest([*PACKAGE.glob("effects/*.py"), *PACKAGE.glob("solve/*.py")])


@cache
def engine_digest() -> str:
    """Digest of all sources that a simulated number depends on."""
    return digest(sources_behind(ENGINE))


def sources_behind(module: str) -> set[Path]:
    """Source files of a module of the package and of all that it imports, wherever it does so."""
    found: set[Path] = set()
    left = [module]
    while left:
        file = source_of(left.pop())
        if file is not None and file not in found:
            found |= {file, *data_of(file)}
            left += imported_by(file)
    return found


def source_of(module: str) -> Path | None:
    """File of a module of the package, or None: a name that is imported may be no module."""
    place = PACKAGE.joinpath(*module.split(".")[1:])
    file = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
    return file if module.split(".")[0] == NAME and file.exists() else None


@cache
def data_of(file: Path) -> tuple[Path, ...]:
    """Files beside a source file that it names: what it reads."""
    constants = (node for node in ast.walk(_tree(file)) if isinstance(node, ast.Constant))
    names = {node.value for node in constants if isinstance(node.value, str)}
    beside = [path for path in file.parent.iterdir() if path.suffix != ".py" and path.is_file()]
    return tuple(path for path in beside if path.name in names)


@cache
def imported_by(file: Path) -> tuple[str, ...]:
    """Names that a source file imports from the package: modules, and what may be modules."""
    return tuple(_imported(_tree(file)))


@cache
def _tree(file: Path) -> ast.Module:
    return ast.parse(file.read_bytes())


def _imported(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
