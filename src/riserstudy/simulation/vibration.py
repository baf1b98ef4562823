"""How a riser vibrates once its vibration is built up: size and frequency, which are all that runs share.

Where several modes take turns in a vortex-induced vibration, two runs that differ in the last digit soon
differ by as much as they move, and only their statistics agree. So a requested accuracy is of these.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.model.vortex_lift import ramp_of, shedding_period
from riserstudy.scene.models import Scene

Array = NDArray[np.float64]
SINCE, FREQUENCY = "vibration_since", "vibration_frequency"  # among the facts of a run
LATER = 0.5  # of the time after all ramps, over which statistics are taken
STEPS, OUTPUTS = 20, 4  # a period of the vortices, at least


def since(scene: Scene) -> float | None:
    """Time from which on a run's vibration is judged (s); None where none is called for."""
    duration = scene.analysis.duration
    if duration is None or not any(section.viv for section in scene.riser):
        return None
    built_up = max(ramp_of(scene), scene.built_up)
    return built_up + (1.0 - LATER) * max(duration - built_up, 0.0)


def enter(scene: Scene, step: float, arrays: dict[str, Array], facts: dict[str, Any]) -> None:
    """Enter a run's vibration into its facts: since when, largest root mean square, where, frequency.

    Steps (s) or outputs too long for its vortices are warned of; of the latter no frequency is taken.
    ``arrays``: histories (times, s), m.
    """
    start = since(scene)
    if start is None or "y" not in arrays:
        return
    period, interval = shedding_period(scene), float(np.diff(arrays["time"][:2])[0])
    if step > period / STEPS:
        facts["warnings"].append(
            f"riser.viv: {period / step:.3g} steps a period of the fastest vortices, {period:.3g} s: take a "
            f"step of {period / (2 * STEPS):.2g} s"
        )
    late = arrays["time"] >= start
    parts = [arrays[name][late] for name in ("x", "y")]
    rms = np.sqrt(sum(part.var(axis=0) for part in parts))
    most = int(rms.argmax())
    facts[SINCE] = start
    facts["vibration_rms"], facts["vibration_rms_s"] = float(rms[most]), float(arrays["s"][most])
    if interval > period / OUTPUTS:
        facts["warnings"].append(
            f"riser.viv: outputs {interval:.3g} s apart show no frequency of vortices with periods down to "
            f"{period:.3g} s: take analysis.output.interval of {period / OUTPUTS:.2g} s"
        )
        return
    motion = max(parts, key=lambda part: float(part[:, most].var()))[:, most]
    facts[FREQUENCY] = frequency(arrays["time"][late], motion)


def frequency(time: Array, motion: Array) -> float:
    """Frequency (Hz) of a motion (times,) by its upward crossings of its mean; 0 with fewer than two."""
    away = motion - motion.mean()
    up = np.flatnonzero((away[:-1] < 0.0) & (away[1:] >= 0.0))
    if len(up) < 2:
        return 0.0
    crossed = time[up] - away[up] * (time[up + 1] - time[up]) / (away[up + 1] - away[up])
    return float((len(crossed) - 1) / (crossed[-1] - crossed[0]))


def apart(
    pairs: dict[str, tuple[Array, Array]], times: tuple[Array, Array], facts: dict[str, Any]
) -> dict[str, float]:
    """Relative differences of the statistics of two runs of a vibration, by quantity.

    Displacement: the largest of those of root mean square and of mean, each of its largest anywhere, and of
    frequency where the vibration is largest. Tension and moment: of mean and root mean square.

    Parameters
    ----------
    pairs : histories of both runs, (times, places), by field.
    times : of both runs (s).
    facts : of the finer run.
    """
    low_late, up_late = (time >= facts[SINCE] for time in times)
    late = {name: (low[low_late], up[up_late]) for name, (low, up) in pairs.items()}
    out = {}
    places = [late[name] for name in ("x", "y", "z") if name in late]
    if places:
        out["displacement"] = max(
            _relative([(low.std(axis=0), up.std(axis=0)) for low, up in places]),
            _relative([(low.mean(axis=0), up.mean(axis=0)) for low, up in places]),
            _in_frequency(places, times[0][low_late], times[1][up_late])
            if FREQUENCY in facts
            else 0.0,
        )
    for name, field in (("tension", "effective_tension"), ("moment", "bending_moment")):
        if field in late:
            low, up = late[field]
            rms = [np.sqrt((values**2).mean(axis=0)) for values in (low, up)]
            means = low.mean(axis=0), up.mean(axis=0)
            out[name] = _relative([(rms[0], rms[1]), means])
    return out


def _relative(pairs: list[tuple[Array, Array]]) -> float:
    """The largest difference over the largest value."""
    scale = max(float(np.abs(up).max()) for _, up in pairs)
    off = max(float(np.abs(up - low).max()) for low, up in pairs)
    return off / scale if scale > 0.0 else 0.0


def _in_frequency(places: list[tuple[Array, Array]], low_time: Array, up_time: Array) -> float:
    """Relative difference of the frequencies where the finer run vibrates most."""
    low, up = max(places, key=lambda pair: float(pair[1].std(axis=0).max()))
    most = int(up.std(axis=0).argmax())
    ours, other = frequency(up_time, up[:, most]), frequency(low_time, low[:, most])
    return abs(other - ours) / ours if ours > 0.0 else 0.0
