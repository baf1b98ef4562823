"""A digest of code is blind to prose, and to nothing else."""

import ast
import random
import sys
from pathlib import Path

import pytest

from riserstudy.files.syntax import meaning
from riserstudy.folders import PACKAGE

sys.path.append(str(Path(__file__).parents[1] / "workflow"))
from edits import edit, prose_edit

FILES = sorted(PACKAGE.rglob("*.py"))


def meant(text):
    return meaning(ast.parse(text))


@pytest.mark.parametrize("seed", range(6))
def test_no_edit_of_prose_changes_what_a_file_means(seed):
    draw = random.Random(seed)
    done = set()
    for _ in range(20):
        file = draw.choice(FILES)
        text = file.read_text()
        for _ in range(3):  # one after the other
            kind, text = prose_edit(text, draw)
            done.add(kind)
        assert meant(text) == meant(file.read_text()), (file, kind)
    assert len(done) >= 7


@pytest.mark.parametrize("seed", range(6))
def test_every_edit_of_code_changes_what_a_file_means(seed):
    draw = random.Random(seed)
    done = set()
    for _ in range(60):
        file = draw.choice(FILES)
        kind, text = edit(file.read_text(), draw)
        if kind:
            done.add(kind)
            assert meant(text) != meant(file.read_text()), (file, kind)
    assert len(done) >= 10


SAMPLE = '''
"""What it is."""
from __future__ import annotations
from typing import Any
import math as m

KNOWN: dict[str, float] = {"a": 1e3, "b": -0.5}


@inner
def f(x: float, *rest: Any, y: float = 2, **more) -> float:
    """Docstring."""
    z: float = x if x < y else m.sqrt(y)
    return f"{z!r:>{y}} é" + 'text' "joined"


class Row(NamedTuple):
    size: int
'''
MEANT = (
    "[ImportFrom(module='__future__',names=[alias(name='annotations',)]level=0,)"
    "Import(names=[alias(name='math',asname='m',)])"
    "Assign(targets=[Name(id='KNOWN',)]value=Dict(keys=[str:'a',str:'b',]"
    "values=[float:1000.0,UnaryOp(op=USub()operand=float:0.5,)]))"
    "FunctionDef(name='f',args=args=x,vararg=rest,kwonlyargs=y,kw_defaults=int:2,kwarg=more,body="
    "[Assign(targets=[Name(id='z',)]value=IfExp(test=Compare(left=Name(id='x',)ops=[Lt()]"
    "comparators=[Name(id='y',)])body=Name(id='x',)orelse=Call(func=Attribute(value=Name(id='m',)"
    "attr='sqrt',)args=[Name(id='y',)])))Return(value=BinOp(left=JoinedStr(values="
    "[FormattedValue(value=Name(id='z',)conversion=114,format_spec=JoinedStr(values=[str:'>',"
    "FormattedValue(value=Name(id='y',)conversion=-1,)]))str:' \\xe9',])op=Add()"
    "right=str:'textjoined',))]decorator_list=[Name(id='inner',)])"
    "ClassDef(name='Row',bases=[Name(id='NamedTuple',)]body=[AnnAssign(target=Name(id='size',)"
    "annotation=Name(id='int',)simple=1,)])]"
)


def test_every_python_finds_the_same_meaning():
    assert meant(SAMPLE) == MEANT


@pytest.mark.parametrize(
    "before, after",
    [
        ("class A:\n    x: int", "class A:\n    x: float"),
        ("class A(M):\n    x: int = 1", "class A(M):\n    x = 1"),
        ("def f(x: int): ...", "def f(x: float): ..."),  # evaluated: not postponed
        (
            "from __future__ import annotations\nimport typer\ndef f(x: int): ...",
            "from __future__ import annotations\nimport typer\ndef f(x: float): ...",
        ),
        (
            "from __future__ import annotations\n@computed_field\ndef f(x) -> int: ...",
            "from __future__ import annotations\n@computed_field\ndef f(x) -> float: ...",
        ),
        (
            "from __future__ import annotations\n@unknown\ndef f(x: int): ...",
            "from __future__ import annotations\n@unknown\ndef f(x: float): ...",
        ),
        ("def f():\n    x: int\n    return x", "def f():\n    return x"),  # x is local, or is not
        ('"""A."""\nprint(__doc__)', '"""B."""\nprint(__doc__)'),
        ("x = 1", "x = 1.0"),
        ("x = 1", "x = True"),
        ("x = 0.0", "x = -0.0"),
        ("from typing import List as L", "from typing import Dict as L"),
        ("from numpy import array", "from numba import array"),
        ("def f(a, /, b): ...", "def f(a, b): ..."),
        ("def f(a, *, b): ...", "def f(a, b): ..."),
        ("x = 'a' 'b'", "x = 'a', 'b'"),
        ("if TYPE_CHECKING:\n    x = 1\nelse:\n    x = 2", "x = 3"),
    ],
)
def test_what_can_be_read_counts(before, after):
    assert meant(before) != meant(after)
