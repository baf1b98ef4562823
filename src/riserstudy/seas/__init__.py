"""Years of sea: records of sea states, workable hours, and weather windows."""
