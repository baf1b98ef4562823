"""Measurement of the datasets: one file per dataset, with a function of its name."""
