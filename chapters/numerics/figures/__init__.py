"""Figures of the chapter, one file per subject."""
