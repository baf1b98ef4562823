"""Check that docstrings contain units, array shapes, errors, and the sources of equations.

1. A public function with a number or an array of numbers (``float``, or an array of them) among its
   annotated arguments or results must give a unit, or state that there is none: a share, relative.
2. A public function with an array among them must give a shape: ``(n,)``, ``(3, n+1)``, or the shape of
   another array.
3. A public function that raises an error of the project, itself or by a private function of its file, must
   name the error or one of its base classes in its docstring: in a sentence such as "Raises InputError when
   ...", or in a section ``Raises`` where the documentation of the Python interface shows it.
4. A field of a kernel's record, a NamedTuple of ``effects`` or ``solve``, must have a unit if it is a number
   and a shape if it is an array, in the comment next to it or for all fields in the docstring of the record,
   because kernels receive records and not single arguments.
5. A file that registers an effect must have ``References`` in its docstring, the source of its equation.

Rules 1 and 2 apply to the physics (`PHYSICS`): functions that draw, grade and measure receive datasets, whose
variables have units. Rule 3 applies everywhere except to commands (`COMMANDS`), whose docstrings are their
help. Nested functions are not checked, nor functions that libraries call (validators of pydantic, hooks of
numba).
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "src/riserstudy"
CHAPTERS = ROOT / "chapters"  # outside the package
KERNELS = ("effects", "solve")
COMMANDS = "cli"
PHYSICS = (*KERNELS, "scene", "model", "simulation", "dataset", "study")

NUMBER = re.compile(r"\bfloat(64)?\b|\bFloatArray\b")
ARRAY = re.compile(r"\b(NDArray|FloatArray|ndarray|Array)\b")

SYMBOL = r"(?:[kMG]?(?:m|s|N|J|W|Pa|Hz)|kg|rad|deg|%)\d?"
PRODUCT = rf"(?:{SYMBOL}(?: {SYMBOL})*|1)"
QUOTIENT = rf"{PRODUCT}(?:/(?:{SYMBOL}|\({PRODUCT}\)))?"
# Units in brackets, or after a comma, "in" or "or"; some words mean that a number has no unit.
UNIT = re.compile(
    rf"\({QUOTIENT}(?=[),;: ])|(?:, |\bin |\bor )(?!1\b){QUOTIENT}(?=[),.;:\s]|$)"
    r"|\b(?i:shares?|relative|unit|spectral radius)\b"
)
DIMENSION = (
    r"(?:\.{3}|\d+(?: points)?|\d?[A-Za-z](?: ?[+*-] ?\w+)*"
    r"|calls|components|count|cylinders|fixed|its parts|nodes|places|probes|quantities of a node"
    r"|stages|steps|times?)"
)
SHAPE = re.compile(
    rf"\({DIMENSION},(?: ?{DIMENSION}(?:, ?{DIMENSION})*)?\)|\b(?i:any|same|their) shape\b|\b(?i:shape) of\b"
)


def main() -> None:
    """Print every fault with its place; exit with 1 if there is one."""
    kinds = errors()
    paths = sorted([*PACKAGE.rglob("*.py"), *CHAPTERS.rglob("*.py")])
    faults = [fault for path in paths for fault in faults_of(path, kinds)]
    print("\n".join(faults))
    sys.exit(bool(faults))


def errors() -> dict[str, set[str]]:
    """Return the project's errors, each with the names of its base classes."""
    kinds: dict[str, set[str]] = {}
    for node in ast.parse((PACKAGE / "errors.py").read_text("utf-8")).body:
        if isinstance(node, ast.ClassDef):
            bases = {ast.unparse(base) for base in node.bases}
            kinds[node.name] = {node.name}.union(*(kinds.get(base, set()) for base in bases))
    return kinds


def faults_of(path: Path, kinds: dict[str, set[str]]) -> Iterator[str]:
    """Yield the faults of the docstrings of a file."""
    text = path.read_text("utf-8")
    tree = ast.parse(text)
    place = path.relative_to(ROOT)
    folder = path.relative_to(PACKAGE).parts[0] if path.is_relative_to(PACKAGE) else "chapters"
    if registers(tree) and "References\n----------\n" not in (ast.get_docstring(tree) or ""):
        yield f"{place}:1: no References, which tell where the effect's equation is from"
    if folder in KERNELS:
        yield from (f"{place}:{line}: {fault}" for line, fault in bare_fields(tree, text))
    raised = Raised(tree, kinds)
    for function in public(tree):
        docstring = ast.get_docstring(function) or ""
        wants = [] if folder == COMMANDS else raised.undocumented(function, docstring)
        if folder in PHYSICS:
            wants += lacks(function, docstring)
        yield from (f"{place}:{function.lineno}: {function.name}: {kind}" for kind in wants)


