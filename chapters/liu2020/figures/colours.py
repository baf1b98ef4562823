"""Colours and names in all figures of this chapter: one colour and one name for each thing."""

from __future__ import annotations

VERTICAL, CARRIED = "vertical force at the ring", "232 t carried to the upper flex joint"
ON_PLATFORM = "riser's top on the platform"
#: colours of the models of the riser's top; config/studies/liu2020.yaml, readings
OF_TOP = {
    "gas law": "#0072b2",
    "linear": "#d55e00",
    "constant": "#e69f00",
    VERTICAL: "#009e73",
    CARRIED: "#000000",
    ON_PLATFORM: "#cc79a7",
    "vertical cylinders": "#882255",
}
ON_TENSIONERS, LINEAR, VERTICAL_CYLINDERS = (
    OF_TOP[top] for top in ("gas law", "linear", "vertical cylinders")
)
#: names of the interpretations of a riser without tensioners
WITHOUT = {
    "constant": "constant tension along the cylinders",
    VERTICAL: VERTICAL,
    CARRIED: CARRIED,
    ON_PLATFORM: ON_PLATFORM,
}
#: names of all models of the top
NAMES = {"gas law": "tensioners", **WITHOUT}
LINEARISED = "linearised gas law"
#: motions of the platform, and waves that act on the riser as well
OF_MOTION = {"surge": "#332288", "heave": "#999933", "pitch": "#56b4e9"}
WITH_WAVES = "#aa4499"
#: current profiles; the calibrated currents have shapes from this list
OF_PROFILE = {
    "linear": "#456882",
    "exponential 50 m": "#5c2e0b",
    "exponential 100 m": "#a8622a",
    "exponential 200 m": "#dfa974",
}
ALL, ONE = "8765 N by all cylinders", "8765 N by one cylinder"
OF_CALIBRATION = {ALL: OF_PROFILE["exponential 50 m"], ONE: OF_PROFILE["exponential 200 m"]}
