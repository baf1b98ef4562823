"""Results of runs: arrays with names and labels, and how datasets are opened and compared."""
