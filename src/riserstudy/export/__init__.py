"""Export of scenes as input files (decks) of other programs."""
