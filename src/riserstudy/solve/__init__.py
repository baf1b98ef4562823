"""Arrays in, arrays out: statics, time stepping, modes. It uses effect records, but no scene and no files."""
