"""One mesh and one step for all sea states of a heading, the coarsest that leaves demands as they are.

A run that finds its own mesh and step does so for moments and displacements along the whole riser, and takes
ten times as long as demands of limits need. So a few sea states are run by the scene's accuracy, the same
runs are repeated on coarser meshes with longer steps, and the coarsest serves whose demands differ little.
What they differ by, also in sea states that it was not chosen by, widens the band of the response.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.scene.load import SceneFile
from riserstudy.seas.cover import Cover, off_by, scale_of
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import SeaStates
from riserstudy.study.setting import Layers, Setting, layers_of

FloatArray = NDArray[np.float64]
Notify = Callable[[str], None]
SHARE = 0.3  # of the error between sea states: what mesh and step may change of a demand
METHOD = "generalised-alpha"
HALVINGS = 3  # of the mesh and of the step of runs by accuracy, at most
CHECKED = 2  # sea states that are compared with runs by accuracy afterwards


class MeshOfSeas(NamedTuple):
    """A mesh and a step, and what they are worth."""

    values: dict[str, Any]  # of the scene, by path
    error: FloatArray  # (limits,) largest difference of demands, over what is allowed or over the demand
    words: str


def on_mesh(file: SceneFile, values: dict[str, Any]) -> SceneFile:
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
    """The coarsest mesh and step whose demands differ little from those of runs by accuracy.

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

    def differing(setting: Setting) -> FloatArray:
        """Largest difference of demands on a mesh, (limits,)."""
        other = RiserResponse(on_mesh(riser.file, setting.values), 1, riser.interval, riser.cores)
        return differences(other(states), reference, riser.allowed)

    found = _coarsest(
        elements, step, layers_of([riser.file.resolved()], None), differing, SHARE * error
    )
    if found is not None:
        notify(
            f"{found.words}: demands differ by up to {found.error.max():.2%} from those by accuracy"
        )
        return found
    notify("no coarser mesh gives the same demands, so each run finds its own mesh")
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


def _coarsest(
    elements: int,
    step: float,
    layers: Sequence[Layers],
    differing: Callable[[Setting], FloatArray],
    allowed: float,
) -> MeshOfSeas | None:
    """The mesh of fewest elements that serves with a short step, with the longest step that serves then.

    A step of twice the length takes more iterations, and saves a fifth; half the elements save half.

    Parameters
    ----------
    elements, step : of runs by accuracy.
    layers : ways to grade a mesh, the even one first.
    differing : largest difference of demands, (limits,).
    """
    for a, graded in product(range(HALVINGS, -1, -1), reversed(layers)):
        every = [
            Setting(math.ceil(elements / 2**a), graded, float(f"{step * 2**b:.2g}"), METHOD)
            for b in range(HALVINGS + 1)
        ]
        short, *longer = every
        if differing(short).max() > allowed:
            continue
        for setting in [*reversed(longer), *([short] if a else [])]:
            if (off := differing(setting)).max() <= allowed:
                kind = "graded" if graded else "even"
                words = f"{setting.elements} {kind} elements and steps of {setting.step:g} s"
                return MeshOfSeas(setting.values, off, words)
    return None
