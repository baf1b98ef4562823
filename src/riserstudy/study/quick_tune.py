"""Tune a small study at one point, at a small cost, because few points benefit from it.

The reference is a run by the fourth-order method with the segments of the refined run halved. Its error is a
third of the change by this halving. Every second mesh and step is tried. Points are then compared with the
tolerance by their estimated errors, which exceed the true errors. Mesh and step are therefore refined until a
few corner points have a sufficiently small estimated error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from riserstudy.errors import SimulationError
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import massless
from riserstudy.study.corners import corners
from riserstudy.study.grid import Index
from riserstudy.study.setting import FINER, SHORTER, Setting, layers_of, meshes, steps
from riserstudy.study.study import Study
from riserstudy.study.tune import FREE, Notify, Place, Tuned, Tuner, check_tunable, work_of

# factor on the refined run's step, whose method is of second order; with events, of fourth
LONGER = 2.0
LEFT = 3.0  # ratio of the change by halving a mesh to the remaining error: second order
METHODS = ("ESDIRK4", "generalised-alpha")
HELD_OUT = 2  # number of corner points for the check of the setting
ENOUGH = 0.9  # largest estimated error at these points, as a share of the tolerance
TWICE = 4  # number of segments is a multiple of this, since two coarser meshes give the error
ROUNDS = 6  # largest number of finer settings


@dataclass
class QuickTuner(Tuner):
    """A study and a tolerance, tuned at one point."""

    def place(self, index: Index) -> Place:
        """A point, and a reference run by the fourth-order method with the refined run's segments halved.

        Raises SimulationError when the run cannot be completed.
        """
        self.notify(f"a run with the tolerance and a finer run at {self.study.place(index)}")
        file = self.study.grid.file(index).with_values(FREE, "tune")
        scene = file.with_values(self.request, "--accuracy").resolved()
        refinement = Refinement(scene)
        requested = refinement.result()
        mesh = refinement.finest_mesh if massless(scene) else refinement.finest_mesh.halved()
        step = requested.facts["step"] * (1.0 if scene.events else LONGER)
        best = single(scene.replaced(analysis=scene.analysis.replaced(method="ESDIRK4")), mesh, step)
        unsure = {name: off / LEFT for name, off in difference(requested, best).items()}
        return Place(index, file, best, unsure, sum(map(work_of, requested.facts["refinements"])))

    def least_work(self, places: list[Place]) -> Setting:
        """The setting of least work among every second mesh and step, along the border of those that suffice.

        Raises SimulationError when no setting needs less work than runs with a tolerance.
        """
        scenes = [place.file.resolved() for place in places]
        best, least = None, sum(place.work_of_request for place in places)
        finest = max(place.best.facts["elements"] for place in places) // 2
        counts = [_halvable(count) for count in meshes(scenes, finest)[::-2][::-1]]
        layers = layers_of(scenes, None)[-1]
        for method in METHODS:
            every = [[Setting(n, layers, h, method) for h in steps(scenes)[::2]] for n in counts]
            found, work = self._along_border(every, places, least)
            if work < least:
                best, least = found, work
        if best is None:
            raise self.nothing_faster()
        return best

    def nothing_faster(self) -> SimulationError:
        """The error if no setting needs less work than runs with a tolerance."""
        return SimulationError(
            f"{self.study.where}: no mesh and time step takes less time than runs with the tolerance; "
            "run the study with analysis.accuracy"
        )

    def estimated(self, setting: Setting, index: Index) -> float:
        """Ratio of a point's largest estimated error to the tolerance (1); infinite if the run fails."""
        file = self.study.grid.file(index).with_values(FREE, "tune")
        try:
            result = run(file.with_values(setting.values, "tune").resolved())
        except SimulationError:
            return math.inf
        error = result.facts["error_estimate"]
        return self._over(error) if error else math.inf


def finer(setting: Setting) -> Setting:
    """The setting with the next finer mesh and the next shorter step."""
    elements = setting.elements
    if elements >= TWICE:  # fewer segments are for a massless spring
        elements = _halvable(elements * FINER)
    return replace(setting, elements=elements, step=float(f"{setting.step / SHORTER:.2g}"))


def _halvable(elements: float) -> int:
    """The number of segments, increased to a multiple of `TWICE`, so that it can be halved twice."""
    return TWICE * math.ceil(elements / TWICE) if elements >= TWICE else round(elements)


def quick_tune(study: Study, seed: int, notify: Notify = lambda _: None) -> Tuned:
    """A setting for a small study, with its error and cost.

    Raises InputError when there is nothing to tune. Raises SimulationError when the point cannot be run, or
    no setting suffices with less work than runs with a tolerance.
    """
    check_tunable(study, 1)
    tuner = QuickTuner(study, None, notify)
    index, *checks = corners(study, 1 + HELD_OUT, seed)
    place = tuner.place(index)
    setting = tuner.least_work([place])
    left = [index, *checks]
    errors: dict[Index, float] = {}
    for _ in range(ROUNDS):
        while left and max(errors.values(), default=0.0) <= ENOUGH:
            errors[left[0]] = tuner.estimated(setting, left[0])
            left = left[1:]
        if max(errors.values()) <= ENOUGH:
            break
        setting = finer(setting)
        worst = max(errors, key=lambda one: errors[one])
        left = [worst, *left, *(one for one in errors if one != worst)]
        errors = {}
    work = tuner.work(setting, [place]) if not left else math.inf
    if work >= place.work_of_request:
        raise tuner.nothing_faster()
    return Tuned(
        accuracy=tuner.words,
        setting=setting,
        points=[index],
        checked=checks,
        error=tuner.excess(setting, place),
        held_out=max(errors.values()),
        work=work / place.work_of_request,
        own=None,
    )
