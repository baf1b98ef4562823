"""Environmental contours of height and peak period by the library virocon, with a band from whole years.

virocon is an optional extra: ``pip install 'riserstudy[contours]'``.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.table import Cell, Table
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.seas.periods_of_heights import fitted
from riserstudy.seas.record import interval_of_rows
from riserstudy.seas.return_values import whole_years
from riserstudy.seas.year_bands import BAND
from riserstudy.study.spacing import check_spacing

if TYPE_CHECKING:
    import xarray as xr

PLACES = 24  # number of points on a contour
BEYOND = 1.5  # largest ratio of a period of a contour to the longest period of the record
COLUMNS = [
    *("return period", "significant wave height", "height from", "height to"),
    *("peak period", "period from", "period to"),
]
UNITS = ["years", "m", "m", "m", "s", "s", "s"]


def contour(record: xr.Dataset, years: float) -> Table:
    """A contour with a return period in years, one row for each of its points, with a band.

    Calm rows, without waves, count as time, but not as sea states. The method is the inverse first-order
    reliability method, with a three-parameter Weibull distribution of heights and a log-normal
    distribution of periods for a given height. The band is by the jackknife: from contours that each
    leave out one whole year, with Student's distribution, for each point of the circle of normal
    variables. Raises InputError when virocon is absent, the record has no peak periods, fewer than five
    years are nearly whole, rows with both values have another interval in a part of the record, or the
    distributions cannot be fitted.

    Parameters
    ----------
    record : record with significant wave heights (m) and peak periods (s).
    years : return period (years).

    References
    ----------
    Winterstein et al. 1993, ICOSSAR; DNV-RP-C205, 3.6.3 and 3.7.2; Efron and Tibshirani 1993, An Introduction
    to the Bootstrap, chapter 11.
    """
    _import()
    if "peak_period" not in record:
        why = "the record has no peak periods, which a contour requires"
        allowed = "add a column, or convert zero-crossing periods with `riserstudy seas --gamma`"
        raise InputError("RECORD", "peak_period", why, allowed)
    states = np.column_stack([record[name].values for name in ("significant_wave_height", "peak_period")])
    calm = states[:, 0] == 0.0
    known = np.isfinite(states).all(axis=1) & ~calm
    time = record["time"].values
    check_spacing("RECORD", time[known | calm])
    # longer than the interval between heights if only every third row has a period
    interval = interval_of_rows(time[known | calm], float(record.attrs["interval_hours"]))
    whole = whole_years(time, known | calm, interval, "a height and a period")
    found = _contour(states[known], interval_of(known, calm, interval), years)
    without = [
        _contour(states[known & ~year], interval_of(known & ~year, calm & ~year, interval), years)
        for year in whole
    ]
    low, high = _band(found, np.array(without))
    rows_of: list[list[Cell]] = [
        [years, *(float(each[k, side]) for side in (0, 1) for each in (found, low, high))]
        for k in range(PLACES)
    ]
    return Table(COLUMNS, UNITS, rows_of)


def _band(found: FloatArray, without: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Ends of the band of a contour, (n, 2), from those without each year, (years, n, 2), in m and s."""
    from scipy.special import stdtrit

    count = len(without)
    each = np.stack([without[..., 0], np.log(without[..., 1])], axis=-1)  # periods are log-normal
    squares = ((each - each.mean(axis=0)) ** 2).sum(axis=0)
    height, period = (stdtrit(count - 1, BAND[1]) * np.sqrt((count - 1) / count * squares)).T
    low = np.column_stack([np.maximum(found[:, 0] - height, 0.0), found[:, 1] * np.exp(-period)])
    return low, np.column_stack([found[:, 0] + height, found[:, 1] * np.exp(period)])


def doubts(record: xr.Dataset, table: Table) -> list[str]:
    """A note on points of a contour, from `contour`, with periods that are not those of the record; or none.

    The period of a point may exceed the longest period of the record, or be below the shortest, by the factor
    `BEYOND`.
    """
    periods = record["peak_period"].values[record["significant_wave_height"].values > 0.0]
    least, most = np.nanmin(periods), np.nanmax(periods)
    points = np.array([[row[1], row[4]] for row in table.rows], float)
    off = points[(points[:, 1] < least / BEYOND) | (points[:, 1] > most * BEYOND)]
    if not len(off):
        return []
    (low, short), (high, long) = off.min(axis=0), off.max(axis=0)
    return [
        f"{len(off)} of {len(points)} points, with heights of {low:.2g} m to {high:.2g} m, have periods of "
        f"{short:.2g} s to {long:.2g} s, but the record has periods of {least:.2g} s to {most:.2g} s; do not "
        "use these points: the log-normal distribution does not fit the periods, for example because swell "
        "and wind waves have different periods"
    ]


def interval_of(known: NDArray[np.bool_], calm: NDArray[np.bool_], interval: float) -> float:
    """Mean time (h) between rows with waves; other rows, also an interval apart, are calm."""
    seas = int(known.sum())
    return interval * (seas + int(calm.sum())) / seas if seas else interval


def _contour(states: FloatArray, interval: float, years: float) -> FloatArray:
    """Points on the contour, (n, 2): height (m), peak period (s).

    Raises InputError when the distributions cannot be fitted.
    """
    from scipy.special import ndtri

    virocon = _import()
    described, fits, _ = virocon.get_DNVGL_Hs_Tz()
    model = virocon.GlobalHierarchicalModel(described)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about bins with few sea states, which virocon excludes
        try:
            model.fit(states, fits)
        except (RuntimeError, ValueError) as error:
            allowed = "give a record with more sea states at different heights"
            found = f"the distribution of sea states cannot be fitted: {error}"
            raise InputError("RECORD", "--contour", found, allowed) from None
    alpha = virocon.calculate_alpha(interval, years)
    heights: FloatArray = virocon.IFORMContour(model, alpha, n_points=PLACES).coordinates[:, 0]
    # the smallest height of a fit may be below zero, where there is no sea and no period
    heights = np.maximum(heights, 0.0)
    of_bins = model.distributions[1]
    start = [v for name in ("mu", "sigma") for v in of_bins.conditional_parameters[name].parameters.values()]
    bins = np.asarray(of_bins.conditioning_values, float)
    # the exponential function may be very large below the lowest bin or above the highest
    periods = fitted(states, start, np.array([bins.min(), bins.max()]))
    normal = -ndtri(alpha) * np.sin(2.0 * np.pi * np.arange(PLACES) / PLACES)
    return np.column_stack([heights, periods.at(heights, normal)])


def _import():  # type: ignore[no-untyped-def]
    """The library. Raises InputError when it is absent."""
    try:
        import virocon
    except ImportError:
        allowed = "install it with pip install 'riserstudy[contours]'"
        found = "a contour requires the library virocon, which is not installed"
        raise InputError("seas", "--contour", found, allowed) from None
    return virocon