def registers(tree: ast.Module) -> bool:
    """Return whether a file registers an effect."""
    calls = (node.value for node in tree.body if isinstance(node, ast.Expr))
    return any(isinstance(c, ast.Call) and ast.unparse(c.func) == "register" for c in calls)


def bare_fields(tree: ast.Module, text: str) -> Iterator[tuple[int, str]]:
    """Yield fields of records without unit or shape in the comment next to or above them."""
    lines = text.splitlines()
    for record in tree.body:
        if isinstance(record, ast.ClassDef) and "NamedTuple" in map(ast.unparse, record.bases):
            for field in record.body:
                if isinstance(field, ast.AnnAssign):
                    kind = ast.unparse(field.annotation)
                    comment = f"{comment_on(field, lines)} {ast.get_docstring(record)}"
                    name = f"{record.name}.{ast.unparse(field.target)}"
                    if ARRAY.search(kind) and not SHAPE.search(comment):
                        yield field.lineno, f"{name}: no shape"
                    if kind == "float" and not unit_in(comment):
                        yield field.lineno, f"{name}: no unit"


def comment_on(field: ast.AnnAssign, lines: list[str]) -> str:
    """Return the comment next to a field, or in the line above it."""
    above = lines[field.lineno - 2].strip()
    comment = " ".join(lines[field.lineno - 1 : field.end_lineno]).partition("#")[2]
    return f"{above} {comment}" if above.startswith("#") else comment


def public(tree: ast.Module) -> Iterator[ast.FunctionDef]:
    """Yield the public functions of a file, and the methods of its public classes."""
    for node in tree.body:
        inner = node.body if isinstance(node, ast.ClassDef) and node.name[0] != "_" else [node]
        for function in inner:
            if isinstance(function, ast.FunctionDef) and function.name[0] != "_":
                decorators = " ".join(map(ast.unparse, function.decorator_list))
                if not re.search("validator|serializer|lower_|unbox", decorators):
                    yield function


def lacks(function: ast.FunctionDef, docstring: str) -> Iterator[str]:
    """Yield missing units and shapes of a docstring."""
    every = (*function.args.args, *function.args.kwonlyargs)
    kinds = [ast.unparse(a.annotation) for a in every if a.annotation]
    kinds += [ast.unparse(function.returns)] if function.returns else []
    kinds = [kind for kind in kinds if "Callable" not in kind]
    if any(map(NUMBER.search, kinds)) and not unit_in(docstring):
        yield "no unit of its numbers"
    if any(map(ARRAY.search, kinds)) and not SHAPE.search(docstring):
        yield "no shape of its arrays"


def unit_in(text: str) -> bool:
    """Return whether a text gives a unit or states that there is none."""
    return bool(UNIT.search(SHAPE.sub("", text)))


class Raised:
    """Errors of the project that the functions of a file raise, directly or through private functions."""

    def __init__(self, tree: ast.Module, kinds: dict[str, set[str]]):
        self.kinds = kinds
        functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
        self.private = {f.name: f for f in functions if f.name[0] == "_" and f.name[:2] != "__"}

    def undocumented(self, function: ast.FunctionDef, docstring: str) -> list[str]:
        """Return the errors that a docstring does not document."""
        documented = {*re.findall(r"\bRaises\s+(\w+)", docstring)}
        documented |= words(docstring.partition("Raises\n------\n")[2])
        missing = [e for e in sorted(self.by(function, set())) if not self.kinds[e] & documented]
        return [f"no sentence 'Raises {error}'" for error in missing]

    def by(self, function: ast.FunctionDef, seen: set[str]) -> set[str]:
        """Return the names of the errors that a function raises."""
        found = set()
        for node in ast.walk(function):
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
                found |= {ast.unparse(node.exc.func).rpartition(".")[2]} & self.kinds.keys()
            name = called(node)
            if name in self.private and name not in seen:
                found |= self.by(self.private[name], seen | {name})
        return found


def called(node: ast.AST) -> str:
    """Return the last part of the name that a node calls; "" if it calls none."""
    return ast.unparse(node.func).rpartition(".")[2] if isinstance(node, ast.Call) else ""


def words(text: str) -> set[str]:
    """Return the words of a text."""
    return set(re.findall(r"\w+", text))


if __name__ == "__main__":
    main()
