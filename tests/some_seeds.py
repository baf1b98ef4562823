"""Seeds of a test that is slow: the first few in `make test-all`, the others in `make test-slow`."""

import pytest


def seeds(number, few):
    """The seeds from 0 on, of which those after the first few are left to the slow tests."""
    return [*range(few), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(few, number))]
