"""Make the report from all results."""

from __future__ import annotations

import argparse
from pathlib import Path

from riserstudy.report import write_report
from riserstudy.report.contents import Sources


def main(target: Path, papers: list[str], files: list[Path], compiled: Path) -> None:
    """Sort the files by kind and write the page."""
    kinds = {
        kind: [file for file in files if file.suffix == kind] for kind in (".nc", ".png", ".csv")
    }
    sources = Sources(Path("config"), papers, kinds[".nc"], kinds[".png"], kinds[".csv"], compiled)
    write_report(sources, target)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", type=Path)
    parser.add_argument("--papers", nargs="+", required=True)
    parser.add_argument("--compiled", type=Path, required=True)
    parser.add_argument("--files", type=Path, nargs="+", required=True)
    main(**vars(parser.parse_args()))
