"""A scene at rest on a mesh, kept for several runs with different time steps."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Model
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation import outputs
from riserstudy.simulation.equilibrium import settle


class Rest:
    """Model and outputs at rest; the model is restored to rest before the next run.

    Attributes
    ----------
    model : at static equilibrium.
    iterations : Newton iterations of the search.
    arrays : outputs at rest.
    moment : (m, n + 1) components of the moment at rest (N m).

    Raises
    ------
    SimulationError
        When no equilibrium is found.
    """

    def __init__(self, scene: Resolved, mesh: Mesh) -> None:
        self.model, equilibrium = settle(scene, mesh)
        self.iterations = equilibrium.iterations
        self.arrays = outputs.at_rest(scene, self.model, mesh)
        self.moment = self.model.s.moment[:, : len(mesh.s)].copy()
        self._mesh, self._kept = mesh, [(array, array.copy()) for array in _arrays(self.model)]

    def again(self, mesh: Mesh) -> bool:
        """Restore the model to rest, to the last bit; False if the mesh is a different one."""
        if mesh is not self._mesh:
            return False
        for array, kept in self._kept:
            array[...] = kept
        return True


def _arrays(model: Model) -> Iterator[NDArray[np.generic]]:
    """All arrays that a run may write: both states, and the records of effects."""
    for record in (model.s, model.spare.value, *(effect.record for effect in model.effects)):
        for value in record:
            for part in value if isinstance(value, tuple) else (value,):
                if isinstance(part, np.ndarray) and part.flags.writeable:
                    yield part
