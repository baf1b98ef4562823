"""Draw a figure from its datasets."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import xarray as xr

from riserstudy.errors import RiserStudyError
from riserstudy.figures import draw, draw_plot, save
from riserstudy.study import read_studies


def main(paper: str, name: str, png: Path, pdf: Path, sources: list[Path]) -> None:
    """Read the sources, write the figure in both formats."""
    datasets = {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}
    model = read_studies(Path("config"), paper).figures[name]
    figure = (
        draw_plot(model, datasets[model.reads[0]]) if model.plot else draw(paper, name, datasets)
    )
    save(figure, png, pdf)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("name")
    parser.add_argument("png", type=Path)
    parser.add_argument("pdf", type=Path)
    parser.add_argument("sources", type=Path, nargs="+")
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
