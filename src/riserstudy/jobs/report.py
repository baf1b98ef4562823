"""Make the report from all results."""

from __future__ import annotations

import argparse
from pathlib import Path

from riserstudy.dataset.unit_systems import UnitSystem, reading_in
from riserstudy.jobs.seals import seal
from riserstudy.report import write_report
from riserstudy.report.contents import Sources


def main(
    target: Path, papers: list[str], database: Path, compiled: Path, units: UnitSystem
) -> None:
    """Write the page."""
    with reading_in(units):
        write_report(Sources(Path("config"), papers, database, compiled), target)
    seal(target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", type=Path)
    parser.add_argument("--papers", nargs="+", required=True)
    parser.add_argument("--compiled", type=Path, required=True)
    parser.add_argument("--database", type=Path, required=True)
    parser.add_argument("--units", type=UnitSystem, default=UnitSystem.FIELD)
    main(**vars(parser.parse_args()))
