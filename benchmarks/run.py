"""All benchmarks, one after the other: what ``make bench`` runs."""

import s2c

if __name__ == "__main__":
    s2c.main()
