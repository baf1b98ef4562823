"""Update the counts of verdicts in README and the first page of the docs with the results of `make study`."""

from __future__ import annotations

import csv
import textwrap
from collections import Counter
from pathlib import Path

from riserstudy.grading.summary import PLURALS, VERDICTS
from riserstudy.records.words import listed

ROOT = Path(__file__).resolve().parents[2]
BEGIN = "<!-- {part}: python workflow/scripts/update_readme.py -->\n"
END = "<!-- end -->\n"
WIDTH = 140  # characters in a line of the pages

#: verdicts in the order of the summary, in the words for one item and for several
WORDS = (
    (("reproduced",), *PLURALS["reproduced"]),
    (("holds",), *PLURALS["holds"]),
    (
        ("depends",),
        "depends on inputs that the papers omit or on an interpretation",
        "depend on inputs that the papers omit or on an interpretation",
    ),
    (("fails",), *PLURALS["fails"]),
    (("calibrated",), *PLURALS["calibrated"]),
    (
        ("not comparable", "not reproducible"),
        "cannot be checked or compared",
        "cannot be checked or compared",
    ),
)


def main() -> None:
    """Replace the generated parts of both pages."""
    with (ROOT / "results/reproduction.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    verdicts = Counter(row["verdict"] for row in rows)
    opened, counted = opening(verdicts.total()), summary(verdicts)
    for name, parts in {
        "README.md": {"summary": wrapped(f"{opened} {counted}"), "results": table(rows)},
        "docs/index.md": {"summary": wrapped(opened)},
    }.items():
        text = (ROOT / name).read_text("utf-8")
        for part, made in parts.items():
            text = replaced(text, part, made)
        (ROOT / name).write_text(text, "utf-8")


def replaced(text: str, part: str, made: str) -> str:
    """Return a page with one of its generated parts replaced."""
    before, begin, rest = text.partition(BEGIN.format(part=part))
    _, end, after = rest.partition(END)
    return before + begin + made + end + after


def opening(number: int) -> str:
    """Return the sentences that introduce the project."""
    return (
        "riserstudy is a simulation program for deepwater drilling risers, with a workflow (an automatic "
        "sequence of jobs) in Snakemake. One command repeats the simulations of five published papers, "
        f"redraws their figures, and grades each of their {number} published values and claims (qualitative "
        "statements)."
    )


def summary(verdicts: Counter[str]) -> str:
    """Return the sentence that counts all verdicts."""
    counts = [(sum(verdicts[one] for one in group), words) for group, *words in WORDS]
    parts = [f"{count} {several if count > 1 else single}" for count, (single, several) in counts if count]
    number, rest = parts[0].split(" ", 1)
    return f"{listed([f'{number} of them {rest}', *parts[1:]])}."


def wrapped(text: str) -> str:
    """Return a paragraph in lines of the width of the pages."""
    return textwrap.fill(text, WIDTH, break_on_hyphens=False) + "\n"


def table(rows: list[dict[str, str]]) -> str:
    """Return the table of verdicts by paper and kind."""
    counts: dict[tuple[str, str], Counter[str]] = {}
    for row in rows:
        counts.setdefault((row["paper"], row["kind"]), Counter())[row["verdict"]] += 1
    found = {verdict for of in counts.values() for verdict in of}
    columns = [verdict for verdict in VERDICTS if verdict in found]
    lines = [f"| | {' | '.join(columns)} |", "|---" * (len(columns) + 1) + "|"]
    for (paper, kind), verdicts in counts.items():
        cells = " | ".join(str(verdicts[verdict] or "–") for verdict in columns)
        number = sum(verdicts.values())
        lines.append(f"| {paper}, {number} {kind}{'s' if number > 1 else ''} | {cells} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
