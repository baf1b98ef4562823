"""Import of files of other programs as scenes, or as tables for scenes."""
