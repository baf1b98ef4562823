"""Import of OrcaFlex text models (decks) as scenes."""

from riserstudy.importers.orcaflex.read import Imported, as_text, read_deck

__all__ = ["Imported", "as_text", "read_deck"]
