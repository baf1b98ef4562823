"""What measures the datasets: a file a dataset, with a function of its name."""
