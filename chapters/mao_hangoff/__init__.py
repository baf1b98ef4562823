"""Mao, Zeng, Liu: what is derived from its runs, drawn and claimed."""
