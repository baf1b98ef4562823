"""Mesh, time step and method of a study, as in its file, and the settings that tuning tries."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from riserstudy.scene.analysis import GeneralisedAlpha
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.starting_mesh import end_layers, massless, period
from riserstudy.simulation.time_stepping import RHO_INF, STIFF

#: methods by name: the value in a scene, and the smallest number of solutions per time step
METHODS: dict[str, tuple[Any, int]] = {
    "generalised-alpha": ({"rho_inf": RHO_INF}, 1),
    "TR-BDF2": ("TR-BDF2", 2),
    "ESDIRK4": ("ESDIRK4", 5),
}
COARSE = 8  # segments of the coarsest mesh
FINER = 2 ** (1 / 4)  # ratio of segments of successive meshes
LONG, SHORT = 4.0, 400.0  # time steps in a period, for the longest and the shortest step
SHORTER = 2 ** (1 / 3)  # ratio of successive time steps
ENDS = ("bottom", "top")
#: lengths of layers by end (m)
Layers = tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Setting:
    """Segments, layers by end (m), step (s) and the name of a method."""

    elements: int
    layers: Layers
    step: float
    method: str

    @property
    def analysis(self) -> dict[str, Any]:
        """Mesh, step and method in the form of a scene's analysis."""
        mesh: dict[str, Any] = {"elements": self.elements}
        if self.layers:
            mesh["layers"] = {end: f"{length:g} m" for end, length in self.layers}
        return {"mesh": mesh, "step": f"{self.step:g} s", "method": METHODS[self.method][0]}

    @property
    def values(self) -> dict[str, Any]:
        """Values that it sets in a scene, by path."""
        paths = {f"analysis.{name}": value for name, value in self.analysis.items()}
        return paths | {"analysis.accuracy": None}

    @property
    def least_work(self) -> float:
        """Smallest number of segments times solutions per second of a run (1/s)."""
        return self.elements * METHODS[self.method][1] / self.step


def own_setting(scene: Resolved) -> Setting | None:
    """The setting of a scene; None if it has none, or has a method that tuning does not try."""
    a = scene.analysis
    method: Any = a.method or (STIFF if scene.events else "generalised-alpha")
    if isinstance(method, GeneralisedAlpha) and method.rho_inf == RHO_INF:
        method = "generalised-alpha"
    if a.mesh is None or a.step is None or method not in METHODS:
        return None
    layers = a.mesh.layers
    lengths = [(end, getattr(layers, end)) for end in ENDS if layers and getattr(layers, end)]
    return Setting(a.mesh.elements, tuple(lengths), a.step, method)


def layers_of(scenes: list[Resolved], own: Setting | None) -> list[Layers]:
    """Gradings of a mesh to try: even, by the thinnest layers of some scenes, by the layers of a setting."""
    ends = zip(*map(end_layers, scenes), strict=True)
    thinnest = zip(ENDS, map(min, ends), strict=True)
    graded = tuple((end, float(f"{x:.2g}")) for end, x in thinnest if x < math.inf)
    return list(dict.fromkeys([(), graded, own.layers if own else ()]))


def meshes(scenes: list[Resolved], finest: int) -> list[int]:
    """Numbers of segments to try, up to about ``finest``."""
    if massless(scenes[0]):
        return [len(scenes[0].riser)]
    count = max(1, math.ceil(math.log(finest / COARSE) / math.log(FINER)) + 1)
    return sorted({round(COARSE * FINER**k) for k in range(count)})


def steps(scenes: list[Resolved]) -> list[float]:
    """Steps to try (s), the longest first, to two digits."""
    shortest = min(map(period, scenes))
    count = math.ceil(math.log(SHORT / LONG) / math.log(SHORTER)) + 1
    every = [float(f"{shortest / LONG / SHORTER**k:.2g}") for k in range(count)]
    return list(dict.fromkeys(every))
