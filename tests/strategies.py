"""What property tests draw from."""

import math

from hypothesis import strategies as st

numbers = st.floats(-1e6, 1e6, allow_nan=False).filter(lambda x: x == 0.0 or abs(x) > 1e-6)

#: unit as a paper writes it, the SI unit of its kind, and how much of that it is
UNITS = [
    ("in", "m", 0.0254),
    ("ft", "m", 0.3048),
    ("km", "m", 1e3),
    ("lbf", "N", 4.4482216152605),
    ("kip", "N", 4448.2216152605),
    ("tf", "N", 9806.65),
    ("kN/m", "N/m", 1e3),
    ("ksi", "N/m^2", 6894757.293168361),
    ("deg", "rad", math.pi / 180.0),
    ("kN*m/deg", "N*m/rad", 1e3 * 180.0 / math.pi),
    ("knot", "m/s", 1852.0 / 3600.0),
    ("min", "s", 60.0),
]

#: area (m2), absolute pressure (Pa), volume (m3), exponent of one gas chamber
gases = st.fixed_dictionaries(
    {
        "area": st.floats(0.02, 0.5),
        "pressure": st.floats(1e6, 3e7),
        "volume": st.floats(1.0, 10.0),
        "exponent": st.floats(1.0001, 1.6667),
    }
)
#: share of the reach at which the gas volume closes
shares = st.floats(-0.9, 0.9)
#: shifts of a whole scene, horizontal and up (m)
shifts = st.tuples(st.floats(-200.0, 200.0), st.floats(-2000.0, 2000.0))
