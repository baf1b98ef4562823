"""What of a source file has a meaning when it runs: its syntax tree as text that editing prose leaves alone.

Not in that text are comments, layout, how a constant is written (``1e3``, ``1000.0``), and, because it can be
shown that nothing which runs reads them:

- strings and other constants that stand alone as a statement, docstrings among them, unless the file itself
  reads docstrings (``__doc__`` and its like);
- annotations of variables within functions: Python neither evaluates nor keeps them;
- annotations of functions and of a module's variables where the file postpones their evaluation
  (``from __future__ import annotations``) and names nothing that reads them. A decorated function loses
  them only under decorators that are known to read none;
- blocks under ``if TYPE_CHECKING``, and names imported from ``typing`` and ``collections.abc`` without
  another name: where such a name is used, the use stays.

Annotations in a class are kept: those of dataclasses, named tuples and pydantic models are their fields.
The text is the same for every Python that can read the file.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

#: names by which a file reads docstrings, here of functions and classes
DOCSTRING_READERS = {"__doc__", "getdoc", "use_attribute_docstrings"}
#: names by which a file reads annotations of functions, or has them read
ANNOTATION_READERS = {
    *("__annotations__", "get_annotations", "get_type_hints", "getfullargspec", "inspect"),
    *("singledispatch", "singledispatchmethod", "typer", "validate_call", "computed_field"),
    *("field_serializer", "model_serializer", "PlainSerializer", "WrapSerializer"),
}
#: decorators that read no annotations
BLIND = {
    *("property", "setter", "cached_property", "staticmethod", "classmethod", "abstractmethod"),
    *("cache", "lru_cache", "wraps", "contextmanager", "override"),
    # pydantic looks at how many arguments they take
    *("model_validator", "field_validator"),
    # numba infers types from what a function is called with
    *("kernel", "inner", "unrolled", "njit"),
}
TYPES_ALONE = {"typing", "collections.abc"}
#: of a node, what says where a name stands, or how a constant was written
PROSE = {"ctx", "kind", "type_comment", "type_ignores"}
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
SCOPES = {ast.FunctionDef: "function", ast.AsyncFunctionDef: "function", ast.ClassDef: "class"}


def meaning(tree: ast.Module) -> str:
    """The syntax tree as text, without what has no meaning when it runs."""
    return "".join(_Writer(tree).module(tree))


class _Writer:
    """Writes a tree, knowing what its file reads."""

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
        """Statements of a block that do something."""
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
        """Whether nothing reads the annotation of a variable."""
        return scope == "function" or (scope == "module" and self.unread)

    def unannotated(self, node: ast.AnnAssign, scope: str) -> Iterator[str]:
        """An assignment; without a value it still makes a name local."""
        if node.value is not None:
            yield from self.node(ast.Assign([node.target], node.value), scope)
        elif scope == "function" and isinstance(node.target, ast.Name):
            yield f"local({node.target.id})"

    def node(self, node: ast.AST, scope: str) -> Iterator[str]:
        """A node of any kind, by its fields; empty ones, of which newer Pythons have more, are left out."""
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
        """A field of a node."""
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
        """Arguments of a function, without annotations where nothing reads them."""
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
        """Whether nothing reads the annotations of a function."""
        return self.unread and all(_name_of(one) in BLIND for one in node.decorator_list)


def _names(tree: ast.AST) -> Iterator[str]:
    """All names that a file mentions: of variables, attributes and imports."""
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
    """Last name of ``a.b`` and of ``a.b(...)``."""
    if isinstance(node, ast.Call):
        node = node.func
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""
