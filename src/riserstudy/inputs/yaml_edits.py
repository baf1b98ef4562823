"""Change values in the text of a YAML file, and nothing else: remarks, empty lines and line ends stay."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import Any, NamedTuple

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap
from ruamel.yaml.nodes import CollectionNode, MappingNode, Node


class Edit(NamedTuple):
    """A part of a text, and what replaces it."""

    begin: int
    end: int
    new: str


class Pair(NamedTuple):
    """A key of a mapping and its value, by their places in the text."""

    begin: int  # of the key
    column: int  # of the key
    value: Any  # a node
    end: int  # of the value


#: lines of keys to set; None deletes a key
Changes = Mapping[str, str | None]


def tree_of(text: str) -> Any:
    """Return the node of a whole YAML text."""
    return YAML().compose(text)


def pairs_of(node: MappingNode) -> dict[str, Pair]:
    """Return the keys of a mapping, in order."""
    return {
        str(key.value): Pair(key.start_mark.index, key.start_mark.column, value, _end(value))
        for key, value in node.value
    }


def _end(node: Node) -> int:
    """Return the end of a value, without the remarks and empty lines below it."""
    if isinstance(node, CollectionNode) and not node.flow_style and node.value:
        last = node.value[-1]
        return _end(last[1] if isinstance(last, tuple) else last)
    return int(node.end_mark.index)


def line_of(key: str, value: Any) -> str:
    """Return a key with its value in one line."""
    yaml, text = YAML(), io.StringIO()
    yaml.width = 1_000_000
    yaml.representer.add_representer(
        type(None), lambda it, _: it.represent_scalar("tag:yaml.org,2002:null", "null")
    )
    yaml.dump({key: _flow(value)}, text)
    return text.getvalue().rstrip("\n")


def _flow(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    made = CommentedMap({key: _flow(one) for key, one in value.items()})
    made.fa.set_flow_style()
    return made


def in_braces(text: str, node: MappingNode | None, changes: Changes) -> str:
    """Return a mapping in braces, with changes; new keys come last."""
    held = {key: text[pair.begin : pair.end] for key, pair in pairs_of(node).items()} if node else {}
    lines = {**held, **changes}
    return "{" + ", ".join(line for line in lines.values() if line is not None) + "}"


def in_lines(text: str, node: MappingNode, changes: Changes, after: str | None = None) -> list[Edit]:
    """Return the edits of a mapping with a key in each line.

    ``after``: key that new keys follow; absent: they follow the last changed key, or else the last key.
    """
    held, edits = pairs_of(node), []
    margin = end_of_lines(text) + " " * node.start_mark.column
    for key in held.keys() & changes.keys():
        begin, line = held[key].begin, changes[key]
        if line is None:  # with the end of the line above
            above = begin - held[key].column
            edits.append(Edit(above - len(end_of_lines(text[:above])), _line_end(text, held[key].end), ""))
        else:
            edits.append(Edit(begin, held[key].end, line.replace("\n", margin)))
    new = [line for key, line in changes.items() if key not in held and line is not None]
    place = after or ([key for key in held if changes.get(key)] or [*held])[-1]
    where = _line_end(text, held[place].end)
    return [*edits, Edit(where, where, "".join(margin + line.replace("\n", margin) for line in new))]


def applied(text: str, edits: list[Edit]) -> str:
    """Return the text after edits, of which those at one place follow each other in the order given."""
    ordered = sorted(edits, key=lambda edit: edit.begin)
    for edit in reversed(ordered):
        text = text[: edit.begin] + edit.new + text[edit.end :]
    return text


def end_of_lines(text: str) -> str:
    """Return the end of the last whole line of a text."""
    before = text[: text.rfind("\n") + 1]
    return "\r\n" if before.endswith("\r\n") else "\n"


def _line_end(text: str, place: int) -> int:
    """Return the end of a line, without the characters that end it."""
    found = text.find("\n", place)
    found = len(text) if found < 0 else found
    return found - 1 if text[place:found].endswith("\r") else found
