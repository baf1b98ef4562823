"""Years of sea: records of sea states, and the hours and windows that they leave for work."""
