"""Arrays in, arrays out: statics, time stepping, modes. Knows effect records, no scene, no files."""
