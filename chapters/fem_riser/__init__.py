"""The finite-element riser: what is derived from its runs, drawn and claimed."""
