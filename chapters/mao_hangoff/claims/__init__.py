"""Claims of the chapter, a file a subject."""
