"""Reading and writing of reference solutions; reasons not to use one: absent, damaged, scene or physics."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from chapters.numerics.reference.folder import path_of
from chapters.numerics.reference.identity import PHYSICS, scene_digest
from chapters.numerics.reference.kept import Damaged, Kept, packed, unpacked
from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.files.whole import write_whole
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved

REMEDY = "Run `make references`."


class NotUsed(SimulationError):
    """Error: a reference solution cannot be used, with the reason."""


class Wanted(NamedTuple):
    """A case that needs a reference solution, and the function that computes it; picklable for processes."""

    case: str
    file: SceneFile
    compute: Callable[[], Kept]


def read(config: Path, study: str, case: str, scene: Resolved) -> Kept:
    """Read the stored reference solution of a case.

    Parameters
    ----------
    scene : the current scene of the case.

    Raises
    ------
    NotUsed
        When there is no solution, it is damaged, or it is for another scene or another version of physics.
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


def solution(config: Path, study: str, case: str, scene: Resolved) -> Result:
    """Read the stored reference solution of a case that cannot do without one; arguments as in `read`.

    Raises
    ------
    SimulationError
        When there is none, or it cannot be used.
    """
    kept = read(config, study, case, scene)
    if kept.result is None:
        raise SimulationError(f"{case}: {kept.missing}")
    return kept.result


def write(config: Path, study: str, kept: Kept) -> Path:
    """Store a reference solution, and return its file path."""
    path = path_of(config, study, kept.case)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, packed(kept))
    return path
