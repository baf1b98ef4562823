"""Results against which the numbers, claims and errata of Liu et al. 2020 are checked."""
