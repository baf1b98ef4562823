"""Grade the numbers and claims of a paper, and say what simulations make of its errata.

False claims about the paper are graded, too: the grader is to refuse them.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import xarray as xr

from riserstudy.chapters import checks_of
from riserstudy.errors import RiserStudyError
from riserstudy.folders import write_whole
from riserstudy.grading.false_claims import read_false_claims
from riserstudy.grading.falsify import FalseRow, false_rows
from riserstudy.grading.grade import errata, grade
from riserstudy.grading.published import read_published
from riserstudy.grading.rows import ErratumRow, Row, row_of, table
from riserstudy.jobs.seals import seal
from riserstudy.records.graded import Case

CONFIG = Path("config")


def main(
    paper: str, graded: Path, errors: Path, margins: Path, false: Path, sources: list[Path]
) -> None:
    """Read the sources, write the tables."""
    datasets = {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}
    file = read_published(CONFIG, paper, datasets)
    checks = checks_of(paper)
    items = grade(file, datasets, checks)
    write_whole(graded, table(map(row_of, items), Row).encode())
    cases = (case for item in items for case in item.cases)
    write_whole(margins, table(cases, Case).encode())
    write_whole(errors, table(errata(file, datasets, checks), ErratumRow).encode())
    claims = read_false_claims(CONFIG, paper, file)
    refused = [*false_rows(CONFIG, file, claims, datasets, checks, items)]
    write_whole(false, table(refused, FalseRow).encode())
    seal(graded, errors, margins, false)
    for item in items:
        print(f"{paper}/{item.id}: {item.verdict}")
    for row in refused:
        print(f"{paper}/{row.id}: {row.verdict}, a false claim made from {row.made_from}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("graded", type=Path)
    parser.add_argument("errors", type=Path)
    parser.add_argument("margins", type=Path)
    parser.add_argument("false", type=Path)
    parser.add_argument("sources", type=Path, nargs="+")
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
