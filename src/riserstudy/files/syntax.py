"""The meaning of a source file when it runs: its syntax tree as text, which edits of prose do not change.

The text does not contain comments, layout, or the notation of a constant (``1e3``, ``1000.0``). It does not
contain the following either, which no running code reads:

- strings and other constants that are a statement of their own, such as docstrings, unless the file itself
  reads docstrings (``__doc__`` and similar names);
- annotations of variables inside functions: Python neither evaluates nor stores them;
- annotations of functions and of a module's variables, if the file postpones their evaluation
  (``from __future__ import annotations``) and contains no name that reads them. The annotations of a
  decorated function are left out only if its decorators are known not to read them;
- blocks under ``if TYPE_CHECKING``, and imports from ``typing`` and ``collections.abc`` without ``as``: the
  uses of such a name are kept.

Annotations in a class are kept, because in dataclasses, named tuples and pydantic models they are the fields.
The text is the same for every Python that can read the file.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

#: names with which a file reads docstrings, here of functions and classes
DOCSTRING_READERS = {"__doc__", "getdoc", "use_attribute_docstrings"}
#: names with which a file reads annotations of functions, directly or through a library
ANNOTATION_READERS = {
    *("__annotations__", "get_annotations", "get_type_hints", "getfullargspec", "inspect"),
    *("singledispatch", "singledispatchmethod", "typer", "validate_call", "computed_field"),
    *("field_serializer", "model_serializer", "PlainSerializer", "WrapSerializer"),
}
#: decorators that read no annotations
BLIND = {
    *("property", "setter", "cached_property", "staticmethod", "classmethod", "abstractmethod"),
    *("cache", "lru_cache", "wraps", "contextmanager", "override"),
    # pydantic reads only their number of arguments
    *("model_validator", "field_validator"),
    # numba infers types from the arguments of a call
    *("kernel", "inner", "unrolled", "njit"),
}
TYPES_ALONE = {"typing", "collections.abc"}
#: fields of a node with the context of a name or the notation of a constant
PROSE = {"ctx", "kind", "type_comment", "type_ignores"}
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
SCOPES = {ast.FunctionDef: "function", ast.AsyncFunctionDef: "function", ast.ClassDef: "class"}


def meaning(tree: ast.Module) -> str:
    """Return the syntax tree as text, without the parts that have no meaning when it runs."""
    return "".join(_Writer(tree).module(tree))


class _Writer:
    """Writes a tree; it knows which annotations and docstrings the file reads."""

    def __init__(self, tree: ast.Module):
        names = set(_names(tree))
        self.prose = not names & DOCSTRING_READERS
        postponed = any(
            isinstance(node, ast.ImportFrom)
            and node.module == "__future__"
            and any(alias.name == "annotations" for alias in node.names)
            for node in tree.body
        )
        self.unread = postponed and not names & ANNOTATION_READERS

    def module(self, tree: ast.Module) -> Iterator[str]:
        yield from self.block(tree.body, "module")

    def block(self, body: list[ast.stmt], scope: str) -> Iterator[str]:
        """Yield the statements of a block that have an effect."""
        yield "["
        for node in body:
            yield from self.statement(node, scope)
        yield "]"

    def statement(self, node: ast.stmt, scope: str) -> Iterator[str]:
        if isinstance(node, ast.Pass):
            return
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and self.prose:
            return
        if isinstance(node, ast.If) and _name_of(node.test) == "TYPE_CHECKING":
            for other in node.orelse:
                yield from self.statement(other, scope)
        elif isinstance(node, ast.ImportFrom) and node.module in TYPES_ALONE and not node.level:
            kept = [alias for alias in node.names if alias.asname or alias.name == "*"]
            if kept:
                yield from self.node(ast.ImportFrom(node.module, kept, 0), scope)
        elif isinstance(node, ast.AnnAssign) and self.is_unread(scope):
            yield from self.unannotated(node, scope)
        else:
            yield from self.node(node, scope)

    def is_unread(self, scope: str) -> bool:
        """Return whether no code reads the annotation of a variable."""
        return scope == "function" or (scope == "module" and self.unread)

    def unannotated(self, node: ast.AnnAssign, scope: str) -> Iterator[str]:
        """Yield an assignment without its annotation; even without a value it makes a name local."""
        if node.value is not None:
            yield from self.node(ast.Assign([node.target], node.value), scope)
        elif scope == "function" and isinstance(node.target, ast.Name):
            yield f"local({node.target.id})"

    def node(self, node: ast.AST, scope: str) -> Iterator[str]:
        """Yield a node by its fields; empty fields, of which newer Pythons have more, are left out."""
        if isinstance(node, ast.Constant):
            yield f"{type(node.value).__name__}:{node.value!a},"
            return
        blind = isinstance(node, FUNCTIONS) and self.is_blind(node)
        within = SCOPES.get(type(node), scope)
        yield f"{type(node).__name__}("
        for name, value in ast.iter_fields(node):
            if name in PROSE or value is None or value == [] or (blind and name == "returns"):
                continue
            yield f"{name}="
            if name == "args" and isinstance(value, ast.arguments):
                yield from self.arguments(value, within, blind)
            elif name in ("body", "orelse", "finalbody") and isinstance(value, list):
                yield from self.block(value, within)
            else:
                yield from self.value(value, scope)
        yield ")"

    def value(self, value: object, scope: str) -> Iterator[str]:
        """Yield a field of a node."""
        if isinstance(value, ast.AST):
            yield from self.node(value, scope)
        elif isinstance(value, list):
            yield "["
            for one in value:
                yield from self.value(one, scope)
            yield "]"
        else:
            yield f"{value!a},"

    def arguments(self, node: ast.arguments, scope: str, blind: bool) -> Iterator[str]:
        """Yield the arguments of a function, without annotations if no code reads them."""
        for name, value in ast.iter_fields(node):
            if value is None or value == []:
                continue
            yield f"{name}="
            for one in value if isinstance(value, list) else [value]:
                if blind and isinstance(one, ast.arg):
                    yield f"{one.arg},"
                else:
                    yield from self.value(one, scope)

    def is_blind(self, node: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
        """Return whether no code reads the annotations of a function."""
        return self.unread and all(_name_of(one) in BLIND for one in node.decorator_list)


def _names(tree: ast.AST) -> Iterator[str]:
    """Yield all names in a file: of variables, attributes and imports."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.alias):
            yield from node.name.split(".")
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from node.module.split(".")
        elif isinstance(node, ast.keyword) and node.arg:
            yield node.arg


def _name_of(node: ast.expr) -> str:
    """Return the last name of ``a.b`` and of ``a.b(...)``."""
    if isinstance(node, ast.Call):
        node = node.func
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""
