"""Amplitude and frequency of a built-up vibration, as facts of a run."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from riserstudy.errors import SimulationError
from riserstudy.model.vortices import ramp_of, shedding, shedding_period, shortest_shedding_period, slowest
from riserstudy.records.arrays import FloatArray
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.limits import OF_ONE_PLACE
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.until import LOWER_ANGLE
from riserstudy.simulation.vortex_vibration_statistics import (
    FIELDS,
    NONE,
    along,
    frequency,
    principal,
    rounding_of,
    sampling,
    sampling_of_one_place,
    vibration,
)

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

LATER = 0.5  # share of the time after all ramps that is evaluated
FEWEST = 16  # smallest number of outputs for statistics
STEPS, OUTPUTS = 20, 4  # smallest numbers of time steps and outputs in a period of the vortices
# number of outputs in a period below which outputs show a motion at another frequency, or, close to two
# outputs in a period, at the same phases
FOLDED = 2.5


def since(scene: Resolved) -> float | None:
    """Time from which on a run's vibration is evaluated (s); None without vortex-induced vibration.

    Raises SimulationError when a run ends before its ramps.
    """
    duration = scene.analysis.duration
    if duration is None or not shedding(scene):
        return None
    built_up = max(ramp_of(scene), scene.built_up)
    start = built_up + (1.0 - LATER) * (duration - built_up)
    if duration <= built_up:
        raise SimulationError(
            f"riser.viv: the ramps end at {built_up:.4g} s, but the run ends at {duration:.4g} s; give a "
            "longer analysis.duration, or a shorter riser.viv.ramp"
        )
    return start


def enter(scene: Resolved, step: float, arrays: dict[str, FloatArray], facts: RunFacts) -> None:
    """Add a run's vibration to its facts: start of the evaluated time, root mean square, place, frequency.

    There is a warning if time steps (s) or output intervals are too long for the vortices; with too few
    outputs, the frequency is not computed, or no statistics at all. For a riser at rest, there are only root
    mean squares. ``arrays``: histories (times, s), m.
    """
    start = since(scene)
    if start is None or "y" not in arrays:
        return
    fastest, interval = _shortest_shedding(scene, arrays), float(np.diff(arrays["time"][:2])[0])
    facts["warnings"] += _too_long(scene, step, fastest)
    late = arrays["time"] >= start
    if int(late.sum()) < FEWEST:
        text = (
            f"riser.viv: fewer than {FEWEST} outputs after {{start:.4g}} s, too few for statistics of the "
            "vibration. Run longer, or with a shorter analysis.output.interval"
        )
        facts["warnings"].append(warning("few_outputs_of_a_vibration", text, {"start": start}))
        return
    period, name = _shortest_period(scene, fastest)
    values = {"interval": interval, "name": name, "period": period, "advised": period / OUTPUTS}
    if interval > period / FOLDED:
        text = (
            "riser.viv: outputs every {interval:.3g} s may show fast vibrations as slow motion, since the "
            "{name} is {period:.3g} s, so statistics of the vibration are not computed; "
            "give an analysis.output.interval of {advised:at_most} s"
        )
        facts["warnings"].append(warning("slow_outputs_of_a_vibration", text, values))
        return
    time, above = arrays["time"][late], slowest(scene)
    parts = [vibration(arrays[name][late], time, above) for name in ("x", "y")]
    rms = np.sqrt(sum((part**2).mean(axis=0) for part in parts))
    most = int(rms.argmax())
    facts["vibration_since"], facts["vibration_above"] = start, above
    facts["vibration_rms"] = along(rms**2, arrays["s"])
    facts["vibration_rms_max"] = float(rms[most])
    facts["vibration_rms_max_s"] = float(arrays["s"][most])
    if facts["vibration_rms"] <= NONE * arrays["s"][-1]:
        return
    if scene.shortest_period and above * scene.shortest_period < 1.0:
        text = (
            "riser.viv: the statistics of vibration include motion due to waves and the platform above "
            "{above:.3g} Hz. To find its part, repeat the run with riser[*].viv: null"
        )
        facts["warnings"].append(warning("vibration_with_other_motion", text, {"above": above}))
    facts["vibration_scatter"] = _scatter(parts, arrays["s"])
    often = interval <= period / OUTPUTS
    histories = {name: arrays[name][late] for name in FIELDS if name in arrays}
    facts["sampling_error"] = sampling(histories, arrays["s"], time, above, often)
    joined = late & (arrays["time"] <= scene.lower_joint_until)
    for key, names in OF_ONE_PLACE.items():
        counts = joined if key == LOWER_ANGLE else late
        known = int(counts.sum()) >= FEWEST
        late_values = [arrays[name][counts] for name in names if name in arrays and known]
        error = sampling_of_one_place(late_values, rounding_of(key, float(arrays["s"][-1])))
        facts["sampling_error"] |= {} if error is None else {key: error}
    if often:
        facts["vibration_frequency"] = frequency(time, principal(parts, most))
        return
    text = (
        "riser.viv: outputs every {interval:.3g} s cannot resolve the {name} of {period:.3g} s, so no "
        "frequency is computed; give an analysis.output.interval of {advised:at_most} s"
    )
    facts["warnings"].append(warning("no_frequency_of_a_vibration", text, values))


def _too_long(scene: Resolved, step: float, fastest: float) -> list[RunWarning]:
    """A warning if a time step (s) is too long for the shortest shedding period (s); else none."""
    if step <= fastest / STEPS:
        return []
    kind, waves = "long_step_of_vortices", ""
    if fastest < shedding_period(scene):
        kind, waves = f"{kind}_in_waves", " in current, waves and motions of the platform"
    text = (
        "riser.viv: the time step is too long: {steps:.3g} steps per shortest shedding period of "
        f"{{period:.3g}} s{waves}; use a time step of {{advised:.2g}} s"
    )
    return [
        warning(kind, text, {"steps": fastest / step, "period": fastest, "advised": fastest / (2 * STEPS)})
    ]


def _shortest_shedding(scene: Resolved, arrays: dict[str, FloatArray]) -> float:
    """Shortest shedding period (s) of a run, which knows how fast its vessel drifted."""
    drift = 0.0
    if scene.vessel:
        top = [np.gradient(arrays[name][:, -1], arrays["time"]) for name in ("x", "y")]
        drift = float(np.hypot(*top).max())
    return shortest_shedding_period(scene, drift)


def _shortest_period(scene: Resolved, shedding: float) -> tuple[float, str]:
    """Shortest period (s) of the motion that counts as vibration, and its name.

    ``shedding``: shortest shedding period (s).
    """
    moved = scene.shortest_period or math.inf
    if moved < shedding:
        return moved, "shortest period of waves and platform"
    return shedding, "shortest shedding period"


def _scatter(parts: list[FloatArray], s: FloatArray) -> float:
    """Relative difference of root mean squares at places between both halves of the evaluated time (1)."""
    half = len(parts[0]) // 2
    first, second = (
        np.sqrt(sum((part[span] ** 2).mean(axis=0) for part in parts))
        for span in (slice(None, half), slice(half, None))
    )
    size = along(0.5 * (first**2 + second**2), s)
    return along((second - first) ** 2, s) / size if size > 0.0 else 0.0
