"""Liu et al. 2020: what is derived from its runs, drawn and claimed."""
