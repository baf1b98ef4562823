"""Scenes: what is there, in the units of its source, and where each value comes from."""
