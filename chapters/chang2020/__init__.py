"""Chang, Wu, Zhang, Chen 2020: what is derived from its runs, drawn and claimed."""
