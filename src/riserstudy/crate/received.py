"""Files of a received crate that are not those that its sender packed.

The database has the checksums of results, which a rerun replaces. Only the description of the crate has those
of inputs, and the description lies in the root of an unpacked crate.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote

from riserstudy.crate.metadata import NAME, RUN
from riserstudy.errors import InputError, printable
from riserstudy.files.whole import sha256_of

AGAIN = f"unpack the archive again, or delete {NAME} if you edited the file"


def inputs_in(study: Path) -> dict[str, str]:
    """Return the SHA-256 of each input of a received crate, by its path in the folder of the study.

    Empty in a folder without a description. Raises InputError when the description is not one of a crate.
    """
    file = study / NAME
    try:
        text = file.read_bytes()
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise InputError(file, "", error.strerror or "cannot be read", "allow reading it") from None
    try:
        entities = {entity["@id"]: entity for entity in json.loads(text)["@graph"]}
        run = entities[RUN]
        names = [run["instrument"]["@id"], *(reference["@id"] for reference in run["object"])]
        return {unquote(name): str(entities[name]["sha256"]) for name in names}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        found = "this is not the description of a run crate"
        raise InputError(file, "", found, "unpack the archive again") from None


def changed_inputs(study: Path, inputs: dict[str, str]) -> Iterator[str]:
    """Yield a message for each input of a received crate, (path, SHA-256), that is not as it was packed."""
    for name, checksum in inputs.items():
        file = study / name
        if Path(name).is_absolute() or ".." in Path(name).parts:
            yield f"{study / NAME}: {printable(repr(name))} is outside of the crate; do not use this archive"
        elif not file.is_file():
            yield f"{file}: missing; {AGAIN}"
        elif sha256_of(file) != checksum:
            yield f"{file}: differs from its checksum in {NAME}; {AGAIN}"
