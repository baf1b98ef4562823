"""Pack a study into one file: its inputs, its results, and their description."""

from __future__ import annotations

import zipfile
from pathlib import Path

from riserstudy.crate.former import of_former_results
from riserstudy.crate.metadata import NAME, crate_text, inputs_of, outputs_of
from riserstudy.crate.records import recorded
from riserstudy.errors import InputError
from riserstudy.files.seals import SEALS, fits_seal
from riserstudy.files.whole import whole_file

#: optional files in the folder of the study
FILES = ("README.md", "LICENSE", "CITATION.cff")


def pack(study: Path, target: Path) -> int:
    """Write a zip that another person can unpack and rerun with ``snakemake``; return its number of files.

    Raises InputError when the folder has no results of jobs, one that is not as its job wrote it, or results
    of a run that did not end or made only some files, or the zip has another suffix or exists already. Raises
    SimulationError when the zip cannot be written.
    """
    if target.suffix != ".zip" or target.exists() or not target.resolve().parent.is_dir():
        found = "the file already exists" if target.exists() else "this is not a .zip file in a folder"
        raise InputError("OUT.zip", str(target), found, "name a new .zip file in an existing folder")
    results = [study / name for name in outputs_of(study)]
    if not (study / "Snakefile").exists() or not results:
        found = "the folder contains no results of `snakemake` or `make study`"
        raise InputError("crate", str(study), found, "run the study in this folder first")
    for file in results:
        if not fits_seal(file, study / "results"):
            found = "the file was changed after the study wrote it"
            raise InputError(file, "", found, "repeat the study")
    if absent := _absent(study):
        found = "missing, because the last run was interrupted or failed, or the file was deleted"
        raise InputError(absent[0], "", found, "repeat the study")
    if former := of_former_results(study):
        found = (
            "the file is older than its inputs, since the last run was interrupted or wrote some files only"
        )
        raise InputError(study / former[0], "", found, "repeat the study")
    text = crate_text(study, study)  # reads results, so after these checks
    if text is None:
        found = "the folder has no records of the jobs of the study"
        raise InputError("crate", str(study), found, "run the study in this folder first")
    seals = [path for path in (study / "results" / SEALS).rglob("*") if path.is_file()]
    others = [study / name for name in ("Snakefile", *FILES) if (study / name).exists()]
    files = [*others, *inputs_of(study), *results, *sorted(seals)]
    with (
        whole_file(target) as partial,
        # files of reproducible archives may have dates before the earliest date of a zip
        zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED, strict_timestamps=False) as archive,
    ):
        archive.writestr(NAME, text)
        for file in dict.fromkeys(files):
            archive.write(file, file.relative_to(study).as_posix())
    return len(files) + 1


def _absent(study: Path) -> list[Path]:
    """Return the files that jobs made, or made results from, and that are absent.

    A job removes its old files when it starts. The other results may then be those before an edit.
    """
    results, made = study / "results", recorded(study)
    read = {name for out in outputs_of(study) if out in made for name in made[out].inputs}
    of_jobs = {study / name for name in read if name.startswith("results/")}
    seals = {path.relative_to(results / SEALS) for path in (results / SEALS).rglob("*.*")}
    return sorted(path for path in of_jobs | {results / seal for seal in seals} if not path.exists())
