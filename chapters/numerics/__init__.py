"""Measurements of the engine: cost of accuracy, stability, importance of effects, known solutions."""
