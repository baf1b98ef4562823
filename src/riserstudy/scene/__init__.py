"""Scenes: the parts of a riser system, in the units of their source, with the origin of each value."""
