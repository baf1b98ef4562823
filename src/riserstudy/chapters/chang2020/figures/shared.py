"""What figures of this chapter have in common: labels, models, interpretations."""

from __future__ import annotations

MODELS = {"gas law": "-", "linear": "--"}
AMPLITUDE, TIME = "heave amplitude of the platform (m)", "time (s)"
