"""Records that several packages exchange, each defined once, so that no data are parsed from sentences."""
