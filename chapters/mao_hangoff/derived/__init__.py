"""Derived datasets of the chapter, one file per subject."""
