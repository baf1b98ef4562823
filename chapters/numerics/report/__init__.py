"""Measurements of the engine in the report: three answers on its first screen, and a section."""
