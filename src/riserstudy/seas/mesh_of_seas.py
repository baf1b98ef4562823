"""One mesh and one step for all sea states of a heading, the cheapest that leaves demands as they are.

A run that finds its own mesh and step does so for moments and displacements along the whole riser, and takes
ten times as long as demands of limits need. So a few sea states are run by the scene's accuracy, the same
runs are repeated on coarser meshes with longer steps, and the cheapest serves whose demands differ little.
What they differ by, also in sea states that it was not chosen by, widens the band of the response.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.scene.load import SceneFile
from riserstudy.seas.cover import Cover, off_by, scale_of
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import SeaStates

FloatArray = NDArray[np.float64]
Notify = Callable[[str], None]
SHARE = 0.3  # of the error between sea states: what mesh and step may change of a demand
HALVINGS = 3  # of the mesh and of the step of runs by accuracy, at most
CHECKED = 2  # sea states that are compared with runs by accuracy afterwards


class MeshOfSeas(NamedTuple):
    """A mesh and a step, and what they are worth."""

    values: dict[str, object]  # of the scene, by path
    error: FloatArray  # (limits,) largest difference of demands, over what is allowed or over the demand
    words: str


def on_mesh(file: SceneFile, values: dict[str, object]) -> SceneFile:
    """The scene on a mesh and step, as `MeshOfSeas` has them."""
    return file.with_values(values, "mesh of seas")


def checked(accurate: RiserResponse, meshed: RiserResponse, found: Cover) -> FloatArray:
    """Largest difference of demands, (limits,), at sea states that the mesh was not chosen by.

    Parameters
    ----------
    accurate, meshed : the scene by its accuracy, and on the mesh.
    found : of the heading; some of the sea states that are held out are run by accuracy, too.
    """
    states = found.states[found.held_out][:CHECKED]
    both = [
        RiserResponse(one.file, 1, one.interval, one.cores)(states) for one in (accurate, meshed)
    ]
    off = off_by(both[1], both[0], scale_of(accurate.allowed, found.responses))
    return np.asarray(np.nanmax(off, axis=0, initial=0.0))


def has_own_mesh(file: SceneFile) -> bool:
    """Whether a scene prescribes its mesh."""
    return file.resolved().analysis.mesh is not None


def mesh_of_seas(
    riser: RiserResponse, of: SeaStates, error: float, notify: Notify
) -> MeshOfSeas | None:
    """The cheapest mesh and step whose demands differ little from those of runs by accuracy.

    None where the scene has its own mesh, or none that is cheaper serves.

    Parameters
    ----------
    riser : a scene that requests an accuracy.
    of : sea states of a heading; the highest, the most frequent and a short one are run.
    error : of the response between sea states, of which mesh and step get a share.
    """
    if has_own_mesh(riser.file):
        return None
    one = RiserResponse(riser.file, 1, riser.interval, riser.cores)
    states = probes(of)
    notify(f"mesh and step by {len(states)} sea states that are run by the scene's accuracy")
    reference = one(states)
    used = [facts for facts in one.facts(states) if facts]
    if len(used) < len(states):
        return None
    elements = max(int(facts["elements"]) for facts in used)
    step = min(float(facts["step"]) for facts in used)
    for values, words in _coarser(elements, step):
        other = RiserResponse(on_mesh(riser.file, values), 1, riser.interval, riser.cores)
        found = differences(other(states), reference, riser.allowed)
        if np.isfinite(found).all() and found.max() <= SHARE * error:
            notify(f"{words}: demands differ by up to {found.max():.2%} from those by accuracy")
            return MeshOfSeas(values, found, words)
    notify("no coarser mesh leaves demands as they are: each run finds its own")
    return None


def probes(of: SeaStates) -> FloatArray:
    """The highest sea state, the one nearest to the middle, and the shortest of the higher half, (3, 2)."""
    states = of.states[of.rows > 0]
    height, period = states.T
    middle = np.abs(states / np.median(states, axis=0) - 1.0).sum(axis=1)
    high = height >= np.median(height)
    chosen = [height.argmax(), middle.argmin(), np.where(high, period, math.inf).argmin()]
    return states[list(dict.fromkeys(map(int, chosen)))]


def differences(found: FloatArray, reference: FloatArray, allowed: FloatArray) -> FloatArray:
    """Largest difference of demands, (limits,); infinite where a run failed."""
    off = off_by(found, reference, scale_of(allowed, reference))
    return np.asarray(np.nan_to_num(off, nan=math.inf).max(axis=0))


def _coarser(elements: int, step: float) -> list[tuple[dict[str, object], str]]:
    """Meshes and steps that are coarser, the cheapest first, as values of a scene and in words."""
    every = sorted(
        ((a + b, a, b) for a in range(HALVINGS + 1) for b in range(HALVINGS + 1) if a + b),
        reverse=True,
    )
    found: list[tuple[dict[str, object], str]] = []
    for _, a, b in every:
        count, long = math.ceil(elements / 2**a), float(f"{step * 2**b:.3g}")
        values: dict[str, object] = {
            "analysis.accuracy": None,
            "analysis.mesh": {"elements": count},
            "analysis.step": f"{long!r} s",
        }
        found.append((values, f"{count} elements and steps of {long:g} s"))
    return found
