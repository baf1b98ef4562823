"""Responses between simulated sea states, by cubic interpolation over triangles, without extrapolation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import FloatArray

# share of the distance to the middle by which points are moved, so that no border point is outside by
# rounding
INWARDS = 1e-9


class Surface:
    """Responses over height and period, with continuous slopes.

    A response of NaN belongs to a sea state whose run failed; the response is not known in the adjacent
    triangles.

    Parameters
    ----------
    states : (n, 2) simulated sea states: significant height (m), peak period (s); not all on one line.
    responses : (n, k) responses at these, each in its unit.

    References
    ----------
    Alfeld, 1984, Computer Aided Geometric Design 1; Renka and Cline, 1984, Rocky Mountain J. Math. 14.
    """

    def __init__(self, states: FloatArray, responses: FloatArray) -> None:
        from scipy.interpolate import CloughTocher2DInterpolator, LinearNDInterpolator
        from scipy.spatial import Delaunay

        self._least = states.min(axis=0)
        self._range = np.ptp(states, axis=0)
        places = self._scaled(states)
        self._middle = places.mean(axis=0)
        self.triangles = Delaunay(places)
        self._straight = LinearNDInterpolator(self.triangles, responses)
        known = np.isfinite(responses).all(axis=1)
        self._cubic = CloughTocher2DInterpolator(places[known], responses[known])

    def at(self, states: FloatArray) -> FloatArray:
        """Responses (m, k) at sea states (m, 2); NaN outside, or next to a run that failed."""
        places = self._inwards(states)
        found = np.asarray(self._cubic(places))
        found[np.isnan(self._straight(places))] = np.nan
        return found

    def bend(self, states: FloatArray) -> FloatArray:
        """Difference of responses from linear interpolation over the triangles, (m, k)."""
        places = self._inwards(states)
        off: FloatArray = np.abs(self._cubic(places) - self._straight(places))
        return off

    def triangle(self, states: FloatArray) -> NDArray[np.int64]:
        """Index of the triangle that contains each sea state (m, 2), (m,); -1 outside."""
        return np.asarray(self.triangles.find_simplex(self._inwards(states)), np.int64)

    def _scaled(self, states: FloatArray) -> FloatArray:
        scaled: FloatArray = (states - self._least) / self._range
        return scaled

    def _inwards(self, states: FloatArray) -> FloatArray:
        places = self._scaled(states)
        moved: FloatArray = places + INWARDS * (self._middle - places)
        return moved
