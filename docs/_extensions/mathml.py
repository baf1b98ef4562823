"""Formulas as MathML, which browsers draw themselves: a page needs neither a network nor a script."""

from __future__ import annotations

import re
from html import unescape
from typing import Any
from xml.etree import ElementTree

from docutils import nodes
from docutils.utils.math.latex2mathml import accents, tex2mathml
from sphinx.application import Sphinx

ACCENTS = set(accents.values())
NAMESPACE = re.compile(r' xmlns="[^"]*"')
NAMED = re.compile(r"&(?!(?:amp|lt|gt);)\w+;")  # what HTML knows and XML does not
NUMBER = re.compile(r"\s*\\tag\{(.*?)\}")
#: what is usual in TeX and docutils does not know, with what it does
KNOWN = (
    (re.compile(r"\\([Bb]ig)(?=[(\[])"), r"\\\1l"),
    (re.compile(r"\\([Bb]ig)(?=[)\]])"), r"\\\1r"),
    (re.compile(r"\\[Bb]ig/"), "/"),
    (re.compile(r"\\dots\b"), r"\\ldots"),
    # a fraction of two digits without braces, which it takes for a number over what comes next
    (re.compile(r"\\([td]?frac)\s*(\d)\s*(\d)"), r"\\\1{\2}{\3}"),
)


def mathml(formula: str, **options: bool) -> str:
    """A formula of TeX in MathML."""
    for pattern, known in KNOWN:
        formula = pattern.sub(known, formula)
    drawn = _elements(tex2mathml(formula.strip(), **options))
    for node in list(drawn.iter("munderover")):
        _set_index_at_foot(node)
    return ElementTree.tostring(drawn, encoding="unicode", short_empty_elements=False)


def _elements(text: str) -> ElementTree.Element:
    """MathML as a tree: without its name space, which HTML does not need, names of letters as letters."""
    text = NAMED.sub(lambda name: unescape(name[0]), NAMESPACE.sub("", text))
    return ElementTree.fromstring(text)


def _set_index_at_foot(node: ElementTree.Element) -> None:
    """The index of an accented letter stands at its foot; docutils sets it below, as that of a sum."""
    letter, index, accent = node
    if accent.text in ACCENTS:
        accented = ElementTree.Element("mover", {"accent": "true"})
        accented.extend([letter, accent])
        node.tag = "msub"
        node[:] = [accented, index]


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
    translator.body.append(f'<div class="formula"{anchor}><div>{drawn}</div><span>{number}</span></div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Make it known to Sphinx as ``html_math_renderer = "mathml"``."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
