"""The engine measured: what accuracy costs, what stays stable, which effects matter, what is known."""
