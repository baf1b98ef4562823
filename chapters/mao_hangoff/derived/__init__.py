"""Derived of the chapter, a file a subject."""
