"""Plain YAML: tags, aliases and duplicate keys are refused; nothing is executed."""

from __future__ import annotations

import hashlib
import math
import re
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from riserstudy.errors import InputError
from riserstudy.files.cache import remembered
from riserstudy.files.digests import digest
from riserstudy.inputs.text import read_text
from riserstudy.inputs.yaml_faults import in_words

MOST_BYTES = 1_000_000  # largest input file
DEEPEST = 20  # most nesting levels
TOO_DEEP = ("nested too deeply", f"use at most {DEEPEST} levels of fields within fields")
MANY = 1000  # most brackets, which may be nested; the time of the parser grows as their square
# Characters that begin tags, anchors and aliases, at a place where a value may begin.
_SPECIAL = re.compile(r"(?:^|[\s\ufeff,\[{:?-])[!&*]")
# an escape such as "\ud83d" writes half of a character, the next one the other half
_HALVES = re.compile(r"\\[uU](0000)?[dD][89a-fA-F]")
# control characters, which change a terminal, and halves of characters, which no file can contain
_NO_TEXT = re.compile(r"[\x00-\x08\x0e-\x1f\x7f-\x84\x86-\x9f\ud800-\udfff]")
NO_TEXT = "remove this control character"


def read_yaml(path: Path, *, keep: bool = False) -> Any:
    """Read a YAML file as plain data. Tags, aliases and duplicate keys are refused; nothing is executed.

    With ``keep`` the data are stored in the cache: reading them again is a hundred times as fast.
    """
    text = read_text(Path(path), MOST_BYTES)
    if not keep:
        return plain_yaml(text, path)
    name = f"yaml/{_reader()}-{hashlib.sha256(text.encode()).hexdigest()}"
    return remembered(name, lambda: plain_yaml(text, path))


@cache
def _reader() -> str:
    """Return a digest that identifies this version of the reader."""
    return f"{version('ruamel.yaml')}-{digest([Path(__file__)])}"


def plain_yaml(text: str, source: object) -> Any:
    """Return the plain data of a YAML text; ``source`` names the text in errors.

    Raises InputError when the text is not plain YAML: invalid YAML, tags, anchors, duplicate names, or too
    deep nesting.
    """
    reader = YAML(typ="safe", pure=True)
    reader.allow_duplicate_keys = False
    try:
        if _SPECIAL.search(text) or text.count("[") + text.count("{") > MANY:
            _scan(text, source)  # scanning every token takes as long as parsing
        data = reader.load(text)
        data = _joined(data) if _HALVES.search(text) else data
    except YAMLError as error:
        raise InputError(source, *in_words(error)) from None
    except (RecursionError, ValueError) as error:
        raise InputError(source, "", f"the YAML cannot be read: {error}"[:200], "correct the file") from None
    fault = plain_fault(data)
    if fault:
        raise InputError(source, *fault)
    return data


def _joined(data: Any) -> Any:
    """Return data in which a character that is written in two halves, as JSON may have it, is one."""
    if isinstance(data, dict):
        return {key: _joined(value) for key, value in data.items()}
    if isinstance(data, list):
        return [_joined(value) for value in data]
    if isinstance(data, str):
        return data.encode("utf-16", "surrogatepass").decode("utf-16", "surrogatepass")
    return data


def _scan(text: str, source: object) -> None:
    """Refuse tags, anchors, aliases and too deep nesting, before any object is built."""
    depth = 0
    for token in YAML(typ="safe", pure=True).scan(text):
        kind, place = type(token).__name__, f"line {token.start_mark.line + 1}"
        if kind in ("AliasToken", "AnchorToken", "TagToken"):
            raise InputError(source, place, "contains a YAML tag, anchor or alias", "write the value itself")
        depth += kind.endswith("StartToken") - kind.endswith("EndToken")
        if depth > DEEPEST + 1:  # the stream itself counts as one level
            raise InputError(source, place, *TOO_DEEP)


def plain_fault(data: Any, path: str = "", depth: int = 0) -> tuple[str, str, str] | None:
    """Return the first place that is not plain data, as path, found and allowed; None without one."""
    if depth > DEEPEST:
        return path, *TOO_DEEP
    if isinstance(data, dict):
        for key, value in data.items():
            here = f"{path}.{key}" if path else str(key)
            if not isinstance(key, str):
                return here, f"the key {key!r} is not text", "use a name as the key, or put it in quotes"
            if wrong := _NO_TEXT.search(key):
                return here, _found(wrong), NO_TEXT
            if fault := plain_fault(value, here, depth + 1):
                return fault
    elif isinstance(data, list):
        for k, value in enumerate(data):
            if fault := plain_fault(value, f"{path}[{k}]", depth + 1):
                return fault
    elif isinstance(data, float) and not math.isfinite(data):
        return path, f"{data!r} is not a finite number", "give a finite number"
    elif isinstance(data, str) and (wrong := _NO_TEXT.search(data)):
        return path, _found(wrong), NO_TEXT
    elif not isinstance(data, str | int | float | bool | None):
        kind = type(data).__name__
        return path, f"is read as a {kind}", "put it in quotes, or use a number, a list or fields"
    return None


def _found(wrong: re.Match[str]) -> str:
    return f"contains the character U+{ord(wrong.group()):04X}"
