"""Liu et al. 2017: what is derived from its runs, drawn and claimed."""
