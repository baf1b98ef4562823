"""Bench scenes: figures of their runs."""
