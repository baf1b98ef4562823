"""What papers printed, as data, and how simulations come out beside it."""
