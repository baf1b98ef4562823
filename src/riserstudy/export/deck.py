"""A deck while it is built: its objects, and which values of the scene it contains or lacks."""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass, field
from typing import Any

from riserstudy.errors import InputError, on_one_line
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import CALLED
from riserstudy.scene.paths import last_name, leaves, parent, within, within_any, without_indices
from riserstudy.scene.resolve import Resolved

PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9 _.,/+-]*[A-Za-z0-9)]|[A-Za-z]")
WORDS = ("yes", "no", "on", "off", "true", "false", "null", "infinity")


@dataclass
class Deck:
    """A deck, and the paths of the scene that it contains."""

    file: SceneFile
    scene: Resolved
    # lists of objects by their name in a deck, and General and Environment
    objects: dict[str, Any] = field(default_factory=dict)
    # paths of the scene that the deck contains, without indices
    carried: set[str] = field(default_factory=set)
    # paths of the scene that the deck contains in another form, and this form
    otherwise: dict[str, str] = field(default_factory=dict)

    def add(self, of: str, entry: dict[str, Any]) -> None:
        """Append an object to a list."""
        self.objects.setdefault(of, []).append(entry)

    def refused(self, path: str, found: str, allowed: str) -> InputError:
        """Return the error for a value without which the deck would describe another riser."""
        return InputError(self.file.source, path, found, allowed)

    def left_out(self) -> list[str]:
        """Return lines that name the values of the scene that the deck lacks or has in another form."""
        lines = [f"{path}: {reason}" for path, reason in self.otherwise.items()]
        missing: dict[str, None] = {}
        for path, _ in leaves(self.file.tree):
            bare = without_indices(path)
            called = last_name(bare) in CALLED
            if called or within_any(bare, self.carried):
                continue
            if not within_any(path, self.otherwise):
                above = parent(bare)
                whole = bare.count(".") > 1 and not any(within(p, above) for p in self.carried)
                missing[above if whole else bare] = None
        return [*lines, *(f"{path}: not written" for path in missing)]

    def text(self) -> str:
        """Return the deck as a text data file."""
        source = self.file.source.rpartition("/")[2]
        head = ["%YAML 1.1", "# Type: Model", f"# Made from {on_one_line(source)}"]
        return "\n".join([*head, "---", *_lines(self.objects, 0), ""])


def _lines(entry: dict[str, Any], indent: int) -> list[str]:
    """Return the lines of an object, entry by entry; each row of a table has one line."""
    margin, lines = "  " * indent, []
    for key, value in entry.items():
        if isinstance(value, dict):
            lines += [f"{margin}{key}:", *_lines(value, indent + 1)]
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            lines.append(f"{margin}{key}:")
            for one in value:
                first, *rest = _lines(one, indent + 2)
                lines += [f"{margin}  - {first.lstrip()}", *rest]
        elif isinstance(value, list) and value and isinstance(value[0], list):
            lines.append(f"{margin}{key}:")
            lines += [f"{margin}  - [{', '.join(map(_word, row))}]" for row in value]
        elif isinstance(value, list):
            lines.append(f"{margin}{key}: [{', '.join(map(_word, value))}]")
        else:
            lines.append(f"{margin}{key}: {_word(value)}")
    return lines


def _word(value: Any) -> str:
    """Return one value in the notation of decks."""
    if value is None:
        return "~"
    if isinstance(value, bool):
        return "Yes" if value else "No"
    if isinstance(value, float):
        return "Infinity" if math.isinf(value) else repr(float(f"{value:.15g}")).replace("e+", "e")
    if isinstance(value, int):
        return str(value)
    text = str(value)
    plain = PLAIN.fullmatch(text) and "," not in text and text.lower() not in WORDS
    return text if plain else json.dumps(text, ensure_ascii=False)
