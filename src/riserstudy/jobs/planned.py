"""What a job reads, the plan of the workflow among it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.errors import InputError, SimulationError

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.jobs.workplan import Workplan

CONFIG = Path("config")  # in the folder where Snakemake runs


def read_plan(tier: str | None, papers: list[str], only: list[tuple[str, str]]) -> Workplan:
    """The plan of a tier, of which some studies are checked; None: of that in config.yaml."""
    from riserstudy.jobs.workplan import Workplan

    settings = {"papers": papers} if tier is None else {"tier": tier, "papers": papers}
    return Workplan.read(CONFIG, settings, only=only)


def check_unchanged(digest: str, expected: str) -> None:
    """Refuse to do another thing than was planned.

    Raises SimulationError when scene, study, published values, engine or code of the chapter changed since
    the workflow was planned, so that the digests differ.
    """
    if digest != expected:
        changed = "scene, study or code changed while the workflow was running"
        raise SimulationError(f"{changed}; repeat the command")


def datasets_of(sources: list[Path]) -> dict[str, xr.Dataset]:
    """Return the datasets of files by their names."""
    import xarray as xr

    return {source.stem: xr.load_dataset(source, engine="netcdf4") for source in sources}


def text_of(source: Path) -> str:
    """Return the text of a table. Raises InputError when the file cannot be read."""
    try:
        return source.read_text("utf-8")
    except OSError as error:
        raise InputError(source, "", str(error.strerror), "repeat `make study`, which writes it") from None
