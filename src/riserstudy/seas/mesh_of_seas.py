"""One mesh and time step for all sea states of a heading, the coarsest that hardly change the demands.

A run with a tolerance refines mesh and step for moments and displacements along the whole riser, and takes
ten times the time that demands of limits require. Therefore, a few sea states are run with the scene's
tolerance, and the runs are repeated on coarser meshes with longer steps. The coarsest mesh and step whose
demands differ little are used. The differences, also in sea states that were not used for this choice, widen
the band of the response.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from riserstudy.records.arrays import FloatArray
from riserstudy.scene.load import SceneFile
from riserstudy.seas.cover import Cover, off_by, scale_of
from riserstudy.seas.riser_response import RiserResponse
from riserstudy.seas.sea_states import SeaStates
from riserstudy.study.setting import Layers, Setting, layers_of

Notify = Callable[[str], None]
# largest change of a demand by mesh and step, as a share of the tolerance between sea states
SHARE = 0.3
METHOD = "generalised-alpha"
HALVINGS = 3  # largest number of coarsenings by 2 of mesh and step, from runs with the tolerance
CHECKED = 2  # number of sea states that are compared with runs with the tolerance afterwards


class MeshOfSeas(NamedTuple):
    """A mesh and a time step, with their error."""

    values: dict[str, Any]  # values to set in the scene, by path
    # (limits,) largest difference of demands, relative to the allowable or the demand
    error: FloatArray
    words: str


def on_mesh(file: SceneFile, values: dict[str, Any]) -> SceneFile:
    """The scene with a mesh and a step from `MeshOfSeas`."""
    return file.with_values(values, "mesh of seas")


def checked(accurate: RiserResponse, meshed: RiserResponse, found: Cover) -> FloatArray:
    """Largest relative difference of demands, (limits,), at sea states that were not used to choose the mesh.

    Parameters
    ----------
    accurate, meshed : the scene with its tolerance, and on the mesh.
    found : cover of the heading; some of its sea states for comparison are also run with the tolerance.
    """
    states = found.states[found.held_out][:CHECKED]
    both = [RiserResponse(one.file, 1, one.interval, one.cores)(states) for one in (accurate, meshed)]
    off = off_by(both[1], both[0], scale_of(accurate.allowed, found.responses))
    return np.asarray(np.nanmax(off, axis=0, initial=0.0))


def estimated(riser: RiserResponse, of: SeaStates, found: Cover) -> FloatArray:
    """Largest estimated relative error of demands, (limits,), in runs at hard sea states of a heading.

    It includes errors of a prescribed mesh and step, and those of outputs that no tolerance limits. Runs that
    fail are left out.

    Parameters
    ----------
    riser : the scene with its prescribed mesh, or its tolerance.
    of : sea states of the heading.
    found : cover of the heading.
    """
    one = RiserResponse(riser.file, 1, riser.interval, riser.cores)
    states = probes(of)
    errors = one.estimated_errors(states)  # which leaves the runs in the store
    # a run that fails has neither demand nor error: its error stays NaN, whatever its scale
    scale = np.maximum(scale_of(riser.allowed, found.responses), np.abs(np.nan_to_num(one(states))))
    return np.asarray(np.nanmax(errors / scale, axis=0, initial=0.0))


def has_own_mesh(file: SceneFile) -> bool:
    """Whether a scene prescribes its mesh."""
    return file.resolved().analysis.mesh is not None


def mesh_of_seas(riser: RiserResponse, of: SeaStates, error: float, notify: Notify) -> MeshOfSeas | None:
    """The coarsest mesh and step whose demands differ little from those of runs with the tolerance.

    None if the scene prescribes its mesh, or no cheaper mesh suffices.

    Parameters
    ----------
    riser : riser of a scene with a tolerance.
    of : sea states of a heading; the highest, the most frequent and one with a short period are run.
    error : tolerance of the response between sea states, of which mesh and step may use a share.
    """
    if has_own_mesh(riser.file):
        return None
    one = RiserResponse(riser.file, 1, riser.interval, riser.cores)
    states = probes(of)
    notify(f"choosing mesh and time step by {len(states)} sea states, run with the scene's accuracy")
    reference = one(states)
    used = [facts for facts in one.facts(states) if facts]
    if len(used) < len(states):
        return None
    elements = max(int(facts["elements"]) for facts in used)
    step = min(float(facts["step"]) for facts in used)

    def differing(setting: Setting) -> FloatArray:
        """Largest relative difference of demands on a mesh, (limits,)."""
        other = RiserResponse(on_mesh(riser.file, setting.values), 1, riser.interval, riser.cores)
        return differences(other(states), reference, riser.allowed)

    found = _coarsest(elements, step, layers_of([riser.file.resolved()], None), differing, SHARE * error)
    if found is not None:
        notify(
            f"{found.words}: demands differ by up to {found.error.max():.2%} from those of the runs with "
            "the scene's accuracy"
        )
        return found
    notify("no coarser mesh gives the same demands, so each run finds its own mesh")
    return None


def probes(of: SeaStates) -> FloatArray:
    """The highest sea state, the middle one, and that of the higher half with the least period, (3, 2)."""
    states = of.states[of.rows > 0]
    height, period = states.T
    middle = np.abs(states / np.median(states, axis=0) - 1.0).sum(axis=1)
    high = height >= np.median(height)
    chosen = [height.argmax(), middle.argmin(), np.where(high, period, math.inf).argmin()]
    return states[list(dict.fromkeys(map(int, chosen)))]


def differences(found: FloatArray, reference: FloatArray, allowed: FloatArray) -> FloatArray:
    """Largest relative difference of demands, (limits,); infinite if a run failed."""
    off = off_by(found, reference, scale_of(allowed, reference))
    return np.asarray(np.nan_to_num(off, nan=math.inf).max(axis=0))


def _coarsest(
    elements: int,
    step: float,
    layers: Sequence[Layers],
    differing: Callable[[Setting], FloatArray],
    allowed: float,
) -> MeshOfSeas | None:
    """The mesh with the fewest elements that suffices with a short step, with the longest sufficient step.

    Doubling the step requires more iterations, and saves a fifth of the time; half of the elements save half
    of it.

    Parameters
    ----------
    elements, step : elements and step of runs with the tolerance.
    layers : gradings of a mesh, the even one first.
    differing : function that returns the largest difference of demands, (limits,).
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
