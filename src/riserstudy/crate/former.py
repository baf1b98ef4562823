"""Results that were made from results which another job has replaced since.

Snakemake finds them by file times only, which a copy of the folder or a wrong clock changes. A run that was
killed, or that makes only one file, leaves such results.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from riserstudy.crate.metadata import outputs_of
from riserstudy.crate.records import Made, recorded
from riserstudy.files.seals import SEALS


def of_former_results(study: Path) -> list[str]:
    """Return results that were made from former results, as paths relative to the folder of the study."""
    made = recorded(study)
    return [
        out
        for out in outputs_of(study)
        if out in made and any(_is_replaced(study, name, made[out], made) for name in made[out].inputs)
    ]


def _is_replaced(study: Path, name: str, reader: Made, made: Mapping[str, Made]) -> bool:
    """Return whether a result differs from the one that a job read; large ones have only a time."""
    if not name.startswith("results/") or name not in made:
        return False
    checksum = reader.checksums.get(name)
    if checksum is None:
        return made[name].ended > reader.began
    seal = study / "results" / SEALS / Path(name).relative_to("results")
    present = seal.read_bytes().partition(b" ")[0] if seal.is_file() else b""
    return bool(present) and present != checksum.rpartition(":")[2].encode()
