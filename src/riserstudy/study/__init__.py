"""Grids of scenes: what a study file asks for, its points, their store, and the datasets they become."""
