"""Mao, Zeng, Liu: derived datasets, figures and claims."""
