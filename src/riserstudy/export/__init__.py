"""Scenes as decks of other programs."""
