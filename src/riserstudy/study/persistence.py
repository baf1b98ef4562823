"""How years of workable hours persist, which bands of years to come take for known."""

from __future__ import annotations

#: Hurst exponent of the shares of years, assumed: the middle of 0.58 to 0.74, which Bakker and van den Hurk
#: (2012, Climate Dynamics 39) found of annual winds over the North Sea and around it
PERSISTENCE = 0.66
#: exponents that are allowed: from years that do not depend on one another
LEAST_PERSISTENCE, MOST_PERSISTENCE = 0.5, 0.95
#: exponents whose effect is printed: years that do not persist, and the largest of those found
PERSISTENCES = (LEAST_PERSISTENCE, 0.74)
#: years to come that a band may be of
MOST_AHEAD = 100
