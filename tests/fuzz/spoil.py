"""Spoil input files: in their tree, where every value stays readable, or in their text.

Values go through JSON, which is YAML; those that JSON cannot write stand in as marks and are put in
afterwards, as they are.
"""

import copy
import json
import math
import re
from pathlib import Path

HERE = Path(__file__).parent
#: as they stand in a file, quoted or not
VALUES = (
    *(HERE / "values.txt").read_text("utf-8").splitlines(),
    "9" * 400,
    f'"{"9" * 400} m"',
    "[" * 100 + "]" * 100,
    "{a: " * 30 + "1" + "}" * 30,
    json.dumps("long " * 2000),
    json.dumps([0] * 5000),
)
#: put anywhere in a text
SCRAPS = (
    *(
        line.encode().decode("unicode_escape").encode("latin-1")
        for line in (HERE / "scraps.txt").read_text().splitlines()
    ),
    b"[" * 3000,
)
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
MARK = "\ue000{}\ue001"


def spoilt(tree, others, rng, changes=3):
    """The text of a tree after some changes; ``others`` lend their parts."""
    tree, raw = copy.deepcopy(tree), []
    for _ in range(rng.randint(1, changes)):
        change_tree(tree, others, raw, rng)
    text = json.dumps(tree, ensure_ascii=False)
    for k, value in enumerate(raw):
        text = text.replace(f'"{MARK.format(k)}"', value)
    content = text.encode("utf-8", "surrogatepass")
    return torn(content, rng) if changes > 1 and rng.random() < 0.1 else content


def change_tree(tree, others, raw, rng):
    """Make one change to a tree in place."""
    parent, key = rng.choice(list(places(tree)))
    value = parent[key]
    kind = rng.random()
    if kind < 0.4:
        raw.append(rng.choice(VALUES))
        parent[key] = MARK.format(len(raw) - 1)
    elif kind < 0.65 and (number := NUMBER.match(str(value))):
        parent[key] = scaled(value, number, rng)
    elif kind < 0.75:
        del parent[key]
    elif kind < 0.85:
        other, at = rng.choice(list(places(rng.choice(others))))
        parent[key] = copy.deepcopy(other[at])
    elif isinstance(value, list) and value:
        value.append(copy.deepcopy(rng.choice(value)))
    elif isinstance(value, dict):
        other, at = rng.choice(list(places(rng.choice(others))))
        value[str(at)] = copy.deepcopy(other[at])
    else:
        parent[key] = rng.choice([[value], {"a": value}, f"{value} {value}", str(value).upper()])


def scaled(value, number, rng):
    """A number, with its unit where it has one, made much larger, smaller, or of another sign."""
    factor = rng.choice([-1.0, 0.0, 0.5, 2.0, 1e-6, 1e6, 1e-12, 1e12, 1e150, 1e-150])
    new = float(number.group()) * factor
    if isinstance(value, str):
        return f"{new!r}{value[number.end() :]}"
    return int(new) if isinstance(value, int) and math.isfinite(new) else new


def places(tree):
    """Every place of a tree, as the container and the key in it."""
    pairs = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in list(pairs):
        yield tree, key
        if isinstance(value, dict | list):
            yield from places(value)


def torn(content, rng):
    """Bytes with one to three pieces put in, taken out, doubled, or flipped."""
    for _ in range(rng.randint(1, 3)):
        a, b = sorted(rng.randrange(len(content) + 1) for _ in range(2))
        b = min(b, a + rng.choice([1, 8, 200]))
        piece = content[a:b]
        new = rng.choice(
            [b"", rng.choice(SCRAPS), rng.choice(SCRAPS) + piece, piece * 2, rng.randbytes(len(piece))]
        )
        content = content[:a] + new + content[b:]
    return content
