"""Draw a figure that a study file names: from datasets, or a schematic from its scene."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.errors import InputError
from riserstudy.study.read import read_studies

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def from_datasets(config: Path, paper: str, name: str, datasets: dict[str, xr.Dataset]) -> Figure:
    """Draw a figure of a chapter, or a general plot, which suits any grid.

    Raises InputError when a dataset lacks a quantity that is drawn; it names figure, dataset and quantity.
    """
    from riserstudy.chapters.draw import draw
    from riserstudy.figures import draw_plot
    from riserstudy.grading.printed import with_printed

    model = read_studies(config, paper).figures[name]
    if not model.plot:
        return draw(paper, name, datasets, with_printed(model.settings, config, paper))
    try:
        return draw_plot(model, datasets[model.reads[0]])
    except InputError as error:
        where = config / f"studies/{paper}.yaml"
        found = f"{error.found} (dataset {model.reads[0]!r})"
        raise InputError(where, f"figures.{name}.of", found, error.allowed) from None


def from_scene(config: Path, paper: str, name: str) -> Figure:
    """Draw the schematic of a scene.

    Raises InputError when the study file places cylinders although the scene arranges them itself or has
    none, or a remark names a part whose label cannot carry a remark; it names study file and field.
    """
    from riserstudy.schematic import schematic
    from riserstudy.schematic.geometry import labelled

    model = read_studies(config, paper).schematics[name]
    file, standing = model.file(config), model.cylinders == "standing"
    scene = file.resolved()
    where = config / f"studies/{paper}.yaml"
    bearing = [*labelled(scene)]
    for path in model.remarks:
        if path not in bearing:
            found = "no part of the drawing has this name"
            allowed = f"use one of {', '.join(bearing)}"
            raise InputError(where, f"schematics.{name}.remarks.{path}", found, allowed)
    rig = scene.top.tensioners
    if standing and (rig is None or rig.arrangement):
        found = "'standing' does not apply, since the scene "
        found += "has an arrangement of its tensioners" if rig else "has no tensioners"
        allowed = "remove cylinders, or write 'hanging'" if rig else "remove cylinders"
        raise InputError(where, f"schematics.{name}.cylinders", found, allowed)
    return schematic(
        scene, standing=standing, remarks=model.remarks, assumed=file.assumed, calibrated=file.calibrated
    )
