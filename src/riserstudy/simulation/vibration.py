"""How a riser vibrates once its vibration is built up: size and frequency, which are all that runs share.

Where several modes take turns in a vortex-induced vibration, two runs that differ in the last digit soon
differ by as much as they move, and only their statistics agree. So a requested accuracy is of these.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import SimulationError
from riserstudy.model.vortex_lift import ramp_of, shedding, shedding_period
from riserstudy.scene.models import Scene

if TYPE_CHECKING:
    from riserstudy.records.facts import RunFacts

Array = NDArray[np.float64]
LATER = 0.5  # of the time after all ramps, over which statistics are taken
FEWEST = 16  # outputs from which statistics are made
STEPS, OUTPUTS = 20, 4  # a period of the vortices, at least


def since(scene: Scene) -> float | None:
    """Time from which on a run's vibration is judged (s); None where none is called for.

    Raises
    ------
    SimulationError
        When a run is over before its ramps are.
    """
    duration = scene.analysis.duration
    if duration is None or not shedding(scene):
        return None
    built_up = max(ramp_of(scene), scene.built_up)
    start = built_up + (1.0 - LATER) * (duration - built_up)
    if duration <= built_up:
        raise SimulationError(
            f"riser.viv: ramps end at {built_up:.4g} s, and analysis.duration of {duration:.4g} s is over by "
            "then. Run longer, or give riser.viv.ramp"
        )
    return start


def enter(scene: Scene, step: float, arrays: dict[str, Array], facts: RunFacts) -> None:
    """Enter a run's vibration into its facts: since when, root mean square, where it is largest, frequency.

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
    if int(late.sum()) < FEWEST:
        facts["warnings"].append(
            f"riser.viv: fewer than {FEWEST} outputs after {start:.4g} s: the vibration is not judged. Run "
            "longer, or with a shorter analysis.output.interval"
        )
        return
    parts = [arrays[name][late] for name in ("x", "y")]
    rms = np.sqrt(sum(map(_vibration, parts)))
    most = int(rms.argmax())
    facts["vibration_since"] = start
    facts["vibration_rms"] = _along(rms**2, arrays["s"])
    facts["vibration_rms_max"] = float(rms[most])
    facts["vibration_rms_max_s"] = float(arrays["s"][most])
    facts["vibration_scatter"] = _scatter(parts, arrays["s"])
    if interval > period / OUTPUTS:
        facts["warnings"].append(
            f"riser.viv: outputs {interval:.3g} s apart show no frequency of vortices with periods down to "
            f"{period:.3g} s: take analysis.output.interval of {period / OUTPUTS:.2g} s"
        )
        return
    motion = max(parts, key=lambda part: float(_vibration(part[:, [most]])[0]))[:, most]
    facts["vibration_frequency"] = frequency(arrays["time"][late], motion)


def _vibration(motion: Array) -> Array:
    """Mean squares of a motion (times, places) about a straight line in time, on which it may still drift."""
    return np.asarray(_about_a_line(motion).var(axis=0))


def _about_a_line(motion: Array) -> Array:
    """A motion (times, places) less the straight line in time that fits it best."""
    time = np.arange(len(motion)) - 0.5 * (len(motion) - 1)
    away = motion - motion.mean(axis=0)
    return np.asarray(away - np.multiply.outer(time, time @ away / (time @ time)))


def _along(squares: Array, s: Array) -> float:
    """Root mean square along the riser of squares at places."""
    return float(np.sqrt(np.trapezoid(squares, s) / (s[-1] - s[0]))) if len(s) > 1 else 0.0


def _scatter(parts: list[Array], s: Array) -> float:
    """By how much root mean squares at places differ between the halves of a time, over their size (1)."""
    half = len(parts[0]) // 2
    first, second = (
        np.sqrt(sum(_vibration(part[span]) for part in parts))
        for span in (slice(None, half), slice(half, None))
    )
    size = _along(0.5 * (first**2 + second**2), s)
    return _along((second - first) ** 2, s) / size if size > 0.0 else 0.0


def frequency(time: Array, motion: Array) -> float:
    """Frequency (Hz) of a motion (times,) by upward crossings of its mean line; 0 for fewer than two."""
    away = _about_a_line(motion)
    up = np.flatnonzero((away[:-1] < 0.0) & (away[1:] >= 0.0))
    if len(up) < 2:
        return 0.0
    crossed = time[up] - away[up] * (time[up + 1] - time[up]) / (away[up + 1] - away[up])
    return float((len(crossed) - 1) / (crossed[-1] - crossed[0]))


def apart(
    pairs: dict[str, tuple[Array, Array]],
    places: Array,
    times: tuple[Array, Array],
    facts: RunFacts,
) -> dict[str, float]:
    """Relative differences of the statistics of two runs of a vibration, by quantity.

    Displacement: the largest of those of the root mean square over time and riser, of means, over the
    largest mean anywhere, and of the frequency where the vibration is largest. Moment: of its root mean
    square over time and riser. Tension: of its mean and root mean square at every place.

    Parameters
    ----------
    pairs : histories of both runs, (times, places), by field.
    places : of both (m).
    times : of both runs (s).
    facts : of the finer run.
    """
    low_late, up_late = (time >= facts["vibration_since"] for time in times)
    late = {name: (low[low_late], up[up_late]) for name, (low, up) in pairs.items()}
    out = {}
    moved = [late[name] for name in ("x", "y", "z") if name in late]
    if moved:
        out["displacement"] = max(
            _of_size(
                places,
                np.sum([_vibration(low) for low, _ in moved], axis=0),
                np.sum([_vibration(up) for _, up in moved], axis=0),
            ),
            _relative([(low.mean(axis=0), up.mean(axis=0)) for low, up in moved]),
            _in_frequency(moved, times[0][low_late], times[1][up_late])
            if "vibration_frequency" in facts
            else 0.0,
        )
    if "bending_moment" in late:
        out["moment"] = _of_size(places, *((run**2).mean(axis=0) for run in late["bending_moment"]))
    if "effective_tension" in late:
        low, up = late["effective_tension"]
        rms = [np.sqrt((run**2).mean(axis=0)) for run in (low, up)]
        out["tension"] = _relative([(rms[0], rms[1]), (low.mean(axis=0), up.mean(axis=0))])
    return out


def _of_size(places: Array, low: Array, up: Array) -> float:
    """Relative difference of the root mean squares along the riser, of mean squares at places (m)."""
    coarse, fine = (_along(squares, places) for squares in (low, up))
    return abs(coarse - fine) / fine if fine > 0.0 else 0.0


def _relative(pairs: list[tuple[Array, Array]]) -> float:
    """The largest difference over the largest value."""
    scale = max(float(np.abs(up).max()) for _, up in pairs)
    off = max(float(np.abs(up - low).max()) for low, up in pairs)
    return off / scale if scale > 0.0 else 0.0


def _in_frequency(moved: list[tuple[Array, Array]], low_time: Array, up_time: Array) -> float:
    """Relative difference of the frequencies where the finer run vibrates most."""
    low, up = max(moved, key=lambda pair: float(_vibration(pair[1]).max()))
    most = int(_vibration(up).argmax())
    ours, other = frequency(up_time, up[:, most]), frequency(low_time, low[:, most])
    return abs(other - ours) / ours if ours > 0.0 else 0.0
