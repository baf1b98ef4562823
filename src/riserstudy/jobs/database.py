"""Make the results database, or bring it to date."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from riserstudy.database.build import build
from riserstudy.database.sources import Sources
from riserstudy.errors import RiserStudyError
from riserstudy.jobs.seals import is_whole, remove, seal


def main(target: Path, papers: list[str], files: list[Path]) -> None:
    """Read what changed, write the database."""
    if not is_whole(target):
        remove(target)  # what it holds is not built upon
    built = build(target, Sources(Path("config"), papers, files))
    seal(target)
    print(f"{built.read} of {built.datasets} datasets were new or had changed")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", type=Path)
    parser.add_argument("--papers", nargs="+", required=True)
    parser.add_argument("--files", type=Path, nargs="*", required=True)
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
