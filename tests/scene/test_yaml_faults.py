"""Faults of YAML syntax: errors are in words for the author of a file, not in those of the parser."""

import random
import re
from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import plain_yaml

FILES = [p for p in sorted(Path("config").rglob("*.yaml")) if p.stat().st_size < 20_000]
#: words that only the parser uses
OF_PARSER = re.compile(r"block end|node content|token|stream|mapping|scalar|sequence|could not find|expected")


def fault_of(text: str) -> str:
    """Fault and remedy of a text; "" if it can be read."""
    try:
        plain_yaml(text, "x.yaml")
    except InputError as error:
        return f"{error.found}; {error.allowed}"
    return ""


@pytest.mark.parametrize("seed", range(300))
def test_no_error_about_a_damaged_file_uses_words_of_the_parser(seed):
    draw = random.Random(seed)
    text = draw.choice(FILES).read_text()
    k = draw.choice([m.start() for m in re.finditer(r"[\[\]{}:,\"'\n-]", text)])
    damaged = draw.choice(
        [
            text[:k] + text[k + 1 :],
            text[:k] + draw.choice("\t[]{}:,\"'%@`|>\\") + text[k:],
            text[:k] + text[k] + text[k:],
            text[:k] + "\n " + text[k:],
        ]
    )
    assert not OF_PARSER.search(fault_of(damaged))


@pytest.mark.parametrize(
    "text, found",
    [
        ("a: b: c\n", "': ' occurs twice"),
        ("a: b\n  c: d\n", "indented further"),
        ("a:\n  - b\n c: d\n", "indentation differs"),
        ("a: {b: 1\nc: 2\n", "bracket around it"),
        ("a: [1, 2\nc: 2\n", "bracket around it"),
        ("x: 1\na: 'b\nc: d\n", "opens in line 2"),
        ("a:\n\tb: 1\n", "tab"),
        ("a: @b\n", "'@'"),
        ("a: 1\na: 2\n", '"a" twice'),
        ('a: "\\q"\n', "backslash"),
        ("a: >x\n  b\n", "follow > or |"),
        ("a: 1\nb\nc: 2\n", "line 2 is not complete"),
    ],
)
def test_common_faults_are_named(text, found):
    with pytest.raises(InputError) as error:
        plain_yaml(text, "x.yaml")
    assert found in error.value.found
