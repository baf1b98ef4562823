"""Fatigue over years: damage of a study's sea states by how often each occurs."""
