"""Faults of the YAML syntax, in words for the author of a file instead of those of the parser."""

from __future__ import annotations

import re
from typing import NamedTuple

from ruamel.yaml.error import MarkedYAMLError, YAMLError


class Fault(NamedTuple):
    """Words for a fault that the parser reports by a problem and by what it was reading."""

    problem: str  # regular expression
    reading: str  # regular expression
    found: str
    remedy: str


_INDENTED = ("the indentation differs from that of the lines before", "indent all keys of a group equally")
_BRACKET = (
    "an item or the bracket around it is not complete",
    "separate items by commas, write keys as 'name: value', put text with [ ] {{ }} or a comma in quotes, "
    "and close the bracket that opens in line {begin}",
)
_CHARACTER = ("a value cannot begin with {quoted}", "put the value in quotes")
_FAULTS = (
    Fault("expected .* or .*, but got", "flow", *_BRACKET),
    Fault("expected the node content", "flow", *_BRACKET),
    Fault(
        "mapping values are not allowed",
        "",
        "': ' occurs twice, or the line is indented further than the line before it",
        "put text that contains ': ' in quotes, or indent all keys of a group equally",
    ),
    Fault("expected <block end>", "", *_INDENTED),
    Fault("sequence entries are not allowed", "", *_INDENTED),
    Fault("expected the node content", "block", *_CHARACTER),
    Fault(
        "could not find expected",
        "",
        "line {begin} is not complete",
        "write it as 'name: value', or in quotes",
    ),
    Fault("found character '\\\\t'", "", "the line is indented by a tab", "indent lines by spaces"),
    Fault("found character", "", *_CHARACTER),
    Fault(
        "end of stream",
        "quoted",
        "the quotation mark that opens in line {begin} is never closed",
        "close it, or double a quotation mark that belongs to the text",
    ),
    Fault(
        "", "block scalar", "only + or - may follow > or |", "begin the text on the next line, or in quotes"
    ),
    Fault(
        "unknown escape character",
        "",
        "the character after a backslash has no meaning",
        "use single quotes, or double the backslash",
    ),
    Fault("found duplicate key", "", "the group has the key {quoted} twice", "remove one of the two"),
)


def in_words(error: YAMLError) -> tuple[str, str, str]:
    """Return place, fault and remedy of an error of the parser."""
    problem = str(getattr(error, "problem", None) or "the file is not valid YAML")
    if not isinstance(error, MarkedYAMLError) or error.problem_mark is None:
        return "", problem, "correct the YAML syntax"
    line = error.problem_mark.line + 1
    begin = error.context_mark.line + 1 if error.context_mark else line
    for fault in _FAULTS:
        if re.search(fault.problem, problem) and re.search(fault.reading, str(error.context)):
            quoted = re.search("'.*?'|\".*?\"", problem)  # a character or a key
            facts = {"begin": begin, "quoted": quoted[0] if quoted else ""}
            return f"line {line}", fault.found.format(**facts), fault.remedy.format(**facts)
    return f"line {line}", problem, "correct the YAML syntax there"
