"""What the report shows of the engine measured: three answers on its first screen, and a section."""
