"""Draw a figure from its datasets."""

from __future__ import annotations

import argparse
from pathlib import Path

import xarray as xr

from riserstudy.figures import draw, save


def main(paper: str, name: str, png: Path, pdf: Path, sources: list[Path]) -> None:
    """Read the sources, write the figure in both formats."""
    datasets = {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}
    save(draw(paper, name, datasets), png, pdf)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("name")
    parser.add_argument("png", type=Path)
    parser.add_argument("pdf", type=Path)
    parser.add_argument("sources", type=Path, nargs="+")
    main(**vars(parser.parse_args()))
