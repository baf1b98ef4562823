"""Coverage of bands for later years, over random records: `python workflow/scripts/band_coverage.py`.

There are two kinds of records: yearly shares with a known exponent of persistence, and years of hourly sea
states of the synthetic record. Each record is split into known years and the years that follow. The script
prints a table of how often the mean of the later years is within the band.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from riserstudy.seas import year_bands
from riserstudy.seas.synthetic import synthetic
from riserstudy.seas.year_bands import Band, band_of_next
from riserstudy.seas.years import Year, by_year
from riserstudy.study.persistence import PERSISTENCE

Bands = Callable[[list[Year], int], Band]
HOURS = 8766
KNOWN, AHEAD = (3, 5, 10, 20), (3, 5, 10)
EXPONENTS = (0.5, 0.66, 0.9)
TRIALS, RECORDS = 400, 8
MEAN, DEVIATION = 0.85, 0.03  # of yearly shares, approximate
LIMITS = (1.5, 2.5, 4.0)  # m, of the significant height


def main() -> None:
    """Print a table."""
    year_bands.DRAWS = 2000
    print("| years | known | next | Student, persistence 0.5 | Student, 0.66 | drawn with replacement |")
    print("|---|---|---|---|---|---|")
    methods: tuple[Bands, ...] = (at_exponent(0.5), at_exponent(PERSISTENCE), with_replacement)
    kinds: list[tuple[str, Callable[[int], Iterator[list[Year]]]]] = [
        (f"drawn, persistence {exponent:g}", partial(noise, exponent)) for exponent in EXPONENTS
    ]
    hourly = [years_of_seas(seed) for seed in range(RECORDS)]
    kinds.append(("hourly sea states", partial(cut, hourly)))
    for name, records in kinds:
        for known in KNOWN:
            for ahead in AHEAD:
                cells = coverage(list(records(known + ahead)), known, methods)
                print(f"| {name} | {known} | {ahead} | " + " | ".join(f"{c:.1%}" for c in cells) + " |")


def coverage(records: list[list[Year]], known: int, methods: tuple[Bands, ...]) -> list[float]:
    """Share of records, by method, in which the mean of later years is within the band of the first years."""
    held = np.zeros(len(methods))
    for years in records:
        observed = np.mean([year.share for year in years[known:]])
        bands = [of(years[:known], len(years) - known) for of in methods]
        held += [band.low <= observed <= band.high for band in bands]
    return [float(count / len(records)) for count in held]


def at_exponent(persistence: float) -> Bands:
    """Return a function that computes bands of later years with an exponent of persistence."""
    return lambda years, count: band_of_next(years, count, persistence)


def with_replacement(years: list[Year], count: int) -> Band:
    """Bands by the former method: known years are resampled, and later years are drawn from each sample."""
    draw = np.random.default_rng(0)
    shares = np.array([year.share for year in years])
    chosen = draw.integers(len(years), size=(2000, len(years)))
    places = draw.integers(len(years), size=(2000, count))
    means = shares[np.take_along_axis(chosen, places, axis=1)].mean(axis=1)
    return Band(float(shares.mean()), *(float(q) for q in np.quantile(means, (0.05, 0.95))))


def noise(exponent: float, length: int, trials: int = TRIALS, seed: int = 0) -> Iterator[list[Year]]:
    """Yield records of years whose shares persist: increments of fractional Brownian motion."""
    draw = np.random.default_rng(seed)
    at = np.arange(length + 1.0)
    power = 2.0 * exponent
    motion = at[:, None] ** power + at**power - np.abs(at[:, None] - at) ** power
    increments = np.diff(np.diff(motion, axis=0), axis=1) / 2.0
    values = draw.standard_normal((trials, length)) @ np.linalg.cholesky(increments).T
    slope = np.sqrt(MEAN * (1.0 - MEAN))  # d share / d arcsine of its root, halved
    shares = np.sin(np.arcsin(np.sqrt(MEAN)) + values * DEVIATION / (2.0 * slope)) ** 2
    for row in shares:
        yield [Year(2001 + k, HOURS, s * HOURS, 1.0) for k, s in enumerate(row)]


def years_of_seas(seed: int, count: int = 100) -> list[list[Year]]:
    """Years of an hourly synthetic record, one list for each limit of the significant height."""
    record = synthetic(count, seed)
    height, time = record["significant_wave_height"].values, record["time"].values
    return [by_year(time, height <= limit, 1.0) for limit in LIMITS]


def cut(hourly: list[list[list[Year]]], length: int) -> Iterator[list[Year]]:
    """Yield consecutive periods of ``length`` years, without overlap, of all records and limits."""
    for limits in hourly:
        for years in limits:
            for first in range(0, len(years) - length + 1, length):
                yield years[first : first + length]


if __name__ == "__main__":
    main()
