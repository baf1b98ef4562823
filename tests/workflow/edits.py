"""Edits of a source file, drawn at random: of its prose, and of what it does."""

import ast

from riserstudy.files import digests

FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
SCOPES = (ast.Module, ast.ClassDef, *FUNCTIONS)


def forget_sources():
    """Forget what this process has found out about sources, before or after an edit of them."""
    for found in vars(digests).values():
        if hasattr(found, "cache_clear"):
            found.cache_clear()


def prose_edit(text, draw):
    """The text with another comment, docstring, annotation or layout: name of the edit and new text."""
    return _first_possible(PROSE, text, draw)


def edit(text, draw):
    """The text after an edit that changes what it does: name of the edit and new text."""
    return _first_possible(MEANING, text, draw)


def _first_possible(edits, text, draw):
    for one in draw.sample(edits, len(edits)):
        new = one(text, ast.parse(text), draw)
        if new is not None:
            return one.__name__, new
    return None, text


# Prose, edited as text


def comment(text, tree, draw):
    places = [node for node in ast.walk(tree) if isinstance(node, ast.stmt)]
    if not places:
        return f"# {draw.random()}\n{text}"
    node = draw.choice(places)
    decorators = getattr(node, "decorator_list", None)
    line = min(one.lineno for one in [node, *(decorators or [])])
    lines = text.splitlines(keepends=True)
    if lines[line - 1][: node.col_offset].strip():
        return None  # `else: x = 1`, or the decorator's line
    lines.insert(line - 1, f"{' ' * node.col_offset}# {draw.random()}\n\n")
    return "".join(lines)


def layout(text, tree, draw):
    return ast.unparse(tree)


def docstring(text, tree, draw):
    """Another one, or one where there was none."""
    places = [node for node in ast.walk(tree) if isinstance(node, SCOPES) and node.body]
    if not places or _reads_prose(tree):
        return None
    node = draw.choice(places)
    if ast.get_docstring(node, clean=False) is not None:
        return _replaced(text, node.body[0], f'"""Words {draw.random()}"""')
    if isinstance(node, ast.Module):
        return None
    node.body.insert(0, ast.Expr(ast.Constant(f"Words {draw.random()}")))
    return ast.unparse(tree)


def no_docstring(text, tree, draw):
    places = [
        node
        for node in ast.walk(tree)
        if isinstance(node, SCOPES)
        and len(node.body) > 1
        and ast.get_docstring(node) is not None
        and not (isinstance(node, ast.Module) and _is_future(node.body[1]))
    ]
    if not places or _reads_prose(tree):
        return None
    return _replaced(text, draw.choice(places).body[0], "pass")


def annotation_of_a_function(text, tree, draw):
    """Another one, of an argument or of what is returned, in a file that postpones them."""
    if not _postpones(tree):
        return None
    plain = [n for n in ast.walk(tree) if isinstance(n, FUNCTIONS) and not n.decorator_list]
    arguments = [a for n in plain for a in (*n.args.args, *n.args.kwonlyargs) if a.annotation]
    places = [*(a.annotation for a in arguments), *(n.returns for n in plain if n.returns)]
    if not places:
        return None
    return _replaced(text, draw.choice(places), draw.choice(["object", "'words'", "list[Any]"]))


def no_annotation(text, tree, draw):
    """Of an argument, where there was one; one of what is returned, where there was none."""
    if not _postpones(tree):
        return None
    plain = [n for n in ast.walk(tree) if isinstance(n, FUNCTIONS) and not n.decorator_list]
    if not plain:
        return None
    node = draw.choice(plain)
    for argument in (*node.args.args, *node.args.kwonlyargs):
        argument.annotation = None
    node.returns = None if node.returns else ast.Name("object")
    return ast.unparse(tree)


def annotation_of_a_local(text, tree, draw):
    places = [
        node
        for function in ast.walk(tree)
        if isinstance(function, FUNCTIONS)
        for node in function.body
        if isinstance(node, ast.Assign) and len(node.targets) == 1 and isinstance(node.targets[0], ast.Name)
    ]
    places = [node for node in places if node.targets[0].id not in _shared(tree)]
    if not places:
        return None
    name = draw.choice(places).targets[0]
    return _replaced(text, name, f"{name.id}: object")


def import_of_a_type(text, tree, draw):
    """One that nothing uses."""
    if not _postpones(tree):
        return None
    line = next(node for node in tree.body if _is_future(node)).end_lineno
    lines = text.splitlines(keepends=True)
    new = draw.choice(["from typing import Sized\n", "from collections.abc import Sized\n"])
    only = "from typing import TYPE_CHECKING\n\nif TYPE_CHECKING:\n    import calendar\n"
    lines.insert(line, draw.choice([new, only]))
    return "".join(lines)


PROSE = [
    *(comment, layout, docstring, no_docstring, annotation_of_a_function, no_annotation),
    *(annotation_of_a_local, import_of_a_type),
]


# What a file does, edited as a tree


