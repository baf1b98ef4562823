"""Statistics of a vortex-induced vibration, which are reproducible, and their difference between two runs.

If several modes alternate, two runs that differ in the last digit soon differ by as much as the amplitude of
the motion, and only their statistics agree. Errors are therefore errors of statistics.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from riserstudy.records.arrays import FloatArray
from riserstudy.scene.limits import ANGLES
from riserstudy.simulation.sampling_error import standard_error

# shortest block, as a share of the vibration's longest period: shorter blocks resolve the periods
SLOW = 0.5
FEWEST_PERIODS = 8  # smallest number of periods for an error of the frequency
NONE = 1e-9  # motion that may be a rounding error, as a share of the riser's length
UPRIGHT = 1e-9  # angle that may be a rounding error (rad)
MOVED = ("x", "y", "z")
FIELDS = (*MOVED, "effective_tension", "bending_moment")


class Statistics(NamedTuple):
    """Statistics of a run at places of the riser, over the evaluated time."""

    s: FloatArray  # (n,) places (m)
    square: FloatArray  # (n,) mean square of the displacement about its linear trend in time (m2)
    means: FloatArray  # (k, n) mean displacements (m)
    # where the vibration is largest (Hz); None where outputs do not show it
    frequency: float | None
    moment_square: FloatArray | None  # (n,) mean square of the bending moment (N2 m2)
    tension: FloatArray | None  # (n,) mean tension (N)
    tension_square: FloatArray | None  # (n,) mean square of the tension (N2)

    def at(self, places: FloatArray) -> Statistics:
        """The statistics at other places, (k,), m, by cubic interpolation."""
        from scipy.interpolate import CubicSpline

        if len(places) == len(self.s) and np.allclose(places, self.s, rtol=0.0, atol=1e-9 * self.s[-1]):
            return self
        names = ("square", "means", "moment_square", "tension", "tension_square")
        moved = {
            name: CubicSpline(self.s, values, axis=-1)(places)
            for name in names
            if (values := getattr(self, name)) is not None
        }
        return self._replace(s=places, **moved)

    def plain(self) -> dict[str, Any]:
        """The statistics as plain data, which `of_plain` converts back."""
        return {
            name: value.tolist() if isinstance(value, np.ndarray) else value
            for name, value in self._asdict().items()
        }


def of_plain(data: dict[str, Any]) -> Statistics:
    """Statistics from plain data."""
    made: dict[str, Any] = {
        name: np.array(value) if isinstance(value, list) else value for name, value in data.items()
    }
    return Statistics(**made)


def statistics(
    histories: dict[str, FloatArray],
    places: FloatArray,
    time: FloatArray,
    above: float,
    with_frequency: bool,
    most: int | None = None,
) -> Statistics:
    """Statistics of histories.

    Parameters
    ----------
    histories : histories by field, (times, places), over the evaluated time.
    places : places (m).
    time : times of the histories (s).
    above : frequency (Hz) above which motion counts as vibration.
    with_frequency : whether outputs are frequent enough for the frequency.
    most : index of the place whose frequency is computed; None: where the vibration is largest.
    """
    moved = [histories[name] for name in MOVED if name in histories]
    away = [vibration(motion, time, above) for motion in moved]
    square = np.sum([motion**2 for motion in away], axis=0).mean(axis=0)
    moment, pull = histories.get("bending_moment"), histories.get("effective_tension")
    most = int(square.argmax()) if most is None else most
    return Statistics(
        places,
        square,
        np.array([motion.mean(axis=0) for motion in moved]),
        frequency(time, principal(away, most)) if with_frequency else None,
        None if moment is None else (moment**2).mean(axis=0),
        None if pull is None else pull.mean(axis=0),
        None if pull is None else (pull**2).mean(axis=0),
    )


def principal(away: list[FloatArray], most: int) -> FloatArray:
    """The vibration (m), (times,), at a place, along the direction in which it is largest."""
    motion = np.stack([one[:, most] for one in away])
    return np.asarray(np.linalg.eigh(motion @ motion.T)[1][:, -1] @ motion)


def apart(low: Statistics, up: Statistics) -> dict[str, float]:
    """Relative differences of the statistics of two runs at the same places, by quantity.

    Displacement: the largest of three differences: of the root mean square over time and riser; of the means,
    divided by the largest mean anywhere; and of the frequency where the vibration is largest. Moment:
    difference of its root mean square over time and riser. Tension: difference of its mean and root mean
    square at every place.
    """
    out = {
        "displacement": max(
            _of_size(low.s, low.square, up.square),
            _relative([(low.means, up.means)]),
            _in_frequency(low.frequency, up.frequency),
        )
    }
    if low.moment_square is not None and up.moment_square is not None:
        out["moment"] = _of_size(low.s, low.moment_square, up.moment_square)
    if low.tension is not None and up.tension is not None:
        squares = (low.tension_square, up.tension_square)
        rms = [np.sqrt(np.maximum(square, 0.0)) for square in squares if square is not None]
        out["tension"] = _relative([(rms[0], rms[1]), (low.tension, up.tension)])
    return out


def sampling(
    histories: dict[str, FloatArray], places: FloatArray, time: FloatArray, above: float, with_frequency: bool
) -> dict[str, float]:
    """Relative standard errors of the quantities in `apart`; arguments are as in `statistics`.

    Parameters
    ----------
    histories : histories by field, (times, places).
    places, time : (places,), m, and (times,), s.
    above : Hz.
    """
    moved = [histories[name] for name in MOVED if name in histories]
    away = [vibration(motion, time, above) for motion in moved]
    squares = np.sum([motion**2 for motion in away], axis=0)
    least = int(SLOW / above / (time[1] - time[0])) if above > 0.0 else 0
    of_displacement = [_of_rms(squares, places, least), _of_means(moved, least)]
    if with_frequency:
        most = int(squares.mean(axis=0).argmax())
        of_displacement.append(_of_frequency(time, principal(away, most)))
    out = {"displacement": max(of_displacement)}
    if "bending_moment" in histories:
        out["moment"] = _of_rms(histories["bending_moment"] ** 2, places, least)
    if "effective_tension" in histories:
        pull = histories["effective_tension"]
        rms = np.sqrt((pull**2).mean(axis=0))
        square = standard_error(lambda block: (pull[block] ** 2).mean(axis=0), len(pull), least)
        of_rms = 0.5 * square / np.where(rms > 0.0, rms, np.inf)
        scale = float(rms.max())
        largest = float(of_rms.max()) / scale if scale > 0.0 else 0.0
        out["tension"] = max(largest, _of_means([pull], least))
    return out


def rounding_of(name: str, length: float) -> float:
    """Displacement, stroke (m) or angle (rad) that may be a rounding error, for a riser of a length (m)."""
    lengths = {"displacement": NONE * length, "stroke": NONE * length}
    return UPRIGHT if name in ANGLES else lengths.get(name, 0.0)


def sampling_of_one_place(histories: list[FloatArray], zero: float) -> float | None:
    """Standard error of outputs of one place, divided by their largest value; None if all values are zero.

    It is the largest of the errors of means, of scatter about them, and of the largest values. For the
    largest values, the scatter between quarters of the run is taken as the scatter between runs.
    ``histories``: (times,) or (times, cylinders), in the same unit, over the evaluated time. ``zero``: value
    in this unit that counts as zero.
    """
    scale = max((float(np.abs(values).max()) for values in histories), default=0.0)
    if scale <= zero:
        return None
    errors = []
    for values in (column for each in histories for column in each.reshape(len(each), -1).T):
        size = float(values.std())
        away = np.square(values - values.mean())
        errors.append(_of_blocks(values, np.mean))
        errors.append(0.5 * _of_blocks(away, np.mean) / size if size > 0.0 else 0.0)
        quarters = [np.abs(part).max() for part in np.array_split(values, 4)]
        errors.append(float(np.std(quarters, ddof=1)))
    return max(errors) / scale


def _of_blocks(values: FloatArray, statistic: Any) -> float:
    """Standard error of a statistic of values (times,)."""
    return float(standard_error(lambda b: np.array([statistic(values[b])]), len(values)).max())


def vibration(motion: FloatArray, time: FloatArray, above: float) -> FloatArray:
    """A motion (times, places) without its slow part.

    The slow part is the best linear trend in time, plus the slow cosines of the remainder. Cosines do not
    require equal values at both ends, so a drift over the whole time leaves almost no residue.

    Parameters
    ----------
    time : times at equal intervals (s).
    above : frequency (Hz) above which motion counts as vibration; 0: all motion except the trend.
    """
    count = len(motion)
    steps = np.arange(count) - 0.5 * (count - 1)
    away = motion - motion.mean(axis=0)
    away = away - np.multiply.outer(steps, steps @ away / (steps @ steps))
    slow = np.arange(1, int(2.0 * above * count * (time[1] - time[0])) + 1)
    if not len(slow):
        return np.asarray(away)
    cosines = np.cos(np.pi * np.outer(np.arange(count) + 0.5, slow) / count)
    return np.asarray(away - cosines @ (cosines.T @ away) * (2.0 / count))


def along(squares: FloatArray, s: FloatArray) -> float:
    """Root mean square along the riser, from squares at places s (m), (n,) each; in the unit of the root."""
    return float(np.sqrt(np.trapezoid(squares, s) / (s[-1] - s[0]))) if len(s) > 1 else 0.0


def frequency(time: FloatArray, away: FloatArray) -> float:
    """Frequency (Hz) of a vibration (times,), from its crossings of zero; 0 for fewer than three."""
    crossed = _crossings(time, away)
    halves = len(crossed) - 1
    return float(0.5 * halves / (crossed[-1] - crossed[0])) if halves > 1 else 0.0


def _crossings(time: FloatArray, away: FloatArray) -> FloatArray:
    """Times (s) at which a vibration (times,) crosses zero, upwards or downwards."""
    at = np.flatnonzero((away[:-1] < 0.0) != (away[1:] < 0.0))
    return np.asarray(time[at] - away[at] * (time[at + 1] - time[at]) / (away[at + 1] - away[at]))


def _of_rms(squares: FloatArray, s: FloatArray, least: int) -> float:
    """Relative standard error of a root mean square over times and places (m); squares (times, places)."""
    whole = along(squares.mean(axis=0), s) ** 2
    error = standard_error(
        lambda block: np.array([along(squares[block].mean(axis=0), s) ** 2]), len(squares), least
    )
    return float(0.5 * error.max() / whole) if whole > 0.0 else 0.0


def _of_means(each: list[FloatArray], least: int) -> float:
    """Largest standard error of means at places, divided by the largest mean; histories (times, places)."""
    scale = max(float(np.abs(one.mean(axis=0)).max()) for one in each)
    stacked = np.concatenate(each, axis=1)
    error = standard_error(lambda block: stacked[block].mean(axis=0), len(stacked), least)
    return float(error.max()) / scale if scale > 0.0 else 0.0


def _of_frequency(time: FloatArray, motion: FloatArray) -> float:
    """Relative standard error of a vibration's frequency (times,), from quarters of its half periods."""
    halves = np.diff(_crossings(time, motion))
    if len(halves) < 2 * FEWEST_PERIODS:
        return 0.0
    quarters = [part.mean() for part in np.array_split(halves, 4)]
    return float(np.std(quarters, ddof=1) / 2.0 / halves.mean())


def _of_size(places: FloatArray, low: FloatArray, up: FloatArray) -> float:
    """Relative difference of the root mean squares along the riser, from mean squares at places (m)."""
    coarse, fine = (along(squares, places) for squares in (low, up))
    return abs(coarse - fine) / fine if fine > 0.0 else 0.0


def _relative(pairs: list[tuple[FloatArray, FloatArray]]) -> float:
    """The largest difference divided by the largest value."""
    scale = max(float(np.abs(up).max()) for _, up in pairs)
    off = max(float(np.abs(up - low).max()) for low, up in pairs)
    return off / scale if scale > 0.0 else 0.0


def _in_frequency(low: float | None, up: float | None) -> float:
    """Relative difference of frequencies (Hz), if both are known."""
    return abs(low - up) / up if low is not None and up else 0.0
