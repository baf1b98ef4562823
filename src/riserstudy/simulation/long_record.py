"""A long record of an irregular sea: mesh and step of a piece of it serve the whole, if that errs no more.

A refinement runs a record again and again, each run finer, and all of them take about twice as long as the
last. Here these are runs of the record's first piece. Of the whole there are two: with the mesh and the step
that the piece ended with, and one with segments and steps twice as long, which takes a quarter of its time.
Where these two differ by more than the same two of the piece, the whole errs by as much more.
"""

from __future__ import annotations

import math

from riserstudy.dataset.result import Result
from riserstudy.errors import PhysicallyUnstable, SimulationError
from riserstudy.model.mesh import Mesh
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.sea import Storm
from riserstudy.simulation.error_estimate import CONTROLLED, difference
from riserstudy.simulation.piece import longest_ramp, piece_of
from riserstudy.simulation.refine import Refinement
from riserstudy.simulation.run import march
from riserstudy.simulation.run_cost import cost
from riserstudy.simulation.starting_mesh import massless, period
from riserstudy.simulation.thinning import thinned
from riserstudy.simulation.time_limit import Watch, size
from riserstudy.simulation.vibration_refinement import VibrationRefinement

PERIODS = 48.0  # the shortest of a scene, after its ramps, that are a piece: two dozen waves
LONG = 10.0  # pieces, from which on they pay


def piece_length(scene: Resolved) -> float:
    """Time of the piece that a record is refined on (s)."""
    return longest_ramp(scene) + PERIODS * period(scene)


def is_long(scene: Resolved) -> bool:
    """Whether a scene is a long record of an irregular sea, in which nothing happens but waves."""
    a = scene.analysis
    response = scene.platform and scene.platform.response
    seas = scene.wave, response and response.wave
    if a.duration is None or a.output is None or not any(isinstance(sea, Storm) for sea in seas):
        return False
    if scene.vessel or scene.events or scene.top.tension_loss or massless(scene) or a.solver:
        return False
    return a.duration >= LONG * piece_length(scene)


def refinement_of(scene: Resolved, watch: Watch) -> Refinement:
    """What refines a scene; with a patience by runs of the whole, of which the last that is done counts."""
    if any(section.viv for section in scene.riser):
        return VibrationRefinement(scene, watch)
    by_piece = is_long(scene) and watch.patience == math.inf
    return LongRecord(scene, watch) if by_piece else Refinement(scene, watch)


class LongRecord(Refinement):
    """The refinement of a long record, by way of a piece of it."""

    def _refine(self) -> bool:
        """As of any record, begun with the mesh and step that its piece ended with; whether it reached."""
        part = Refinement(piece_of(self.scene, piece_length(self.scene)), self.watch)
        try:
            whole = self._by_piece(part)
        except PhysicallyUnstable:
            raise
        except SimulationError:  # it may only be that a coarse run fails
            whole = None
        if whole is None:
            return super()._refine()
        self.meshes, self.step, self.way = part.meshes, part.step, part.way
        self.last = self.finest = whole
        self.finest_mesh, self.thin = self.mesh, False
        whole.facts["error_estimate"] = self.error
        way = self._next_way()
        if way is None:
            return True
        self._halve(way)
        return super()._refine()

    def _by_piece(self, part: Refinement) -> Result | None:
        """The whole as its piece says, with the error of each way; None where the piece does not say."""
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
        self.seen = {way: one.scaled(more) for way, one in part.seen.items()}
        return whole

    def _run(self, scene: Resolved, mesh: Mesh, step: float, coarse: bool) -> Result:
        """A run of the whole or of a piece; a coarse one has what a comparison needs."""
        self.watch.begin(f"{scene.analysis.duration:.4g} s on {size(len(mesh.l0), step)}")
        shortened = thinned(scene, step)[0] if coarse else scene
        run = march(shortened, mesh, step, watch=self.watch, extremes=not coarse)
        self.spent.append(cost(run))
        return run
