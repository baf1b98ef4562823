"""Parameter studies of deepwater drilling risers: simulate, store, grade and draw."""

__version__ = "0.1.0"
