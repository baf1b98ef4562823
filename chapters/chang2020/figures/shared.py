"""Common parts of the figures of this chapter: labels, models, and colours."""

from __future__ import annotations

MODELS = {"gas law": "-", "linear": "--"}
#: names of the models in figures
NAMES = {"gas law": "gas law", "linear": "least-squares line"}
AMPLITUDE, TIME = "heave amplitude of the platform (m)", "time (s)"
AWAY = "displacement from equilibrium (m)"
#: names of the states of motion in figures
STATES = {"steady": "steady state", "from_rest": "transient from rest", "quasi_static": "quasi-static"}

GAS_LAW, FITTED = "#0072b2", "#d55e00"
#: colours of the gas law and of the lines that replace it; keys: config/studies/chang2020.yaml, readings
OF_MODEL = {
    "gas law": GAS_LAW,
    "linear": FITTED,
    "least squares over -8 to 8 m": FITTED,
    "chord from -8 to 8 m": "#882255",
    "tangent at X = 0": "#999933",
    "tangent at rest": "#ee3377",
}
#: colours of the states of motion with the gas law, in comparisons
OF_STATE = {"steady": "#009e73", "from_rest": "#e69f00", "quasi_static": "#cc79a7"}
#: colours of the initial states; the unstretched state is the start of all runs from rest
OF_START = {"unstretched": OF_STATE["from_rest"], "equilibrium": "#332288"}
#: colours of the positions of the riser's mass; in all other figures the mass is at the ring
OF_MASS = {"at the ring": GAS_LAW, "along the riser": "#661100"}


#: names, in figures, of the lines that replace the gas law
LINES = {
    "least squares over -8 to 8 m": "least-squares line, −8 to 8 m",
    "chord from -8 to 8 m": "chord, −8 to 8 m",
    "tangent at X = 0": "tangent at $X = 0$",
    "tangent at rest": "tangent at equilibrium",
}


def of_amplitude(amplitude: float) -> str:
    """Return the words for the platform's heave amplitude (m) in the title of a panel."""
    return f"heave amplitude {amplitude:g} m"
