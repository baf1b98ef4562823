"""The generated parts of README and of the first page of the docs agree with each other."""

import csv
import random
import re
from collections import Counter
from pathlib import Path

import pytest

import update_readme
from riserstudy.grading.summary import VERDICTS

ROOT = Path(__file__).parents[2]


def part(name, of, root=ROOT):
    """Generated part of a page."""
    begin = re.escape(update_readme.BEGIN.format(part=of))
    (found,) = re.findall(f"^{begin}(.*?)^{update_readme.END}", (root / name).read_text("utf-8"), re.M | re.S)
    return found


def counts_of(table):
    """Numbers of verdicts in a table, over all of its rows; each row adds up to its heading."""
    heading, _, *rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()]
    counts = Counter()
    for name, *cells in rows:
        numbers = [0 if cell == "–" else int(cell) for cell in cells]
        assert sum(numbers) == int(re.search(r"\d+", name.partition(",")[2]).group())
        counts.update(dict(zip(heading[1:], numbers, strict=True)))
    return counts


def test_the_first_sentences_count_what_the_table_counts():
    counts = counts_of(part("README.md", "results"))
    first = update_readme.opening(counts.total())
    assert " ".join(part("docs/index.md", "summary").split()) == first
    assert " ".join(part("README.md", "summary").split()) == f"{first} {update_readme.summary(counts)}"


@pytest.mark.parametrize("seed", range(8))
def test_all_verdicts_are_counted_once(seed, tmp_path, monkeypatch):
    draw = random.Random(seed)
    verdicts = draw.sample(list(VERDICTS), draw.randint(1, len(VERDICTS)))
    columns = {"paper": ["a", "b"], "kind": ["number", "claim"], "verdict": verdicts}
    rows = [
        {name: draw.choice(values) for name, values in columns.items()} for _ in range(draw.randint(1, 40))
    ]
    (tmp_path / "results").mkdir()
    with (tmp_path / "results/reproduction.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(columns))
        writer.writeheader()
        writer.writerows(rows)
    for name in ("README.md", "docs/index.md"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text((ROOT / name).read_text("utf-8"), "utf-8")
    monkeypatch.setattr(update_readme, "ROOT", tmp_path)
    update_readme.main()
    expected = Counter(row["verdict"] for row in rows)
    assert +counts_of(part("README.md", "results", tmp_path)) == expected
    _, written = part("README.md", "summary", tmp_path).replace("\n", " ").split("(qualitative statements).")
    assert sum(int(number) for number in re.findall(r"\d+", written)) == len(rows)
    opened = part("docs/index.md", "summary", tmp_path).replace("\n", " ")
    assert f"each of their {len(rows)} published values" in opened
