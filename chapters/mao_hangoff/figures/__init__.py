"""Figures of the chapter, a file a subject."""
