"""Summary of a run: folder of the results, and verdicts on the published numbers and claims."""

import csv
from collections import Counter, defaultdict
from collections.abc import Iterable
from pathlib import Path

from riserstudy.jobs.progress import lasting

VERDICTS = (
    *("reproduced", "holds", "depends", "fails", "calibrated"),
    *("not comparable", "not reproducible"),
)


def summarise(seconds: float) -> None:
    """Print the folder of the results and the verdicts on the published numbers and claims."""
    report, table = Path("results/report.html"), Path("results/reproduction.csv")
    datasets = Counter(path.parent for path in sorted(Path("results").glob("*/*.nc")))
    print(f"Done in {lasting(seconds)}.")
    for folder, count in datasets.items():
        print(f"  datasets  {folder}/*.nc ({count})")
    graded = sorted(Path("results").glob("*/reproduction.csv"))
    newest = max((path.stat().st_mtime for path in graded), default=0.0)
    old = {path for path in (report, table) if path.exists() and path.stat().st_mtime < newest}
    for kind, path in (("report", report), ("table", table)):
        if path.exists():
            print(f"  {kind:9} {path}{' (of an earlier run)' if path in old else ''}")
    reported = graded if table in old else [table] if table.exists() else []
    if reported:
        rows = [row for path in reported for row in graded_in(path)]
        print(f"\n{verdicts(rows)}")
        if failed := [f"{row['paper']} {row['id']}" for row in rows if row["verdict"] == "fails"]:
            print(f"\nFails: {', '.join(failed)}")
    if report.exists() and report not in old:
        print(f"\nOpen {report.resolve().as_uri()}")


def graded_in(table: Path) -> list[dict[str, str]]:
    """Return the rows of a table of numbers and claims."""
    with table.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def verdicts(rows: Iterable[dict[str, str]]) -> str:
    """Return the counts of verdicts per paper and kind, in words."""
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for row in rows:
        counts[f"{row['paper']} {row['kind']}s"][row["verdict"]] += 1
    met = {verdict for counter in counts.values() for verdict in counter}
    columns = [*(v for v in VERDICTS if v in met), *sorted(met.difference(VERDICTS))]
    width = max(map(len, counts), default=0)
    lines = ["  ".join((f"  {'':{width}}", *columns))]
    for name, counter in counts.items():
        cells = (f"{counter[column] or '-':>{len(column)}}" for column in columns)
        lines.append("  ".join((f"  {name:{width}}", *cells)))
    return "\n".join(lines)
