"""Files of other programs and measurements: tables of text, and time series that QATS reads."""
