"""What figures of this chapter have in common: labels, models, and what colours mean."""

from __future__ import annotations

MODELS = {"gas law": "-", "linear": "--"}
#: of these, as figures name them
NAMES = {"gas law": "gas law", "linear": "least-squares line"}
AMPLITUDE, TIME = "heave amplitude of the platform (m)", "time (s)"
AWAY = "displacement from equilibrium (m)"
#: states of motion, as figures name them
STATES = {
    "steady": "steady state",
    "from_rest": "transient from rest",
    "quasi_static": "quasi-static",
}

GAS_LAW, FITTED = "#0072b2", "#d55e00"
#: the gas law and lines in its place; config/studies/chang2020.yaml, readings
OF_MODEL = {
    "gas law": GAS_LAW,
    "linear": FITTED,
    "least squares over -8 to 8 m": FITTED,
    "chord from -8 to 8 m": "#882255",
    "tangent at X = 0": "#999933",
    "tangent at rest": "#ee3377",
}
#: states of motion on the gas law, where they are compared
OF_STATE = {"steady": "#009e73", "from_rest": "#e69f00", "quasi_static": "#cc79a7"}
#: how a riser starts; the unstretched one is that of all runs from rest
OF_START = {"unstretched": OF_STATE["from_rest"], "equilibrium": "#332288"}
#: at the ring it is in all other figures
OF_MASS = {"at the ring": GAS_LAW, "along the riser": "#661100"}


#: lines in place of the gas law, as figures name them
LINES = {
    "least squares over -8 to 8 m": "least-squares line, −8 to 8 m",
    "chord from -8 to 8 m": "chord, −8 to 8 m",
    "tangent at X = 0": "tangent at $X = 0$",
    "tangent at rest": "tangent at equilibrium",
}


def of_amplitude(amplitude: float) -> str:
    """How the title of a panel names the heave amplitude of the platform (m)."""
    return f"heave amplitude {amplitude:g} m"
