"""All benchmarks, one after the other: what ``make bench`` runs."""

import compare
import explicit

if __name__ == "__main__":
    compare.main()
    explicit.main()
