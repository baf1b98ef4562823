"""Fatigue over years: damage in a study's sea states, weighted by their frequency of occurrence."""
