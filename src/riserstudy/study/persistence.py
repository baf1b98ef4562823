"""Persistence of workable hours from year to year, which bands for future years assume."""

from __future__ import annotations

#: assumed Hurst exponent of the yearly shares: the middle of the range 0.58 to 0.74 that Bakker and van den
#: Hurk (2012, Climate Dynamics 39) found for annual winds over the North Sea and around it
PERSISTENCE = 0.66
#: range of allowed exponents; the smallest is for independent years
LEAST_PERSISTENCE, MOST_PERSISTENCE = 0.5, 0.95
#: exponents whose effect is printed: independent years, and the largest published exponent
PERSISTENCES = (LEAST_PERSISTENCE, 0.74)
#: largest number of future years of a band
MOST_AHEAD = 100
