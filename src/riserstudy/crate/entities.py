"""Entities of a crate: files with size and digest, software, licence."""

from __future__ import annotations

from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from platform import python_version
from typing import Any
from urllib.parse import quote

from riserstudy.files.whole import sha256_of

Entity = dict[str, Any]
#: formats of files, by their suffix
FORMATS = {
    ".nc": "application/x-netcdf",
    ".csv": "text/csv",
    ".png": "image/png",
    ".pdf": "application/pdf",
    ".html": "text/html",
    ".json": "application/json",
    ".yaml": "application/yaml",
    ".yml": "application/yaml",
    ".py": "text/x-python",
    ".smk": "text/plain",
    ".lock": "text/plain",
    ".toml": "application/toml",
    ".md": "text/markdown",
    ".sqlite": "application/vnd.sqlite3",
    ".gz": "application/gzip",
    ".txt": "text/plain",
}
PACKAGES = ("riserstudy", "snakemake", "numpy", "numba", "scipy", "xarray", "netCDF4")


def ref(*names: str) -> list[Entity]:
    """Return references to entities."""
    return [{"@id": name} for name in names]


def file_entity(file: Path, name: str) -> Entity:
    """Describe a file: size, SHA-256, date and format. ``name``: path from the root of the crate."""
    stat = file.stat()
    entity: Entity = {
        "@id": quote(name),
        "@type": "File",
        "name": Path(name).name,
        "contentSize": str(stat.st_size),
        "sha256": sha256_of(file),
        "dateModified": datetime.fromtimestamp(stat.st_mtime, UTC).isoformat(timespec="seconds"),
    }
    if (known := FORMATS.get(file.suffix)) is not None:
        entity["encodingFormat"] = known
    return entity


def software() -> list[Entity]:
    """Return Python and the packages that compute, with their installed versions."""
    entities = [_application("#python", "Python", python_version())]
    for package in PACKAGES:
        try:
            entities.append(_application(f"#{package}", package, version(package)))
        except PackageNotFoundError:
            continue
    return entities


def _application(name: str, title: str, number: str) -> Entity:
    kind = "SoftwareApplication"
    return {"@id": name, "@type": kind, "name": title, "softwareVersion": number}


def licence(study: Path) -> tuple[Any, list[Entity]]:
    """Return the licence property of the root, and the entity of a known licence."""
    from riserstudy.inputs.plain_yaml import read_yaml

    citation = study / "CITATION.cff"
    name = read_yaml(citation).get("license") if citation.exists() else None
    if not name:
        return "No licence is stated by the folder of the study.", []
    address = f"https://spdx.org/licenses/{name}"
    entity = {"@id": address, "@type": "CreativeWork", "name": name, "url": address}
    return {"@id": address}, [entity]
