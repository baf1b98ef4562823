"""What grids cost whose settings are tuned: nine scenes of the papers, 64 points each, all included.

``python benchmarks/tuned_grids.py [SCENE ...]`` varies two inputs of each scene of ``benchmarks/prices.py``
by 15 % to either side, tunes mesh, step and method as ``settings: tuned`` in a study does, and runs, stores
and joins all points, every eighth with its error. That is compared with the same study by the cheapest
setting that prices.py found for the scene in the middle, without any error, and finer where it does not serve
at a point that nothing was tuned on. A study at rest cannot be tuned: its points are run with the tolerance.
Times are of the processor. True errors are over the accuracy, at that other point, as `riserstudy tune`
measures them.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import netCDF4
import pytest
from prices import CONFIG, scene_file

from riserstudy.scene.fields import in_si, value_at
from riserstudy.simulation.compile import compile_once
from riserstudy.simulation.refine import run
from riserstudy.solve.kernel_cache import kernel_cache
from riserstudy.study import simulate_points
from riserstudy.study.corners import others
from riserstudy.study.models import Numbers
from riserstudy.study.quick_tune import finer
from riserstudy.study.setting import Setting, layers_of
from riserstudy.study.settings import tuned_for
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel
from riserstudy.study.tune import Tuner, described
from riserstudy.study.write_study import write_study

VALUES, SPREAD = 8, 0.15  # of each of two inputs; to either side
SURGE = ("platform.surge.amplitude", "platform.surge.period")
PITCH = ("platform.pitch.amplitude", "platform.pitch.period")
HEAVE = ("platform.heave.amplitude", "platform.heave.period")
WAVE = ("wave.height", "wave.period")
#: by scene what is varied, and the cheapest setting that prices.py found; at rest segments alone
GRIDS: dict[str, tuple[tuple[str, str], Setting]] = {
    "S2c": (SURGE, Setting(45, (), 0.31, "ESDIRK4")),
    "surge": (SURGE, Setting(59, (), 0.88, "ESDIRK4")),
    "roll": (PITCH, Setting(117, (), 0.59, "ESDIRK4")),
    "heave": (HEAVE, Setting(9, (), 1.8, "generalised-alpha")),
    "statics": (("top.tension", "riser[0].submerged_weight"), Setting(59, (), 1.0, "generalised-alpha")),
    "waves": (WAVE, Setting(90, (), 0.33, "generalised-alpha")),
    "hang-off": (
        ("riser[0].mass", "riser[0].submerged_weight"),
        Setting(184, (), 0.052, "generalised-alpha"),
    ),
    "drive-off": (
        ("riser[0].mass", "riser[0].submerged_weight"),
        Setting(229, (), 0.79, "generalised-alpha"),
    ),
    "tensioners": (HEAVE, Setting(1, (), 0.24, "ESDIRK4")),
}


def study_of(name: str) -> Study:
    """A grid of 64 points about a scene."""
    file, axes = scene_file(name), {}
    for number, path in enumerate(GRIDS[name][0]):
        value, unit = in_si(path, value_at(file.tree, path))
        if value is None or unit is None:
            raise SystemExit(f"{name}: no number at {path}")
        ends = [value * (1.0 + SPREAD * (2.0 * k / (VALUES - 1) - 1.0)) for k in range(VALUES)]
        axes[f"axis{number}"] = Numbers(path=path, unit=unit, values=ends)
    still = file.resolved().analysis.duration is None
    model = StudyModel(
        scene="", caption=name, axes=axes, keep=["x_max", "z_max"], settings=None if still else "tuned"
    )
    study = Study("grids", name, model, CONFIG, "standard")
    vars(study)["base"] = file
    return study


def spent(do: Callable[[], Any]) -> tuple[float, Any]:
    """Processor time (s), and what came of it."""
    begun = time.process_time()
    made = do()
    return time.process_time() - begun, made


def price(name: str, folder: Path) -> float:
    """Print what a grid costs, tuned and by the cheapest fixed setting; their ratio."""
    study, fixed = study_of(name), GRIDS[name][1]
    error, fixed = held_out(study, fixed) if study.model.settings else (None, fixed)
    run(study.grid.file((0, 0)).resolved())  # loads kernels
    tuning, found = 0.0, None
    if study.model.settings:
        tuning, found = spent(lambda: tuned_for(study, lambda what: print(what, file=sys.stderr)))
    target = folder / f"{name}.nc"
    points, _ = spent(lambda: write_study(study, target, 1, lambda _: None, settings=found))
    again = len(study.plan)
    if found:
        with netCDF4.Dataset(target) as dataset:
            again = int(dataset["by_request"][:].sum())
    values = fixed.values if study.model.settings else {"analysis.mesh": {"elements": fixed.elements}}
    plain = study_of(name)
    vars(plain)["base"] = plain.base.with_values(values, "fixed")
    with pytest.MonkeyPatch.context() as patch:  # no point tells its error
        patch.setattr(simulate_points, "has_error_estimate", lambda *_: False)
        alone, _ = spent(lambda: write_study(plain, target, 1, lambda _: None))
    ratio = (tuning + points) / alone
    told = "–"
    if error and found and found.setting:
        told = ", ".join(f"{error(setting):.2f}" for setting in (found.setting, fixed))
    said = described(found.setting) if found and found.setting else "tolerance"
    print(
        f"| {name} | {tuning:.2f} | {points:.2f} | {again} | {alone:.2f} | {ratio:.1f} | {told} "
        f"| {said}; {described(fixed)} |",
        flush=True,
    )
    return ratio


def held_out(study: Study, fixed: Setting) -> tuple[Callable[[Setting], float], Setting]:
    """What gives the true error of a setting at another point; and the fixed one, as fine as serves there."""
    tuner = Tuner(study, None, lambda _: None)
    (index,) = others(study, [], 1, 7)
    place = tuner.place(index)
    kinds = [replace(fixed, layers=layers) for layers in layers_of([place.file.resolved()], None)]
    fixed = min(kinds, key=lambda one: tuner.excess(one, place))
    while tuner.excess(fixed, place) > 1.0:
        fixed = finer(fixed)
    return lambda setting: tuner.excess(setting, place), fixed


def main(names: list[str]) -> None:
    """Measure and print, with a store of its own."""
    compile_once(print)
    numba = kernel_cache().parent.resolve()
    with TemporaryDirectory() as folder:
        os.environ["RISERSTUDY_CACHE"] = f"{folder}/.cache"
        Path(folder, ".cache").mkdir(mode=0o700)
        Path(folder, ".cache/numba").symlink_to(numba)
        print(
            "| grid | tuning (s) | points (s) | by request | cheapest fixed (s) | ratio "
            "| true errors: tuned, fixed | tuned; fixed |"
        )
        print("|---|---|---|---|---|---|---|---|")
        ratios = [price(name, Path(folder)) for name in names]
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    print(f"\ngeometric mean {mean:.1f}, worst {max(ratios):.1f}")


if __name__ == "__main__":
    main(sys.argv[1:] or list(GRIDS))