def _edit(kind, change):
    """An edit of one node of a kind, drawn from those where `change` is possible."""

    def edited(text, tree, draw):
        prose = {id(node) for node in _prose(tree)}
        nodes = [n for n in ast.walk(tree) if isinstance(n, kind) and id(n) not in prose]
        draw.shuffle(nodes)
        for node in nodes:
            before = ast.dump(node)
            change(node, draw)
            if ast.dump(node) != before:
                return ast.unparse(ast.fix_missing_locations(tree))
        return None

    edited.__name__ = change.__name__
    return edited


def constant(node, draw):
    value = node.value
    if isinstance(value, bool):
        node.value = not value
    elif isinstance(value, int | float):
        node.value = value + draw.choice([1, 0.5])
    elif isinstance(value, str):
        node.value = f"{value}."


def default(node, draw):
    if node.defaults:
        node.defaults[draw.randrange(len(node.defaults))] = ast.Constant(draw.random())


def operator(node, draw):
    node.op = ast.Sub() if isinstance(node.op, ast.Add) else ast.Add()


def comparison(node, draw):
    node.ops[0] = ast.LtE() if isinstance(node.ops[0], ast.Lt) else ast.Lt()


def name(node, draw):
    node.id = f"{node.id}_"


def attribute(node, draw):
    node.attr = f"{node.attr}_"


def order_of_arguments(node, draw):
    node.args.reverse()


def keyword(node, draw):
    if node.arg:
        node.arg = f"{node.arg}_"


def branches(node, draw):
    node.body, node.orelse = node.orelse or [ast.Pass()], node.body


def statements(node, draw):
    """Lose one that does something."""
    last = node.body[-1]
    prose = isinstance(last, ast.Expr) and isinstance(last.value, ast.Constant)
    if len(node.body) > 1 and not prose and not isinstance(last, ast.Pass | ast.AnnAssign):
        node.body.pop()


def decorators(node, draw):
    node.decorator_list = node.decorator_list[1:] or [ast.Name("other")]


def field(node, draw):
    """The annotation of a field of a class."""
    for one in node.body:
        if isinstance(one, ast.AnnAssign):
            one.annotation = ast.Subscript(ast.Name("list"), one.annotation)
            return


def base_class(node, draw):
    node.bases.append(ast.Name("Other"))


def another_module(node, draw):
    if node.module != "__future__":
        node.module = f"{node.module}_"


MEANING = [
    _edit(ast.Constant, constant),
    _edit(ast.arguments, default),
    _edit(ast.BinOp, operator),
    _edit(ast.Compare, comparison),
    _edit(ast.Name, name),
    _edit(ast.Attribute, attribute),
    _edit(ast.Call, order_of_arguments),
    _edit(ast.keyword, keyword),
    _edit(ast.If, branches),
    _edit(FUNCTIONS, statements),
    _edit(FUNCTIONS, decorators),
    _edit(ast.ClassDef, field),
    _edit(ast.ClassDef, base_class),
    _edit(ast.ImportFrom, another_module),
]


def _prose(tree):
    """Nodes that nothing reads: in docstrings, annotations but those of fields, and what only types need."""
    for node in ast.walk(tree):
        if isinstance(node, SCOPES) and ast.get_docstring(node) is not None:
            yield from ast.walk(node.body[0])
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            yield from ast.walk(node)
        if isinstance(node, ast.arg) and node.annotation:
            yield from ast.walk(node.annotation)
        if isinstance(node, FUNCTIONS) and node.returns:
            yield from ast.walk(node.returns)
        if isinstance(node, ast.AnnAssign) and not node.value:
            yield node.target
        if isinstance(node, ast.AnnAssign):
            yield from ast.walk(node.annotation)
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            yield from ast.walk(node)
        if isinstance(node, ast.ImportFrom) and node.module in ("typing", "collections.abc"):
            yield from ast.walk(node)


def _replaced(text, node, new):
    """The text with another one in the place of a node."""
    lines = text.encode().splitlines(keepends=True)
    start = sum(map(len, lines[: node.lineno - 1])) + node.col_offset
    end = sum(map(len, lines[: node.end_lineno - 1])) + node.end_col_offset
    whole = b"".join(lines)
    return (whole[:start] + new.encode() + whole[end:]).decode()


def _is_future(node):
    return isinstance(node, ast.ImportFrom) and node.module == "__future__"


def _postpones(tree):
    return any(_is_future(node) for node in tree.body) and not _reads_prose(tree)


def _reads_prose(tree):
    """Whether a file may read docstrings or annotations."""
    text = ast.unparse(tree)
    words = ("__doc__", "getdoc", "inspect", "typer", "__annotations__", "get_type_hints")
    return any(word in text for word in words)


def _shared(tree):
    """Names that a function declares to be another scope's, which cannot be annotated."""
    kinds = (ast.Global, ast.Nonlocal)
    return {name for node in ast.walk(tree) if isinstance(node, kinds) for name in node.names}
