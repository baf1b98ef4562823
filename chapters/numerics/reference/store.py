"""Where reference solutions lie, and why one is not used: absent, damaged, of another scene or physics."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from chapters.numerics.reference.folder import path_of
from chapters.numerics.reference.identity import PHYSICS, scene_digest
from chapters.numerics.reference.kept import Damaged, Kept, packed, unpacked
from riserstudy.errors import SimulationError
from riserstudy.folders import write_whole
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved

REMEDY = "Run `make references`."


class NotUsed(SimulationError):
    """A reference solution that cannot be used, and why."""


class Wanted(NamedTuple):
    """A case that needs a reference solution, and what computes it: picklable, for other processes."""

    case: str
    file: SceneFile
    compute: Callable[[], Kept]


def read(config: Path, study: str, case: str, scene: Resolved) -> Kept:
    """The reference solution of a case, as it is kept.

    Parameters
    ----------
    scene : the case as it is now.

    Raises
    ------
    NotUsed
        When there is none, it is damaged, or it solves another scene or other physics.
    """
    path = path_of(config, study, case)
    try:
        kept = unpacked(path.read_bytes())
    except FileNotFoundError:
        raise NotUsed(f"{path}: '{case}' has no reference solution. {REMEDY}") from None
    except (OSError, Damaged):
        raise NotUsed(f"{path}: the reference solution of '{case}' is damaged. {REMEDY}") from None
    if kept.case != case or kept.scene != scene_digest(scene):
        raise NotUsed(f"{path}: '{case}' is no longer the scene that was solved. {REMEDY}")
    if kept.physics != PHYSICS:
        raise NotUsed(
            f"{path}: '{case}' was solved with physics {kept.physics}, the engine has {PHYSICS}. {REMEDY}"
        )
    return kept


def write(config: Path, study: str, kept: Kept) -> Path:
    """Keep a reference solution; its file."""
    path = path_of(config, study, kept.case)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, packed(kept))
    return path
