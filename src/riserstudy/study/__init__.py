"""Grids of scenes: study files, their points, the point store, and the resulting datasets."""
