"""Computation of all reference solutions, which `make references` starts."""
