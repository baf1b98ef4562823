"""Files of other programs and of measurements: tables of text, and time series that QATS reads."""
