"""All benchmarks, one after the other: what ``make bench`` runs."""

import compare

if __name__ == "__main__":
    compare.main()
