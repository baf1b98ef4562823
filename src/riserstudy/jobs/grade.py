"""Grade the numbers and claims of a paper, and say what simulations make of its errata."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import xarray as xr

from riserstudy.chapters import checks_of
from riserstudy.errors import RiserStudyError
from riserstudy.folders import write_whole
from riserstudy.grading.grade import Case, ErratumRow, Row, errata, table, weigh
from riserstudy.grading.models import read_published
from riserstudy.jobs.seals import seal


def main(paper: str, graded: Path, errors: Path, margins: Path, sources: list[Path]) -> None:
    """Read the sources, write the tables."""
    datasets = {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}
    file = read_published(Path("config"), paper, datasets)
    weights = weigh(file, datasets, checks_of(paper))
    rows = [item.row for item in weights]
    write_whole(graded, table(rows, Row).encode())
    cases = (case for item in weights for case in item.cases)
    write_whole(margins, table(cases, Case).encode())
    write_whole(errors, table(errata(file, datasets, checks_of(paper)), ErratumRow).encode())
    seal(graded, errors, margins)
    for row in rows:
        print(f"{paper}/{row.id}: {row.verdict}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("graded", type=Path)
    parser.add_argument("errors", type=Path)
    parser.add_argument("margins", type=Path)
    parser.add_argument("sources", type=Path, nargs="+")
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
