"""All benchmarks, one after the other: what ``make bench`` runs."""

import compare
import explicit
import prices
import vortices

if __name__ == "__main__":
    compare.main()
    explicit.main()
    prices.main(list(prices.SCENES))
    vortices.main()
