"""Quantities that derived datasets, figures and checks all take from datasets; they know nothing else."""
