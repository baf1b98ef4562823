"""Tension, offsets and watch circles of a generic drilling riser: what is derived and drawn."""
