"""The engine measured: what is derived from its runs, drawn and claimed."""
