"""Claims of the chapter, one file per subject."""
