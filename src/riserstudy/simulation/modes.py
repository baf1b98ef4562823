"""Natural modes of a scene about its static equilibrium."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import SimulationError
from riserstudy.model.layout import AXES, directions, stiffness
from riserstudy.model.mesh import Mesh, even, own_mesh
from riserstudy.scene.at_rest import at_rest
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.starting_mesh import massless
from riserstudy.solve.modes import lowest_squares, natural_modes

if TYPE_CHECKING:
    import xarray as xr

DEFAULT_ELEMENTS = 200
MOST_MODES = 1000
BELOW = 0.05  # distance of the shift from the lowest square of a frequency, as a share of it
EQUAL = 1e-6  # largest difference of displacements of a mode that count as equal


def modes_of(scene: Resolved, count: int) -> xr.Dataset:
    """Frequencies, periods and shapes of the lowest modes, as in `riserstudy.modes`.

    A riser with bending stiffness or tension also has lateral modes, even if nothing in the scene moves it
    laterally. A bar without either has only axial modes. Raises SimulationError when there is no equilibrium,
    or a node that moves has no mass.
    """
    import xarray as xr

    scene = _without_lag(scene)
    mesh, d = mesh_of_modes(scene)  # in all directions in which the riser can vibrate
    model, _ = settle(at_rest(scene), mesh, d)
    try:
        frequency, shape = natural_modes(model.programs, model.state, model.fixed, count)
    except np.linalg.LinAlgError:
        raise SimulationError(
            "modes require mass at every node that moves; add mass to every section, or divide a section "
            "without mass into one segment only"
        ) from None
    shape = _upright(shape)
    size = np.abs(shape).max(axis=2)
    motion = [_motion(row) for row in size]
    data = {
        name: (("mode", "s"), shape[:, k, :], {"units": "1", "long_name": f"mode shape along {name}"})
        for k, name in enumerate("xyz"[axis] for axis in AXES[d])
    }
    return xr.Dataset(
        {
            "frequency": (
                "mode",
                frequency / (2.0 * math.pi),
                {"units": "Hz", "long_name": "natural frequency"},
            ),
            "natural_period": (
                "mode",
                np.where(frequency > 0.0, 2.0 * math.pi / np.abs(frequency), np.nan),
                {"units": "s", "long_name": "natural period"},
            ),
            "motion": ("mode", motion, {"long_name": "direction in which a mode moves most"}),
            **data,
        },
        {"mode": np.arange(1, len(frequency) + 1), "s": mesh.s},
    )


def frequency_errors(scene: Resolved, frequency: NDArray[np.float64]) -> NDArray[np.float64]:
    """Estimated relative errors of the lowest natural frequencies by the mesh, (k,), 1.

    ``frequency`` (k,) are those of `modes_of`. They are compared with those of meshes with two and four times
    the number of segments, whose errors of second order are a quarter and a sixteenth. Errors may change
    their sign or first rise from mesh to mesh, so the largest of three estimates counts: by either mesh, and
    the error of the first of them by the second. A massless spring is exact. NaN where sections without mass
    prevent finer meshes, and for a frequency of zero.
    """
    if massless(scene):
        return np.zeros(len(frequency))
    scene = _without_lag(scene)
    mesh, d = mesh_of_modes(scene)
    square = np.sign(frequency) * (2.0 * math.pi * frequency) ** 2
    below = float(square.min() - BELOW * (abs(square.min()) or square.max()))
    found = [frequency]
    for _ in range(2):
        mesh = mesh.halved()
        model, _ = settle(at_rest(scene), mesh, d)
        try:
            finer = lowest_squares(model.programs, model.state, model.fixed, len(square), below)
        except np.linalg.LinAlgError:
            return np.full(len(frequency), np.nan)
        found.append(np.sign(finer) * np.sqrt(np.abs(finer)) / (2.0 * math.pi))
    one, two, four = found
    changes = [abs(one - two) / 0.75, abs(one - four) / 0.9375, abs(two - four) / 0.75]
    errors: NDArray[np.float64] = np.max(changes, axis=0) / np.where(frequency == 0.0, np.nan, abs(frequency))
    return errors


def mesh_of_modes(scene: Resolved) -> tuple[Mesh, int]:
    """The mesh and the number of directions for the computation of modes."""
    mesh = own_mesh(scene) or even(scene, len(scene.riser) if massless(scene) else DEFAULT_ELEMENTS)
    bends = all(stiffness(section).bending > 0.0 for section in scene.riser)
    return mesh, max(directions(scene), 2 if bends and scene.top.x is not None else 1)


def _upright(shape: NDArray[np.float64]) -> NDArray[np.float64]:
    """Shapes (k, d, n+1) whose largest displacement is positive; among equal displacements, the lowest."""
    flat = shape.reshape(len(shape), -1)
    size = np.abs(flat)
    largest = (size >= (1.0 - EQUAL) * size.max(axis=1, keepdims=True)).argmax(axis=1)
    sign = np.sign(flat[np.arange(len(flat)), largest])
    return shape * np.where(sign == 0.0, 1.0, sign)[:, None, None]


def _without_lag(scene: Resolved) -> Resolved:
    """The scene with thrusters without lag, which modes cannot represent."""
    vessel = scene.vessel
    if vessel is None or vessel.thrusters is None or vessel.thrusters.lag is None:
        return scene
    return scene.replaced(vessel=vessel.replaced(thrusters=vessel.thrusters.replaced(lag=None)))


def _motion(size: NDArray[np.float64]) -> str:
    """The direction with the largest motion, from the largest displacement in each direction."""
    if size.max() < 0.5:
        return "yaw"
    return "axial" if size.argmax() == len(size) - 1 else "lateral"
