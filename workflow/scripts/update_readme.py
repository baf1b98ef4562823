"""Update the table of the README with the results of `make study`."""

from __future__ import annotations

import csv
from collections import Counter
from pathlib import Path

from riserstudy.report.claims import VERDICTS

ROOT = Path(__file__).resolve().parents[2]
BEGIN, END = "<!-- results: python workflow/scripts/update_readme.py -->\n", "<!-- end -->\n"


def main() -> None:
    """Replace the table."""
    with (ROOT / "results/reproduction.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    readme = ROOT / "README.md"
    before, rest = readme.read_text("utf-8").split(BEGIN)
    readme.write_text(before + BEGIN + table(rows) + END + rest.split(END)[1], "utf-8")


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
