"""Change and cost of each effect: runs of a scene with and without it, on one mesh, with one step.

All variants run in turn, the whole round is repeated, and the median time of each variant is taken: other
work of the machine then affects all of them equally. Before, the first steps are run, which load the kernels.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from statistics import median
from typing import Any, NamedTuple

import numpy as np

from riserstudy.advice.changes import fitting
from riserstudy.dataset.result import Result
from riserstudy.effects.registry import Change
from riserstudy.errors import RiserStudyError
from riserstudy.model.mesh import Mesh, even, own_mesh
from riserstudy.model.vortices import shedding
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.load import SceneFile
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.audit import UNEXPLAINED
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import massless, period
from riserstudy.simulation.step_peaks import peaks_of

FEW = 4  # steps of a run that only loads the kernels
SEGMENTS = 100  # of a scene without its own mesh
STEPS_A_PERIOD = 48  # of a scene without its own step
OUTPUTS_A_PERIOD = 24  # in space at least, where displacements are known at outputs only
HALVINGS = 5  # most halvings of the step, if the energy is not balanced
ROUNDING = 1e-9  # least displacement that counts, as a share of the riser's length


class Peaks(NamedTuple):
    """Largest values of a run, by which the change of an effect is measured."""

    displacement: float  # lateral (m), or axial if the riser cannot move laterally
    moment: float  # N m, NaN in a string
    tension: float  # N, at the top

    def change_to(self, other: Peaks) -> tuple[float, float, float]:
        """Return the relative change (1) of each value; NaN where the old value is zero."""
        pairs = zip(self, other, strict=True)
        return tuple(b / a - 1.0 if a > 0.0 else math.nan for a, b in pairs)  # type: ignore[return-value]


def peaks(result: Result) -> Peaks:
    """Return the largest values of a run."""
    arrays = result.arrays

    ends = ("_max", "_min") if "time" in arrays else ("_static",)

    def largest(name: str, rest: FloatArray | float = 0.0) -> float:
        sides = [arrays[name + end] for end in ends if name + end in arrays]
        return max((float(np.abs(values - rest).max()) for values in sides), default=0.0)

    sideways = max(*(largest(name) for name in "xy"), _in_space(arrays))
    length = float(arrays["s_node"][-1])
    moved = sideways if sideways > ROUNDING * length else largest("z", straight(result))
    top = float(np.abs(arrays["effective_tension" + ends[0]][-2:]).max())
    moment = largest("bending_moment") if "bending_moment_static" in arrays else math.nan
    return Peaks(moved, moment, top)


def _in_space(arrays: dict[str, FloatArray]) -> float:
    """Largest horizontal displacement (m) in any direction: at rest, or over time; 0 in a plane.

    Extremes along x and y do not give it, since they may belong to different times.
    """
    if "time" not in arrays:
        return float(np.hypot(arrays["x_static"], arrays["y_static"]).max()) if "y_static" in arrays else 0.0
    if "y" not in arrays:
        return 0.0
    away = np.hypot(arrays["x"], arrays["y"])
    return peaks_of(arrays["time"], {"away": away})["away"].largest if len(away) else 0.0


def straight(result: Result) -> FloatArray:
    """Return the elevations (m) from which axial motion counts: at rest, or unstretched in a static run."""
    arrays = result.arrays
    return arrays["z_static"] if "time" in arrays else arrays["z_static"][0] + arrays["s_node"]


@dataclass(kw_only=True)
class Measured:
    """Peaks of a run, and the times of its repeats."""

    peaks: Peaks | None = None
    smallest_tension: float = math.nan  # smallest effective tension of the riser (N)
    unbalanced: bool = False  # energy is not balanced: the peaks may come from the step
    times: list[float] = field(default_factory=list)  # s

    @property
    def seconds(self) -> float:
        """Median of the times (s); infinite without times."""
        return median(self.times) if self.times else math.inf

    @property
    def scatter(self) -> float:
        """Half of the range of the times, as a share (1) of their median."""
        return 0.5 * (max(self.times) - min(self.times)) / self.seconds if self.times else 0.0


@dataclass
class Changed(Measured):
    """A scene with one effect changed, and the results.

    ``message``: why it cannot be run; ``fault``: the same without file and remedy; both "" if it ran.
    """

    change: Change
    because: str = ""
    message: str = ""
    fault: str = ""

    def refused(self, error: RiserStudyError) -> None:
        """Store why it cannot be run."""
        self.message, self.fault = str(error), error.fault


@dataclass
class Ablation(Measured):
    """A scene, its mesh and step, and all changes of it."""

    file: SceneFile
    mesh: Mesh
    step: float | None
    changed: list[Changed] = field(default_factory=list)


#: receives the name of the next run
Notify = Callable[[str], None]


def ablate(
    file: SceneFile,
    repeats: int,
    budget: float,
    notify: Notify = lambda _: None,
    left_out: Collection[str] = (),
    shortest: float = 0.0,
) -> Ablation:
    """Run every possible change of a scene, on one mesh with one step.

    Raises RiserStudyError when the scene itself cannot be run.

    Parameters
    ----------
    repeats : number of timed runs of each change.
    budget : most node-steps of a run.
    left_out : labels of changes that are left out.
    shortest : time (s) that a run is not cut below, whatever the budget.
    """
    own = file.resolved().analysis.step
    file, mesh = fixed(file, budget, shortest)
    if own is None:
        file = _balanced(file, mesh)
    scene = file.resolved()
    step = scene.analysis.step
    base = Ablation(file, mesh, step)
    runs: list[tuple[Ablation | Changed, Resolved]] = [(base, scene)]
    every = [(change, other) for change, other in fitting(file) if change.label not in left_out]
    for k, (change, other) in enumerate(every, 1):
        notify(f"{k} of {len(every)} changes: {change.label}")
        changed = Changed(change, change.because or "")
        base.changed.append(changed)
        try:
            of_change = other.resolved()
            single(brief(of_change, step), laid(of_change, mesh), step)
            runs.append((changed, of_change))
        except RiserStudyError as error:
            changed.refused(error)
    single(brief(scene, step), mesh, step)
    for k in range(repeats):
        notify(f"timing {len(runs)} runs, round {k + 1} of {repeats}")
        for of, which in list(runs):
            try:
                measure(of, which, laid(which, mesh), step)
            except RiserStudyError as error:
                if not isinstance(of, Changed):
                    raise
                of.refused(error)
                runs.remove((of, which))
    return base


def laid(scene: Resolved, mesh: Mesh) -> Mesh:
    """Return the same segments in the sections of a scene, which may be divided at other places."""
    return mesh._replace(section=np.searchsorted(scene.borders[1:], mesh.s[:-1] + 0.5 * mesh.l0))


def brief(scene: Resolved, step: float | None) -> Resolved:
    """Return the first steps of a scene, which load its kernels; all of it if later steps need others."""
    if step is None or scene.analysis.output is None or is_whole(scene) or scene.vessel:
        return scene
    output = scene.analysis.output.replaced(start=None, interval=FEW * step)
    return scene.replaced(analysis=scene.analysis.replaced(duration=FEW * step, output=output))


def is_whole(scene: Resolved) -> bool:
    """Return whether a scene must run to its end, as its response comes after an event or after ramps."""
    return bool(scene.events or scene.top.tension_loss or shedding(scene))


def _balanced(file: SceneFile, mesh: Mesh) -> SceneFile:
    """Return the scene with a step that balances its energy; the step is halved a few times at most."""
    for _ in range(HALVINGS):
        scene = file.resolved()
        step = scene.analysis.step
        if step is None or balanced(single(scene, mesh, step)):
            break
        file = file.with_values({"analysis.step": f"{0.5 * step!r} s"}, "half the step")
    return file


def balanced(result: Result) -> bool:
    """Return whether the energy of a run is balanced; True for a static run."""
    audit = result.facts.get("audit")
    return audit is None or audit["unexplained_share"] <= UNEXPLAINED


def measure(of: Measured, scene: Resolved, mesh: Mesh, step: float | None) -> None:
    """Run a scene once; store its peaks and its time."""
    result = single(scene, mesh, step)
    of.peaks, of.unbalanced = peaks(result), not balanced(result)
    of.smallest_tension = float(result.facts["smallest_tension"])
    of.times.append(float(result.facts["solve_seconds"]))


def fixed(file: SceneFile, budget: float, shortest: float = 0.0) -> tuple[SceneFile, Mesh]:
    """Return the scene with mesh and step, cut to a budget of node-steps, and without fatigue.

    ``shortest``: time (s) below which it is not cut.

    A scene without its own mesh and step gets default ones. They are fine enough for the change by an effect,
    which is the difference of two runs with common errors.
    """
    scene = file.resolved()
    a = scene.analysis
    mesh = own_mesh(scene) or even(scene, len(scene.riser) if massless(scene) else SEGMENTS)
    values: dict[str, Any] = {"analysis.accuracy": None, "fatigue": None}  # peaks are compared
    if not (a.mesh and a.mesh.layers):
        values["analysis.mesh"] = {"elements": len(mesh.l0) - int(mesh.joint)}
    if a.duration:
        step = a.step or period(scene) / STEPS_A_PERIOD
        values["analysis.step"] = f"{step!r} s"
        most = max(budget * step / len(mesh.s), shortest)
        if a.duration > most and not is_whole(scene):
            values["analysis.duration"] = f"{most!r} s"
            if a.output and a.output.start:
                values["analysis.output.start"] = None
        often = period(scene) / OUTPUTS_A_PERIOD
        if scene.spatial and a.output and a.output.interval > often:
            values["analysis.output.interval"] = f"{often!r} s"
    return file.with_values(values, "fixed mesh and step"), mesh
