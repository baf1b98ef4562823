"""OrcaFlex text models: decks become scenes, and scenes become decks."""

from riserstudy.importers.orcaflex.read import Imported, as_text, read_deck

__all__ = ["Imported", "as_text", "read_deck"]
