"""Write all files that are generated from models and libraries.

They are the reference page and JSON schemas, tables of platforms, factors of usual units, parts of pages,
drawings of effects, and the metadata for archives. With a dataset of the validation study
(results/numerics/validation.nc) the comparisons of the engine are written, too.
"""

from __future__ import annotations

import json
import sys
from contextlib import chdir
from pathlib import Path

from effect_drawings import drawing, file_of
from made_parts import kept_pages, write_validation
from riserstudy.effects.catalogue import catalogue
from riserstudy.files.chapters import own_chapters
from riserstudy.grading import claims_schema
from riserstudy.scene.units import USUAL, factor
from riserstudy.study.schemas import schema_files
from scene_reference import scene_reference
from semisubmersible import read_units, table
from software_metadata import software_metadata

ROOT = Path(__file__).resolve().parents[2]


def made() -> dict[Path, str]:
    """Return the content of every file."""
    platforms = ROOT / "config/platforms"
    units = read_units(platforms / "semisubmersibles.yaml")
    usual = json.loads(USUAL.read_text("utf-8"))
    with chdir(ROOT):  # the schema of study files contains its chapters
        schemas = schema_files(own_chapters())
    factors = {unit: {name: factor(name, unit) for name in usual[unit]} for unit in usual}
    return {
        USUAL: json.dumps(factors, indent=2) + "\n",
        **{platforms / f"{name}.csv": table(unit) for name, unit in units.items()},
        ROOT / "docs/scene.md": scene_reference(),
        **kept_pages(),
        **software_metadata(),
        **{ROOT / "docs/images/effects" / file_of(name): drawing(name) for name in catalogue()},
        **{ROOT / "workflow/schemas" / name: text for name, text in schemas.items()},
        ROOT / "workflow/schemas/claims.schema.json": json.dumps(claims_schema(), indent=2) + "\n",
    }


if __name__ == "__main__":
    for path, content in made().items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, "utf-8")
    if sys.argv[1:]:
        import xarray as xr

        write_validation(xr.load_dataset(sys.argv[1]))
