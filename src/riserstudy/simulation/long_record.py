"""Refinement of a long record of an irregular sea, by mesh and time step of its first piece.

A refinement repeats a record with finer and finer runs, which together take about twice the time of the last
run. Here, these are runs of the record's first piece. The whole record is run twice: with the final mesh and
step of the piece, and with segments and steps twice as long, which takes a quarter of the time. If these two
runs differ by more than the same two runs of the piece, the estimated error of the whole is increased by the
same factor.
"""

from __future__ import annotations

import math

from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, SimulationError
from riserstudy.model.mesh import Mesh
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.error_estimate import CONTROLLED, difference
from riserstudy.simulation.piece import longest_ramp, piece_of
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import march
from riserstudy.simulation.run_cost import cost
from riserstudy.simulation.starting_mesh import massless, period
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Watch, size
from riserstudy.simulation.vortex_vibration_refinement import VibrationRefinement

# length of a piece after the ramps, in shortest periods of the scene: two dozen waves
PERIODS = 48.0
LONG = 10.0  # ratio of record to piece from which on a piece saves time


def piece_length(scene: Resolved) -> float:
    """Duration of the piece on which a record is refined (s)."""
    return longest_ramp(scene) + PERIODS * period(scene)


def is_long(scene: Resolved) -> bool:
    """Whether a scene is a long record of an irregular sea, without events and without a vessel."""
    a = scene.analysis
    if a.duration is None or a.output is None or not scene.irregular_waves:
        return False
    if scene.vessel or scene.events or scene.top.tension_loss or massless(scene) or a.solver:
        return False
    return a.duration >= LONG * piece_length(scene)


def refinement_of(scene: Resolved, watch: Watch) -> Refinement:
    """The refinement of a scene; with a time limit, all runs are of the whole record."""
    if any(section.viv for section in scene.riser):
        return VibrationRefinement(scene, watch)
    by_piece = is_long(scene) and watch.patience == math.inf
    return LongRecord(scene, watch) if by_piece else Refinement(scene, watch)


class LongRecord(Refinement):
    """The refinement of a long record by its first piece."""

    def _refine(self) -> bool:
        """Refine from the final mesh and step of the piece; returns whether the tolerance is met."""
        part = Refinement(piece_of(self.scene, piece_length(self.scene)), self.watch)
        try:
            whole = self._by_piece(part)
        except PhysicallyUnstable:
            raise
        except SimulationError:  # perhaps only a coarse run fails
            whole = None
        if whole is None:
            return super()._refine()
        self.meshes, self.step, self.convergence.way = part.meshes, part.step, part.convergence.way
        self.last = self.finest = whole
        self.finest_mesh, self.thin = self.mesh, False
        whole.facts["error_estimate"] = self.convergence.error
        way = self.convergence.next_way()
        if way is None:
            return True
        self._halve(way)
        return super()._refine()

    def _by_piece(self, part: Refinement) -> Result | None:
        """The whole record with mesh and step of the piece, with its errors; None if the piece gives none."""
        if not part._refine() or part.finest is None or len(part.meshes) < 2 or part.step is None:
            return None
        self.spent += part.spent
        coarse_mesh, step = part.meshes[-2], part.step
        before = difference(self._run(part.scene, coarse_mesh, 2.0 * step, True), part.finest)
        coarse = self._run(self.scene, coarse_mesh, 2.0 * step, True)
        whole = self._run(self.scene, part.mesh, step, False)
        more = {}
        for name, off in difference(coarse, whole).items():
            if before.get(name, 0.0) > 0.0:
                more[name] = max(1.0, off / before[name])
            elif name in CONTROLLED:
                return None
        self.convergence.halved = {way: one.scaled(more) for way, one in part.convergence.halved.items()}
        return whole

    def _run(self, scene: Resolved, mesh: Mesh, step: float, coarse: bool) -> Result:
        """A run of the whole record or of a piece; a coarse run has only the outputs for a comparison."""
        self.watch.begin(f"{scene.analysis.duration:.4g} s on {size(len(mesh.l0), step)}")
        shortened = thinned(scene, step)[0] if coarse else scene
        run = march(shortened, mesh, step, watch=self.watch, extremes=not coarse)
        self.spent.append(cost(run))
        return run
