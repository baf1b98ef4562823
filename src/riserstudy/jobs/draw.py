"""Draw a figure from its datasets, or a schematic, which reads none, from its scene; also as values."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.chapters.draw import draw
from riserstudy.dataset.unit_systems import UnitSystem, reading_in
from riserstudy.errors import InputError, RiserStudyError
from riserstudy.figures import draw_plot, save
from riserstudy.grading.printed import with_printed
from riserstudy.jobs.seals import seal
from riserstudy.study.read import read_studies

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def main(
    paper: str, name: str, targets: list[Path], sources: list[Path], units: UnitSystem
) -> None:
    """Write the figure in all formats."""
    with reading_in(units):
        figure = from_datasets(paper, name, sources) if sources else from_scene(paper, name)
        save(figure, *targets)
    seal(*targets)


def from_datasets(paper: str, name: str, sources: list[Path]) -> Figure:
    """Read the sources, draw the figure.

    Raises
    ------
    InputError
        When a dataset lacks a quantity that is drawn: figure, dataset and quantity.
    """
    import xarray as xr

    datasets = {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}
    config = Path("config")
    model = read_studies(config, paper).figures[name]
    if model.plot:
        try:
            return draw_plot(model, datasets[model.reads[0]])
        except InputError as error:
            where = config / f"studies/{paper}.yaml"
            found = f"{error.found} in {model.reads[0]}"
            raise InputError(where, f"figures.{name}.of", found, error.allowed) from None
    return draw(paper, name, datasets, with_printed(model.settings, config, paper))


def from_scene(paper: str, name: str) -> Figure:
    """Read the scene, draw the schematic."""
    from riserstudy.schematic import schematic

    shown = read_studies(Path("config"), paper).schematics[name]
    return schematic(shown.file(Path("config")).scene())


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paper")
    parser.add_argument("name")
    parser.add_argument("--targets", type=Path, nargs="+", required=True)
    parser.add_argument("--sources", type=Path, nargs="*", default=[])
    parser.add_argument("--units", type=UnitSystem, default=UnitSystem.FIELD)
    try:
        main(**vars(parser.parse_args()))
    except RiserStudyError as error:
        sys.exit(f"riserstudy: {error}")
