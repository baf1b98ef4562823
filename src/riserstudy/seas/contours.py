"""Environmental contours of height and peak period by the library virocon, with a band of whole years.

virocon is an optional extra: ``pip install 'riserstudy[contours]'``.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.table import Cell, Table
from riserstudy.errors import InputError
from riserstudy.seas.return_values import whole_years
from riserstudy.seas.year_bands import BAND

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]
PLACES = 24  # number of points on a contour
DRAWS = 20  # number of samples of the whole years, drawn with replacement
COLUMNS = [
    *("return period", "significant wave height", "height from", "height to"),
    *("peak period", "period from", "period to"),
]
UNITS = ["years", "m", "m", "m", "s", "s", "s"]


def contour(record: xr.Dataset, years: float, seed: int = 0) -> Table:
    """A contour with a return period in years, one row for each of its points, with a band.

    Calm rows, without waves, count as time, but not as sea states. The method is the inverse first-order
    reliability method, with a three-parameter Weibull distribution of heights and a log-normal distribution
    of periods for a given height. The band contains nine in ten contours from years drawn with replacement,
    separately for each point of the circle of normal variables. Raises InputError when virocon is absent, the
    record has no peak periods, or fewer than five years are nearly whole.

    Parameters
    ----------
    record : record with significant wave heights (m) and peak periods (s).
    years : return period (years).

    References
    ----------
    Winterstein et al. 1993, ICOSSAR; DNV-RP-C205, 3.6.3 and 3.7.2.
    """
    _import()
    if "peak_period" not in record:
        raise InputError("RECORD", "peak_period", "not in the record", "see riserstudy seas --gamma")
    states = np.column_stack([record[name].values for name in ("significant_wave_height", "peak_period")])
    calm = states[:, 0] == 0.0
    known = np.isfinite(states).all(axis=1) & ~calm
    interval = float(record.attrs["interval_hours"])
    whole = whole_years(record["time"].values, known | calm, interval)
    found = _contour(states[known], interval_of(known, calm, interval), years)
    draw = np.random.default_rng(seed)
    drawn = []
    for _ in range(DRAWS):
        chosen = draw.integers(len(whole), size=len(whole))
        rows = np.concatenate([np.flatnonzero(whole[k] & (known | calm)) for k in chosen])
        seas = known[rows]
        apart = interval_of(seas, calm[rows], interval)
        drawn.append(_contour(states[rows[seas]], apart, years))
    low, high = np.quantile(drawn, BAND, axis=0)
    rows_of: list[list[Cell]] = [
        [years, *(float(each[k, side]) for side in (0, 1) for each in (found, low, high))]
        for k in range(PLACES)
    ]
    return Table(COLUMNS, UNITS, rows_of)


def interval_of(known: NDArray[np.bool_], calm: NDArray[np.bool_], interval: float) -> float:
    """Mean time (h) between rows with waves; other rows, also an interval apart, are calm."""
    seas = int(known.sum())
    return interval * (seas + int(calm.sum())) / seas if seas else interval


def _contour(states: FloatArray, interval: float, years: float) -> FloatArray:
    """Points on the contour, (n, 2): height (m), peak period (s)."""
    virocon = _import()
    described, fits, _ = virocon.get_DNVGL_Hs_Tz()
    model = virocon.GlobalHierarchicalModel(described)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about bins with few sea states, which virocon excludes
        model.fit(states, fits)
    alpha = virocon.calculate_alpha(interval, years)
    places: FloatArray = virocon.IFORMContour(model, alpha, n_points=PLACES).coordinates
    # the smallest height of a fit may be below zero, where there is no sea and no period
    low = places[:, 0] < 0.0
    if low.any():
        places[low, 0] = 0.0
        shorter = _shorter(alpha)[low]
        places[low, 1] = model.distributions[1].icdf(shorter, given=places[low, 0])
    return places


def _shorter(alpha: float) -> FloatArray:
    """Probability of a shorter period for the height at each point of a contour, (PLACES,)."""
    from scipy.special import ndtr, ndtri

    angle = 2.0 * np.pi * np.arange(PLACES) / PLACES
    return np.asarray(ndtr(-ndtri(alpha) * np.sin(angle)))


def _import():  # type: ignore[no-untyped-def]
    """The library. Raises InputError when it is absent."""
    try:
        import virocon
    except ImportError:
        allowed = "install it: pip install 'riserstudy[contours]'"
        raise InputError("seas", "--contour", "virocon is not installed", allowed) from None
    return virocon
