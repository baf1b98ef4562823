"""The three answers about the engine, from its measured datasets: cost, stability, effects."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from chapters.numerics.outcome import Outcome

if TYPE_CHECKING:
    import xarray as xr

CHANGES = ("displacement_change", "moment_change", "tension_change")
QUANTITIES = ("displacement", "moment", "tension")
TOLERANCE = 0.01  # relative change of an answer, or error, that matters
OWN = "the paper's own"  # candidate of the long runs with the setting of their paper
COMPARED = 0.002  # relative error at which codes are compared
STEP_FOUND = 0.6  # error (%) of measured stable steps, which are found by bisection
SURE = 1.96  # standard deviations of a 95 % interval
#: motions that a scene prescribes for the platform
MOTIONS = frozenset({"surge", "sway", "heave", "roll", "pitch", "yaw", "cruise"})
#: effects that a scene prescribes; all other effects are physics of riser, water and tensioners
PRESCRIBED = MOTIONS | {"platform response", "wave", "current"}
#: effect that is added to scenes instead of removed: the engine decides whether a scene has it
DECIDED = "motion out of the plane"


class Price(NamedTuple):
    """Ratios of run times between two tolerances."""

    coarse: float
    fine: float
    low: float  # smallest ratio of times among the scenes
    high: float  # largest ratio

    @property
    def words(self) -> str:
        """The ratio of times, to two digits: "4 to 9"."""
        low, high = f"{self.low:.2g}", f"{self.high:.2g}"
        return low if low == high else f"{low} to {high}"


class Others(NamedTuple):
    """Run times of other codes divided by riserstudy's, for one scene at one error."""

    error: float
    codes: int
    low: float
    high: float


class Hard(NamedTuple):
    """Numbers of hard cases: as expected, all, compared with a reference, and silently inaccurate."""

    met: int
    cases: int
    compared: int
    silent: int


class Ranked(NamedTuple):
    """One effect: number of scenes in which its absence, or presence, changes an answer by over 1 %."""

    name: str
    prescribed: bool
    added: bool
    scenes: int
    changed: int
    values: tuple[float, ...]  # largest relative change of an answer, one per scene
    share: float  # share of the effect in the run time with it, median over scenes
    middle: tuple[float, float]  # its first and third quartile over scenes

    @property
    def median(self) -> float:
        """Median of the largest changes over the effect's scenes."""
        return float(np.median(self.values))

    @property
    def low(self) -> float:
        """Lower 95 % bound (Wilson) of the share of scenes in which it changes the answer."""
        n, p = self.scenes, self.changed / self.scenes
        spread = SURE * math.sqrt(p * (1.0 - p) / n + SURE**2 / (4.0 * n * n))
        return (p + SURE**2 / (2.0 * n) - spread) / (1.0 + SURE**2 / n)


def price(accuracy: xr.Dataset) -> Price | None:
    """Ratios of run times: finest tolerance that all scenes met, divided by 1 %.

    The coarsest tolerance that all scenes met replaces 1 % where not all met it. None if all scenes
    together met fewer than two tolerances.
    """
    met = accuracy["request_seconds"].notnull().values
    requested, scene = accuracy["requested"].values, accuracy["request_scene"].values
    seconds = accuracy["request_seconds"].values
    scenes = sorted(set(scene[met]))
    every = [set(requested[met & (scene == s)]) for s in scenes]
    shared = sorted(set.intersection(*every)) if every else []
    if len(shared) < 2:
        return None
    fine = shared[0]
    coarse = TOLERANCE if TOLERANCE in shared[1:] else shared[-1]

    def of(name: object, tolerance: float) -> float:
        return float(seconds[(scene == name) & (requested == tolerance)][0])

    ratios = [of(s, fine) / of(s, coarse) for s in scenes]
    return Price(float(coarse), float(fine), min(ratios), max(ratios))


def without_time(accuracy: xr.Dataset) -> list[str]:
    """Scenes of which no run met any of the tolerances within the time limit."""
    scene, seconds = accuracy["request_scene"].values, accuracy["request_seconds"].values
    return [str(s) for s in dict.fromkeys(scene) if not np.isfinite(seconds[scene == s]).any()]


def others(accuracy: xr.Dataset, error: float = COMPARED) -> Others | None:
    """Times of other codes divided by riserstudy's at an error, in the first compared scene, or None."""
    if "peer_scene" not in accuracy or not accuracy["peer_scene"].size:
        return None
    scene = accuracy["peer_scene"].values
    here = (scene == scene[0]) & np.isclose(accuracy["peer_error"].values, error)
    ratios = accuracy["peer_ratio"].values[here]
    if not ratios.size:
        return None
    return Others(error, ratios.size, float(ratios.min()), float(ratios.max()))


def hard(stability: xr.Dataset) -> Hard:
    """Count the hard cases by outcome."""
    met = stability["as_expected"].values.astype(bool)
    outcome = stability["written_outcome"].values.astype(str)
    inaccurate = outcome == Outcome.INACCURATE
    compared = inaccurate | (outcome == Outcome.ACCURATE)
    return Hard(int(met.sum()), met.size, int(compared.sum()), int((inaccurate & ~met).sum()))


def ranking(effects: xr.Dataset) -> list[Ranked]:
    """Effects by the lower 95 % bound of the share of scenes whose answer they change, largest first.

    It contains the effects that were removed, and motion out of the plane, which was added.
    """
    sizes = np.stack([abs(effects[name]).transpose("scene", "change").values for name in CHANGES])
    known = np.isfinite(sizes)
    largest = np.where(known, sizes, -np.inf).max(axis=0)
    times = effects["time_change"].transpose("scene", "change").values
    ranked = []
    of_changes = zip(effects["changed_effect"].values.tolist(), effects["is_added"].values, strict=True)
    for k, (name, added) in enumerate(of_changes):
        values = largest[np.isfinite(largest[:, k]), k]
        if (added and name != DECIDED) or not values.size:
            continue
        time = times[np.isfinite(times[:, k]), k]
        share = time / (1.0 + time) if added else -time
        changed = int((values > TOLERANCE).sum())
        shown = f"platform {name}" if name in MOTIONS else name
        ranked.append(
            Ranked(
                shown, name in PRESCRIBED, bool(added), values.size, changed, tuple(map(float, values)),
                *_quartiles(share),
            )
        )  # fmt: skip
    return sorted(ranked, key=lambda one: (-one.low, -one.median))


def _quartiles(share: np.ndarray) -> tuple[float, tuple[float, float]]:
    """Median, and the first and third quartile; NaN without any value."""
    first, median, third = np.quantile(share, (0.25, 0.5, 0.75)) if share.size else (math.nan,) * 3
    return float(median), (float(first), float(third))


def never(ranked: list[Ranked]) -> list[Ranked]:
    """Effects that changed no answer, sorted by number of scenes, largest first."""
    return sorted((one for one in ranked if not one.changed), key=lambda one: -one.scenes)
