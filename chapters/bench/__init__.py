"""Bench scenes: what is derived from its runs, drawn and claimed."""
