"""A study as one file: what it is computed from, its results, and their description."""

from __future__ import annotations

import zipfile
from pathlib import Path

from riserstudy.crate.metadata import NAME, crate_text, inputs_of, outputs_of
from riserstudy.errors import InputError
from riserstudy.folders import SEALS, whole_file

#: what stands beside the configuration, where it is there
FILES = ("README.md", "LICENSE", "CITATION.cff")


def pack(study: Path, target: Path) -> int:
    """Write a zip that another can unpack and rerun with ``snakemake``; the number of files in it.

    Raises
    ------
    InputError
        When the folder has no results of jobs, or the zip has another ending or is there already.
    SimulationError
        When the zip cannot be written.
    """
    if target.suffix != ".zip" or target.exists() or not target.resolve().parent.is_dir():
        found = "is there already" if target.exists() else "is no new .zip in a folder that exists"
        raise InputError("OUT.zip", str(target), found, "name a new file that ends in .zip")
    text = crate_text(study, study) if (study / "Snakefile").exists() else None
    if text is None:
        found = "no results of a run of `snakemake` or `make study`"
        raise InputError("crate", str(study), found, "run the study here first")
    results = [study / name for name in outputs_of(study)]
    seals = [path for path in (study / "results" / SEALS).rglob("*") if path.is_file()]
    others = [study / name for name in ("Snakefile", *FILES) if (study / name).exists()]
    files = [*others, *inputs_of(study), *results, *sorted(seals)]
    with (
        whole_file(target) as partial,
        # files of reproducible archives may be older than a zip can say
        zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED, strict_timestamps=False) as archive,
    ):
        archive.writestr(NAME, text)
        for file in dict.fromkeys(files):
            archive.write(file, file.relative_to(study).as_posix())
    return len(files) + 1
