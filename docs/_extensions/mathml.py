"""Formulas as MathML, which browsers draw themselves: a page needs neither a network nor a script."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx

NUMBER = re.compile(r"\s*\\tag\{(.*?)\}")
#: what is usual in TeX and docutils does not know, with what it does
KNOWN = (
    (re.compile(r"\\([Bb]ig)(?=[(\[])"), r"\\\1l"),
    (re.compile(r"\\([Bb]ig)(?=[)\]])"), r"\\\1r"),
    (re.compile(r"\\[Bb]ig/"), "/"),
    (re.compile(r"\\dots\b"), r"\\ldots"),
)


def mathml(formula: str, **options: bool) -> str:
    """A formula of TeX in MathML."""
    for pattern, known in KNOWN:
        formula = pattern.sub(known, formula)
    drawn: str = tex2mathml(formula.strip(), **options)
    return drawn


def inline(translator: Any, node: nodes.math) -> None:
    """A formula within a line."""
    translator.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def block(translator: Any, node: nodes.math_block) -> None:
    """A formula by itself, its number at the right."""
    formula, number = node.astext(), ""
    if numbered := NUMBER.search(formula):
        formula, number = NUMBER.sub("", formula), f"({numbered[1]})"
    drawn = mathml(formula, as_block=True)
    anchor = f' id="equation-{number.strip("()")}"' if number else ""
    translator.body.append(
        f'<div class="formula"{anchor}><div>{drawn}</div><span>{number}</span></div>\n'
    )
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Make it known to Sphinx as ``html_math_renderer = "mathml"``."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
