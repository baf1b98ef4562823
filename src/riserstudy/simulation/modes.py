"""Natural modes of a scene about its static equilibrium, as a dataset."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import SimulationError
from riserstudy.model.layout import AXES, directions, stiffness
from riserstudy.model.mesh import prescribed
from riserstudy.scene.models import Scene
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.starting_mesh import massless
from riserstudy.solve.modes import natural_modes

if TYPE_CHECKING:
    import xarray as xr

DEFAULT_ELEMENTS = 200


def modes_of(scene: Scene, count: int) -> xr.Dataset:
    """Frequencies and shapes of the lowest modes.

    A riser with bending stiffness or tension vibrates sideways too, whatever the scene moves; only a
    bar without either is left to its axial modes.

    Returns
    -------
    Dataset with ``frequency`` (Hz, negative for an unstable direction) and ``motion`` over ``mode``
    (yaw: that of a vessel, where the riser rests),
    and shapes ``x``, ``z`` over (mode, s), largest displacement 1.

    Raises
    ------
    SimulationError
        When there is no equilibrium, or a node that moves has no mass.
    """
    import xarray as xr

    scene = _without_lag(scene)
    most = len(scene.riser) if massless(scene) else DEFAULT_ELEMENTS
    mesh = prescribed(scene, scene.analysis.mesh.elements if scene.analysis.mesh else most)
    bends = all(stiffness(section).bending > 0.0 for section in scene.riser)
    d = max(directions(scene), 2 if bends and scene.top.x is not None else 1)
    model, _ = settle(scene, mesh, d)
    try:
        frequency, shape = natural_modes(model.programs, model.state, model.fixed, count)
    except np.linalg.LinAlgError:
        raise SimulationError(
            "modes need mass at every node that moves: give every section its mass, or a massless "
            "spring a single segment"
        ) from None
    size = np.abs(shape).max(axis=2)
    motion = [_motion(row) for row in size]
    data = {
        name: (
            ("mode", "s"),
            shape[:, k, :],
            {"units": "1", "long_name": f"mode shape along {name}"},
        )
        for k, name in enumerate("xyz"[axis] for axis in AXES[d])
    }
    return xr.Dataset(
        {
            "frequency": (
                "mode",
                frequency / (2.0 * math.pi),
                {"units": "Hz", "long_name": "natural frequency"},
            ),
            "motion": ("mode", motion),
            **data,
        },
        {"mode": np.arange(1, len(frequency) + 1), "s": mesh.s},
    )


def _without_lag(scene: Scene) -> Scene:
    """The scene with thrusters that answer at once: modes know no delays."""
    vessel = scene.vessel
    if vessel is None or vessel.thrusters is None or vessel.thrusters.lag is None:
        return scene
    prompt = vessel.thrusters.model_copy(update={"lag": None})
    return scene.model_copy(update={"vessel": vessel.model_copy(update={"thrusters": prompt})})


def _motion(size: NDArray[np.float64]) -> str:
    """What moves most, by the largest displacement in each direction; 1 is the largest of all."""
    if size.max() < 0.5:
        return "yaw"
    return "axial" if size.argmax() == len(size) - 1 else "lateral"
