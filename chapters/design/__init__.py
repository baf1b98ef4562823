"""Tension, offsets and watch circles of a generic drilling riser: derived datasets and figures."""
