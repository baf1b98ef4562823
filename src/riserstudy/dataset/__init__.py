"""What runs return: arrays, their names and labels, and how datasets are opened and compared."""
