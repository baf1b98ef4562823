"""A file an effect: its case, its plain version, its closed form."""
